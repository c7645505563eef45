"""The blocks of all characters: those alive, and what is remembered of those that have ended."""

from collections.abc import Iterable
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.scheduler.bml_block import BlockState, BMLBlock


@dataclass(frozen=True, slots=True)
class Ended:
    """All that is kept of an ended block."""

    key: BlockKey
    state: BlockState
    time: GlobalTime


class Blocks:
    """Blocks by name, in order of arrival.

    Args:
        remembered: how many ended blocks are kept.
    """

    def __init__(self, remembered: int) -> None:
        self._remembered = remembered
        self._alive: dict[BlockKey, BMLBlock] = {}
        self._ended: dict[BlockKey, Ended] = {}

    def __contains__(self, key: BlockKey) -> bool:
        return key in self._alive

    @property
    def alive(self) -> tuple[BMLBlock, ...]:
        """Accepted and not ended, in order of arrival."""
        return tuple(self._alive.values())

    @property
    def ended(self) -> tuple[Ended, ...]:
        """The last ones that ended, in order of ending."""
        return tuple(self._ended.values())

    def of(self, character: str) -> list[BMLBlock]:
        """The blocks of one character that are alive."""
        return [block for block in self._alive.values() if block.key.character == character]

    def get(self, key: BlockKey) -> BMLBlock | None:
        """The block alive of exactly that name."""
        return self._alive.get(key)

    def last_of(self, character: str) -> list[BMLBlock]:
        """The blocks of a character that no other one waits for: when they have ended, all have.

        Those that are preplanned and not activated do not count.
        """
        own = [block for block in self.of(character) if not block.asleep]
        awaited = {wait.target for block in own for wait in block.waits if not wait.chunk}
        return [block for block in own if block not in awaited]

    def has_ended(self, character: str, block: str) -> bool:
        """Whether a name is remembered as that of an ended block, of the character or of any other."""
        return BlockKey(character, block) in self._ended or any(key.block == block for key in self._ended)

    def find(self, character: str, block: str) -> BMLBlock | None:
        """The block alive that a reference names: the character's own, else the first of any other character.

        Where the own one has ended, nothing is named: that others use the same id is their affair.
        """
        key = BlockKey(character, block)
        if key in self._alive or key in self._ended:
            return self._alive.get(key)
        return next((other for other in self._alive.values() if other.key.block == block), None)

    def planned_before(self, block: BMLBlock) -> list[BMLBlock]:
        """The blocks in preparation that are to be planned before one that is in preparation too.

        They are those whose points it names, and of those whose parameters it changes the ones that came before it.
        """
        changed = self._preparing(block, block.mentions.parameters)
        return [
            *self._preparing(block, block.mentions.points),
            *(other for other in changed if other.arrival < block.arrival),
        ]

    def add(self, block: BMLBlock) -> None:
        """A block was accepted."""
        self._alive[block.key] = block

    def end(self, block: BMLBlock, time: GlobalTime) -> None:
        """A block has ended."""
        self._alive.pop(block.key, None)
        self._ended.pop(block.key, None)
        self._ended[block.key] = Ended(block.key, block.state, time)
        while len(self._ended) > self._remembered:
            self._ended.pop(next(iter(self._ended)))

    def _preparing(self, block: BMLBlock, ids: Iterable[str]) -> list[BMLBlock]:
        """The blocks in preparation among those that a block names."""
        found = (self.find(block.key.character, id_) for id_ in ids)
        return [other for other in found if other is not None and other.state is BlockState.IN_PREP]
