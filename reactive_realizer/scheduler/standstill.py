"""Whether a block can still move by itself, and what it waits for if it cannot."""

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.pegboard.following import unknown_sources
from reactive_realizer.scheduler.bml_block import BlockState, BMLBlock


def can_move(block: BMLBlock, now: GlobalTime) -> bool:
    """Whether it is being prepared, may start, or a time that is known lies ahead of it."""
    if not block.state.plays:
        return block.state is BlockState.IN_PREP or (block.may_start and block.start.value is not None)
    times = (point.peg.value for unit in block.live_units for point in unit.ahead())
    return any(time is not None and not is_due(time, now) for time in times)


def awaited_by(block: BMLBlock) -> list[str]:
    """Names of the ends, activations and predictions without which nothing of it moves, each once."""
    pegs = [point.peg for unit in block.live_units for point in unit.ahead()]
    ends = [wait.peg.name for wait in block.waits_for]
    return list(dict.fromkeys([*ends, *unknown_sources([block.start, *pegs])]))
