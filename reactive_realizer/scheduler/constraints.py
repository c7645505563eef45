"""Resolves the references of a block, and reads its constraints as ties and orders of points (thesis 7.1.1)."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TypeVar

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.block import BehaviorBlock, OrderKind, Synchronize
from reactive_realizer.bml.block import Order as OrderConstraint
from reactive_realizer.bml.faults import LostWith, UnknownBlock, UnknownReference, UnknownSync
from reactive_realizer.bml.names import ANTICIPATORS
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.pegboard.peg_key import PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import Bound, TimeCell
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.block_state import BlockState
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.faults import CyclicReference, MutualReference
from reactive_realizer.scheduler.losses import lost_behavior
from reactive_realizer.scheduler.problem import Loss, Node, Origin, Point, Precedence, Tie

C = TypeVar("C", Synchronize, OrderConstraint)
T = TypeVar("T", Tie, Precedence)


class ReferenceResolver:
    """Finds the points that the references of one block name."""

    def __init__(self, block: BMLBlock, units: Mapping[str, PlanUnit], board: PegBoard, blocks: Blocks) -> None:
        self._block = block
        self._units = units
        self._board = board
        self._blocks = blocks
        self._causes: dict[str, str] = {}

    def lose(self, behavior: str, fault: Fault) -> None:
        """Note that a behavior of the block is dropped: what hangs on it is lost with the cause of that loss."""
        if isinstance(fault, LostWith):
            self._causes[behavior] = fault.behavior

    def locate(self, ref: SyncRef) -> Node:
        """The point that a reference names, without its offset.

        Raises:
            RealizerError: there is no such point.
        """
        if ref.block == ANTICIPATORS and ref.behavior is not None and ref.sync is not None:
            return self._block.predicted[ref.behavior, ref.sync]
        if ref.block not in (None, self._block.key.block):
            return self._outside(ref)
        if ref.behavior is None or ref.sync is None:
            return Origin.BLOCK_START
        unit = self._units.get(ref.behavior)
        if unit is None and ref.behavior in _written(self._block):
            raise RealizerError(LostWith(behavior=self._causes.get(ref.behavior, ref.behavior), reference=str(ref)))
        if unit is None:
            raise RealizerError(UnknownReference(behavior=ref.behavior, reference=str(ref), known=_list(self._units)))
        if ref.sync not in unit.timing.points:
            raise _no_sync(ref, unit.timing.points)
        return unit.open.get(ref.sync) or Point(ref.behavior, ref.sync)

    def _outside(self, ref: SyncRef) -> TimeCell:
        """A peg of another block."""
        other = self._blocks.find(self._block.key.character, ref.block or "")
        if other is None:
            raise RealizerError(UnknownBlock(block=ref.block or "", reference=str(ref)))
        peg = self._board.get(PegKey(*other.key, ref.behavior, ref.sync or "start"))
        if peg is not None and peg.depends_on(self._block.start):
            raise RealizerError(CyclicReference(block=self._block.key.block, reference=str(ref)))
        if ref.behavior in other.dropped:
            raise _lost(ref)
        if peg is None:
            units = {unit.behavior.id: unit for unit in other.units}
            if ref.behavior in units:
                raise _no_sync(ref, units[ref.behavior].timing.points)
            if ref.behavior not in _written(other):
                known = _list([behavior.id for behavior in other.description.behaviors])
                raise RealizerError(UnknownReference(behavior=ref.behavior or "", reference=str(ref), known=known))
            if other.state is BlockState.IN_PREP:
                raise RealizerError(
                    MutualReference(block=self._block.key.block, other=ref.block or "", reference=str(ref))
                )
            raise _lost(ref)
        return peg


def drop_unplaceable(units: dict[str, PlanUnit], resolver: ReferenceResolver) -> list[Loss]:
    """Remove the behaviors that hang on a point that cannot come, those that hang on these, and so on."""
    losses: list[Loss] = []
    while (lost := next(_unplaceable(units, resolver), None)) is not None:
        unit, fault = lost
        losses.append(lost_behavior(unit.behavior, fault))
        resolver.lose(unit.behavior.id, fault)
        del units[unit.behavior.id]
    return losses


def ties_of(
    block: BehaviorBlock, units: Mapping[str, PlanUnit], resolver: ReferenceResolver
) -> tuple[list[Tie], list[Loss]]:
    """All `at` constraints between the units of a block, and losses for those that name something else."""
    ties = [tie for unit in units.values() for tie in _own_ties(unit.behavior, resolver)]
    written = [each for each in block.constraints if isinstance(each, Synchronize)]
    others, losses = _read(written, _synchronized, resolver)
    return ties + others, losses


def orders_of(block: BehaviorBlock, resolver: ReferenceResolver) -> tuple[list[Precedence], list[Loss]]:
    """All before/after constraints between the units of a block, and losses for those that name something else."""
    return _read([each for each in block.constraints if isinstance(each, OrderConstraint)], _ordered, resolver)


def holding(constraint: Tie | Precedence) -> Bound | None:
    """The bound that a constraint puts on the start of its block, if it does (thesis, example 34)."""
    match constraint:
        case Precedence(later=Origin.BLOCK_START, earlier=node, offset=distance):
            pass
        case Tie(left=Origin.BLOCK_START, right=node, offset=distance):
            pass
        case Tie(left=node, right=Origin.BLOCK_START, offset=offset):
            distance = -offset
        case _:
            return None
    return None if isinstance(node, Point | Origin) else (node, distance)


def _unplaceable(units: Mapping[str, PlanUnit], resolver: ReferenceResolver) -> Iterator[tuple[PlanUnit, Fault]]:
    for unit in units.values():
        behavior = unit.behavior
        for sync, ref in behavior.syncs.items():
            try:
                resolver.locate(ref)
                _own_point(unit, sync, ref)
            except RealizerError as problem:
                yield unit, problem.fault


def _own_point(unit: PlanUnit, sync: str, ref: SyncRef) -> None:
    known = unit.timing.points
    if sync not in known:
        raise RealizerError(
            UnknownSync(behavior=unit.behavior.id, sync=sync, reference=str(ref), known=", ".join(known))
        )


def _own_ties(behavior: Behavior, resolver: ReferenceResolver) -> list[Tie]:
    return [
        Tie(
            Point(behavior.id, sync), resolver.locate(ref), ref.offset, behavior.id, behavior.location,
            f"{behavior.id}:{sync} = {ref}", behavior.required,
        )
        for sync, ref in behavior.syncs.items()
    ]  # fmt: skip


def _read(
    constraints: Iterable[C], read: Callable[[C, ReferenceResolver], list[T]], resolver: ReferenceResolver
) -> tuple[list[T], list[Loss]]:
    found: list[T] = []
    losses: list[Loss] = []
    for constraint in constraints:
        try:
            found += read(constraint, resolver)
        except RealizerError as problem:
            fault = problem.fault.located(constraint.location.line, constraint.location.column)
            losses.append(Loss(None, fault, dropped=False, required=constraint.required))
    return found, losses


def _synchronized(constraint: Synchronize, resolver: ReferenceResolver) -> list[Tie]:
    """Ties of all points to the first one from outside, or else to the first: all follow that, in any order."""
    nodes = [resolver.locate(ref) for ref in constraint.refs]
    pivot = next((place for place, node in enumerate(nodes) if not isinstance(node, Point)), 0)
    first = constraint.refs[pivot]
    return [
        Tie(
            node, nodes[pivot], first.offset - ref.offset, None, constraint.location, f"{ref} = {first}",
            constraint.required,
        )
        for place, (node, ref) in enumerate(zip(nodes, constraint.refs, strict=True))
        if place != pivot
    ]  # fmt: skip


def _ordered(constraint: OrderConstraint, resolver: ReferenceResolver) -> list[Precedence]:
    pivot, orders = constraint.ref, []
    for ref in constraint.refs:
        late, early = (ref, pivot) if constraint.kind is OrderKind.AFTER else (pivot, ref)
        text = f"{ref} {constraint.kind} {pivot}"
        distance = early.offset - late.offset
        name = f"{constraint.id or ''} {text}"
        order = Precedence(
            resolver.locate(late),
            resolver.locate(early),
            distance,
            name,
            constraint.location,
            text,
            constraint.required,
        )
        orders.append(order)
    return orders


def _written(block: BMLBlock) -> set[str]:
    """Ids of all behaviors that stand in a block, played or not."""
    return {behavior.id for behavior in block.description.behaviors} | block.description.unread


def _lost(ref: SyncRef) -> Exception:
    return RealizerError(LostWith(behavior=f"{ref.block}:{ref.behavior}", reference=str(ref)))


def _no_sync(ref: SyncRef, known: Sequence[str]) -> Exception:
    behavior, sync = ref.behavior or "", ref.sync or ""
    return RealizerError(UnknownSync(reference=str(ref), behavior=behavior, sync=sync, known=", ".join(known)))


def _list(ids: Iterable[str]) -> str:
    return ", ".join(ids) or "none"
