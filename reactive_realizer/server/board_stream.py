"""Snapshots of the peg board for the viewer: pegs, and the commits that moved them."""

from collections import deque
from collections.abc import Callable
from itertools import islice

from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, TimePeg
from reactive_realizer.reactive.graph import Change, Commit
from reactive_realizer.server.protocol import Message, encode
from reactive_realizer.server.subscribers import Subscribers

_INTERVAL = 0.2
_MOST_PEGS = 200
_MOST_COMMITS = 50
_MOST_CHANGES = 50


class BoardStream:
    """Sends snapshots of the board to subscribers, at most five a second and only after a change.

    Args:
        board: the peg board.
        now: returns the time of the current tick, for the commits.

    Attributes:
        subscribers: of the snapshots, as texts of the protocol.
    """

    def __init__(self, board: PegBoard, now: Callable[[], GlobalTime]) -> None:
        self.subscribers: Subscribers[str] = Subscribers()
        self._board = board
        self._now = now
        self._commits: deque[tuple[GlobalTime, Commit]] = deque(maxlen=_MOST_COMMITS)
        self._sent: list[Message] = []
        self._next = now()
        board.graph.listen(self._note)

    def picture(self) -> Message:
        """The current board without commits, for a new client."""
        return self._message(self._pegs(), [])

    def publish(self) -> None:
        """Sends a snapshot if the interval is over and the board changed."""
        if not self.subscribers or not is_due(self._next, self._now()):
            return
        pegs = self._pegs()
        if not self._commits and pegs == self._sent:
            return
        commits = [_commit(time, commit) for time, commit in self._commits]
        self.subscribers.publish(encode(self._message(pegs, commits)))
        self._commits.clear()
        self._sent = pegs
        self._next = GlobalTime(self._now() + _INTERVAL)

    def _note(self, commit: Commit) -> None:
        """Keep a commit that moved pegs, or made some."""
        if not commit.changes or any(map(_is_peg, commit.changes)):
            self._commits.append((self._now(), commit))

    def _pegs(self) -> list[Message]:
        """The newest pegs, in order of naming."""
        views = self._board.snapshot(newest=_MOST_PEGS)
        return [
            {"key": str(view.key), "time": _rounded(view.time), "state": view.state, "source": view.source}
            for view in views
        ]

    def _message(self, pegs: list[Message], commits: list[Message]) -> Message:
        return {"type": "board", "time": round(self._now(), 6), "pegs": pegs, "commits": commits}


def _commit(time: GlobalTime, commit: Commit) -> Message:
    changes = [_change(change) for change in islice(filter(_is_peg, commit.changes), _MOST_CHANGES)]
    return {"sequence": commit.stamp.sequence, "time": round(time, 6), "cause": commit.stamp.cause, "changes": changes}


def _is_peg(change: Change) -> bool:
    return isinstance(change.cell, TimePeg | AnticipatorPeg)


def _change(change: Change) -> list[object]:
    return [change.cell.name, _rounded(change.old), _rounded(change.new)]


def _rounded(time: Time) -> float | None:
    return None if time is None else round(time, 6)
