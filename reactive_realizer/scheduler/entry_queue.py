"""Blocks and procedures that have arrived and have not entered yet, because a tick has only so much time."""

from collections import Counter, deque
from dataclasses import dataclass

from reactive_realizer.bml.block import BehaviorBlock, Parsed
from reactive_realizer.bml.extensions import Activate, Interrupt
from reactive_realizer.scheduler.named_blocks import named_blocks


@dataclass(frozen=True, slots=True)
class Entry:
    """What is to enter.

    Attributes:
        number: of arrival.
        parsed: as it was read.
        character: id of its character, which may not exist.
        names_others: whether it may name blocks or procedures that arrived before.
    """

    number: int
    parsed: Parsed
    character: str
    names_others: bool


class EntryQueue:
    """Entries by character, in order of arrival.

    An entry that may name others, such as a block that refers to another block, enters after all earlier ones.

    Args:
        characters: ids of the characters; the first one gets what names none, or an unknown one.
    """

    def __init__(self, characters: tuple[str, ...]) -> None:
        self._characters = characters
        self._arrived = 0
        self._entries: dict[int, Entry] = {}
        self._lanes: dict[str, deque[Entry]] = {character: deque() for character in characters}
        self._names: Counter[str] = Counter()

    def __bool__(self) -> bool:
        """Return whether blocks or procedures are waiting to enter."""
        return bool(self._entries)

    def __contains__(self, name: object) -> bool:
        """Whether a block with an id has not entered yet."""
        return name in self._names

    @property
    def waiting(self) -> tuple[Parsed, ...]:
        """What has not entered yet, in order of arrival."""
        return tuple(entry.parsed for entry in self._entries.values())

    def add(self, parsed: Parsed) -> None:
        """Add what has arrived."""
        self._arrived += 1
        character = (parsed.block and parsed.block.character) or self._characters[0]
        entry = Entry(self._arrived, parsed, character, _names_others(parsed))
        self._entries[entry.number] = entry
        self._lane(entry).append(entry)
        if parsed.block is not None:
            self._names[parsed.block.id] += 1

    def first(self, character: str) -> Entry | None:
        """The entry of a character that may enter now."""
        lane = self._lanes[character]
        if not lane or (lane[0].names_others and lane[0].number != next(iter(self._entries))):
            return None
        return lane[0]

    def remove(self, entry: Entry) -> None:
        """Remove the first entry of a character."""
        self._lane(entry).popleft()
        del self._entries[entry.number]
        if entry.parsed.block is not None:
            name = entry.parsed.block.id
            self._names[name] -= 1
            if not self._names[name]:
                del self._names[name]

    def _lane(self, entry: Entry) -> "deque[Entry]":
        return self._lanes.get(entry.character, self._lanes[self._characters[0]])


def _names_others(parsed: Parsed) -> bool:
    """Whether something may name blocks or procedures that arrived before."""
    block = parsed.block
    return block is None or bool(
        block.procedure or _composed(block) or named_blocks(block).all or any(map(_controls, block.behaviors))
    )


def _composed(block: BehaviorBlock) -> tuple[str, ...]:
    """The ids in the attributes that relate a block to others."""
    joined = (*block.append_after, *block.chunk_after, *block.prepend_before, *block.chunk_before)
    return (*joined, *block.interrupts, *block.on_start)


def _controls(behavior: object) -> bool:
    return isinstance(behavior, Activate | Interrupt)
