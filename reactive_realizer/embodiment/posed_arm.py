"""An arm in a pose whose forearm can be moved, with the points of forearm and hand that should keep clear of flesh."""

import math
from collections.abc import Iterator
from typing import NamedTuple, Self

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.girth import Girth
from reactive_realizer.embodiment.quaternion import Quat, between, conjugate, from_axis_angle, multiply, rotate
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import (
    ZERO,
    Vec3,
    add,
    cross,
    distance,
    dot,
    length,
    rejected,
    scale,
    subtract,
    unit,
)

_FOREARM = (0.35, 0.7)
"""Points of the forearm that are kept clear, as shares of its length; the wrist, the palm and the fingers are too."""

_MIDDLE = 0.5 * (1.0 + _FOREARM[0])

_HAND = ("index1", "pinky1", "middle2", "middle3")

_STRAIGHT = 0.995
_BENT = 0.002
"""Square of the sine of its bend at which an elbow bends half as much as it should."""

_FOLDED = math.radians(30.0)
_OFF_LINE = 0.02
"""Distance of the elbow from the line between shoulder and wrist from which on it swivels well, m."""


class Shift(NamedTuple):
    """Where the two ends of a forearm should go, m."""

    elbow: Vec3
    wrist: Vec3


STAYING = Shift(ZERO, ZERO)


class ArmLinks(NamedTuple):
    """An arm of a skeleton.

    Attributes:
        carrier: the joint that carries the shoulder.
        shoulder: its name, as those of elbow and wrist.
        elbow: its name.
        wrist: its name.
        hand: joints of the hand that are kept clear.
        upper: from shoulder to elbow, m.
        lower: from elbow to wrist, m.
        radii: of the points that are kept clear, m.
        shares: of the way from elbow to wrist at which these points are; those of the hand go with the wrist.
        knuckle: the joint around which the hand is.
        sizes: radii of two balls that contain these points, around the middle of the forearm and the knuckle, m.
    """

    carrier: str
    shoulder: str
    elbow: str
    wrist: str
    hand: tuple[str, ...]
    upper: Vec3
    lower: Vec3
    radii: tuple[float, ...]
    shares: tuple[float, ...]
    knuckle: str
    sizes: tuple[float, float]

    @classmethod
    def of(cls, skeleton: Skeleton, side: str, girth: Girth) -> Self:
        """Return the left ("l") or right ("r") arm of a skeleton."""
        shoulder, elbow, wrist = (f"{side}_{joint}" for joint in Arm.JOINTS)
        hand = tuple(name for joint in _HAND if (name := f"{side}_{joint}") in skeleton)
        begin, end = girth.forearm
        knuckle = f"{side}_middle1" if f"{side}_middle1" in skeleton else wrist
        lower, default = skeleton.offset(wrist), Body(skeleton)
        reach = (distance(*(default.transform(joint).position for joint in (knuckle, each))) for each in hand)
        return cls(
            skeleton.parent(shoulder) or shoulder,
            shoulder,
            elbow,
            wrist,
            hand,
            skeleton.offset(elbow),
            lower,
            (*(begin + share * (end - begin) for share in _FOREARM), end, *(girth.hand for _ in hand)),
            (*_FOREARM, 1.0, *(1.0 for _ in hand)),
            knuckle,
            (0.5 * (1.0 - _FOREARM[0]) * length(lower) + begin, max(reach, default=0.0) + girth.hand),
        )

    def balls(self, body: Body) -> tuple[Vec3, Vec3]:
        """Return the centers of the two balls, m."""
        elbow, wrist, knuckle = (body.transform(joint).position for joint in (self.elbow, self.wrist, self.knuckle))
        return add(elbow, scale(subtract(wrist, elbow), _MIDDLE)), knuckle

    def points(self, body: Body) -> tuple[Vec3, ...]:
        """Return the points of the arm that are kept clear, m."""
        elbow, wrist = body.transform(self.elbow).position, body.transform(self.wrist).position
        return (*_along(elbow, wrist), wrist, *(body.transform(joint).position for joint in self.hand))


class PosedArm(NamedTuple):
    """An arm in a pose, in the figure's frame unless stated.

    Attributes:
        links: its joints.
        start: of the upper arm, m.
        above: rotation of what carries it.
        shoulder: rotation of the shoulder, local.
        elbow: that of the elbow.
        hand: from the wrist to the points of the hand, in the axes of the forearm, m.
        wrist: its position, m.
        points: that are kept clear, m.
    """

    links: ArmLinks
    start: Vec3
    above: Quat
    shoulder: Quat
    elbow: Quat
    hand: tuple[Vec3, ...]
    wrist: Vec3
    points: tuple[Vec3, ...]

    @classmethod
    def of(cls, body: Body, links: ArmLinks, points: tuple[Vec3, ...]) -> Self:
        """Return the arm of a body, whose points are known."""
        wrist, *hand = points[len(_FOREARM) :]
        back = conjugate(body.transform(links.elbow).rotation)
        return cls(
            links,
            body.transform(links.shoulder).position,
            body.transform(links.carrier).rotation,
            body.rotation(links.shoulder),
            body.rotation(links.elbow),
            tuple(rotate(back, subtract(point, wrist)) for point in hand),
            wrist,
            points,
        )

    def shifted(self, shift: Shift) -> "PosedArm":
        """Return the arm with the ends of its forearm moved, as far as it can."""
        if shift is STAYING:
            return self
        back, upper, lower = conjugate(self.above), self.links.upper, self.links.lower
        goal = rotate(back, subtract(add(self.wrist, shift.wrist), self.start))
        elbow = multiply(_bend(upper, rotate(self.elbow, lower), length(goal)), self.elbow)
        way, reached = unit(goal), rotate(self.shoulder, add(upper, rotate(elbow, lower)))
        shoulder = multiply(between(unit(reached), way), self.shoulder)
        if shift.elbow != ZERO:
            middle = rejected(rotate(shoulder, upper), way)
            moved = dot(rotate(back, shift.elbow), cross(way, middle))
            shoulder = multiply(from_axis_angle(way, moved / (dot(middle, middle) + _OFF_LINE**2)), shoulder)
        return self._turned(shoulder, elbow)

    def _turned(self, shoulder: Quat, elbow: Quat) -> "PosedArm":
        upper_turn = multiply(self.above, shoulder)
        middle, turn = add(self.start, rotate(upper_turn, self.links.upper)), multiply(upper_turn, elbow)
        wrist = add(middle, rotate(turn, self.links.lower))
        points = (*_along(middle, wrist), wrist, *(add(wrist, rotate(turn, point)) for point in self.hand))
        return self._replace(shoulder=shoulder, elbow=elbow, wrist=wrist, points=points)


def _along(elbow: Vec3, wrist: Vec3) -> Iterator[Vec3]:
    """Yield the points of a forearm that are kept clear, m."""
    (ex, ey, ez), (wx, wy, wz) = elbow, wrist
    x, y, z = wx - ex, wy - ey, wz - ez
    return ((ex + share * x, ey + share * y, ez + share * z) for share in _FOREARM)


def _bend(upper: Vec3, lower: Vec3, far: float) -> Quat:
    """Return the further turn of an elbow that brings the wrist to a distance from the shoulder, or nearly."""
    long, short = length(upper), length(lower)
    sum_of_squares, product = long * long + short * short, 2.0 * long * short
    least = math.sqrt(sum_of_squares - product * math.cos(_FOLDED))
    axis = scale(cross(upper, lower), 2.0 / product)
    bent = dot(axis, axis)
    # A straight elbow would have to bend abruptly for little.
    stretched = length(add(upper, lower))
    far = stretched + (far - stretched) * bent / (bent + _BENT)
    far = min(max(stretched, _STRAIGHT * (long + short)), max(least, far))
    now = math.atan2(math.sqrt(bent), 2.0 * dot(upper, lower) / product)
    then = math.acos(max(-1.0, min(1.0, (far * far - sum_of_squares) / product)))
    return from_axis_angle(unit(add(axis, scale(Arm.HINGE, 0.01))), then - now)
