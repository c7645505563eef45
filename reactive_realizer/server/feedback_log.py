"""Feedback as clients receive it: numbered, with POSIX times, and kept for clients that resume."""

from collections import deque
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import RealizerError
from reactive_realizer.feedback.feedback_manager import Report
from reactive_realizer.feedback.messages import PredictionFeedback, WarningFeedback
from reactive_realizer.feedback.xml import to_xml
from reactive_realizer.limits import Limits
from reactive_realizer.server.faults import FeedbackGone
from reactive_realizer.server.protocol import encode, refused
from reactive_realizer.server.subscribers import Subscribers

BlockName = tuple[str, str]
"""Character and id of a block."""


@dataclass(frozen=True, slots=True)
class Entry:
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


class FeedbackLog:
    """Numbers feedback messages from 1 and keeps the newest.

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
        self.subscribers: Subscribers[Entry] = Subscribers()
        self.ticks: Subscribers[GlobalTime] = Subscribers()
        self._session = session
        self._epoch = epoch
        self._limits = limits
        self._kept: deque[Entry] = deque()
        self._bytes = 0

    def append(self, report: Report) -> None:
        """Numbers a message, keeps it and publishes it."""
        self.seq += 1
        message = {
            "type": "feedback",
            "session": self._session,
            "seq": self.seq,
            "time": round(report.time, 6),
            "xml": to_xml(report.message, self._epoch),
        }
        about = report.message
        block = None if isinstance(about, WarningFeedback) else (about.character, about.block)
        entry = Entry(self.seq, encode(message), report.time, block, isinstance(about, PredictionFeedback))
        self._keep(entry)
        self.subscribers.publish(entry)

    def after(self, seq: int) -> list[Entry]:
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

    def _keep(self, entry: Entry) -> None:
        self._kept.append(entry)
        self._bytes += len(entry.text)
        most, most_bytes = self._limits.remembered_feedback, self._limits.remembered_feedback_bytes
        while len(self._kept) > most or self._bytes > most_bytes:
            self._bytes -= len(self._kept.popleft().text)
