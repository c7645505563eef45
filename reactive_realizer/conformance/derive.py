"""Derives assertions about the feedback from a script (thesis 9.6)."""

from collections.abc import Iterator
from functools import partial
from typing import Final

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.bml.block import BehaviorBlock, Order, OrderKind, Synchronize
from reactive_realizer.bml.names import ANTICIPATORS, BML, BML_EXT
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.conformance.case import Check, ConformanceCase, Profile
from reactive_realizer.conformance.relations import relations
from reactive_realizer.testing.assertions import (
    DONE,
    assert_all_predicted,
    assert_block_around,
    assert_block_times,
    assert_ended,
    assert_linked,
    assert_not_played,
    assert_order,
    assert_predicted,
    assert_reported_once,
    assert_syncs_in_order,
    assert_warned,
    assert_warnings,
)

_PREDICTION: Final = "the last prediction before it"


def checks_of(case: ConformanceCase) -> Iterator[Check]:
    """All assertions of a case."""
    warnings = [(warning.id, warning.type) for warning in case.warnings]
    yield Check("progress", assert_reported_once)
    for id_, _ in warnings:
        yield Check("warnings", partial(assert_warned, id_=id_))
    yield Check("warnings", lambda feedback: assert_warnings(feedback, *warnings), Profile.STRICT)
    for block in case.blocks:
        yield from _block(case, block)
    yield from relations(case)


def _block(case: ConformanceCase, block: BehaviorBlock) -> Iterator[Check]:
    status = case.ends.get(block.id, DONE)
    yield Check(f"{block.id} ends {status}", partial(assert_ended, block=block.id, status=status), Profile.STATUS)
    if not case.starts(block):
        yield Check(f"{block.id} is never played", partial(assert_not_played, behavior=block.id))
        return
    yield Check(f"all of {block.id} is between its start and its end", partial(assert_block_around, block=block.id))
    yield Check("time", partial(assert_block_times, block=block.id), timed=True)
    yield _predicted(f"{block.id}:start")
    if status == DONE:
        yield _predicted(f"{block.id}:end")
        yield from _whole(case, block)


def _whole(case: ConformanceCase, block: BehaviorBlock) -> Iterator[Check]:
    """Assertions about a block that is not interrupted."""
    silent = {warning.id for warning in case.warnings if not warning.plays}
    for behavior in block.behaviors:
        name = f"{block.id}:{behavior.id}"
        if name in silent:
            yield Check(f"{name} is left out", partial(assert_not_played, behavior=name))
        else:
            yield _in_order(name, behavior)
            yield Check(_PREDICTION, partial(assert_all_predicted, behavior=name), Profile.PREDICTIONS, timed=True)
            yield from _ties(block, name, behavior)
    if block.id not in silent:
        yield from _constraints(block)


def _predicted(point: str) -> Check:
    return Check(_PREDICTION, partial(assert_predicted, point=point), Profile.PREDICTIONS, timed=True)


def _in_order(name: str, behavior: Behavior) -> Check:
    """The order of all points of a core behavior; of another one, which may have more points, of start and end."""
    if behavior.namespace in (BML, BML_EXT):
        return Check(
            f"points of {behavior.name}",
            lambda feedback: assert_syncs_in_order(feedback, name, *behavior.sync_points),
        )
    return Check(f"points of {behavior.name}", partial(assert_order, earlier=f"{name}:start", later=f"{name}:end"))


def _ties(block: BehaviorBlock, name: str, behavior: Behavior) -> Iterator[Check]:
    for sync, ref in behavior.syncs.items():
        if isinstance(behavior, Wait) and sync == "end" and behavior.until is not None:
            continue  # it may end at its limit
        yield from _linked(f"{name}:{sync}", 0.0, block, ref, f'{sync}="{ref}"')
    if isinstance(behavior, Wait) and behavior.duration is not None and not {"start", "end"} <= behavior.syncs.keys():
        text = f'duration="{behavior.duration:g}"'
        yield _distance(f"{name}:end", f"{name}:start", behavior.duration, text)


def _constraints(block: BehaviorBlock) -> Iterator[Check]:
    for constraint in block.constraints:
        yield from (
            _synchronized(block, constraint) if isinstance(constraint, Synchronize) else _ordered(block, constraint)
        )


def _synchronized(block: BehaviorBlock, constraint: Synchronize) -> Iterator[Check]:
    first, *others = sorted(constraint.refs, key=lambda ref: ref.behavior is None)
    for ref in others:
        yield from _linked(_point(block, first), first.offset, block, ref, f"synchronize {first}, {ref}")


def _ordered(block: BehaviorBlock, constraint: Order) -> Iterator[Check]:
    for ref in constraint.refs:
        early, late = (constraint.ref, ref) if constraint.kind is OrderKind.AFTER else (ref, constraint.ref)
        if ANTICIPATORS not in (early.block, late.block):
            assertion = partial(
                assert_order,
                earlier=_point(block, early),
                later=_point(block, late),
                distance=early.offset - late.offset,
            )
            yield Check(f"{ref} {constraint.kind} {constraint.ref}", assertion, timed=True)


def _linked(point: str, offset: float, block: BehaviorBlock, ref: SyncRef, text: str) -> Iterator[Check]:
    """The distance of ``point + offset`` from a reference; feedback does not report the points of anticipators."""
    if ref.block != ANTICIPATORS:
        yield _distance(point, _point(block, ref), ref.offset - offset, text)


def _distance(point: str, other: str, offset: float, text: str) -> Check:
    return Check(text, partial(assert_linked, point=point, other=other, offset=offset), timed=True)


def _point(block: BehaviorBlock, ref: SyncRef) -> str:
    """The name in feedback of the point of a reference, without its offset."""
    parts = (ref.block or block.id, ref.behavior, ref.sync or "start")
    return ":".join(part for part in parts if part is not None)
