"""Writes the predictions of anticipators on the peg board."""

from math import isfinite

from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.errors import NotANumber, RealizerError
from reactive_realizer.pegboard.peg_key import PegKey, anticipator_key
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import AnticipatorPeg

_SHARE = 10
"""The part of the points, a tenth, that is forgotten at once."""


class PredictedPoints:
    """The points of all anticipators; its methods are called within a transaction.

    Args:
        board: of the points.
        limit: number of points on the board; beyond it, points that nobody needs make room for new ones.
    """

    def __init__(self, board: PegBoard, limit: int) -> None:
        self._board = board
        self._limit = limit
        self._coming: dict[PegKey, None] = {}
        """The recurring points with a prediction."""
        self._last: dict[PegKey, list[AnticipatorPeg]] = {}
        """The pegs of the last occurrence of each recurring point."""
        self._revoked: dict[PegKey, list[AnticipatorPeg]] = {}
        """Pegs of occurrences that did not count; they move with the next one."""

    def predict(self, anticipator: str, sync: str, time: Time, now: GlobalTime) -> None:
        """Predict the time of a point; None withdraws the prediction.

        Since messages are late, a point that has not passed is never set before ``now``. A point that has passed keeps
        its time, unless it is to happen again.

        Raises:
            RealizerError: the time is not finite.
        """
        if time is not None and not isfinite(time):
            raise RealizerError(NotANumber())
        key = anticipator_key(anticipator, sync)
        self._make_room(key, now)
        peg = self._board.predicted(anticipator, sync)
        if time is not None and time < now:
            if is_due(peg.value, now):
                return
            time = now
        for each in (peg, *self._revoked.get(key, ())):
            each.set(time)
        owner = self._board.anticipators.get(anticipator)
        if owner is not None and owner.recurs(sync):
            self._coming[key] = None
            self._pass(key, now)

    def renew(self, now: GlobalTime) -> None:
        """Have the name of each recurring point that has passed mean the next occurrence."""
        for key in tuple(self._coming):
            self._pass(key, now)

    def revoke(self, anticipator: str, sync: str) -> None:
        """Have what depends on the last occurrence of a recurring point, and has not begun, wait for the next one."""
        key = anticipator_key(anticipator, sync)
        time = self._board.predicted(anticipator, sync).value
        pegs = [peg for peg in self._last.pop(key, ()) if peg.dependents]
        for peg in pegs:
            peg.set(time)
        self._revoked.setdefault(key, []).extend(pegs)

    def _pass(self, key: PegKey, now: GlobalTime) -> None:
        peg = self._board.predicted(key.behavior or "", key.sync)
        if peg.value is None or is_due(peg.value, now):
            del self._coming[key]
        if is_due(peg.value, now):
            self._last[key] = [peg, *self._revoked.pop(key, ())]
            self._board.renew(key.behavior or "", key.sync)

    def _make_room(self, key: PegKey, now: GlobalTime) -> None:
        """Make the board forget points that nobody needs, if a new one would exceed the limit.

        It forgets many at a time, because it takes a look at all of them.
        """
        if self._board.get(key) is not None:
            return
        excess = len(self._board.predicted_points) + 1 - self._limit
        if excess > 0:
            self._board.forget_points(self._board.unneeded_points(now)[: max(excess, self._limit // _SHARE)])
