"""A motion as a function of phase: what the animation engine plays between pegs (thesis 4.2)."""

from collections.abc import Mapping
from typing import Protocol

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import Quat

GESTURE_POINTS = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")
"""Sync points of gesture, head and pointing, in order (BML 1.0)."""


class MotionUnit(Protocol):
    """One motion of one character.

    Which phase it is when is not its business: phases are spread between key positions as their pegs say.
    """

    parameters: dict[str, float]
    """Name -> value; a value may be changed while the motion plays."""

    @property
    def amount(self) -> str | None:
        """The one of its parameters that says how much of it is shown, 0 to 1; None if none does."""

    @property
    def joints(self) -> frozenset[str]:
        """The joints that it turns, while it plays."""

    @property
    def key_positions(self) -> Mapping[str, float]:
        """Sync id -> phase, 0 to 1; "start" is 0 and "end" is 1, and later points never lie at earlier phases."""

    @property
    def preferred_duration(self) -> float:
        """How long it takes where nothing else is asked for, s."""

    def start(self, body: Body) -> None:
        """The motion begins from here: the body as shown last, without additive layers."""

    def pose(self, phase: float, body: Body) -> dict[str, Quat]:
        """Rotations local to the parent at a phase, of each of the joints.

        Args:
            phase: 0 to 1.
            body: as shown last; the joints above those turned matter.

        Raises:
            RealizerError: "no-motion": there is none at this phase; the unit should be stopped.
        """


def completed(key_positions: Mapping[str, float]) -> dict[str, float]:
    """Key positions with the seven points of a gesture, in order; those that the author left out coincide with others.

    ready = start, relax = end, strokeStart = ready, strokeEnd = relax, stroke = strokeStart. Other points stay.
    """
    keys = {"start": 0.0, "end": 1.0, **key_positions}
    ready = keys.get("ready", keys["start"])
    relax = keys.get("relax", keys["end"])
    stroke_start = keys.get("strokeStart", ready)
    filled = {
        "ready": ready,
        "strokeStart": stroke_start,
        "stroke": keys.get("stroke", stroke_start),
        "strokeEnd": keys.get("strokeEnd", relax),
        "relax": relax,
    }
    return dict(sorted({**keys, **filled}.items(), key=lambda item: (item[1], _rank(item[0]))))


def _rank(name: str) -> int:
    point = name.partition(":")[0]
    return GESTURE_POINTS.index(point) if point in GESTURE_POINTS else len(GESTURE_POINTS)
