"""What blocks say about each other: composition, and the attributes and behaviors of BMLA."""

from collections.abc import Iterable, Iterator
from functools import partial

from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.continuous import Activate, Interrupt
from reactive_realizer.bml.words import Composition
from reactive_realizer.conformance.case import Case
from reactive_realizer.conformance.check import TOLERANCE, Check
from reactive_realizer.testing.assertions import assert_linked, assert_order


def relations(case: Case) -> Iterator[Check]:
    """The order of the blocks of a case, as far as they start."""
    earlier: list[BehaviorBlock] = []
    for block in case.blocks:
        if case.starts(block):
            yield from _waits(case, block, earlier)
            yield from _acts(block)
        earlier.append(block)


def _waits(case: Case, block: BehaviorBlock, earlier: Iterable[BehaviorBlock]) -> Iterator[Check]:
    blocks = {other.id: other for other in case.blocks}
    if block.composition is not Composition.MERGE:
        before = [other.id for other in earlier if other.character == block.character and not other.preplan]
        yield from _after(block, before, f"composition={block.composition}")
    yield from _after(block, block.append_after, "appendAfter")
    yield from _after(block, block.interrupts, "interrupt")
    for name in block.chunk_after:
        yield from (_order(point, f"{block.id}:start", "chunkAfter") for point in _subsiding(blocks[name]))
    for name in block.prepend_before:
        yield _order(f"{block.id}:end", f"{name}:start", "prependBefore")
    for name in block.chunk_before:
        yield from (_order(point, f"{name}:start", "chunkBefore") for point in _subsiding(block))
    for name in block.on_start:
        yield _together(f"{name}:start", f"{block.id}:start", "onStart")


def _acts(block: BehaviorBlock) -> Iterator[Check]:
    """What activate and interrupt do at their start."""
    for behavior in block.behaviors:
        start = f"{block.id}:{behavior.id}:start"
        match behavior:
            case Activate(target=target):
                yield _together(f"{target}:start", start, "activate")
            case Interrupt(target=target, include=(), exclude=()):
                yield _together(f"{target}:end", start, "interrupt")
            case Interrupt(target=target, include=include):
                yield from (_together(f"{target}:{name}:end", start, "interrupt") for name in include)
            case _:
                pass


def _after(block: BehaviorBlock, others: Iterable[str], text: str) -> Iterator[Check]:
    return (_order(f"{other}:end", f"{block.id}:start", text) for other in others)


def _subsiding(block: BehaviorBlock) -> Iterator[str]:
    """The points that a block has passed when all that is left of it is in retraction."""
    for behavior in block.behaviors:
        last = "relax" if "relax" in behavior.sync_points else "end"
        yield f"{block.id}:{behavior.id}:{last}"


def _order(earlier: str, later: str, text: str) -> Check:
    return Check(text, partial(assert_order, earlier=earlier, later=later, tolerance=TOLERANCE))


def _together(point: str, other: str, text: str) -> Check:
    return Check(text, partial(assert_linked, point=point, other=other, tolerance=TOLERANCE))
