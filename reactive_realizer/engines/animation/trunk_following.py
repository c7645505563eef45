"""Trunk, head and pelvis follow a gesturing or pointing arm.

In T. Kaminski, C. Bock and A. Gentile, "The coordination between trunk and arm motion during pointing movements"
(Experimental Brain Research 106, 1995), the trunk starts with the arm and finishes after it, and it takes part where
the hand goes far. All figures here are ours.
"""

import math
from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import HEAD, SIDES, TRUNK
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, conjugate, from_euler, multiply, power, rotate
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import Vec3, add, length, scale, subtract
from reactive_realizer.engines.animation.easing import share, smoothstep
from reactive_realizer.engines.animation.idle_movements import leaning
from reactive_realizer.engines.animation.procedural.effector_track import girdle_of

_NEAR, _WIDE = 0.85, 1.2
"""Way of a wrist from where it hangs, in lengths of its arm: up to the first one, the trunk stays; from the second one
on, it follows in full. A beat in front of the belly goes 0.8, a hand that waves or points 1.2."""

_TURN = (math.radians(5.0), math.radians(-4.0))
"""Turn to the side of the arm, rad: for a hand that goes straight outward, and straight forward."""

_BEND = (math.radians(2.0), math.radians(-3.0))
"""Bend to the side of the arm, rad: for a hand that goes straight outward, and straight up."""

_BOW = (math.radians(3.0), math.radians(-2.0))
"""Bow, rad: for a hand that goes straight forward, and straight up."""

_LEAN = 0.6
"""Weight on the foot of this side (`leaning`), for a hand that goes straight outward."""

_PARTS: Mapping[str, float] = {"vl5": 0.3, "vt10": 0.3, "vt6": 0.4}
"""Share of each joint in the turn of the trunk."""

_HEAD_PART = 0.2
"""Share of each joint of neck and head by which the head goes further than the trunk, where nothing directs it."""

_QUICKNESS = 10.0
"""Natural angular frequency with which the trunk follows, rad/s: it lags behind the arm by 0.2 s."""

_LONGEST = 0.05
"""After a longer time without a frame, the trunk has rested, s."""

_AT_REST = 1e-5


class Following(NamedTuple):
    """How far trunk and pelvis follow.

    Attributes:
        turn: of the trunk to the left, rad.
        bend: of the trunk to the left, rad.
        bow: of the trunk, rad.
        lean: the supporting foot, -1 (right) to 1 (left).
    """

    turn: float
    bend: float
    bow: float
    lean: float


_UPRIGHT = Following(0.0, 0.0, 0.0, 0.0)


def following(skeleton: Skeleton, rotations: Mapping[str, Quat], weight: float = 1.0) -> Following:
    """Return how far trunk and pelvis follow arms.

    Args:
        skeleton: of the figure.
        rotations: of the arms' joints; without a shoulder, an arm does not count.
        weight: of these rotations, 0 to 1.
    """
    arms = [_one_arm(skeleton, rotations, side) for side in SIDES if f"{side}_shoulder" in rotations]
    if all(arm is _UPRIGHT for arm in arms):  # as in most gestures
        return _UPRIGHT
    return Following(*(weight * sum(parts) for parts in zip(_UPRIGHT, *arms, strict=True)))


def _one_arm(skeleton: Skeleton, rotations: Mapping[str, Quat], side: str) -> Following:
    own = 1.0 if side == "l" else -1.0
    way = _way(skeleton, rotations, side)
    far = length(way)
    degree = smoothstep(share(far, _NEAR, _WIDE))
    if degree == 0.0:
        return _UPRIGHT
    aside, up, ahead = scale(way, degree / far)
    outward = own * aside
    turn, bend, bow = (
        a * first + b * second
        for (a, b), first, second in ((_TURN, outward, ahead), (_BEND, outward, up), (_BOW, ahead, up))
    )
    return Following(own * turn, own * bend, bow, own * _LEAN * outward)


def _way(skeleton: Skeleton, rotations: Mapping[str, Quat], side: str) -> Vec3:
    """Return the way of a wrist from where it hangs, in the axes of the trunk and in lengths of its arm."""
    arm = _hanging(skeleton, side)
    girdle, shoulder, elbow = arm.joints
    hand = rotate(rotations[shoulder], add(arm.upper, rotate(rotations.get(elbow, IDENTITY), arm.lower)))
    if girdle in rotations:
        hand = rotate(rotations[girdle], hand)
    return scale(subtract(hand, arm.wrist), 1.0 / arm.length)


class _Hanging(NamedTuple):
    """An arm that hangs.

    Attributes:
        joints: girdle, shoulder and elbow.
        upper: from shoulder to elbow, m.
        lower: from elbow to wrist, m.
        wrist: from the shoulder, m.
        length: of both bones, m.
    """

    joints: tuple[str, str, str]
    upper: Vec3
    lower: Vec3
    wrist: Vec3
    length: float


@lru_cache
def _hanging(skeleton: Skeleton, side: str) -> _Hanging:
    arm, joints = Arm.of(skeleton, side), (girdle_of(side), f"{side}_shoulder", f"{side}_elbow")
    return _Hanging(joints, arm.upper, arm.lower, add(arm.upper, arm.lower), length(arm.upper) + length(arm.lower))


class TrunkFollowing:
    """Lets trunk, head and pelvis of a figure follow its arms, as critically damped springs do.

    However abruptly an arm is taken over, interrupted or hurried, they start softly and come to rest.
    """

    def __init__(self, skeleton: Skeleton) -> None:
        self._skeleton = skeleton
        parts = {joint: part for joint, part in _PARTS.items() if joint in skeleton}
        self._parts = [(joint, part / sum(parts.values())) for joint, part in parts.items()]
        *self._below, self._neck = skeleton.chain(next(joint for joint in HEAD if joint in skeleton))
        self._time = GlobalTime(0.0)
        self._at, self._speed = _UPRIGHT, _UPRIGHT

    def layers(
        self, now: GlobalTime, arms: Iterable[Layer], body: Body, *, directed: bool, standing: float
    ) -> tuple[Layer, ...]:
        """Return the additive layer of a frame; none at rest. It need not be called while it rests without arms.

        Args:
            now: s.
            arms: the layers of gestures and pointings.
            body: as shown last, without additive motion.
            directed: whether a motion directs the head, which then keeps its direction.
            standing: degree to which weight may be shifted, 0 to 1.
        """
        passed, self._time = min(now - self._time, _LONGEST), now
        self._follow(self._goal(arms), passed)
        if self.rests:
            return ()
        turn = from_euler(self._at.bow, self._at.turn, -self._at.bend)
        turns, root = self._trunk(turn, standing)
        head = self._kept(turns, body) if directed else self._further(turn, turns)
        return (Layer(LayerKind.ADDITIVE, {**turns, **head}, root=root),)

    @property
    def rests(self) -> bool:
        """Whether trunk and pelvis are upright and do not move."""
        return self._at == _UPRIGHT

    def _goal(self, arms: Iterable[Layer]) -> Following:
        wanted = [following(self._skeleton, arm.rotations, arm.weight) for arm in arms if _carried(arm)]
        if len(wanted) == 1:
            return wanted[0]
        return Following(*map(sum, zip(*wanted, strict=True))) if wanted else _UPRIGHT

    def _follow(self, goal: Following, passed: float) -> None:
        """Move on toward a goal for some time, s."""
        if goal == self._at and self._speed == _UPRIGHT:
            return
        left = math.exp(-_QUICKNESS * passed)
        at, speeds = [], []
        for wanted, value, speed in zip(goal, self._at, self._speed, strict=True):
            off = value - wanted
            drift = speed + _QUICKNESS * off
            at.append(wanted + (off + drift * passed) * left)
            speeds.append((speed - _QUICKNESS * drift * passed) * left)
        self._at, self._speed = Following(*at), Following(*speeds)
        if goal == _UPRIGHT and max(map(abs, (*at, *speeds))) < _AT_REST:
            self._at = self._speed = _UPRIGHT

    def _trunk(self, turn: Quat, standing: float) -> tuple[dict[str, Quat], Vec3 | None]:
        """Return the turns of trunk and pelvis, and the displacement of the pelvis, m."""
        side = standing * self._at.lean
        leant, root = leaning(side) if abs(side) > _AT_REST else ({}, None)
        turns = {joint: multiply(leant.get(joint, IDENTITY), power(turn, part)) for joint, part in self._parts}
        return {**leant, **turns}, root

    @staticmethod
    def _further(turn: Quat, turns: Mapping[str, Quat]) -> dict[str, Quat]:
        """Return the turns of neck and head that go further than the trunk."""
        further = power(turn, _HEAD_PART)
        return {joint: multiply(turns.get(joint, IDENTITY), further) for joint in HEAD}

    def _kept(self, turns: Mapping[str, Quat], body: Body) -> dict[str, Quat]:
        """Return the turn of the neck with which the head keeps its direction while the trunk turns."""
        steady = turned = IDENTITY
        for joint in self._below:
            held = body.rotation(joint)
            steady, turned = multiply(steady, held), multiply(turned, held)
            if joint in turns:
                turned = multiply(turned, turns[joint])
        held = body.rotation(self._neck)
        return {self._neck: multiply(conjugate(multiply(turned, held)), multiply(steady, held))}


def _carried(arm: Layer) -> bool:
    """Return whether a motion of arms leaves the trunk alone."""
    return arm.rotations.keys().isdisjoint(TRUNK)
