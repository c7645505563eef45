"""The times of a sequence: each pose is reached at its time, and kept until its hold ends."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from reactive_realizer.bml.embr.faults import TimeBack
from reactive_realizer.bml.embr.syntax import CLIP, Node
from reactive_realizer.bml.embr.values import Notes
from reactive_realizer.errors import RealizerError

SHORTEST: Final = 0.04
"""Duration of a way to a pose that would have none, s, as in EMBR."""

_ROUNDING: Final = 1e-9


@dataclass(frozen=True, slots=True)
class Timed:
    """A key pose or a clip in time, s after the start of its sequence.

    Attributes:
        node: its element.
        begins: the end of what is before it.
        reached: its time.
        left: the end of its hold.
        power: of the way to it.
    """

    node: Node
    begins: float
    reached: float
    left: float
    power: float = 0.0


def sequence_start(node: Node, notes: Notes) -> float:
    """The start of a sequence after the script enters, s.

    Absolute times count from there too: each script is a session of its own.
    """
    if "START" not in node.values or node.values["START"].text == "asap":
        return 0.0
    try:
        return notes.moment(node, "START")[1]
    except RealizerError as refused:
        notes.faults.append(refused.fault)
        return 0.0


def timed(node: Node, start: float, notes: Notes) -> Iterator[Timed]:
    """The poses and clips of a sequence in order; those without a time are left out."""
    last = 0.0
    for child in node.children:
        try:
            relative, time = notes.moment(child, "TIME_POINT")
            hold = 0.0 if child.name == CLIP else notes.seconds(child, "HOLD", 0.0)
        except RealizerError as refused:
            notes.faults.append(refused.fault)
            continue
        time = round(time if relative else time - start, 6)
        if time < last - _ROUNDING:
            notes.add(TimeBack(time=time, earliest=last), child.values["TIME_POINT"].location)
        reached = time if time > last + _ROUNDING else round(last + SHORTEST, 6)
        yield Timed(child, last, reached, round(reached + hold, 6))
        last = round(reached + hold, 6)
