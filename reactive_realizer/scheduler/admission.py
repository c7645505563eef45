"""Admission control: whether blocks and procedures may enter."""

from collections import Counter
from collections.abc import Mapping, Sequence

from reactive_realizer.bml.block import BehaviorBlock, DefineProc, Parsed
from reactive_realizer.bml.vocabulary import Composition
from reactive_realizer.errors import Fault, ParsingFault, TargetFault
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.lanes import Lane


class DuplicateBlock(ParsingFault):
    """A block with the id of one that has not ended."""

    code = "duplicate-block"
    template = "there is already a block '{block}' that has not ended; this one is refused"
    block: str


class TooManyBlocks(ParsingFault):
    """A block over the limit of live blocks."""

    code = "too-many-blocks"
    template = "the limit of {limit} live blocks is reached; this one is refused"
    limit: int


class TooManyLiveBehaviors(ParsingFault):
    """A block whose behaviors are over the limit of those of live blocks."""

    code = "too-many-live-behaviors"
    template = "with it, there would be more than the limit of {limit} behaviors of live blocks; this one is refused"
    limit: int


class TooManyOfOne(ParsingFault):
    """A block of a client that has more live blocks than are left, or would have more behaviors of them."""

    code = "too-many-of-one"
    template = "this client has {own} live {things}, so the {free} that are left are for others; this one is refused"
    own: int
    things: str
    free: int


class TooManyProcedures(ParsingFault):
    """A procedure over the limit."""

    code = "too-many-procedures"
    template = "the limit of {limit} procedures is reached; this one is refused"
    limit: int


class UnknownCharacter(TargetFault):
    """No character has the id."""

    code = "unknown-character"
    template = "there is no character '{character}'; available: {known}"
    unknown = "character"
    character: str
    known: tuple[str, ...]


class UnknownProcedure(TargetFault):
    """No procedure has the id."""

    code = "unknown-procedure"
    template = "there is no procedure '{procedure}'; available: {known}"
    unknown = "procedure"
    procedure: str
    known: tuple[str, ...]


class Admission:
    """Decides on the blocks and procedures that enter at one tick, in order; each counts for those that follow.

    No block ends by itself in between, but a REPLACE ends all blocks of its character, and a block may interrupt one
    with its own id.

    Args:
        characters: the first one takes blocks that name none.
        limits: how many blocks may be alive at once, with how many behaviors, and procedures defined.
        blocks: those that are alive.
        procedures: the numbers of behaviors of the procedures that are defined, by id.
    """

    def __init__(
        self,
        characters: Sequence[str],
        limits: Limits,
        blocks: Blocks,
        procedures: Mapping[str, int],
    ) -> None:
        self._characters = characters
        self._limits = limits
        self._blocks = blocks
        self._procedures = procedures
        self._added: set[BlockKey] = set()
        self._replaced: set[str] = set()
        self._defined: dict[str, int] = {}
        self._numbers = blocks.numbers.copy()
        self._behaviors = blocks.behaviors.copy()

    def refusal(self, parsed: Parsed, client: str = "") -> Fault | None:
        """Admit what was read from a client, or return why not."""
        if parsed.procedure is not None:
            return self.admit_procedure(parsed.procedure)
        if parsed.block is not None:
            return self.admit(parsed.block, parsed.failed, client)
        return parsed.refusal

    def admit_procedure(self, procedure: DefineProc) -> Fault | None:
        """Admit a procedure, or return why not."""
        if procedure.id in self._procedures or procedure.id in self._defined:
            return None
        if len(self._procedures) + len(self._defined) >= self._limits.procedures:
            fault = TooManyProcedures(limit=self._limits.procedures)
            return fault.located(procedure.location.line, procedure.location.column)
        self._defined[procedure.id] = len(procedure.behaviors)
        return None

    def admit(self, block: BehaviorBlock, failed: bool = False, client: str = "") -> Fault | None:
        """Admit a block, or return why not.

        Args:
            block: as it was read.
            failed: whether something required could not be read, so that the block ends at once.
            client: that sent it, and has to leave others as many blocks as it has; empty for none.
        """
        key = BlockKey(block.played_by(self._characters), block.id)
        fault = self._rejection(key, block, client)
        if fault is not None:
            return fault.located(block.location.line, block.location.column)
        if block.composition is Composition.REPLACE:
            self._replace(key.character)
        if not failed and not self._is_alive(key):
            self._added.add(key)
            self._numbers[Lane(client, key.character)] += 1
            self._behaviors[Lane(client, key.character)] += self._size(block)
        return None

    def _replace(self, character: str) -> None:
        """Count all blocks of a character as ended."""
        self._replaced.add(character)
        self._added = {key for key in self._added if key.character != character}
        self._numbers = _without(character, self._numbers)
        self._behaviors = _without(character, self._behaviors)

    def _is_alive(self, key: BlockKey) -> bool:
        alive = key.character not in self._replaced and self._blocks.get(key) is not None
        return alive or key in self._added

    def _rejection(self, key: BlockKey, block: BehaviorBlock, client: str) -> Fault | None:
        if key.character not in self._characters:
            return UnknownCharacter(character=key.character, known=tuple(self._characters))
        if self._is_alive(key) and key.block not in block.interrupts:
            return DuplicateBlock(block=key.block)
        if block.procedure is not None and block.procedure not in (*self._procedures, *self._defined):
            return UnknownProcedure(procedure=block.procedure, known=(*self._procedures, *self._defined))
        return None if block.composition is Composition.REPLACE else self._overfull(client, self._size(block))

    def _size(self, block: BehaviorBlock) -> int:
        """The number of behaviors of a block, or of the procedure that it uses."""
        if block.procedure is None:
            return len(block.behaviors)
        return self._defined.get(block.procedure) or self._procedures.get(block.procedure, 0)

    def _overfull(self, client: str, size: int) -> Fault | None:
        """The fault of one more block of a client, with some behaviors."""
        limits = self._limits
        if sum(self._numbers.values()) >= limits.blocks_alive:
            return TooManyBlocks(limit=limits.blocks_alive)
        if sum(self._behaviors.values()) + size > limits.behaviors_alive:
            return TooManyLiveBehaviors(limit=limits.behaviors_alive)
        return _too_many_of(client, 1, self._numbers, limits.blocks_alive, "blocks") or _too_many_of(
            client, size, self._behaviors, limits.behaviors_alive, "behaviors"
        )


def _too_many_of(client: str, more: int, numbers: Counter[Lane], limit: int, things: str) -> Fault | None:
    """The fault of a client that would have more things than were left for others before."""
    own = sum(number for lane, number in numbers.items() if lane.client == client)
    free = limit - sum(numbers.values())
    return TooManyOfOne(own=own, things=things, free=free) if client and own + more - 1 > free else None


def _without(character: str, numbers: Counter[Lane]) -> Counter[Lane]:
    return Counter({lane: number for lane, number in numbers.items() if lane.character != character})
