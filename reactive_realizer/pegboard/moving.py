"""Moving a derived peg: by the one source that would bring it to where it is to be."""

from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time
from reactive_realizer.errors import error
from reactive_realizer.pegboard.time_peg import (
    AfterPeg,
    AnticipatorPeg,
    BeforePeg,
    BMLBlockPeg,
    OffsetPeg,
    TimeCell,
    TimePeg,
)

MovableSource = AnticipatorPeg | BMLBlockPeg


def move(peg: TimeCell, time: GlobalTime) -> MovableSource:
    """Within a transaction, bring a peg to a time (s) by writing its source; which that is.

    The source is a predicted point, or the start of a block, which may be put off.

    Raises:
        RealizerError: it is pinned, hangs on several points equally, or is held elsewhere; nothing changes.
    """
    source, at = _source_of(peg, time)
    before = _written(source)
    _write(source, at)
    reached = peg.value
    if reached is None or abs(reached - time) > RESOLUTION:
        _write(source, before)
        raise error("out-of-reach", point=peg.name, time=time, source=source.name, reached=_text(reached))
    return source


def _source_of(peg: TimeCell, time: GlobalTime) -> tuple[MovableSource, GlobalTime]:
    """What to write, and what, for a peg to come to a time."""
    while not isinstance(peg, AnticipatorPeg):
        if not isinstance(peg, TimePeg) or peg.pinned:
            raise error("point-pinned", point=peg.name, time=_text(peg.value))
        match peg:
            case BMLBlockPeg():
                return peg, time
            case OffsetPeg(offset=offset):
                peg, time = peg.dependencies[0], GlobalTime(time - offset)
            case AfterPeg() | BeforePeg():
                peg = peg.dependencies[0]
            case _:
                raise error("no-single-source", point=peg.name, rule=peg.describe())
    return peg, time


def _written(source: MovableSource) -> Time:
    return source.floor if isinstance(source, BMLBlockPeg) else source.value


def _write(source: MovableSource, time: Time) -> None:
    if isinstance(source, BMLBlockPeg) and time is not None:
        source.wait_for(time, source.dependencies)
    elif isinstance(source, AnticipatorPeg):
        source.set(time)


def _text(time: Time) -> str:
    return "an unknown time" if time is None else f"{time:g} s"
