"""From what a block says about time to ties between points (thesis 7.1.1)."""

from collections.abc import Callable, Collection, Container, Iterable, Iterator, Mapping
from typing import TypeVar

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.constraint import Order as OrderConstraint
from reactive_realizer.bml.constraint import OrderKind, Synchronize
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.errors import Fault, RealizerError, error
from reactive_realizer.pegboard.time_peg import Bound
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.losses import lost_behavior
from reactive_realizer.scheduler.names import Names
from reactive_realizer.scheduler.problem import Loss, Node, Order, Origin, Point, Tie

C = TypeVar("C", Synchronize, OrderConstraint)
T = TypeVar("T", Tie, Order)

Locate = Callable[[SyncRef], Node]
"""The point that a reference names, without its offset.

Raises RealizerError: there is none.
"""


def hanging_on(named: Collection[str], kept: Iterable[Tie | Order]) -> set[str]:
    """Ids of the other behaviors that name some behaviors, or share a constraint with them, in any number of steps.

    Who is named hangs on nobody: a speech goes on whatever becomes of the nod that is tied to its words.
    """
    ties = [tie for tie in kept if isinstance(tie, Tie)]
    ends = [(tie.owner, {node.behavior for node in tie.nodes if isinstance(node, Point)}) for tie in ties]
    found = set(named)
    while new := {each for owner, ids in ends if ids & found for each in ({owner} if owner else ids)} - found:
        found |= new
    return found.difference(named)


def naming(behavior: str, points: Container[Node], kept: Iterable[Tie | Order]) -> Node | None:
    """The first of some points, or pegs of the outside, that a constraint ties a behavior to; None if none does."""
    for each in kept:
        if any(isinstance(node, Point) and node.behavior == behavior for node in each.nodes):
            found = next((node for node in each.nodes if node in points), None)
            if found is not None:
                return found
    return None


def drop_unplaceable(units: dict[str, PlanUnit], names: Names) -> list[Loss]:
    """Take out the behaviors that hang on a point that can never come, and those that hang on them, and so on."""
    losses: list[Loss] = []
    while (lost := next(_unplaceable(units, names.locate), None)) is not None:
        unit, fault = lost
        losses.append(lost_behavior(unit.behavior, fault))
        names.lose(unit.behavior.id, fault)
        del units[unit.behavior.id]
    return losses


def ties_of(block: BehaviorBlock, units: Mapping[str, PlanUnit], locate: Locate) -> tuple[list[Tie], list[Loss]]:
    """All `at` constraints between what is left of a block, and those constraints that name what is not there."""
    ties = [tie for unit in units.values() for tie in _own_ties(unit.behavior, locate)]
    written = [each for each in block.constraints if isinstance(each, Synchronize)]
    others, losses = _read(written, _synchronized, locate)
    return ties + others, losses


def orders_of(block: BehaviorBlock, locate: Locate) -> tuple[list[Order], list[Loss]]:
    """All before/after constraints between what is left of a block, and those that name what is not there."""
    return _read([each for each in block.constraints if isinstance(each, OrderConstraint)], _ordered, locate)


def holding(constraint: Tie | Order) -> Bound | None:
    """What the start of the block is not before by a constraint, if it has to wait for it (thesis, example 34)."""
    match constraint:
        case Order(later=Origin.BLOCK_START, earlier=node, offset=distance):
            pass
        case Tie(left=Origin.BLOCK_START, right=node, offset=distance):
            pass
        case Tie(left=node, right=Origin.BLOCK_START, offset=offset):
            distance = -offset
        case _:
            return None
    return None if isinstance(node, Point | Origin) else (node, distance)


def _unplaceable(units: Mapping[str, PlanUnit], locate: Locate) -> Iterator[tuple[PlanUnit, Fault]]:
    for unit in units.values():
        behavior = unit.behavior
        for sync, ref in behavior.syncs.items():
            try:
                locate(ref)
                _own_point(unit, sync, ref)
            except RealizerError as problem:
                yield unit, problem.fault


def _own_point(unit: PlanUnit, sync: str, ref: SyncRef) -> None:
    known = unit.timing.points
    if sync not in known:
        raise error("unknown-sync", behavior=unit.behavior.id, sync=sync, reference=str(ref), known=", ".join(known))


def _own_ties(behavior: Behavior, locate: Locate) -> list[Tie]:
    return [
        Tie(
            Point(behavior.id, sync), locate(ref), ref.offset, behavior.id, behavior.location,
            f"{behavior.id}:{sync} = {ref}", behavior.required,
        )
        for sync, ref in behavior.syncs.items()
    ]  # fmt: skip


def _read(constraints: Iterable[C], read: Callable[[C, Locate], list[T]], locate: Locate) -> tuple[list[T], list[Loss]]:
    found: list[T] = []
    losses: list[Loss] = []
    for constraint in constraints:
        try:
            found += read(constraint, locate)
        except RealizerError as problem:
            fault = problem.fault.located(constraint.location.line, constraint.location.column)
            losses.append(Loss(None, fault, dropped=False, required=constraint.required))
    return found, losses


def _synchronized(constraint: Synchronize, locate: Locate) -> list[Tie]:
    """Ties to what comes from outside, if one of the points does: all follow that, in whatever order they stand."""
    nodes = [locate(ref) for ref in constraint.refs]
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


def _ordered(constraint: OrderConstraint, locate: Locate) -> list[Order]:
    pivot, orders = constraint.ref, []
    for ref in constraint.refs:
        late, early = (ref, pivot) if constraint.kind is OrderKind.AFTER else (pivot, ref)
        text = f"{ref} {constraint.kind} {pivot}"
        distance = early.offset - late.offset
        name = f"{constraint.id or ''} {text}"
        order = Order(locate(late), locate(early), distance, name, constraint.location, text, constraint.required)
        orders.append(order)
    return orders
