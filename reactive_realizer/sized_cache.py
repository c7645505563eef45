"""A cache that is limited by the size of what it holds, because clients determine the size of each entry."""

from collections import OrderedDict
from collections.abc import Hashable
from typing import Generic, TypeVar

K = TypeVar("K", bound=Hashable)
V = TypeVar("V")


class SizedCache(Generic[K, V]):
    """Values by key; those that were used longest ago make room for new ones.

    Args:
        limit: of the sum of all sizes.
    """

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._size = 0
        self._kept: OrderedDict[K, tuple[V, int]] = OrderedDict()

    def __len__(self) -> int:
        """Return the number of values."""
        return len(self._kept)

    def get(self, key: K) -> V | None:
        """The value of a key; None if there is none any more."""
        if key not in self._kept:
            return None
        self._kept.move_to_end(key)
        return self._kept[key][0]

    def add(self, key: K, value: V, size: int) -> None:
        """Keep a value; one that is larger than the limit is not kept."""
        if key in self._kept or size > self._limit:
            return
        self._kept[key] = value, size
        self._size += size
        while self._size > self._limit:
            self._size -= self._kept.popitem(last=False)[1][1]
