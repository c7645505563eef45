"""What happens again and again at times that chance gives."""

from bisect import bisect_right
from collections import deque
from collections.abc import Callable
from operator import attrgetter
from typing import Generic, NamedTuple, TypeVar

T = TypeVar("T")


class Episode(NamedTuple, Generic[T]):
    """What is so from a time on, s."""

    since: float
    what: T


class Episodes(Generic[T]):
    """Episodes one after the other, from time 0 on; each is drawn when it is first looked at, in order.

    So they are the same whoever asks for which time first, as far back as the last `KEPT` of them reach.

    Args:
        first: what is so at first.
        draw: how long the last episode lasts, s, and what follows; from a generator that nobody else draws from.
    """

    KEPT = 64

    def __init__(self, first: T, draw: Callable[[], tuple[float, T]]) -> None:
        self._draw = draw
        self._drawn = deque([Episode(0.0, first)], self.KEPT)

    def at(self, time: float) -> tuple[Episode[T], Episode[T]]:
        """The episode of a time, and the one before it; the first one is its own predecessor."""
        while (last := self._drawn[-1].since) <= time:
            lasts, what = self._draw()
            self._drawn.append(Episode(last + lasts, what))
        now = max(0, bisect_right(self._drawn, time, key=attrgetter("since")) - 1)
        return self._drawn[now], self._drawn[max(0, now - 1)]
