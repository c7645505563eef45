"""How trunk, neck and head share the turn toward what is looked at (D. Tweed's model of gaze).

All functions are pure.
"""

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

from reactive_realizer.embodiment.body import Body
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
from reactive_realizer.embodiment.skeleton import Pose
from reactive_realizer.embodiment.vector import FORWARD, Vec3, unit
from reactive_realizer.engines.animation.gaze.eyes import EYE_RANGE, Sockets, direction, eye_range
from reactive_realizer.engines.animation.gaze.influence import EYES, joint_weights

HORIZONTAL = 0.9
VERTICAL = 0.3
TORSIONAL = -0.15
"""What the head makes of the turn that would bring the nose to the target: D. Tweed, "Three-dimensional model of the
human eye-head saccadic system" (Journal of Neurophysiology 77, 1997)."""

# The head leaves to the eyes no more than this part of what they can do, so that a nod does not lose the target.
_COMFORT = 0.8

# The furthest a joint turns up or down and to a side, rad: what the segments of a spine allow.
_FURTHEST = {
    "vl5": (0.15, 0.35),
    "vt10": (0.12, 0.25),
    "vt6": (0.12, 0.25),
    "vc4": (0.35, 0.60),
    "skullbase": (0.45, 0.75),
}

_LESS = 0.3
"""By how much less far aside than at the height of the eyes one turns, for each rad of height: so one gets nearest."""


class Turn(NamedTuple):
    """A turn toward a point.

    Attributes:
        rotations: of the joints of trunk, neck and head that take part, local to their parents.
        missing: how far beyond the point is of what they and the eyes turn to, rad; 0 where they get there. None for
            a point that is too near to have a direction: then they are straight ahead.
    """

    rotations: Mapping[str, Quat]
    missing: float | None


def turn_toward(body: Body, rest: Pose, point: Callable[[Vec3], Vec3], weights: Mapping[str, float]) -> Turn:
    """The turn of trunk, neck and head toward a point, as far as they take part.

    All of them turn about one axis, so the head does too while they come from rest: "Listing's law for gaze-directing
    head movements" (D. Tweed and T. Vilis, 1992).

    Args:
        body: as it is; what it does with these joints itself does not matter.
        rest: what they do when nobody looks anywhere.
        point: from between the eyes to where they look, both in the figure's frame, m.
        weights: of each group of joints.
    """
    parts = {joint: part for joint, part in joint_weights(weights).items() if joint in body.skeleton}
    chain = body.skeleton.chain("skullbase")
    ahead = {joint: rest.get(joint, IDENTITY) if joint in parts else body.rotation(joint) for joint in chain}
    sockets = Sockets.of(Body(body.skeleton, ahead, body.root))
    way = direction(sockets.middle, point(sockets.middle))
    sight = FORWARD if way is None else rotate(conjugate(sockets.rotation), way)
    eyes = weights.get(EYES, 0.0)
    willing = eyes * _COMFORT
    aside = sum(_FURTHEST[joint][1] for joint in parts) + willing * EYE_RANGE
    turn = head_turn(_beside(sight, aside), min(1.0, sum(parts.values())), willing)
    rotations, done = _spread(turn, parts, ahead)
    if way is None:
        return Turn(rotations, None)
    beyond = _beyond(done, sight)
    # Eyes that go a part of the way leave the rest of it willingly.
    left = eye_range(beyond) / eyes if eyes > 0.0 else 0.0
    return Turn(rotations, max(0.0, angle(beyond) - left))


def head_turn(sight: Vec3, part: float, willing: float) -> Quat:
    """The head's turn toward a direction: more of it to the side than up or down, and as much roll as Donders' law has.

    With x the turn that would bring the nose there, a quaternion, it is (0.3 x_v, 0.9 x_h, -0.15 x_v x_h): for each
    direction there is one roll, wherever the head comes from. Where the eyes could not make up for what is missing, the
    head goes on by the shortest way.

    Args:
        sight: a unit vector in the axes of a head that looks straight ahead.
        part: how much of it is done, 0 to 1.
        willing: the share of their range within which the eyes make up for what is missing.
    """
    _, vertical, horizontal, _ = between(FORWARD, sight)
    x, y, z = VERTICAL * vertical, HORIZONTAL * horizontal, TORSIONAL * vertical * horizontal
    turn = power((math.sqrt(1.0 - x * x - y * y - z * z), x, y, z), part)
    beyond = _beyond(turn, sight)
    excess = angle(beyond) - willing * eye_range(beyond)
    return turn if excess <= 0.0 else multiply(turn, power(beyond, excess / angle(beyond)))


def _beyond(turn: Quat, sight: Vec3) -> Quat:
    """The shortest turn from where a turned head looks to a direction, in the axes of that head: that of the eyes."""
    return between(FORWARD, rotate(conjugate(turn), sight))


def _beside(sight: Vec3, furthest: float) -> Vec3:
    """A direction, or the one at its height that is so far to its side (rad): what is further behind is turned to so.

    Across the back, the shortest way there would be over the head, and the sooner the higher or lower it is.
    """
    x, y, z = sight
    side, level = math.atan2(x, z), math.hypot(x, z)
    nearest = furthest - _LESS * abs(math.atan2(y, level))
    if abs(side) <= nearest:
        return sight
    side = math.copysign(nearest, side)
    return (level * math.sin(side), y, level * math.cos(side))


def _spread(turn: Quat, parts: Mapping[str, float], ahead: dict[str, Quat]) -> tuple[dict[str, Quat], Quat]:
    """The head's turn as turns of the joints below it, each about the same axis in space.

    Args:
        turn: in the axes of the head as it is ahead.
        parts: joint -> its part.
        ahead: the joints from the root to the head as they are without a turn, in order.

    Returns:
        The rotations of these joints, and how much of the turn they make together.
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
        # As its parent sees it.
        axis = rotate(local, axis)
    return rotations, done


def _shared(far: float, parts: Mapping[str, float], furthest: Mapping[str, float]) -> dict[str, float]:
    """An angle shared out by parts; what a joint cannot do the others do, as far as they can."""
    turns, free = dict.fromkeys(parts, 0.0), dict(parts)
    while free and (left := far - sum(turns.values())) > 1e-9:
        whole = sum(free.values())
        for joint, part in free.items():
            turns[joint] = min(furthest[joint], turns[joint] + left * (part / whole))
        free = {joint: part for joint, part in free.items() if turns[joint] < furthest[joint]}
    return turns


def _furthest(joint: str, axis: Vec3) -> float:
    """How far a joint turns about an axis, rad: its limits are an ellipse."""
    pitch, yaw = _FURTHEST[joint]
    return 1.0 / math.hypot(axis[0] / pitch, axis[1] / yaw, axis[2] / yaw)
