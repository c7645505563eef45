"""The rigid segments of a physical body, with their masses and joint limits (thesis 3.2.1)."""

from collections.abc import Iterator
from dataclasses import dataclass

from reactive_realizer.embodiment.joints import ROOT, SIDES
from reactive_realizer.embodiment.vector import Vec3


@dataclass(frozen=True, slots=True)
class Segment:
    """A rigid part of the body, named after the H-Anim joint that connects it to its parent segment.

    Attributes:
        joint: name; the segment turns about it.
        density: kg/m^3.
        mass: in a body of `REFERENCE_WEIGHT`, kg.
        end: joint within the segment that has its orientation, where this is not `joint`.
    """

    joint: str
    density: float
    mass: float
    end: str | None = None


def _segments() -> Iterator[Segment]:
    yield Segment(ROOT, 1030.0, 10.56)
    yield Segment("vl5", 1030.0, 25.20, "vt6")
    yield Segment("vc4", 1110.0, 4.80, "skullbase")
    for side in SIDES:
        yield Segment(f"{side}_shoulder", 1070.0, 2.95)
        yield Segment(f"{side}_elbow", 1130.0, 1.59)
        yield Segment(f"{side}_wrist", 1160.0, 0.70)
        yield Segment(f"{side}_hip", 1050.0, 8.79)
        yield Segment(f"{side}_knee", 1090.0, 3.73)
        yield Segment(f"{side}_ankle", 1100.0, 1.41)


SEGMENTS = tuple(_segments())
"""Sacroiliac, upper body, head and neck, upper and lower arms, hands, upper and lower legs, and feet (figure 3.5)."""

REFERENCE_WEIGHT = sum(segment.mass for segment in SEGMENTS)
"""kg. The rows of figure 3.5 sum to 78.9 kg with both limbs counted; the total of 94.21 kg that it prints is wrong."""

REFERENCE_STATURE = 1.78
"""Stature of a body of `REFERENCE_WEIGHT`, m: head and neck of the figure have their center of mass at 1.63 m."""


@dataclass(frozen=True, slots=True)
class JointLimits:
    """Bounds of a joint's rotation vector about its x, y and z axis, degrees; an unlimited axis has (-180, 180)."""

    x: tuple[float, float]
    y: tuple[float, float]
    z: tuple[float, float]

    @property
    def lowest(self) -> Vec3:
        """The lower bounds, degrees."""
        return (self.x[0], self.y[0], self.z[0])

    @property
    def highest(self) -> Vec3:
        """The upper bounds, degrees."""
        return (self.x[1], self.y[1], self.z[1])

    @property
    def widest(self) -> float:
        """The largest rotation about a single axis, degrees."""
        return max(map(abs, (*self.lowest, *self.highest)))

    def mirrored(self) -> "JointLimits":
        """The limits of the same joint on the other side."""
        return JointLimits(self.x, (-self.y[1], -self.y[0]), (-self.z[1], -self.z[0]))


_FREE = (-180.0, 180.0)
_STIFF = (0.0, 0.0)

_LEFT = {
    "shoulder": JointLimits((-188.0, 61.0), _FREE, (-48.0, 134.0)),
    "elbow": JointLimits((-142.0, 0.0), (-103.0, 113.0), _STIFF),
    "wrist": JointLimits((-27.0, 47.0), _STIFF, (-90.0, 81.0)),
    "hip": JointLimits((-113.0, 0.0), (-31.0, 30.0), (-31.0, 53.0)),
    "knee": JointLimits((0.0, 113.0), (-43.0, 35.0), _STIFF),
    "ankle": JointLimits((-38.0, 35.0), _STIFF, (-24.0, 23.0)),
}

LIMITS = {
    **{f"l_{joint}": limits for joint, limits in _LEFT.items()},
    **{f"r_{joint}": limits.mirrored() for joint, limits in _LEFT.items()},
    "vc4": JointLimits((-60.0, 61.0), (-79.0, 79.0), (-41.0, 41.0)),
    "vl5": JointLimits((-30.0, 75.0), (-35.0, 35.0), (-35.0, 35.0)),
}
"""Limits of joints (table 3.2). Rotations of forearm and lower leg belong to elbow and knee.

The table has no row for the trunk; that of `vl5` is our choice: a spine bends further forward than back.
"""
