"""Distributes a turn toward a target over trunk, neck and head, by D. Tweed's model of gaze.

The groups are the keys of SmartBody's gaze, from EYES to BACK. All functions are pure.
"""

import math
from collections.abc import Callable, Mapping
from functools import lru_cache
from types import MappingProxyType
from typing import NamedTuple, Self

from reactive_realizer.bml.vocabulary import Influence
from reactive_realizer.embodiment.body import Body, JointRotations
from reactive_realizer.embodiment.quaternion import (
    IDENTITY,
    Quat,
    angle,
    between,
    conjugate,
    from_axis_angle,
    multiply,
    power,
    rotate,
)
from reactive_realizer.embodiment.vector import FORWARD, Vec3, unit
from reactive_realizer.engines.animation.gaze.eyes import EYE_RANGE, EyeSockets, direction_between, eye_range
from reactive_realizer.engines.animation.motion_unit import AMOUNT_RANGE
from reactive_realizer.planunit.parameter import Range

EYE_WEIGHT = "eyes"

JOINT_GROUPS: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {
        "back": {"vl5": 1.0},
        "chest": {"vt10": 0.4, "vt6": 0.6},
        "neck": {"vc4": 1.0},
        "head": {"skullbase": 1.0},
    }
)
"""Group of joints, lowest first -> joint -> its share of the group's turn."""

HEAD_WEIGHTS: Mapping[str, Range] = MappingProxyType(dict.fromkeys(JOINT_GROUPS, AMOUNT_RANGE))
"""Parameters of a head turn: the share of each group; the sum of all shares is limited to 1."""

GAZE_WEIGHTS: Mapping[str, Range] = MappingProxyType({**HEAD_WEIGHTS, EYE_WEIGHT: AMOUNT_RANGE})
"""Parameters of a gaze. The weight of the eyes is the share by which they turn from straight ahead to the target."""

_HEAD = {"neck": 0.43, "head": 0.57, EYE_WEIGHT: 1.0}
_SHOULDER = {"chest": 0.26, "neck": 0.32, "head": 0.42, EYE_WEIGHT: 1.0}
_WAIST = {"back": 0.17, "chest": 0.24, "neck": 0.26, "head": 0.33, EYE_WEIGHT: 1.0}

_USUAL: Mapping[Influence, Mapping[str, float]] = {
    Influence.EYES: {EYE_WEIGHT: 1.0},
    Influence.HEAD: _HEAD,
    Influence.SHOULDER: _SHOULDER,
    Influence.WAIST: _WAIST,
    # The feet turn the figure only where the joints do not reach (`StepTurns`).
    Influence.WHOLE: _WAIST,
}


def default_weights(influence: Influence) -> dict[str, float]:
    """Return the default weight of every group, 0 to 1."""
    return {group: _USUAL[influence].get(group, 0.0) for group in GAZE_WEIGHTS}


def joint_weights(weights: Mapping[str, float]) -> Mapping[str, float]:
    """Return joint -> share of the head's turn, for joints with a share."""
    return _joint_weights(*(weights[group] for group in JOINT_GROUPS))


@lru_cache
def _joint_weights(*weights: float) -> Mapping[str, float]:
    parts = {
        joint: weight * part
        for weight, joints in zip(weights, JOINT_GROUPS.values(), strict=True)
        for joint, part in joints.items()
        if weight > 0.0
    }
    return MappingProxyType(parts)


HORIZONTAL = 0.9
VERTICAL = 0.3
TORSIONAL = -0.15
"""Shares by which the head makes the turn that would point the nose at the target: D. Tweed, "Three-dimensional model
of the human eye-head saccadic system" (Journal of Neurophysiology 77, 1997)."""

# The head leaves at most this share of their range to the eyes, so that a nod does not lose the target.
_EYE_COMFORT = 0.8

# Limits of each joint: turn up or down, and to a side, rad. These are the ranges of the segments of a spine.
_FURTHEST = {
    "vl5": (0.15, 0.35),
    "vt10": (0.12, 0.25),
    "vt6": (0.12, 0.25),
    "vc4": (0.35, 0.60),
    "skullbase": (0.45, 0.75),
}

_LIMIT_DECREASE = 0.3
"""Decrease of the limit to a side for each radian of height above or below the eyes.

This gets nearest to the target.
"""


class HeadTurn(NamedTuple):
    """A turn toward a point.

    Attributes:
        rotations: of the participating joints of trunk, neck and head, local to their parents.
        missing: angle by which joints and eyes fall short of the point, rad; 0 if they reach it. None for a point that
            is too near to have a direction; then they point straight ahead.
    """

    rotations: Mapping[str, Quat]
    missing: float | None


class HeadTurner:
    """Turns trunk, neck and head toward points.

    All joints turn about one axis, so the head does as well on its way from rest: D. Tweed and T. Vilis, "Listing's law
    for gaze-directing head movements" (1992). A turn is computed again only if something has changed: usually, the
    figure stands and its target does not move.
    """

    def __init__(self) -> None:
        self._from: tuple[_Ahead, EyeSockets] | None = None
        self._to: tuple[Vec3, HeadTurn] | None = None

    def __call__(
        self, body: Body, rest: JointRotations, point: Callable[[Vec3], Vec3], weights: Mapping[str, float]
    ) -> HeadTurn:
        """Return the turn of trunk, neck and head toward a point, by their weights.

        Args:
            body: as it is; its rotations of these joints have no effect.
            rest: pose of these joints without gaze.
            point: returns the target from the midpoint between the eyes, both in the figure's frame, m.
            weights: of each group of joints.
        """
        ahead = _Ahead.of(body, rest, weights)
        if self._from is None or self._from[0] != ahead:
            self._from, self._to = (ahead, EyeSockets.of(Body(body.skeleton, ahead.rotations, ahead.root))), None
        _, sockets = self._from
        target = point(sockets.middle)
        if self._to is None or self._to[0] != target:
            self._to = target, _turn_toward(target, sockets, ahead)
        return self._to[1]


class _Ahead(NamedTuple):
    """A head that looks straight ahead, and how it may turn.

    Attributes:
        rotations: of the joints from the root to the head, in order.
        root: displacement of HumanoidRoot, m.
        parts: joint -> its share of the turn.
        eyes: weight of the eyes.
    """

    rotations: dict[str, Quat]
    root: Vec3
    parts: Mapping[str, float]
    eyes: float

    @classmethod
    def of(cls, body: Body, rest: JointRotations, weights: Mapping[str, float]) -> Self:
        """Return the head of a body; see `HeadTurner`."""
        parts = {joint: part for joint, part in joint_weights(weights).items() if joint in body.skeleton}
        chain, pose = body.skeleton.links("skullbase"), body.pose
        rotations = {joint: (rest if joint in parts else pose).get(joint, IDENTITY) for joint, _ in chain}
        return cls(rotations, body.root, parts, weights.get(EYE_WEIGHT, 0.0))


def _turn_toward(target: Vec3, sockets: EyeSockets, ahead: _Ahead) -> HeadTurn:
    way = direction_between(sockets.middle, target)
    direction = FORWARD if way is None else rotate(conjugate(sockets.rotation), way)
    eye_share = ahead.eyes * _EYE_COMFORT
    aside = sum(_FURTHEST[joint][1] for joint in ahead.parts) + eye_share * EYE_RANGE
    turn = head_turn(_limited_to_side(direction, aside), min(1.0, sum(ahead.parts.values())), eye_share)
    rotations, done = _spread(turn, ahead.parts, ahead.rotations)
    if way is None:
        return HeadTurn(rotations, None)
    beyond = _remaining_turn(done, direction)
    # Eyes with a partial weight need not reach the target.
    left = eye_range(beyond) / ahead.eyes if ahead.eyes > 0.0 else 0.0
    return HeadTurn(rotations, max(0.0, angle(beyond) - left))


def head_turn_toward(
    body: Body, rest: JointRotations, point: Callable[[Vec3], Vec3], weights: Mapping[str, float]
) -> HeadTurn:
    """Return a turn of trunk, neck and head toward a point, as `HeadTurner` does."""
    return HeadTurner()(body, rest, point, weights)


def head_turn(direction: Vec3, part: float, eye_share: float) -> Quat:
    """Return the head's turn toward a direction: more to the side than up or down, with roll by Donders' law.

    With x the quaternion of the turn that would point the nose there, it is (0.3 x_v, 0.9 x_h, -0.15 x_v x_h): each
    direction has one roll, wherever the head comes from. If the eyes could not make up for the rest, the head turns
    further by the shortest turn.

    Args:
        direction: a unit vector in the axes of a head that looks straight ahead.
        part: share of the turn, 0 to 1.
        eye_share: share of their range by which the eyes make up for the rest.
    """
    _, vertical, horizontal, _ = between(FORWARD, direction)
    x, y, z = VERTICAL * vertical, HORIZONTAL * horizontal, TORSIONAL * vertical * horizontal
    turn = power((math.sqrt(1.0 - x * x - y * y - z * z), x, y, z), part)
    beyond = _remaining_turn(turn, direction)
    excess = angle(beyond) - eye_share * eye_range(beyond)
    return turn if excess <= 0.0 else multiply(turn, power(beyond, excess / angle(beyond)))


def _remaining_turn(turn: Quat, direction: Vec3) -> Quat:
    """Return the shortest turn from a turned head's direction to another one, in the axes of that head."""
    return between(FORWARD, rotate(conjugate(turn), direction))


def _limited_to_side(direction: Vec3, path_length: float) -> Vec3:
    """Return a direction limited to an angle to the side, rad, at the same height.

    Behind the back, the shortest turn would go over the head, and the more so the higher or lower the target is.
    """
    x, y, z = direction
    side, level = math.atan2(x, z), math.hypot(x, z)
    nearest = path_length - _LIMIT_DECREASE * abs(math.atan2(y, level))
    if abs(side) <= nearest:
        return direction
    side = math.copysign(nearest, side)
    return (level * math.sin(side), y, level * math.cos(side))


def _spread(turn: Quat, parts: Mapping[str, float], ahead: dict[str, Quat]) -> tuple[dict[str, Quat], Quat]:
    """Split the head's turn into turns of the joints below it, all about the same axis in space.

    Args:
        turn: in the axes of the head as it is ahead.
        parts: joint -> its share.
        ahead: the joints from the root to the head without the turn, in order.

    Returns:
        The rotations of these joints, and the turn that they make together.
    """
    far = angle(turn)
    if far == 0.0:
        return {joint: ahead[joint] for joint in parts}, turn
    axis = unit((turn[1], turn[2], turn[3]))
    turns = _shared(far, parts, {joint: _furthest(joint, axis) for joint in parts})
    done = from_axis_angle(axis, sum(turns.values()))
    rotations = dict[str, Quat]()
    for joint, local in reversed(ahead.items()):
        if joint in turns:
            rotations[joint] = multiply(local, from_axis_angle(axis, turns[joint]))
        # Continue in the axes of the parent.
        axis = rotate(local, axis)
    return rotations, done


def _shared(far: float, parts: Mapping[str, float], path_length: Mapping[str, float]) -> dict[str, float]:
    """Split an angle by shares. Joints that reach their limit leave the rest to the others."""
    turns, free = dict.fromkeys(parts, 0.0), dict(parts)
    while free and (left := far - sum(turns.values())) > 1e-9:
        whole = sum(free.values())
        for joint, part in free.items():
            turns[joint] = min(path_length[joint], turns[joint] + left * (part / whole))
        free = {joint: part for joint, part in free.items() if turns[joint] < path_length[joint]}
    return turns


def _furthest(joint: str, axis: Vec3) -> float:
    """Return the limit of a joint for a turn about an axis, rad; limits form an ellipse."""
    pitch, yaw = _FURTHEST[joint]
    return 1.0 / math.hypot(axis[0] / pitch, axis[1] / yaw, axis[2] / yaw)
