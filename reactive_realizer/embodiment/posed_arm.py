"""An arm in a pose whose forearm can be moved, with the points of forearm and hand that should keep clear of flesh."""

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple, Self

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.girth import FOREARM, Girth
from reactive_realizer.embodiment.quaternion import Quat, between, conjugate, from_axis_angle, multiply, rotate
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import (
    FORWARD,
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

_KNUCKLES = ("index1", "pinky1")
"""Joints of the palm that are kept clear."""

_TIP = 0.7
"""Center of a fingertip beyond its last joint, in lengths of the bone before it."""

_FINGERTIPS = (("index1", 0.9), ("ring1", 1.4))
"""Fingers whose tips go with the middle one and are kept clear: how far they are aside, in distances of knuckles."""

_OWN_TIPS = ("thumb3", "pinky3")
"""Last joints of the fingers at the edges of a hand, which bend unlike the middle one: their tips are kept clear."""

_NEAR_ELBOW, _NEAR_WRIST = range(2), range(2, len(FOREARM))

GROUPS = (0, 1, 2)
"""Numbers of groups of points: near the elbow, near the wrist, of the hand."""

ALL_GROUPS, HAND = (1 << len(GROUPS)) - 1, 1 << GROUPS[-1]
"""Sets of groups: bit n for group n."""

_STRAIGHT = 0.995
_BENT = 0.002
"""Square of the sine of its bend at which an elbow bends half as much as it should."""

_MIDDLE, _LITTLE = (tuple(f"{finger}{number}" for number in (1, 2, 3)) for finger in ("middle", "pinky"))
"""Joints of the fingers that bend like a fist."""

_BENDS = (0.0, 0.3, 0.6, 0.9, 1.2, 1.5)
"""How far each of these joints bends from a flat hand to a fist, rad."""

_SPREAD = 0.01
"""How much further from the middle of a hand its points may be, m: fingers spread, too."""

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
        upper: from shoulder to elbow, m.
        lower: from elbow to wrist, m.
        hand: joints of the hand, each with points in its axes that are kept clear, m.
        radii: of the points that are kept clear, first those of the forearm, m.
        shares: of the way from elbow to wrist at which these points are; those of the hand go with the wrist.
        groups: numbers of the points of each group.
        spans: for each set of groups, the numbers of the points from the first to the last group.
        middles: of the groups of the forearm, as shares of its length.
        palm: middle of the group of the hand, in the axes of the wrist, m.
        reaches: furthest points of the groups from their middles, m.
    """

    carrier: str
    shoulder: str
    elbow: str
    wrist: str
    upper: Vec3
    lower: Vec3
    hand: tuple[tuple[str, tuple[Vec3, ...]], ...]
    radii: tuple[float, ...]
    shares: tuple[float, ...]
    groups: tuple[range, ...]
    spans: tuple[range, ...]
    middles: tuple[float, ...]
    palm: Vec3
    reaches: tuple[float, ...]

    @classmethod
    def of(cls, skeleton: Skeleton, side: str, girth: Girth) -> Self:
        """Return the left ("l") or right ("r") arm of a skeleton."""
        shoulder, elbow, wrist = (f"{side}_{joint}" for joint in Arm.JOINTS)
        lower, hand = skeleton.offset(wrist), _Hand(skeleton, side)
        (palm, reach), (knuckles, *fingers) = hand.ball(), tuple(hand.points())
        radii = (
            *girth.forearm,
            *(girth.hand for _ in knuckles[1]),
            *(girth.finger for _, points in fingers for _ in points),
        )
        groups = _NEAR_ELBOW, _NEAR_WRIST, range(len(FOREARM), len(radii))
        ends = [(FOREARM[group[0]], FOREARM[group[-1]]) for group in (_NEAR_ELBOW, _NEAR_WRIST)]
        return cls(
            skeleton.parent(shoulder) or shoulder,
            shoulder,
            elbow,
            wrist,
            skeleton.offset(elbow),
            lower,
            (knuckles, *fingers),
            radii,
            (*FOREARM, *(1.0 for _ in radii[len(FOREARM) :])),
            groups,
            tuple(_span(groups, number) for number in range(ALL_GROUPS + 1)),
            tuple(0.5 * (first + last) for first, last in ends),
            palm,
            (*(0.5 * (last - first) * length(lower) for first, last in ends), reach),
        )

    def balls(self, body: Body) -> tuple[Vec3, Vec3, Vec3]:
        """Return the middles of the groups, m."""
        (ex, ey, ez), (wrist, turn) = body.transform(self.elbow).position, body.transform(self.wrist)
        wx, wy, wz = wrist
        upper, lower = self.middles
        x, y, z = wx - ex, wy - ey, wz - ez
        return (
            (ex + upper * x, ey + upper * y, ez + upper * z),
            (ex + lower * x, ey + lower * y, ez + lower * z),
            add(wrist, rotate(turn, self.palm)),
        )

    def forearm_points(self, body: Body) -> list[Vec3]:
        """Return the points of the forearm that are kept clear, m."""
        return _along(body.transform(self.elbow).position, body.transform(self.wrist).position)

    def hand_points(self, body: Body) -> list[Vec3]:
        """Return the points of the hand that are kept clear, m."""
        found = []
        for joint, points in self.hand:
            (px, py, pz), turn = body.transform(joint)
            for point in points:
                x, y, z = rotate(turn, point)
                found.append((px + x, py + y, pz + z))
        return found


class _Hand:
    """A hand of a skeleton."""

    def __init__(self, skeleton: Skeleton, side: str) -> None:
        self._skeleton, self._side, self._default = skeleton, side, Body(skeleton)
        self._wrist = f"{side}_wrist"

    def points(self) -> Iterator[tuple[str, tuple[Vec3, ...]]]:
        """Yield joints with points in their axes that are kept clear, m, the palm first."""
        yield self._wrist, tuple(self._from(self._wrist, knuckle) for knuckle in _KNUCKLES if self._has(knuckle))
        if all(map(self._has, _MIDDLE)):
            yield f"{self._side}_middle2", (ZERO,)
            aside = [
                scale(self._from(f"{self._side}_middle1", knuckle), far)
                for knuckle, far in _FINGERTIPS
                if self._has(knuckle)
            ]
            yield f"{self._side}_middle3", tuple(add(self._tip("middle3"), each) for each in aside or (ZERO,))
        for joint in _OWN_TIPS:
            if self._has(joint):
                yield f"{self._side}_{joint}", (self._tip(joint),)

    def ball(self) -> tuple[Vec3, float]:
        """Return the middle of the hand, in the axes of the wrist, m, and how far from there its points may be, m."""
        placed = [place for bend in _BENDS for place in self._bent(bend)]
        if not placed:
            return ZERO, 0.0
        x, y, z = (0.5 * (min(side) + max(side)) for side in zip(*placed, strict=True))
        return (x, y, z), max(distance((x, y, z), place) for place in placed) + _SPREAD

    def _bent(self, bend: float) -> Iterator[Vec3]:
        """Yield the points of the hand, relative to the wrist, m, where each joint of the fingers bends so far, rad."""
        turn = from_axis_angle(FORWARD, -bend if self._side == "l" else bend)
        body = Body(self._skeleton, dict.fromkeys((f"{self._side}_{joint}" for joint in (*_MIDDLE, *_LITTLE)), turn))
        start = body.transform(self._wrist).position
        for joint, points in self.points():
            place = body.transform(joint)
            yield from (subtract(add(place.position, rotate(place.rotation, point)), start) for point in points)

    def _has(self, joint: str) -> bool:
        return f"{self._side}_{joint}" in self._skeleton

    def _tip(self, joint: str) -> Vec3:
        return scale(self._skeleton.offset(f"{self._side}_{joint}"), _TIP)

    def _from(self, start: str, joint: str) -> Vec3:
        end = self._default.transform(f"{self._side}_{joint}").position
        return subtract(end, self._default.transform(start).position)


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
    points: Sequence[Vec3]

    @classmethod
    def of(cls, body: Body, links: ArmLinks, points: Sequence[Vec3]) -> Self:
        """Return the arm of a body, whose points are known."""
        wrist, *hand = points[len(FOREARM) - 1 :]
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
        shoulder, elbow = brought((upper, lower), (self.shoulder, self.elbow), goal)
        if shift.elbow != ZERO:
            way = unit(goal)
            middle = rejected(rotate(shoulder, upper), way)
            moved = dot(rotate(back, shift.elbow), cross(way, middle))
            shoulder = multiply(from_axis_angle(way, moved / (dot(middle, middle) + _OFF_LINE**2)), shoulder)
        return self._turned(shoulder, elbow)

    def _turned(self, shoulder: Quat, elbow: Quat) -> "PosedArm":
        upper_turn = multiply(self.above, shoulder)
        middle, turn = add(self.start, rotate(upper_turn, self.links.upper)), multiply(upper_turn, elbow)
        wrist = add(middle, rotate(turn, self.links.lower))
        points = (*_along(middle, wrist), *(add(wrist, rotate(turn, point)) for point in self.hand))
        return self._replace(shoulder=shoulder, elbow=elbow, wrist=wrist, points=points)


def brought(bones: tuple[Vec3, Vec3], turns: tuple[Quat, Quat], goal: Vec3) -> tuple[Quat, Quat]:
    """Return the rotations of shoulder and elbow that bring a wrist to a goal, or nearly, by the smallest turns.

    Args:
        bones: from shoulder to elbow, and from elbow to wrist, m.
        turns: the rotations now.
        goal: from the shoulder, in the axes of what carries it, m.
    """
    (upper, lower), (shoulder, elbow) = bones, turns
    elbow = multiply(_bend(upper, rotate(elbow, lower), length(goal)), elbow)
    reached = rotate(shoulder, add(upper, rotate(elbow, lower)))
    return multiply(between(unit(reached), unit(goal)), shoulder), elbow


def _span(groups: Sequence[range], which: int) -> range:
    """Return the numbers from the first to the last of some groups of points: bit n for group n."""
    chosen = [group for number, group in enumerate(groups) if which >> number & 1]
    return range(chosen[0].start, chosen[-1].stop) if chosen else range(0)


def _along(elbow: Vec3, wrist: Vec3) -> list[Vec3]:
    """Return the points of a forearm that are kept clear, m."""
    (ex, ey, ez), (wx, wy, wz) = elbow, wrist
    x, y, z = wx - ex, wy - ey, wz - ez
    return [(ex + share * x, ey + share * y, ez + share * z) for share in FOREARM]


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
