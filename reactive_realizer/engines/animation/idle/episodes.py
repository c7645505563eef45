"""What happens again and again at times that chance gives."""

from bisect import bisect_right
from collections.abc import Callable
from typing import Generic, NamedTuple, TypeVar

T = TypeVar("T")


class Episode(NamedTuple, Generic[T]):
    """What is so from a time on, s."""

    since: float
    what: T


class Episodes(Generic[T]):
    """Episodes one after the other, from time 0 on; each is drawn when it is first looked at, in order.

    So they are the same whoever asks for which time first.

    Args:
        first: what is so at first.
        draw: how long the last episode lasts, s, and what follows; from a generator that nobody else draws from.
    """

    def __init__(self, first: T, draw: Callable[[], tuple[float, T]]) -> None:
        self._draw = draw
        self._starts = [0.0]
        self._whats = [first]

    def at(self, time: float) -> tuple[Episode[T], Episode[T]]:
        """The episode of a time, and the one before it; the first one is its own predecessor."""
        while self._starts[-1] <= time:
            lasts, what = self._draw()
            self._starts.append(self._starts[-1] + lasts)
            self._whats.append(what)
        now = max(0, bisect_right(self._starts, time) - 1)
        before = max(0, now - 1)
        return Episode(self._starts[now], self._whats[now]), Episode(self._starts[before], self._whats[before])
