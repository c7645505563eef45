"""Predictions of clients that move many sync points take turns: a tick has only so much time to move them."""

from collections.abc import Callable, Iterable

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.peg_key import PegKey, anticipator_key
from reactive_realizer.realizer.inputs import Input, Prediction

_MOVES = 1000
"""Pegs that the predictions of a tick may move; what is more is taken from the next ones. To move one takes 5 us."""

_KNOWN = 1.0
"""Time for which numbers of pegs that points move are known, s: counting takes a tenth as long as moving."""

Waiting = tuple[GlobalTime, int, Input]
"""An input with the time at which it enters, and its number."""


class PredictionTurns:
    """Chooses the predictions that enter in a tick; of a point that has to wait for its turn, the last one.

    Args:
        moved: returns the number of pegs that move with a predicted point.
    """

    def __init__(self, moved: Callable[[PegKey], int]) -> None:
        self._moved = moved
        self._left = 0
        self._known: dict[PegKey, int] = {}
        self._forgotten = GlobalTime(0.0)

    def choose(self, due: Iterable[Waiting], now: GlobalTime) -> tuple[list[Input], list[Waiting]]:
        """The inputs of those that are due that enter in this tick, and the predictions that wait; in their order."""
        self._left = min(self._left, 0) + _MOVES
        entering: list[Input] = []
        entered, held = set[PegKey](), dict[PegKey, Waiting]()
        for at, number, entry in due:
            key = anticipator_key(entry.anticipator, entry.sync) if isinstance(entry, Prediction) else None
            if key is None or key in entered:
                entering.append(entry)
            elif key in held:
                held[key] = (*held[key][:2], entry)
            elif self._left > 0:
                self._left -= self._work(key, now)
                entered.add(key)
                entering.append(entry)
            else:
                held[key] = (at, number, entry)
        return entering, list(held.values())

    def _work(self, key: PegKey, now: GlobalTime) -> int:
        """The number of pegs that move with a point, and the point, as far as is known."""
        if now >= self._forgotten + _KNOWN:
            self._known.clear()
            self._forgotten = now
        if key not in self._known:
            self._known[key] = 1 + self._moved(key)
        return self._known[key]
