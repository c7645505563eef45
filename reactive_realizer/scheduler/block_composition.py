"""Block composition: which blocks a new one ends, which it waits for, and which it delays (thesis 6.6.8; BMLA)."""

from collections.abc import Iterator, Sequence

from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.vocabulary import Composition
from reactive_realizer.errors import Fault, SchedulingFault
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock, Predecessor


class UnknownTargetBlock(SchedulingFault):
    """An attribute that names a block that never existed."""

    code = "unknown-target-block"
    template = "{attribute}: there has never been a block '{block}'"
    unknown = "block"
    attribute: str
    block: str
    known: tuple[str, ...] = ()


class StartedAlready(SchedulingFault):
    """A block put before one that has started."""

    code = "started-already"
    template = "'{block}' has already started, so nothing can be put before it; this block fails"
    block: str


class CyclicComposition(SchedulingFault):
    """A block put before one that it waits for."""

    code = "cyclic-composition"
    template = "'{block}' should come before '{other}' but also waits for it; it fails"
    block: str
    other: str


class NothingToAccompany(SchedulingFault):
    """A block that accompanies one that is not alive."""

    code = "nothing-to-accompany"
    template = "there is no live block '{block}' to accompany; this block fails"
    unknown = "block"
    block: str
    known: tuple[str, ...] = ()


class BlockComposition:
    """The composition attributes of one new block, resolved to blocks that are alive.

    Targets that have ended are left out, and so are unknown ones; `unknown` has a fault for each of these.

    Attributes:
        character: of the new block.
        description: the new block as it was sent.
        replaces: whether it ends all blocks of its character.
        accompanied: the block that it accompanies, if there is one.
        unknown: faults for the names that no block ever had.
    """

    def __init__(self, blocks: Blocks, character: str, description: BehaviorBlock) -> None:
        self.character = character
        self.description = description
        self.replaces = description.composition is Composition.REPLACE
        self.unknown: list[Fault] = []
        self.accompanied = blocks.find(character, description.accompanies) if description.accompanies else None
        self._blocks = blocks
        self._interrupted = self._known("interrupt", description.interrupts)
        self._after = self._known("appendAfter", description.append_after)
        self._after_chunks = self._known("chunkAfter", description.chunk_after)
        self._before = self._known("prependBefore", description.prepend_before)
        self._before_chunks = self._known("chunkBefore", description.chunk_before)

    @property
    def ended(self) -> list[BMLBlock]:
        """The blocks that it ends, the later ones first, because they may depend on the earlier ones."""
        replaced = self._blocks.of(self.character) if self.replaces else []
        return sorted({*replaced, *self._interrupted}, key=lambda block: -block.arrival)

    @property
    def predecessors(self) -> list[Predecessor]:
        """The blocks that the new one waits for, once the blocks that it ends have ended."""
        last = self._blocks.last_of(self.character) if self.description.composition is Composition.APPEND else []
        return [
            *(Predecessor(block, implied=True) for block in last),
            *(Predecessor(block) for block in self._after),
            *(Predecessor(block, chunk=True) for block in self._after_chunks),
        ]

    def delayed_by(self, block: BMLBlock) -> Iterator[tuple[BMLBlock, Predecessor]]:
        """The blocks that the new one, ``block``, is put before, each with its new predecessor."""
        yield from ((later, Predecessor(block)) for later in self._before)
        yield from ((later, Predecessor(block, chunk=True)) for later in self._before_chunks)

    def fault(self) -> Fault | None:
        """Why the block fails at its arrival.

        It cannot be put before another one, which has started, or would have to come first itself; or there is no block
        that it could accompany.
        """
        if self.description.accompanies is not None and self.accompanied is None:
            return NothingToAccompany(block=self.description.accompanies, known=self._blocks.names(self.character))
        later = (*self._before, *self._before_chunks)
        predecessors, ended = (self.predecessors, self.ended) if later else ([], [])
        for block in (each for each in later if each not in ended):
            if block.state.plays:
                return StartedAlready(block=block.key.block)
            if any(each.peg.depends_on(block.start) for each in predecessors):
                return CyclicComposition(block=self.description.id, other=block.key.block)
        return None

    def _known(self, attribute: str, names: Sequence[str]) -> list[BMLBlock]:
        found = {name: self._blocks.find(self.character, name) for name in names}
        for name, block in found.items():
            if block is None and not self._blocks.has_ended(name):
                place = self.description.location
                fault = UnknownTargetBlock(attribute=attribute, block=name, known=self._blocks.names(self.character))
                self.unknown.append(fault.located(place.line, place.column))
        return [block for block in found.values() if block is not None]
