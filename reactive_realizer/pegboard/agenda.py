"""An agenda: items by the times at which they are next due, which follow pegs."""

from collections.abc import Callable, Iterable
from functools import partial
from heapq import heapify, heappop, heappush
from typing import Generic, NamedTuple, TypeVar

from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.reactive.graph import Subscription

T = TypeVar("T")

_FEW = 32
"""Outdated entries of the heap that are left there."""


class _Entry(NamedTuple):
    """When an item is due, as far as it was read; ``number`` is unique."""

    number: int
    time: Time
    pegs: tuple[TimeCell, ...]
    subscriptions: tuple[Subscription, ...]


class Agenda(Generic[T]):
    """Items by the times at which they are next due.

    An item is read when it is added, and again only when one of its pegs has moved or after `note`. An item that waits
    costs nothing.

    Args:
        due: returns the time at which an item is next due; None while it is unknown.
        pegs: returns the pegs on which this time depends.
        wake: called when an item is to be read again.
    """

    def __init__(
        self,
        due: Callable[[T], Time],
        pegs: Callable[[T], Iterable[TimeCell]],
        wake: Callable[[], object] = lambda: None,
    ) -> None:
        self.wake = wake
        self._due = due
        self._pegs = pegs
        self._entries: dict[T, _Entry] = {}
        self._unread: dict[T, None] = {}
        self._items: dict[int, T] = {}
        self._heap: list[tuple[GlobalTime, int]] = []
        self._number = 0

    def add(self, item: T) -> None:
        """Add an item."""
        self._entries[item] = _Entry(self._next_number(item), None, (), ())
        self.note(item)

    def remove(self, item: T) -> None:
        """Remove an item, if it is on the agenda."""
        self._unread.pop(item, None)
        entry = self._entries.pop(item, None)
        if entry is not None:
            del self._items[entry.number]
            for subscription in entry.subscriptions:
                subscription.dispose()

    def note(self, item: T) -> None:
        """Note that an item has changed; an item that is not on the agenda is ignored."""
        if item in self._entries:
            self._unread[item] = None
            self.wake()

    @property
    def next_due(self) -> Time:
        """The earliest time at which an item is due; None while no time is known."""
        self._read()
        while self._heap and self._heap[0][1] not in self._items:
            heappop(self._heap)
        return self._heap[0][0] if self._heap else None

    def take_due(self, now: GlobalTime) -> list[T]:
        """The items that are due, in order of time. Each is read again before the next call."""
        due: list[T] = []
        while is_due(self.next_due, now):
            item = self._items[heappop(self._heap)[1]]
            due.append(item)
        self._unread.update(dict.fromkeys(due))
        return due

    def _read(self) -> None:
        """Read the items that have changed."""
        while self._unread:
            item = next(iter(self._unread))
            time = self._due(item)
            entry, pegs = self._entries[item], tuple(dict.fromkeys(self._pegs(item)))
            subscriptions = entry.subscriptions
            if pegs != entry.pegs:
                for subscription in subscriptions:
                    subscription.dispose()
                subscriptions = tuple([peg.observe(partial(self._note_move, item)) for peg in pegs])
            del self._items[entry.number]
            self._entries[item] = _Entry(self._next_number(item), time, pegs, subscriptions)
            if time is not None:
                heappush(self._heap, (time, self._number))
            del self._unread[item]
        if len(self._heap) > 2 * len(self._entries) + _FEW:
            self._heap = [each for each in self._heap if each[1] in self._items]
            heapify(self._heap)

    def _note_move(self, item: T, _: object) -> None:
        self.note(item)

    def _next_number(self, item: T) -> int:
        self._number += 1
        self._items[self._number] = item
        return self._number
