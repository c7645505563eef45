"""An agenda: items by the times at which they are next due, which follow pegs."""

from collections.abc import Callable, Iterable
from heapq import heapify, heappop, heappush
from operator import itemgetter
from typing import Generic, TypeVar

from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.pegboard.peg_follower import PegFollower
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.reactive.errors import Failure
from reactive_realizer.reactive.graph import Change

T = TypeVar("T")

_FEW = 32
"""Outdated entries of the heap that are left there."""


class _Entry(PegFollower, Generic[T]):
    """An item on an agenda, which follows its pegs.

    Attributes:
        number: of its last reading; what has an earlier number is outdated. 0 before it is read, and once removed.
        time: at which it is due, as far as that is known without reading it again; None if it is unknown, or has come.
        moved: whether it may be due later than that.
    """

    __slots__ = ("_agenda", "item", "moved", "number", "time")

    def __init__(self, agenda: "Agenda[T]", item: T) -> None:
        super().__init__()
        self._agenda = agenda
        self.item = item
        self.number = 0
        self.time: Time = None
        self.moved = False

    def leave(self) -> None:
        """Follow no peg any more, and let go of the item: the heap may keep the entry for a while."""
        self.follow(())
        self.number = 0
        del self.item

    def notify(self, change: Change) -> None:
        """Have the agenda note that a peg has moved."""
        self._agenda.note_move(self, change)


_Due = tuple[GlobalTime, int, _Entry[T]]
"""An entry with the time at which it is due, and its number then."""


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
        self._entries: dict[T, _Entry[T]] = {}
        self._unread: dict[_Entry[T], None] = {}
        self._heap: list[_Due[T]] = []
        self._number = 0

    def add(self, item: T) -> None:
        """Add an item, or note that it has changed."""
        entry = self._entries.get(item)
        if entry is None:
            entry = self._entries[item] = _Entry(self, item)
        self._unread[entry] = None
        self.wake()

    def remove(self, item: T) -> None:
        """Remove an item, if it is on the agenda."""
        entry = self._entries.pop(item, None)
        if entry is not None:
            self._unread.pop(entry, None)
            entry.leave()

    def note(self, item: T) -> None:
        """Note that an item has changed; an item that is not on the agenda is ignored."""
        entry = self._entries.get(item)
        if entry is not None:
            self._unread[entry] = None
            self.wake()

    @property
    def next_due(self) -> Time:
        """A time before which no item is due: the earliest one that was read; None if none was known."""
        self._read()
        return self._first

    def take_due(self, now: GlobalTime) -> list[T]:
        """The items that are due, in order of time. Each is read again before the next call."""
        if not self._unread and not is_due(self._first, now):
            return []
        due: list[_Due[T]] = []
        try:
            self._read(now, due)
            while is_due(self._first, now):
                first = heappop(self._heap)
                if first[2].moved:
                    self._unread[first[2]] = None
                else:
                    due.append(first)
                if not is_due(self._first, now):
                    self._read(now, due)
        finally:
            entries = [entry for _, _, entry in sorted(due, key=itemgetter(0, 1))]
            self._unread.update(dict.fromkeys(entries))
        return [entry.item for entry in entries]

    @property
    def _first(self) -> Time:
        """The earliest time of the items as they were read."""
        heap = self._heap
        while heap and heap[0][1] != heap[0][2].number:
            heappop(heap)
        return heap[0][0] if heap else None

    def note_move(self, entry: _Entry[T], change: Change) -> None:
        """Note that a peg of an item has moved; it is not read before the earliest time at which it can be due now."""
        time, new = entry.time, change.new
        if time is None or isinstance(new, Failure):
            self._unread[entry] = None
        elif new is None or new >= time:
            entry.moved = True
        elif change.old == time:
            entry.time = new
            heappush(self._heap, (new, entry.number, entry))
            entry.moved = True
        else:
            self._unread[entry] = None
        self.wake()

    def _read(self, now: Time = None, due: list[_Due[T]] | None = None) -> None:
        """Read the items that have changed; those that are due now are only added to ``due``."""
        while self._unread:
            for entry in tuple(self._unread):
                item = entry.item
                time = self._due(item)
                self._number += 1
                entry.number = self._number  # what the heap has with the old one is outdated
                entry.moved = False
                if due is not None and now is not None and time is not None and is_due(time, now):
                    entry.time = None
                    due.append((time, entry.number, entry))
                else:
                    entry.time = time
                    entry.follow(self._pegs(item))
                    if time is not None:
                        heappush(self._heap, (time, entry.number, entry))
                del self._unread[entry]
        if len(self._heap) > 2 * len(self._entries) + _FEW:
            self._heap = [each for each in self._heap if each[2].number == each[1] and each[2].time == each[0]]
            heapify(self._heap)
