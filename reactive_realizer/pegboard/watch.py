"""A watch: observes the pegs of items, and tells the items of pegs that have moved."""

from collections.abc import Callable, Iterable
from typing import Generic, TypeVar

from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.reactive.graph import Change, Observer

T = TypeVar("T")


class Watch(Observer, Generic[T]):
    """Observes the pegs of items; a peg may belong to several.

    Args:
        moved: called with an item and the change of one of its pegs, after each commit that moved the peg.
    """

    def __init__(self, moved: Callable[[T, Change], object]) -> None:
        self._moved = moved
        self._pegs: dict[T, dict[TimeCell, None]] = {}
        self._items: dict[TimeCell, dict[T, None]] = {}

    def follow(self, item: T, pegs: Iterable[TimeCell]) -> None:
        """Give an item these pegs, and no others any more."""
        old, new = self._pegs.get(item, {}), dict.fromkeys(pegs)
        if old.keys() == new.keys():
            return
        self._pegs[item] = new
        for peg in [peg for peg in new if peg not in old] if old else new:
            items = self._items.get(peg)
            if items is None:
                self._items[peg] = {item: None}
                peg.attach(self)
            else:
                items[item] = None
        for peg in old:
            if peg not in new:
                self._leave(peg, item)

    def forget(self, item: T) -> None:
        """Forget an item."""
        for peg in self._pegs.pop(item, ()):
            self._leave(peg, item)

    def following(self, pegs: Iterable[TimeCell]) -> list[T]:
        """The items that have any of some pegs, each once."""
        found: dict[T, None] = {}
        for peg in pegs:
            if (items := self._items.get(peg)) is not None:
                found.update(items)
        return list(found)

    def _leave(self, peg: TimeCell, item: T) -> None:
        items = self._items[peg]
        del items[item]
        if not items:
            del self._items[peg]
            peg.detach(self)

    def notify(self, change: Change) -> None:
        """Tell the items of a peg that has moved."""
        for item in tuple(self._items.get(change[0], ())):
            self._moved(item, change)
