"""Feedback as clients receive it: numbered, with POSIX times, and kept for clients that resume."""

import asyncio
import logging
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import RealizerError
from reactive_realizer.feedback.feedback_manager import Report
from reactive_realizer.feedback.messages import Feedback, PredictionFeedback, WarningFeedback
from reactive_realizer.feedback.xml import xml_parts
from reactive_realizer.limits import Limits
from reactive_realizer.server.faults import FeedbackGone
from reactive_realizer.server.protocol import encode, refused
from reactive_realizer.server.subscribers import Subscribers

logger = logging.getLogger(__name__)

_AT_ONCE = 50
"""Parts of messages that are written within a tick; the rest is written after it, in turns of the event loop."""

_TURN = 0.002
"""Duration of a turn, s: a tick waits for it."""

_TURNS = 50
"""Turns in which everything that waits is written, even if they take longer: a backlog does not grow for long."""

BlockName = tuple[str, str]
"""Character and id of a block."""


@dataclass(frozen=True, slots=True)
class LogEntry:
    """A feedback message with its number.

    Attributes:
        text: the message of the protocol.
        time: of the tick that reported.
        block: that it is about; None for a warning.
        predicts: whether it is a prediction.
    """

    seq: int
    text: str
    time: GlobalTime
    block: BlockName | None
    predicts: bool

    def __len__(self) -> int:
        """The length of its text."""
        return len(self.text)


class FeedbackLog:
    """Numbers feedback messages from 1 and keeps the newest.

    A tick writes only so much of its feedback. The rest is written between ticks, in the same order: a tick gives turns
    to other tasks while its engines play, and none of these is for feedback.

    Args:
        session: id of this run.
        epoch: POSIX time (s) of realizer time 0.
        limits: how many messages and bytes are kept.

    Attributes:
        seq: number of the last message.
        subscribers: of the messages.
        ticks: subscribers of the times of ticks, after their messages.
    """

    def __init__(self, session: str, epoch: float, limits: Limits) -> None:
        self.seq = 0
        self.subscribers: Subscribers[LogEntry] = Subscribers()
        self.ticks: Subscribers[GlobalTime] = Subscribers()
        self._session = session
        self._epoch = epoch
        self._limits = limits
        self._kept: deque[LogEntry] = deque()
        self._bytes = 0
        self._left = _AT_ONCE
        self._waiting: deque[Report | GlobalTime] = deque()
        self._parts = 0
        self._steps: Iterator[None] = iter(())
        self._turn: asyncio.Handle | None = None
        self._ticking = False

    def append(self, report: Report) -> None:
        """Numbers a message, keeps it and publishes it, after all earlier ones."""
        parts = _parts_of(report.message)
        if self._waiting or parts > self._left:
            self._wait(report, parts)
        else:
            self._left -= parts
            self._publish(report, "".join(xml_parts(report.message, self._epoch)))

    def begin_tick(self) -> None:
        """Writes nothing until `end_tick`."""
        self._ticking = True
        if self._turn is not None:
            self._turn.cancel()
            self._turn = None

    def end_tick(self, time: GlobalTime) -> None:
        """Publishes the time of a tick, after all of its messages."""
        self._left = _AT_ONCE
        self._ticking = False
        if self._waiting:
            self._wait(time, 1)
        else:
            self.ticks.publish(time)

    def _wait(self, item: Report | GlobalTime, parts: int) -> None:
        self._waiting.append(item)
        self._parts += parts
        if len(self._waiting) == 1:
            self._steps = self._write_waiting()
        if not self._ticking and self._turn is None:
            self._turn = asyncio.get_running_loop().call_soon(self._take_turn)

    def _take_turn(self) -> None:
        loop = asyncio.get_running_loop()
        end, least = loop.time() + _TURN, self._parts // _TURNS
        for written, _ in enumerate(self._steps, 1):
            self._parts -= 1
            if written >= least and loop.time() >= end:
                break
        self._turn = loop.call_soon(self._take_turn) if self._waiting else None

    def _write_waiting(self) -> Iterator[None]:
        """Writes and publishes what waits, a part of a message in each step."""
        while self._waiting:
            item = self._waiting[0]
            try:
                if isinstance(item, Report):
                    parts = []
                    for part in xml_parts(item.message, self._epoch):
                        parts.append(part)
                        yield
                    self._publish(item, "".join(parts))
                else:
                    self.ticks.publish(item)
                    yield
            except Exception:
                logger.exception("feedback could not be published")
            self._waiting.popleft()
        self._parts = 0

    def _publish(self, report: Report, xml: str) -> None:
        self.seq += 1
        message = {
            "type": "feedback",
            "session": self._session,
            "seq": self.seq,
            "time": round(report.time, 6),
            "xml": xml,
        }
        about = report.message
        block = None if isinstance(about, WarningFeedback) else (about.character, about.block)
        entry = LogEntry(self.seq, encode(message), report.time, block, isinstance(about, PredictionFeedback))
        self._keep(entry)
        self.subscribers.publish(entry)

    def after(self, seq: int) -> list[LogEntry]:
        """The messages after a number that are still kept."""
        return [entry for entry in self._kept if entry.seq > seq]

    def gap(self, seq: int) -> str | None:
        """The error message for a client that resumes after a number; None if no message after it is forgotten."""
        forgotten = self.forgotten
        return None if seq >= forgotten else encode(refused(RealizerError(FeedbackGone(seq=forgotten))))

    @property
    def forgotten(self) -> int:
        """Number of the last message that is no longer kept; 0 if all are."""
        return self._kept[0].seq - 1 if self._kept else self.seq

    def _keep(self, entry: LogEntry) -> None:
        self._kept.append(entry)
        self._bytes += len(entry.text)
        most, most_bytes = self._limits.remembered_feedback, self._limits.remembered_feedback_bytes
        while len(self._kept) > most or self._bytes > most_bytes:
            self._bytes -= len(self._kept.popleft().text)


def _parts_of(message: Feedback) -> int:
    """The number of parts of a message."""
    return len(message.behaviors) + 2 if isinstance(message, PredictionFeedback) else 1
