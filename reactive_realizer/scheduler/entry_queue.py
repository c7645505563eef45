"""Blocks and procedures that have arrived and have not entered yet, because a tick has only so much time."""

from collections import deque
from collections.abc import Collection, Iterator
from dataclasses import dataclass

from reactive_realizer.bml.block import BehaviorBlock, Parsed
from reactive_realizer.bml.extensions import Activate, Interrupt
from reactive_realizer.bml.vocabulary import Composition
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import Fault
from reactive_realizer.scheduler.lanes import Lane
from reactive_realizer.scheduler.named_blocks import named_blocks

Name = tuple[str, str]
"""An id, after its kind: "block", "procedure", or "use" of a procedure."""


@dataclass(frozen=True, slots=True)
class Entry:
    """What is to enter.

    Attributes:
        number: of arrival.
        arrived: time of the tick in which it arrived, s.
        parsed: as it was read.
        character: id of its character, which may not exist.
        lane: of its client, and of a character that exists.
        names: its own.
        needed: the names before which it does not enter, if they arrived before.
        fault: why it is to be refused when it enters, if that was clear at its arrival.
    """

    number: int
    arrived: GlobalTime
    parsed: Parsed
    character: str
    lane: Lane
    names: frozenset[Name]
    needed: frozenset[Name]
    fault: Fault | None

    @property
    def replaces(self) -> bool:
        """Whether it ends all blocks of its character."""
        return self.parsed.block is not None and self.parsed.block.composition is Composition.REPLACE


class _Numbers:
    """Numbers of arrival by a key that several may have."""

    def __init__(self) -> None:
        self._numbers: dict[object, dict[int, None]] = {}

    def __contains__(self, key: object) -> bool:
        return key in self._numbers

    def add(self, key: object, number: int) -> None:
        self._numbers.setdefault(key, {})[number] = None

    def remove(self, key: object, number: int) -> None:
        del self._numbers[key][number]
        if not self._numbers[key]:
            del self._numbers[key]

    def any_before(self, key: object, number: int) -> bool:
        """Whether there is a smaller number."""
        return key in self._numbers and next(iter(self._numbers[key])) < number


class EntryQueue:
    """Entries by lane, in order of arrival.

    An entry that names blocks or procedures enters after those of them that arrived before; one that ends all blocks
    of its character, after all that arrived before for that character.

    Args:
        characters: ids of the characters; the first one gets what names none, or an unknown one.
    """

    def __init__(self, characters: tuple[str, ...]) -> None:
        self._characters = characters
        self._arrived = 0
        self._entries: dict[int, Entry] = {}
        self._lanes: dict[Lane, deque[Entry]] = {}
        self._names = _Numbers()
        self._of_character = _Numbers()
        self._replacing = _Numbers()

    def __bool__(self) -> bool:
        """Return whether blocks or procedures are waiting to enter."""
        return bool(self._entries)

    def __contains__(self, name: object) -> bool:
        """Whether a block with an id has not entered yet."""
        return ("block", name) in self._names

    @property
    def waiting(self) -> tuple[Entry, ...]:
        """What has not entered yet, in order of arrival."""
        return tuple(self._entries.values())

    @property
    def lanes(self) -> Collection[Lane]:
        """The lanes of what waits."""
        return self._lanes.keys()

    def add(self, parsed: Parsed, client: str, now: GlobalTime, fault: Fault | None = None) -> Lane:
        """Add what arrives from a client now, with why it is to be refused; its lane."""
        self._arrived += 1
        character = parsed.block.played_by(self._characters) if parsed.block else self._characters[0]
        lane = Lane(client, character if character in self._characters else self._characters[0])
        names = frozenset(_names(parsed))
        entry = Entry(self._arrived, now, parsed, character, lane, names, names.union(_needed(parsed)), fault)
        self._entries[entry.number] = entry
        self._lanes.setdefault(lane, deque()).append(entry)
        for numbers, key in self._keys(entry):
            numbers.add(key, entry.number)
        return lane

    def first(self, lane: Lane) -> Entry | None:
        """The entry of a lane that may enter now."""
        if lane not in self._lanes:
            return None
        entry = self._lanes[lane][0]
        waits = any(self._names.any_before(name, entry.number) for name in entry.needed)
        if waits or (entry.replaces and self._of_character.any_before(entry.lane.character, entry.number)):
            return None
        return entry

    def is_replaced(self, entry: Entry) -> bool:
        """Whether a later entry ends all blocks of its character."""
        return entry.lane.character in self._replacing

    def remove(self, entry: Entry) -> None:
        """Remove the first entry of a lane."""
        self._lanes[entry.lane].popleft()
        if not self._lanes[entry.lane]:
            del self._lanes[entry.lane]
        del self._entries[entry.number]
        for numbers, key in self._keys(entry):
            numbers.remove(key, entry.number)

    def _keys(self, entry: Entry) -> Iterator[tuple[_Numbers, object]]:
        """The keys of an entry in each index."""
        yield from ((self._names, name) for name in entry.names)
        yield self._of_character, entry.lane.character
        if entry.replaces:
            yield self._replacing, entry.lane.character


def _names(parsed: Parsed) -> Iterator[Name]:
    """The names of something, and that of the procedure that it uses."""
    if parsed.block is not None:
        yield "block", parsed.block.id
        if parsed.block.procedure is not None:
            yield "use", parsed.block.procedure
    elif parsed.procedure is not None:
        yield "procedure", parsed.procedure.id


def _needed(parsed: Parsed) -> Iterator[Name]:
    """The names of blocks and procedures that something names; a procedure keeps its meaning for its earlier uses."""
    block = parsed.block
    if block is None:
        yield from (("use", each) for kind, each in _names(parsed))
        return
    if block.procedure is not None:
        yield "procedure", block.procedure
    controlled = (each.target for each in block.behaviors if isinstance(each, Activate | Interrupt))
    yield from (("block", id_) for id_ in (*named_blocks(block).all, *_composed(block), *controlled))


def _composed(block: BehaviorBlock) -> tuple[str, ...]:
    """The ids in the attributes that relate a block to others."""
    joined = (*block.append_after, *block.chunk_after, *block.prepend_before, *block.chunk_before)
    accompanied = () if block.accompanies is None else (block.accompanies,)
    return (*joined, *block.interrupts, *block.on_start, *accompanied)
