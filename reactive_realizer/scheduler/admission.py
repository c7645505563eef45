"""Which blocks are taken in."""

from collections.abc import Iterable, Sequence

from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.words import Composition
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.peg_key import BlockKey


class Admission:
    """Judges blocks that enter at one tick, in order, each beside those that came before it.

    None of them has ended by itself when the next comes, but a REPLACE ends all blocks of its character, and a block
    may interrupt one of its own name.

    Args:
        characters: the first one is meant by a block that names none.
        most: blocks that may be alive at once.
        alive: those that are.
    """

    def __init__(self, characters: Sequence[str], most: int, alive: Iterable[BlockKey]) -> None:
        self._characters = characters
        self._most = most
        self._alive = set(alive)

    def take(self, block: BehaviorBlock, failed: bool = False) -> Fault | None:
        """Count a block among those that have entered, or say why it is refused.

        Args:
            block: as it was read.
            failed: whether something of it that was required could not be read, so that it ends at once.
        """
        key = BlockKey(block.character or self._characters[0], block.id)
        fault = self._refusal(key, block)
        if fault is not None:
            return fault.located(block.location.line, block.location.column)
        if block.composition is Composition.REPLACE:
            self._alive = {other for other in self._alive if other.character != key.character}
        if not failed:
            self._alive.add(key)
        return None

    def _refusal(self, key: BlockKey, block: BehaviorBlock) -> Fault | None:
        if key.character not in self._characters:
            return Fault("unknown-character", {"character": key.character, "known": ", ".join(self._characters)})
        if key in self._alive and key.block not in block.interrupts:
            return Fault("duplicate-block", {"block": key.block})
        if block.composition is not Composition.REPLACE and len(self._alive) >= self._most:
            return Fault("too-many-blocks", {"limit": self._most})
        return None
