"""Checks that the sync points to which a block refers exist."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.block import BehaviorBlock, Constraint, DefineProc, Order, Problem
from reactive_realizer.bml.names import ANTICIPATORS, Location
from reactive_realizer.bml.reference_faults import (
    LostWith,
    UnknownBlock,
    UnknownBlockPoint,
    UnknownOwner,
    UnknownReference,
    UnknownSync,
)
from reactive_realizer.bml.sync_ref import SyncRef, named_point
from reactive_realizer.errors import Fault

Points = Callable[[Behavior], Collection[str] | None]
"""Returns the sync points of a behavior, None if they are not known."""

Blocks = Callable[[str], Sequence[BehaviorBlock]]
"""Returns the other blocks with an id of which the content is known."""


def standard_points(behavior: Behavior) -> Collection[str] | None:
    """The sync points that BML defines; None if the engine of the behavior may define more."""
    return None if behavior.open_points else behavior.sync_points


def check_references(
    block: BehaviorBlock | DefineProc, points: Points = standard_points, others: Blocks = lambda id_: ()
) -> tuple[Problem, ...]:
    """A problem for each reference to a behavior or sync point that is missing from this block or procedure.

    References to other blocks, to anticipators, and to behaviors whose sync points are not known are not checked.

    Args:
        block: to check.
        points: of its behaviors.
        others: blocks that a reference may have meant instead of a behavior.
    """
    behaviors = {behavior.id: behavior for behavior in block.behaviors}
    return tuple(
        Problem(fault, place)
        for place, location, ref in references_of(block)
        if ref.block in {None, block.id} and (fault := _fault(ref, block, behaviors, location, points, others))
    )


def references_of(block: BehaviorBlock | DefineProc) -> Iterator[tuple[str, Location, SyncRef]]:
    """Each reference, after the id (``block:behavior``, or the block's) and the location of its owner."""
    for behavior in block.behaviors:
        for ref in behavior.syncs.values():
            yield f"{block.id}:{behavior.id}", behavior.location, ref
    if isinstance(block, BehaviorBlock):
        yield from ((block.id, block.location, ref) for ref in block.points.values())
    for constraint in block.constraints:
        place = f"{block.id}:{constraint.id}" if constraint.id else block.id
        for ref in _refs_of(constraint):
            yield place, constraint.location, ref


def predictions_of(block: BehaviorBlock | DefineProc) -> Iterator[tuple[str, Location, str, SyncRef]]:
    """The references to points of anticipators, after the id and the location of their owner and the anticipator."""
    for id_, location, ref in references_of(block):
        if ref.block == ANTICIPATORS and ref.behavior is not None:
            yield id_, location, ref.behavior, ref


def unknown_block(ref: SyncRef, block: BehaviorBlock | DefineProc, blocks: Iterable[str]) -> Fault:
    """The fault of a reference in a block to another one that is not among ``blocks``."""
    name = ref.block or ""
    if ref.behavior is not None:
        return UnknownBlock(reference=str(ref), block=name, known=(*blocks, ANTICIPATORS))
    # b1:end may have been meant for a behavior as well.
    known = tuple(behavior.id for behavior in block.behaviors)
    return UnknownOwner(reference=str(ref), block=name, known=known)


def unknown_behavior(ref: SyncRef, behaviors: Iterable[str], blocks: Sequence[BehaviorBlock]) -> Fault:
    """The fault of a reference to a behavior that is not among ``behaviors`` of its block.

    If it has the name of ``blocks``, it names a sync point that these do not have.
    """
    name = ref.behavior or ""
    other = unknown_block_point(replace(ref, block=name, behavior=None), blocks)
    return other or UnknownReference(reference=str(ref), behavior=name, known=tuple(behaviors))


def unknown_block_point(ref: SyncRef, blocks: Sequence[BehaviorBlock]) -> Fault | None:
    """The fault of a reference to a sync point that none of the blocks with its name has; None if one has it.

    By default, a block is ready if one of its behaviors is.
    """
    sync, known = ref.sync or "start", tuple(map(_points, blocks))
    if not known or any(sync in points for points in known):
        return None
    return UnknownBlockPoint(reference=str(ref), block=ref.block or "", sync=sync, known=known[0])


def _points(block: BehaviorBlock) -> tuple[str, ...]:
    """The sync points of a block."""
    ready = any("ready" in behavior.sync_points for behavior in block.behaviors)
    return tuple(dict.fromkeys(("start", *(["ready"] if ready else []), *block.points, "relax", "end")))


def _refs_of(constraint: Constraint) -> tuple[SyncRef, ...]:
    return (constraint.ref, *constraint.refs) if isinstance(constraint, Order) else constraint.refs


def _fault(
    ref: SyncRef,
    block: BehaviorBlock | DefineProc,
    behaviors: Mapping[str, Behavior],
    location: Location,
    points: Points,
    others: Blocks,
) -> Fault | None:
    if ref.behavior is None:
        return None
    behavior = behaviors.get(ref.behavior)
    fault: Fault
    if ref.behavior in block.unread:
        fault = LostWith(reference=str(ref), behavior=ref.behavior)
    elif behavior is None:
        another = ref.block is None and ref.behavior != block.id
        fault = unknown_behavior(ref, behaviors, others(ref.behavior) if another else ())
    elif (those := points(behavior)) is None or named_point(ref.sync or "", those) in those:
        return None
    else:
        fault = UnknownSync(reference=str(ref), behavior=ref.behavior, sync=ref.sync or "", known=tuple(those))
    return fault.located(location.line, location.column)
