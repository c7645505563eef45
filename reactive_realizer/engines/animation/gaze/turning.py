"""Looking at something: how trunk, neck and head share the turn, and what is left to the eyes.

All functions are pure. Directions are yaw (to the figure's left) and pitch (up), rad, from straight ahead.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from reactive_realizer.bml.words import Influence
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, conjugate, from_euler, rotate
from reactive_realizer.embodiment.vector import Vec3, add, length, scale, subtract

EYES = ("l_eyeball_joint", "r_eyeball_joint")

EYE_YAW = math.radians(35.0)
"""The eyes turn no further to a side."""

EYE_PITCH = math.radians(25.0)
"""The eyes turn no further up or down."""

# What the joints must leave to the eyes is less than these can do, so that a nod does not lose the target.
_COMFORT = 0.8


@dataclass(frozen=True, slots=True)
class _Turn:
    """A joint's part in a gaze: shares of yaw and pitch, and the furthest it turns, rad."""

    yaw: float
    pitch: float
    furthest_yaw: float
    furthest_pitch: float


# The head follows a gaze to about two thirds to the side and to half up or down (D. Tweed, "Three-dimensional model of
# the human eye-head saccadic system", 1997); furthest turns are what the segments of a spine allow.
_HEAD = {"vc4": _Turn(0.30, 0.22, 0.60, 0.35), "skullbase": _Turn(0.40, 0.30, 0.75, 0.45)}
_SHOULDER = {
    "vt10": _Turn(0.08, 0.03, 0.25, 0.12),
    "vt6": _Turn(0.12, 0.04, 0.25, 0.12),
    "vc4": _Turn(0.25, 0.20, 0.60, 0.35),
    "skullbase": _Turn(0.33, 0.26, 0.75, 0.45),
}
_WAIST = {
    "vl5": _Turn(0.14, 0.05, 0.35, 0.15),
    "vt10": _Turn(0.10, 0.03, 0.25, 0.12),
    "vt6": _Turn(0.10, 0.03, 0.25, 0.12),
    "vc4": _Turn(0.22, 0.18, 0.60, 0.35),
    "skullbase": _Turn(0.28, 0.24, 0.75, 0.45),
}
_TURNS: Mapping[Influence, Mapping[str, _Turn]] = {
    Influence.EYES: {},
    Influence.HEAD: _HEAD,
    Influence.SHOULDER: _SHOULDER,
    Influence.WAIST: _WAIST,
    # Feet stay where they stand: what would turn the legs is locomotion.
    Influence.WHOLE: _WAIST,
}

_OFFSETS: Mapping[str, tuple[float, float]] = {
    "RIGHT": (-1.0, 0.0),
    "LEFT": (1.0, 0.0),
    "UP": (0.0, 1.0),
    "DOWN": (0.0, -1.0),
    "UPRIGHT": (-math.sqrt(0.5), math.sqrt(0.5)),
    "UPLEFT": (math.sqrt(0.5), math.sqrt(0.5)),
    "DOWNRIGHT": (-math.sqrt(0.5), -math.sqrt(0.5)),
    "DOWNLEFT": (math.sqrt(0.5), -math.sqrt(0.5)),
}


def gaze_joints(influence: Influence) -> tuple[str, ...]:
    """The joints that turn with a gaze, from below; the eyes are not among them."""
    return tuple(_TURNS[influence])


def turn_toward(body: Body, target: Vec3, influence: Influence) -> dict[str, Quat]:
    """Rotations of trunk, neck and head toward a target, their part of the way.

    Args:
        body: as it is; what it does with these joints themselves does not matter.
        target: in the figure's frame, m.
        influence: which joints.
    """
    turns = {joint: turn for joint, turn in _TURNS[influence].items() if joint in body.skeleton}
    if not turns:
        return {}
    ahead = body.posed(dict.fromkeys(turns, IDENTITY))
    axes = ahead.place("skullbase").rotation
    yaw, pitch = _direction(rotate(conjugate(axes), subtract(target, eye_point(ahead))))
    yaws = _shared(yaw, EYE_YAW, {joint: (turn.yaw, turn.furthest_yaw) for joint, turn in turns.items()})
    pitches = _shared(pitch, EYE_PITCH, {joint: (turn.pitch, turn.furthest_pitch) for joint, turn in turns.items()})
    return {joint: from_euler(-pitches[joint], yaws[joint], 0.0) for joint in turns}


def _shared(angle: float, eyes: float, parts: Mapping[str, tuple[float, float]]) -> dict[str, float]:
    """An angle shared out by parts of (share, furthest); they grow where the eyes could not make up for the rest."""
    usual = abs(angle) * sum(share for share, _ in parts.values())
    needed = abs(angle) - _COMFORT * eyes
    more = max(1.0, needed / usual) if usual > 0.0 else 1.0
    return {joint: _clamped(more * share * angle, furthest) for joint, (share, furthest) in parts.items()}


def aim_eyes(body: Body, target: Vec3) -> dict[str, Quat]:
    """Rotations of the eyeballs that look at a target, each for itself, as far as eyes turn.

    Args:
        body: with its head where it will be shown.
        target: in the figure's frame, m.
    """
    aimed = {}
    for eye in EYES:
        if eye in body.skeleton:
            place = body.place(eye)
            # The eye's own rotation is what is wanted, so the direction is taken in the axes of the head.
            head = body.place(body.skeleton.chain(eye)[-2]).rotation
            yaw, pitch = _direction(rotate(conjugate(head), subtract(target, place.position)))
            aimed[eye] = from_euler(-_clamped(pitch, EYE_PITCH), _clamped(yaw, EYE_YAW), 0.0)
    return aimed


def offset_target(body: Body, target: Vec3, angle: float, direction: str) -> Vec3:
    """A point as far away as the target, seen beside it from between the eyes.

    Args:
        body: who looks.
        target: in the figure's frame, m.
        angle: between the two, rad.
        direction: of BML's offsetDirection, as the figure sees it; any other word is no offset.
    """
    sideways, upward = _OFFSETS.get(direction, (0.0, 0.0))
    eyes = eye_point(body)
    way = subtract(target, eyes)
    yaw, pitch = _direction(way)
    turned = from_euler(-(pitch + upward * angle), yaw + sideways * angle, 0.0)
    return add(eyes, rotate(turned, (0.0, 0.0, length(way))))


def eye_point(body: Body) -> Vec3:
    """The point between the eyes, or the top of the neck of a figure without eyes, m."""
    places = [body.place(eye).position for eye in EYES if eye in body.skeleton]
    if len(places) == len(EYES):
        return scale(add(*places), 0.5)
    return body.place("skullbase").position


def _direction(way: Vec3) -> tuple[float, float]:
    x, y, z = way
    return math.atan2(x, z), math.atan2(y, math.hypot(x, z))


def _clamped(angle: float, furthest: float) -> float:
    return max(-furthest, min(furthest, angle))
