"""What the references of a block name."""

from collections.abc import Iterable, Mapping, Sequence

from reactive_realizer.bml.names import ANTICIPATORS
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.errors import Fault, error
from reactive_realizer.pegboard.following import hangs_on
from reactive_realizer.pegboard.peg_key import PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BlockState, BMLBlock
from reactive_realizer.scheduler.problem import Node, Origin, Point


class Names:
    """What the references of one block name."""

    def __init__(self, block: BMLBlock, units: Mapping[str, PlanUnit], board: PegBoard, blocks: Blocks) -> None:
        self._block = block
        self._units = units
        self._board = board
        self._blocks = blocks
        self._causes: dict[str, str] = {}

    def lose(self, behavior: str, fault: Fault) -> None:
        """A behavior of the block is dropped; whoever hangs on it is lost with what it was lost with itself."""
        if fault.code == "lost-with":
            self._causes[behavior] = str(fault.details["behavior"])

    def locate(self, ref: SyncRef) -> Node:
        """The point that a reference names, without its offset.

        Raises:
            RealizerError: there is none.
        """
        if ref.block == ANTICIPATORS and ref.behavior is not None and ref.sync is not None:
            return self._block.predicted[ref.behavior, ref.sync]
        if ref.block not in (None, self._block.key.block):
            return self._outside(ref)
        if ref.behavior is None or ref.sync is None:
            return Origin.BLOCK_START
        unit = self._units.get(ref.behavior)
        if unit is None and ref.behavior in _written(self._block):
            raise error("lost-with", behavior=self._causes.get(ref.behavior, ref.behavior), reference=str(ref))
        if unit is None:
            raise error("unknown-reference", behavior=ref.behavior, reference=str(ref), known=_list(self._units))
        if ref.sync not in unit.timing.points:
            raise _no_sync(ref, unit.timing.points)
        return unit.open.get(ref.sync) or Point(ref.behavior, ref.sync)

    def _outside(self, ref: SyncRef) -> TimeCell:
        """A peg of another block."""
        other = self._blocks.find(self._block.key.character, ref.block or "")
        if other is None:
            raise error("unknown-block", block=ref.block, reference=str(ref))
        peg = self._board.get(PegKey(*other.key, ref.behavior, ref.sync or "start"))
        if peg is not None and hangs_on(peg, self._block.start):
            raise error("cyclic-reference", block=self._block.key.block, reference=str(ref))
        if ref.behavior in other.dropped:
            raise _lost(ref)
        if peg is None:
            units = {unit.behavior.id: unit for unit in other.units}
            if ref.behavior in units:
                raise _no_sync(ref, units[ref.behavior].timing.points)
            if ref.behavior not in _written(other):
                known = _list([behavior.id for behavior in other.description.behaviors])
                raise error("unknown-reference", behavior=ref.behavior, reference=str(ref), known=known)
            if other.state is BlockState.IN_PREP:
                raise error("mutual-reference", block=self._block.key.block, other=ref.block, reference=str(ref))
            raise _lost(ref)
        return peg


def _written(block: BMLBlock) -> set[str]:
    """Ids of all behaviors that stand in a block, those that are not played too."""
    return {behavior.id for behavior in block.description.behaviors} | block.description.unread


def _lost(ref: SyncRef) -> Exception:
    return error("lost-with", behavior=f"{ref.block}:{ref.behavior}", reference=str(ref))


def _no_sync(ref: SyncRef, known: Sequence[str]) -> Exception:
    return error("unknown-sync", behavior=ref.behavior, sync=ref.sync, reference=str(ref), known=", ".join(known))


def _list(ids: Iterable[str]) -> str:
    return ", ".join(ids) or "none"
