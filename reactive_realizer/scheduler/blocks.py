"""The blocks of all characters: those alive, and a record of those that ended last."""

from collections.abc import Iterable
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.errors import Fault, SchedulingFault, TargetFault
from reactive_realizer.pegboard.agenda import Agenda
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.scheduler.block_state import BlockState
from reactive_realizer.scheduler.block_watch import BlockWatch
from reactive_realizer.scheduler.bml_block import BMLBlock


class NoSuchBlock(TargetFault):
    """No block ever had the id."""

    code = "no-such-block"
    template = "there has never been a block '{block}'"
    unknown = "block"
    block: str
    known: tuple[str, ...] = ()


class BlockEnded(SchedulingFault):
    """A block that has ended."""

    code = "block-ended"
    template = "the block '{block}' has ended"
    block: str


@dataclass(frozen=True, slots=True)
class EndedBlock:
    """The record of an ended block."""

    key: BlockKey
    state: BlockState
    time: GlobalTime


class Blocks:
    """Blocks by name, in order of arrival.

    Args:
        remembered: how many ended blocks are kept.

    Attributes:
        starting: those that are planned, by their starts.
        watch: observes those that are alive.
    """

    def __init__(self, remembered: int) -> None:
        self.starting: Agenda[BMLBlock] = Agenda(_start, lambda block: (block.start,))
        self.watch = BlockWatch()
        self._remembered = remembered
        self._alive: dict[BlockKey, BMLBlock] = {}
        self._ended: dict[BlockKey, EndedBlock] = {}

    @property
    def alive(self) -> tuple[BMLBlock, ...]:
        """Accepted and not ended, in order of arrival."""
        return tuple(self._alive.values())

    @property
    def ended(self) -> tuple[EndedBlock, ...]:
        """Those that ended last, in order of ending."""
        return tuple(self._ended.values())

    def of(self, character: str) -> list[BMLBlock]:
        """The blocks of one character that are alive."""
        return [block for block in self._alive.values() if block.key.character == character]

    def get(self, key: BlockKey) -> BMLBlock | None:
        """The block alive of exactly that name."""
        return self._alive.get(key)

    def last_of(self, character: str) -> list[BMLBlock]:
        """The blocks of a character, except for preplanned ones, that no other block waits for."""
        own = [block for block in self.of(character) if not block.awaits_activation]
        awaited = {each.block for block in own for each in block.predecessors if not each.chunk}
        return [block for block in own if block not in awaited]

    def has_ended(self, character: str, block: str) -> bool:
        """Whether a name is remembered as that of an ended block, of the character or of any other."""
        return BlockKey(character, block) in self._ended or any(key.block == block for key in self._ended)

    def find(self, character: str, block: str) -> BMLBlock | None:
        """The block alive that a reference names: the character's own, else the first of any other character.

        An own block that has ended hides the blocks of other characters with the same id.
        """
        key = BlockKey(character, block)
        if key in self._alive or key in self._ended:
            return self._alive.get(key)
        return next((other for other in self._alive.values() if other.key.block == block), None)

    def missing(self, character: str, name: str) -> Fault:
        """The fault of naming a block that is not alive: "block-ended" or "no-such-block"."""
        if self.has_ended(character, name):
            return BlockEnded(block=name)
        return NoSuchBlock(block=name, known=self.names(character))

    def names(self, character: str) -> tuple[str, ...]:
        """The ids of the blocks of a character that are alive."""
        return tuple(block.key.block for block in self.of(character))

    def planned_before(self, block: BMLBlock) -> list[BMLBlock]:
        """The blocks in preparation whose points a block names, and the earlier ones whose parameters it changes."""
        changed = self._preparing(block, block.named_blocks.parameters)
        earlier = [other for other in changed if other.arrival < block.arrival]
        return self._preparing(block, block.named_blocks.points) + earlier

    def add(self, block: BMLBlock) -> None:
        """Add an accepted block."""
        self._alive[block.key] = block
        self.starting.add(block)
        self.watch.follow(block)

    def end(self, block: BMLBlock, time: GlobalTime) -> None:
        """Move a block from those alive to those ended."""
        self._alive.pop(block.key, None)
        self.starting.remove(block)
        self.watch.forget(block)
        self._ended.pop(block.key, None)
        self._ended[block.key] = EndedBlock(block.key, block.state, time)
        while len(self._ended) > self._remembered:
            self._ended.pop(next(iter(self._ended)))

    def _preparing(self, block: BMLBlock, ids: Iterable[str]) -> list[BMLBlock]:
        """The blocks in preparation among those that a block names."""
        found = (self.find(block.key.character, id_) for id_ in ids)
        return [other for other in found if other is not None and other.state is BlockState.IN_PREP]


def _start(block: BMLBlock) -> Time:
    return block.start.value if block.state is BlockState.LURKING else None
