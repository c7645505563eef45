"""How a block joins the others: after them, in front of them, or in their place (thesis 6.6.8; BMLA)."""

from collections.abc import Sequence

from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.words import Composition
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.following import hangs_on
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock, Wait


class Joining:
    """Reads the composition of one new block against the blocks alive.

    A target that has ended counts as over. So does one that was never seen; that is said.

    Attributes:
        unknown: faults for the names that no block ever had.
    """

    def __init__(self, blocks: Blocks, character: str, description: BehaviorBlock) -> None:
        self._blocks = blocks
        self._character = character
        self._description = description
        self._replaces = description.composition is Composition.REPLACE
        self.unknown: list[Fault] = []
        self._interrupted = self._known("interrupt", description.interrupts)
        self._after = self._known("appendAfter", description.append_after)
        self._after_chunks = self._known("chunkAfter", description.chunk_after)
        self._before = self._known("prependBefore", description.prepend_before)
        self._before_chunks = self._known("chunkBefore", description.chunk_before)

    def ended_by_it(self) -> list[BMLBlock]:
        """The blocks that it takes the place of, the later ones first, because they may hang on the earlier ones."""
        replaced = self._blocks.of(self._character) if self._replaces else []
        return sorted({*replaced, *self._interrupted}, key=lambda block: -block.arrival)

    def waits(self) -> list[Wait]:
        """What the new block waits for, once those are ended that it takes the place of."""
        last = self._blocks.last_of(self._character) if self._description.composition is Composition.APPEND else []
        return [
            *(Wait(block, implied=True) for block in last),
            *(Wait(block) for block in self._after),
            *(Wait(block, chunk=True) for block in self._after_chunks),
        ]

    def refusal(self) -> Fault | None:
        """Why the block cannot be put before another one, if it cannot.

        The other one has started, or the new one would wait for it in turn.
        """
        waits = self.waits()
        ended = self.ended_by_it()
        for block in (each for each in (*self._before, *self._before_chunks) if each not in ended):
            if block.state.plays:
                return Fault("started-already", {"block": block.key.block})
            if any(hangs_on(wait.peg, block.start) for wait in waits):
                return Fault("cyclic-composition", {"block": self._description.id, "other": block.key.block})
        return None

    def push_back(self, block: BMLBlock) -> None:
        """Within a transaction: those that the new block is put before wait for it."""
        for later in self._before:
            later.wait_also(Wait(block))
        for later in self._before_chunks:
            later.wait_also(Wait(block, chunk=True))

    def _known(self, attribute: str, names: Sequence[str]) -> list[BMLBlock]:
        found = {name: self._blocks.find(self._character, name) for name in names}
        for name, block in found.items():
            if block is None and not self._blocks.has_ended(self._character, name):
                place = self._description.location
                fault = Fault("unknown-target-block", {"attribute": attribute, "block": name})
                self.unknown.append(fault.located(place.line, place.column))
        return [block for block in found.values() if block is not None]
