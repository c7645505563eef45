"""The board as the page lists it: pegs, and what moved them."""

from collections import deque
from collections.abc import Callable
from itertools import islice

from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, TimePeg
from reactive_realizer.reactive.commit import Change, Commit
from reactive_realizer.server.audience import Audience
from reactive_realizer.server.protocol import Message

_INTERVAL = 0.2
_MOST_PEGS = 200
_MOST_COMMITS = 50
_MOST_CHANGES = 50


class BoardWatch:
    """Sends pictures of the board, at most five a second and only when something is different.

    Args:
        board: what is pictured.
        now: time of the present tick, for the commits.

    Attributes:
        audience: is told every picture, as a message of the protocol.
    """

    def __init__(self, board: PegBoard, now: Callable[[], GlobalTime]) -> None:
        self.audience: Audience[Message] = Audience()
        self._board = board
        self._now = now
        self._commits: deque[tuple[GlobalTime, Commit]] = deque(maxlen=_MOST_COMMITS)
        self._sent: list[Message] = []
        self._next = now()
        board.graph.listen(lambda commit: self._commits.append((now(), commit)))

    def picture(self) -> Message:
        """The board now, without commits: for somebody who comes."""
        return self._message(self._pegs(), [])

    def publish(self) -> None:
        """Send a picture if it is time and something is different."""
        if not self.audience or not is_due(self._next, self._now()):
            return
        pegs = self._pegs()
        if not self._commits and pegs == self._sent:
            return
        commits = [_commit(time, commit) for time, commit in self._commits]
        self.audience.tell(self._message(pegs, commits))
        self._commits.clear()
        self._sent = pegs
        self._next = GlobalTime(self._now() + _INTERVAL)

    def _pegs(self) -> list[Message]:
        """The newest, in order of naming."""
        views = self._board.snapshot(newest=_MOST_PEGS)
        return [
            {"key": str(view.key), "time": _rounded(view.time), "state": view.state, "source": view.source}
            for view in views
        ]

    def _message(self, pegs: list[Message], commits: list[Message]) -> Message:
        return {"type": "board", "time": round(self._now(), 6), "pegs": pegs, "commits": commits}


def _commit(time: GlobalTime, commit: Commit) -> Message:
    moved = (change for change in commit.changes if isinstance(change.cell, TimePeg | AnticipatorPeg))
    changes = [_change(change) for change in islice(moved, _MOST_CHANGES)]
    return {"sequence": commit.sequence, "time": round(time, 6), "cause": commit.cause, "changes": changes}


def _change(change: Change) -> list[object]:
    return [change.cell.name, _rounded(change.old), _rounded(change.new)]


def _rounded(time: Time) -> float | None:
    return None if time is None else round(time, 6)
