"""An agenda: items by the times at which they are next due, which follow pegs."""

from collections.abc import Callable, Iterable
from heapq import heapify, heappop, heappush
from operator import itemgetter
from typing import Generic, TypeVar

from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.pegboard.watch import Watch
from reactive_realizer.reactive.errors import Failure
from reactive_realizer.reactive.graph import Change

T = TypeVar("T")

_FEW = 32
"""Outdated entries of the heap that are left there."""


class Agenda(Generic[T]):
    """Items by the times at which they are next due.

    An item is read when it is added, and again only after `note`, or after one of its pegs has moved: if that may make
    it due earlier, soon, unless it is due at the time of that peg; otherwise when the time comes that was read. An item
    that waits costs nothing, and one that is due when it is read is not put on the heap.

    Args:
        due: returns the time at which an item is next due; None while it is unknown.
        pegs: returns the pegs on which this time depends. The time may not come earlier when one of them comes later,
            and it comes at the time of a peg as long as it is that time, however much earlier the peg comes.
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
        self._watch: Watch[T] = Watch(self._note_move)
        self._numbers: dict[T, int] = {}
        self._times: dict[T, GlobalTime] = {}
        self._later: set[T] = set()
        """The items that have moved since they were read, and may be due later than at the time that is known."""
        self._unread: dict[T, None] = {}
        self._items: dict[int, T] = {}
        self._heap: list[tuple[GlobalTime, int]] = []
        self._number = 0

    def add(self, item: T) -> None:
        """Add an item."""
        self._items.pop(self._numbers.get(item, 0), None)
        self._numbers[item] = 0
        self.note(item)

    def remove(self, item: T) -> None:
        """Remove an item, if it is on the agenda."""
        self._unread.pop(item, None)
        self._times.pop(item, None)
        self._later.discard(item)
        self._watch.forget(item)
        self._items.pop(self._numbers.pop(item, 0), None)

    def note(self, item: T) -> None:
        """Note that an item has changed; an item that is not on the agenda is ignored."""
        if item in self._numbers:
            self._unread[item] = None
            self.wake()

    @property
    def next_due(self) -> Time:
        """A time before which no item is due: the earliest one that was read; None if none was known."""
        self._read()
        return self._first

    def take_due(self, now: GlobalTime) -> list[T]:
        """The items that are due, in order of time. Each is read again before the next call."""
        due: list[tuple[GlobalTime, int, T]] = []
        try:
            self._read(now, due)
            while is_due(self._first, now):
                time, number = heappop(self._heap)
                item = self._items[number]
                if item in self._later:
                    self._unread[item] = None
                else:
                    due.append((time, number, item))
                if not is_due(self._first, now):
                    self._read(now, due)
        finally:
            items = [item for _, _, item in sorted(due, key=itemgetter(0, 1))]
            self._unread.update(dict.fromkeys(items))
        return items

    @property
    def _first(self) -> Time:
        """The earliest time of the items as they were read."""
        heap = self._heap
        while heap and heap[0][1] not in self._items:
            heappop(heap)
        return heap[0][0] if heap else None

    def _note_move(self, item: T, change: Change) -> None:
        """Note that a peg of an item has moved; it is not read before the earliest time at which it can be due now."""
        time, new = self._times.get(item), change.new
        if time is None or isinstance(new, Failure):
            self.note(item)
        elif new is None or new >= time:
            self._later.add(item)
            self.wake()
        elif change.old == time:
            self._times[item] = new
            heappush(self._heap, (new, self._numbers[item]))
            self._later.add(item)
            self.wake()
        else:
            self.note(item)

    def _read(self, now: Time = None, due: list[tuple[GlobalTime, int, T]] | None = None) -> None:
        """Read the items that have changed; those that are due now are only added to ``due``."""
        while self._unread:
            for item in tuple(self._unread):
                time = self._due(item)
                number = self._renumber(item)
                self._later.discard(item)
                self._times.pop(item, None)
                if due is not None and now is not None and time is not None and is_due(time, now):
                    due.append((time, number, item))
                else:
                    self._watch.follow(item, self._pegs(item))
                    if time is not None:
                        self._times[item] = time
                        heappush(self._heap, (time, number))
                del self._unread[item]
        if len(self._heap) > 2 * len(self._numbers) + _FEW:
            times, items = self._times, self._items
            self._heap = [each for each in self._heap if (own := items.get(each[1])) and times.get(own) == each[0]]
            heapify(self._heap)

    def _renumber(self, item: T) -> int:
        """Give an item a new number; the heap's entries with the old one are outdated."""
        self._items.pop(self._numbers.get(item, 0), None)
        self._number += 1
        self._numbers[item] = self._number
        self._items[self._number] = item
        return self._number
