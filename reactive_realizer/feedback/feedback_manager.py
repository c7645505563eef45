"""Delivery of feedback, in one order."""

import logging
from collections.abc import Callable
from dataclasses import dataclass

from reactive_realizer.clock.ticker import RATE
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.feedback.messages import BlockProgress, Message, SyncPointProgress, WarningFeedback
from reactive_realizer.feedback.xml import to_xml

logger = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Report:
    """A message as it goes out.

    Attributes:
        time: of the tick that reported, s; the message has the time of its peg.
        xml: one line.
    """

    time: GlobalTime
    message: Message
    xml: str


@dataclass(frozen=True, slots=True, order=True)
class Place:
    """Where progress stands among that of the same tick: by time, then by block, behavior and sync point."""

    time: float
    block_start: float
    block_arrival: int
    behavior: float
    sync: int


class FeedbackManager:
    """Collects what a tick has to say and tells every listener, each for itself."""

    def __init__(self) -> None:
        self._listeners: list[Callable[[Report], None]] = []
        self._said: list[Message] = []
        self._progress: list[tuple[Place, int, Message]] = []

    def listen(self, listener: Callable[[Report], None]) -> Callable[[], None]:
        """Tell a listener every report from now on; the returned call ends that."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener) if listener in self._listeners else None

    def say(self, message: Message) -> None:
        """A warning or prediction: told in the order of saying, before the progress of the tick."""
        self._said.append(message)

    def progress(self, message: BlockProgress | SyncPointProgress, place: Place) -> None:
        """Something happened at a time that may lie before that of the tick."""
        self._progress.append((place, len(self._progress), message))

    def flush(self, time: GlobalTime) -> None:
        """Tell what the tick at ``time`` has to say."""
        messages = [*self._said, *(message for _, _, message in sorted(self._progress, key=lambda p: p[:2]))]
        self._said, self._progress = [], []
        for message in messages:
            self._tell(Report(time, message, to_xml(message)))

    def _tell(self, report: Report) -> None:
        level = logging.WARNING if isinstance(report.message, WarningFeedback) else logging.DEBUG
        logger.log(level, "tick %d: %s", round(report.time * RATE), report.xml)
        for listener in tuple(self._listeners):
            try:
                listener(report)
            except Exception:
                logger.exception("a feedback listener failed")
