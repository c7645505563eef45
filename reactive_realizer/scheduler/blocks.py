"""The blocks of all characters: those alive, and a record of those that ended last."""

from collections import Counter
from collections.abc import Collection, Iterable
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.errors import Fault, SchedulingFault, TargetFault
from reactive_realizer.pegboard.agenda import Agenda
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.scheduler.block_state import BlockState
from reactive_realizer.scheduler.block_watch import BlockWatch, in_order
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.lanes import ACCOMPANIST, Lane


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


class _BlocksByName:
    """Blocks, in order of addition, by a name that several may have."""

    def __init__(self) -> None:
        self._blocks: dict[str, dict[BMLBlock, None]] = {}

    def of(self, name: str) -> Collection[BMLBlock]:
        return self._blocks.get(name, {})

    def add(self, name: str, block: BMLBlock) -> None:
        self._blocks.setdefault(name, {})[block] = None

    def remove(self, name: str, block: BMLBlock) -> None:
        named = self._blocks.get(name, {})
        named.pop(block, None)
        if not named:
            self._blocks.pop(name, None)


class Blocks:
    """Blocks by name, in order of arrival.

    Args:
        remembered: how many ended blocks are kept.

    Attributes:
        numbers: how many are alive in each lane of a client.
        behaviors: how many behaviors these have.
        starting: those that are planned, by their starts.
        watch: observes those that are alive.
    """

    def __init__(self, remembered: int) -> None:
        self.starting: Agenda[BMLBlock] = Agenda(_start, lambda block: (block.start,))
        self.numbers: Counter[Lane] = Counter()
        self.behaviors: Counter[Lane] = Counter()
        self.watch = BlockWatch()
        self._remembered = remembered
        self._alive: dict[BlockKey, BMLBlock] = {}
        self._own = _BlocksByName()
        self._last = _BlocksByName()
        self._named = _BlocksByName()
        self._ended: dict[BlockKey, EndedBlock] = {}
        self._ended_names: dict[str, int] = {}

    @property
    def alive(self) -> tuple[BMLBlock, ...]:
        """Accepted and not ended, in order of arrival."""
        return tuple(self._alive.values())

    @property
    def asked_for(self) -> tuple[BMLBlock, ...]:
        """Those alive that do not give way to others, in order of arrival."""
        return tuple(block for block in self._alive.values() if not block.gives_way)

    @property
    def ended(self) -> tuple[EndedBlock, ...]:
        """Those that ended last, in order of ending."""
        return tuple(self._ended.values())

    def of(self, character: str) -> list[BMLBlock]:
        """The blocks of one character that are alive."""
        return list(self._own.of(character))

    def __len__(self) -> int:
        """How many blocks are alive."""
        return len(self._alive)

    def get(self, key: BlockKey) -> BMLBlock | None:
        """The block alive of exactly that name."""
        return self._alive.get(key)

    def last_of(self, character: str) -> list[BMLBlock]:
        """The blocks of a character, except for preplanned ones, that no other block waits for."""
        for block in [block for block in self._last.of(character) if _is_awaited(block)]:
            self._last.remove(character, block)
        return in_order(block for block in self._last.of(character) if not block.awaits_activation)

    def has_ended(self, block: str) -> bool:
        """Whether a name is remembered as that of an ended block, of any character."""
        return block in self._ended_names

    def find(self, character: str, block: str) -> BMLBlock | None:
        """The block alive that a reference names: the character's own, else the first of any other character.

        An own block that has ended hides the blocks of other characters with the same id.
        """
        key = BlockKey(character, block)
        if key in self._alive or key in self._ended:
            return self._alive.get(key)
        return next(iter(self._named.of(block)), None)

    def missing(self, character: str, name: str) -> Fault:
        """The fault of naming a block that is not alive: "block-ended" or "no-such-block"."""
        if self.has_ended(name):
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
        if block.client != ACCOMPANIST:
            self.numbers[block.lane] += 1
            self.behaviors[block.lane] += len(block.description.behaviors)
        self._own.add(block.key.character, block)
        if not block.gives_way:
            self._last.add(block.key.character, block)
        self._named.add(block.key.block, block)
        self.starting.add(block)
        self.watch.follow(block)

    def end(self, block: BMLBlock, time: GlobalTime) -> None:
        """Move a block from those alive to those ended."""
        if self._alive.pop(block.key, None) is not None and block.client != ACCOMPANIST:
            self.numbers[block.lane] -= 1
            self.behaviors[block.lane] -= len(block.description.behaviors)
            if not self.numbers[block.lane]:
                del self.numbers[block.lane], self.behaviors[block.lane]
        self._own.remove(block.key.character, block)
        self._last.remove(block.key.character, block)
        self._named.remove(block.key.block, block)
        for each in block.predecessors:
            if not each.block.state.ended:
                self._last.add(each.block.key.character, each.block)
        self.starting.remove(block)
        self.watch.forget(block)
        self._remember(EndedBlock(block.key, block.state, time))

    def _remember(self, ended: EndedBlock) -> None:
        self._forget(ended.key)
        self._ended[ended.key] = ended
        self._ended_names[ended.key.block] = self._ended_names.get(ended.key.block, 0) + 1
        while len(self._ended) > self._remembered:
            self._forget(next(iter(self._ended)))

    def _forget(self, key: BlockKey) -> None:
        if self._ended.pop(key, None) is None:
            return
        self._ended_names[key.block] -= 1
        if not self._ended_names[key.block]:
            del self._ended_names[key.block]

    def _preparing(self, block: BMLBlock, ids: Iterable[str]) -> list[BMLBlock]:
        """The blocks in preparation among those that a block names."""
        found = (self.find(block.key.character, id_) for id_ in ids)
        return [other for other in found if other is not None and other.state is BlockState.IN_PREP]


def _start(block: BMLBlock) -> Time:
    return block.start.value if block.state is BlockState.LURKING else None


def _is_awaited(block: BMLBlock) -> bool:
    """Whether another block of its character, which is neither preplanned nor gives way, waits for its end."""
    return any(
        for_end and not other.awaits_activation and other.key.character == block.key.character
        for other, for_end in block.successors.items()
    )
