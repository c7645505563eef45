"""Whether what a block refers to exists."""

from collections.abc import Callable, Collection, Iterator, Mapping

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.block import BehaviorBlock, Problem
from reactive_realizer.bml.constraint import Constraint, Order
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.procedure import DefineProc
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.bml.trees import listed
from reactive_realizer.errors import Fault

Points = Callable[[Behavior], Collection[str] | None]
"""The sync points of a behavior; None where they are not known."""


def standard_points(behavior: Behavior) -> Collection[str] | None:
    """Those that BML names; None where what plays the behavior may know more."""
    return None if behavior.OPEN_POINTS else behavior.sync_points


def check_references(block: BehaviorBlock | DefineProc, points: Points = standard_points) -> tuple[Problem, ...]:
    """A problem for each reference to a behavior or sync point that this block or procedure should have and has not.

    Other blocks, anticipators, and behaviors of which `points` does not know the sync points are not judged.
    """
    behaviors = {behavior.id: behavior for behavior in block.behaviors}
    return tuple(
        Problem(fault, place)
        for place, location, ref in references_of(block)
        if ref.block in {None, block.id} and (fault := _fault(ref, block, behaviors, location, points))
    )


def references_of(block: BehaviorBlock | DefineProc) -> Iterator[tuple[str, Location, SyncRef]]:
    """Every reference with the id (``block:behavior``, or the block's) and the place of what holds it."""
    for behavior in block.behaviors:
        for ref in behavior.syncs.values():
            yield f"{block.id}:{behavior.id}", behavior.location, ref
    for constraint in block.constraints:
        place = f"{block.id}:{constraint.id}" if constraint.id else block.id
        for ref in _refs_of(constraint):
            yield place, constraint.location, ref


def unknown_block(ref: SyncRef, block: BehaviorBlock | DefineProc) -> Fault:
    """Why a reference of a block names nothing when there is no block of the name that it names."""
    details = {"block": ref.block, "reference": str(ref)}
    if ref.behavior is not None:
        return Fault("unknown-block", details)
    # It may as well have meant a behavior: b1:end is that of either.
    return Fault("unknown-owner", details | {"known": listed(behavior.id for behavior in block.behaviors)})


def _refs_of(constraint: Constraint) -> tuple[SyncRef, ...]:
    return (constraint.ref, *constraint.refs) if isinstance(constraint, Order) else constraint.refs


def _fault(
    ref: SyncRef,
    block: BehaviorBlock | DefineProc,
    behaviors: Mapping[str, Behavior],
    location: Location,
    points: Points,
) -> Fault | None:
    if ref.behavior is None:
        return None
    details: dict[str, object] = {"reference": str(ref), "behavior": ref.behavior, "sync": ref.sync}
    behavior = behaviors.get(ref.behavior)
    if ref.behavior in block.unread:
        return Fault("lost-with", details, location.line, location.column)
    if behavior is None:
        code, known = "unknown-reference", listed(behaviors)
    elif (those := points(behavior)) is None or ref.sync in those:
        return None
    else:
        code, known = "unknown-sync", listed(those)
    return Fault(code, details | {"known": known}, location.line, location.column)
