"""Feedback as it goes to clients: numbered, and kept for those who resume."""

from collections import deque
from dataclasses import dataclass

from reactive_realizer.feedback.feedback_manager import Report
from reactive_realizer.limits import Limits
from reactive_realizer.server.audience import Audience
from reactive_realizer.server.posix import with_posix_times
from reactive_realizer.server.protocol import encode


@dataclass(frozen=True, slots=True)
class Entry:
    """A feedback message with its number; ``text`` is the message of the protocol."""

    seq: int
    text: str


class FeedbackLog:
    """Numbers feedback from 1 and keeps the last.

    Args:
        session: id of this run.
        epoch: POSIX time (s) of realizer time 0.
        limits: how much of it is kept.

    Attributes:
        seq: number of the last message.
        audience: is told every message.
    """

    def __init__(self, session: str, epoch: float, limits: Limits) -> None:
        self.seq = 0
        self.audience: Audience[Entry] = Audience()
        self._session = session
        self._epoch = epoch
        self._limits = limits
        self._kept: deque[Entry] = deque()
        self._bytes = 0

    def append(self, report: Report) -> None:
        """Take a message in and tell everybody."""
        self.seq += 1
        message = {
            "type": "feedback",
            "session": self._session,
            "seq": self.seq,
            "time": round(report.time, 6),
            "xml": with_posix_times(report, self._epoch),
        }
        entry = Entry(self.seq, encode(message))
        self._keep(entry)
        self.audience.tell(entry)

    def after(self, seq: int) -> list[Entry]:
        """The messages after a number, as far as they are kept."""
        return [entry for entry in self._kept if entry.seq > seq]

    @property
    def forgotten(self) -> int:
        """Number of the last message that is not kept any more; 0 if all are."""
        return self._kept[0].seq - 1 if self._kept else self.seq

    def _keep(self, entry: Entry) -> None:
        self._kept.append(entry)
        self._bytes += len(entry.text)
        most, most_bytes = self._limits.remembered_feedback, self._limits.remembered_feedback_bytes
        while len(self._kept) > most or self._bytes > most_bytes:
            self._bytes -= len(self._kept.popleft().text)
