"""Derives assertions about the order of blocks: composition, and the attributes and behaviors of BMLA."""

from collections.abc import Iterable, Iterator
from functools import partial

from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.extensions import Activate, Interrupt
from reactive_realizer.bml.vocabulary import Composition
from reactive_realizer.conformance.case import Check, ConformanceCase, Profile
from reactive_realizer.testing.assertions import assert_linked, assert_order, assert_starts_with_last


def relations(case: ConformanceCase) -> Iterator[Check]:
    """Assertions about the order of the blocks that start."""
    earlier: list[BehaviorBlock] = []
    for block in case.blocks:
        if case.starts(block):
            yield from _waits(case, block, earlier)
            yield from _comes_after(case, block, earlier)
            yield from _acts(block)
        earlier.append(block)


def _waits(case: ConformanceCase, block: BehaviorBlock, earlier: Iterable[BehaviorBlock]) -> Iterator[Check]:
    """A block starts at the last of the points that it waits for, neither before nor after."""
    points = [*_awaited(case, block, earlier), *(_activating(case, block) if block.preplan else ())]
    if points:
        waits = f"{block.id} waits for {', '.join(points)}"
        for point in points:
            yield Check(waits, partial(assert_order, earlier=point, later=f"{block.id}:start"), timed=True)
        at_once = partial(assert_starts_with_last, block=block.id, points=points)
        yield Check(waits, at_once, Profile.STRICT, timed=True)


def _awaited(case: ConformanceCase, block: BehaviorBlock, earlier: Iterable[BehaviorBlock]) -> Iterator[str]:
    """The points that a block waits for, by its composition or by BMLA."""
    if block.composition is Composition.APPEND:
        yield from (f"{other.id}:end" for other in _beside(block, earlier))
    for other in case.blocks:
        if other.id in block.append_after or block.id in other.prepend_before:
            yield f"{other.id}:end"
        if other.id in block.chunk_after or block.id in other.chunk_before:
            yield from _subsiding(case, other)


def _activating(case: ConformanceCase, block: BehaviorBlock) -> Iterator[str]:
    """The points at which a prepared block is activated."""
    for other in case.blocks:
        if block.id in other.on_start:
            yield f"{other.id}:start"
        for behavior in other.behaviors:
            if isinstance(behavior, Activate) and behavior.target == block.id:
                yield f"{other.id}:{behavior.id}:start"


def _subsiding(case: ConformanceCase, block: BehaviorBlock) -> Iterator[str]:
    """The points that a block has passed when it subsides."""
    if block.id in case.ends:
        yield f"{block.id}:end"
        return
    for behavior in block.behaviors:
        last = "relax" if "relax" in behavior.sync_points else "end"
        yield f"{block.id}:{behavior.id}:{last}"


def _comes_after(case: ConformanceCase, block: BehaviorBlock, earlier: Iterable[BehaviorBlock]) -> Iterator[Check]:
    """A block starts after the end of the blocks that it ends, possibly later, because it has to be prepared."""
    replaced = [other.id for other in _beside(block, earlier)] if block.composition is Composition.REPLACE else []
    ended = (*replaced, *block.interrupts)
    for other in (other for other in case.blocks if other.id in ended):
        assertion = partial(assert_order, earlier=f"{other.id}:end", later=f"{block.id}:start")
        profile = Profile.BML if case.starts(other) else Profile.STATUS
        yield Check(f"{block.id} ends {other.id}", assertion, profile, timed=True)


def _beside(block: BehaviorBlock, earlier: Iterable[BehaviorBlock]) -> Iterator[BehaviorBlock]:
    return (other for other in earlier if other.character == block.character and not other.preplan)


def _acts(block: BehaviorBlock) -> Iterator[Check]:
    """An interrupt ends its targets at its own start."""
    for behavior in block.behaviors:
        if isinstance(behavior, Interrupt) and not behavior.exclude:
            ended = [f"{behavior.target}:{name}" for name in behavior.include] or [behavior.target]
            start = f"{block.id}:{behavior.id}:start"
            for name in ended:
                yield Check("interrupt", partial(assert_linked, point=f"{name}:end", other=start), timed=True)
