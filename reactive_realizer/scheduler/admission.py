"""Which blocks and procedures are taken in."""

from collections.abc import Iterable, Sequence

from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.procedure import DefineProc
from reactive_realizer.bml.words import Composition
from reactive_realizer.errors import Fault
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.peg_key import BlockKey


class Admission:
    """Judges blocks and procedures that enter at one tick, in order, each beside those that came before it.

    None of them has ended by itself when the next comes, but a REPLACE ends all blocks of its character, and a block
    may interrupt one of its own name.

    Args:
        characters: the first one is meant by a block that names none.
        limits: how many blocks may be alive at once, and procedures defined.
        alive: the blocks that are.
        procedures: ids of those that are.
    """

    def __init__(
        self, characters: Sequence[str], limits: Limits, alive: Iterable[BlockKey], procedures: Iterable[str]
    ) -> None:
        self._characters = characters
        self._limits = limits
        self._alive = set(alive)
        self._procedures = dict.fromkeys(procedures)

    def define(self, procedure: DefineProc) -> Fault | None:
        """Count a procedure among those that are defined, or say why it is refused."""
        if procedure.id not in self._procedures and len(self._procedures) >= self._limits.procedures:
            fault = Fault("too-many-procedures", {"limit": self._limits.procedures})
            return fault.located(procedure.location.line, procedure.location.column)
        self._procedures[procedure.id] = None
        return None

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
        if block.procedure is not None and block.procedure not in self._procedures:
            known = ", ".join(self._procedures) or "none"
            return Fault("unknown-procedure", {"procedure": block.procedure, "known": known})
        if block.composition is not Composition.REPLACE and len(self._alive) >= self._limits.blocks_alive:
            return Fault("too-many-blocks", {"limit": self._limits.blocks_alive})
        return None
