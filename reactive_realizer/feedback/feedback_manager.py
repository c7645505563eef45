"""Collects feedback and delivers it in one order."""

import logging
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from operator import itemgetter
from typing import NamedTuple

from reactive_realizer.clock.ticker import RATE
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.feedback.messages import (
    BlockProgress,
    FallFeedback,
    Feedback,
    PredictionFeedback,
    SyncPointProgress,
    WarningFeedback,
)
from reactive_realizer.feedback.xml import to_xml

logger = logging.getLogger(__name__)

_MOST_LOGGED = 20
"""Warnings of a tick that are written to the log: a block can cause a thousand, which would take many ticks."""


@dataclass(frozen=True)
class Report:
    """A message as it goes out.

    Attributes:
        time: of the tick that reported, s; the message carries the time of its peg.
    """

    time: GlobalTime
    message: Feedback

    @cached_property
    def xml(self) -> str:
        """The message as one line of XML."""
        return to_xml(self.message)


class ProgressOrder(NamedTuple):
    """The order of progress within a tick: by time, then by block, behavior and sync point."""

    time: float
    block_start: float
    block_arrival: int
    behavior: float
    sync: int


class FeedbackManager:
    """Collects the messages of a tick and sends them to every listener; one that fails does not stop the others."""

    def __init__(self) -> None:
        self._listeners: list[Callable[[Report], None]] = []
        self._messages: list[Feedback] = []
        self._progress: list[tuple[ProgressOrder, BlockProgress | SyncPointProgress]] = []

    def listen(self, listener: Callable[[Report], None]) -> Callable[[], None]:
        """Send a listener every report from now on, until the returned function is called."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener) if listener in self._listeners else None

    def add(self, message: WarningFeedback | PredictionFeedback | FallFeedback) -> None:
        """Send a warning, prediction or fall with this tick: in the order of adding, before all progress."""
        self._messages.append(message)

    def add_progress(self, message: BlockProgress | SyncPointProgress, order: ProgressOrder) -> None:
        """Send progress with this tick, sorted as progress is; its own time may be before the tick."""
        self._progress.append((order, message))

    @property
    def progressing(self) -> set[tuple[str, str]]:
        """Character and id of the blocks of which this tick reports progress."""
        return {(message.character, message.block) for _, message in self._progress}

    def flush(self, time: GlobalTime) -> None:
        """Send the messages of the tick at ``time`` to every listener."""
        messages = [*self._messages, *(message for _, message in sorted(self._progress, key=itemgetter(0)))]
        self._messages, self._progress = [], []
        reports = [Report(time, message) for message in messages]
        _log(reports, round(time * RATE))
        for report in reports:
            self._send(report)

    def _send(self, report: Report) -> None:
        for listener in tuple(self._listeners):
            try:
                listener(report)
            except Exception:
                logger.exception("a feedback listener failed")


def _log(reports: Sequence[Report], tick: int) -> None:
    """Write the warnings of a tick to the log, but not all of many; other messages only to debug."""
    debugging = logger.isEnabledFor(logging.DEBUG)
    warnings = 0
    for report in reports:
        is_warning = isinstance(report.message, WarningFeedback)
        warnings += is_warning
        if debugging or (is_warning and warnings <= _MOST_LOGGED):
            logger.log(logging.WARNING if is_warning else logging.DEBUG, "tick %d: %s", tick, report.xml)
    if warnings > _MOST_LOGGED and not debugging:
        logger.warning("tick %d: %d more warnings", tick, warnings - _MOST_LOGGED)
