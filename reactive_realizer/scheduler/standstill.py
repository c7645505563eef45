"""When a block moves by itself, whether it still can, and what it waits for if it cannot."""

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.pegboard.following import unknown_sources
from reactive_realizer.scheduler.bml_block import BlockState, BMLBlock


def times_ahead(block: BMLBlock) -> list[GlobalTime]:
    """When something of a block is to happen, as far as that is known; nothing is while it waits for others."""
    if block.state.plays:
        times = [point.peg.value for unit in block.live_units for point in unit.ahead()]
    else:
        times = [block.start.value] if block.may_start else []
    return [time for time in times if time is not None]


def can_move(block: BMLBlock, now: GlobalTime) -> bool:
    """Whether it is being prepared, may start, or a time that is known lies ahead of it."""
    times = times_ahead(block)
    if not block.state.plays:
        return block.state is BlockState.IN_PREP or bool(times)
    return any(not is_due(time, now) for time in times)


def awaited_by(block: BMLBlock) -> list[str]:
    """Names of the ends, activations and predictions without which nothing of it moves, each once."""
    pegs = [point.peg for unit in block.live_units for point in unit.ahead()]
    ends = [wait.peg.name for wait in block.waits_for]
    return list(dict.fromkeys([*ends, *unknown_sources([block.start, *pegs])]))
