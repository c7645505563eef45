"""A watch: tells which items hang on pegs that have moved."""

from collections.abc import Callable, Iterable
from typing import Generic, TypeVar

from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.reactive.graph import Change, Subscription

T = TypeVar("T")


class Watch(Generic[T]):
    """Observes the pegs of items; a peg may belong to several.

    Args:
        moved: called with an item and the change of one of its pegs, after each commit that moved the peg.
    """

    def __init__(self, moved: Callable[[T, Change], object]) -> None:
        self._moved = moved
        self._pegs: dict[T, dict[TimeCell, None]] = {}
        self._items: dict[TimeCell, dict[T, None]] = {}
        self._subscriptions: dict[TimeCell, Subscription] = {}

    def follow(self, item: T, pegs: Iterable[TimeCell]) -> None:
        """Observe these pegs for an item, and no others any more."""
        old, new = self._pegs.get(item, {}), dict.fromkeys(pegs)
        if old.keys() == new.keys():
            return
        self._pegs[item] = new
        for peg in new:
            if peg not in old:
                self._join(peg, item)
        for peg in old:
            if peg not in new:
                self._leave(peg, item)

    def forget(self, item: T) -> None:
        """Observe nothing any more for an item."""
        for peg in self._pegs.pop(item, ()):
            self._leave(peg, item)

    def following(self, pegs: Iterable[TimeCell]) -> list[T]:
        """The items for which any of some pegs is observed, each once."""
        return list(dict.fromkeys(item for peg in pegs for item in self._items.get(peg, ())))

    def _join(self, peg: TimeCell, item: T) -> None:
        items = self._items.get(peg)
        if items is None:
            self._items[peg] = {item: None}
            self._subscriptions[peg] = peg.observe(self._note)
        else:
            items[item] = None

    def _leave(self, peg: TimeCell, item: T) -> None:
        items = self._items[peg]
        del items[item]
        if not items:
            del self._items[peg]
            self._subscriptions.pop(peg).dispose()

    def _note(self, change: Change) -> None:
        for item in tuple(self._items.get(change.cell, ())):
            self._moved(item, change)
