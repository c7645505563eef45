"""Measures what the laws of motion limit, in the bodies of successive frames: accelerations, slides, and ranges."""

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.clock.ticker import FRAME_EVERY, RATE
from reactive_realizer.embodiment.arm_anatomy import ArmAnatomy
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.clearance import Clearance
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.quaternion import Quat, difference, rotate, rotation_vector
from reactive_realizer.embodiment.vector import ZERO, Vec3, add

_FRAME = FRAME_EVERY / RATE
TOUCHING = 0.004
"""A part of a sole that is lower than this above where it is in standing touches the ground, m."""

_HEEL = 0.045
"""How far the heel is behind the ankle, m."""

_WRISTS, _ELBOWS = (tuple(f"{side}_{joint}" for side in SIDES) for joint in ("wrist", "elbow"))


def worst_motion(bodies: Sequence[Body]) -> dict[str, float]:
    """Return the worst value of each law of smooth motion.

    Args:
        bodies: of successive frames, three or more.

    Returns:
        ``wrist_m_s2``, of a wrist in the world; ``wrist_rad_s2`` and ``elbow_rad_s2``, of the turn of a joint;
        ``head_deg_s``, the angular speed of the head in the world, degrees/s.
    """
    head = [body.transform("skullbase").rotation for body in bodies]
    return {
        "wrist_m_s2": max(float(accelerations(bodies, wrist).max()) for wrist in _WRISTS),
        **{
            f"{name}_rad_s2": max(float(angular_accelerations(bodies, joint).max()) for joint in joints)
            for name, joints in (("wrist", _WRISTS), ("elbow", _ELBOWS))
        },
        "head_deg_s": math.degrees(np.linalg.norm(_turns(head), axis=1).max()),
    }


def hand_depth(bodies: Iterable[Body], avatar: Avatar) -> float:
    """Return how deep the deepest hand or forearm of some bodies is in trunk, head or a thigh, m; 0 if none is.

    Args:
        bodies: of one avatar.
        avatar: whose skin tells how thick they are.
    """
    return max(0.0, *map(Clearance.of(avatar).deepest, bodies))


def foot_slide(bodies: Sequence[Body]) -> float:
    """Return the longest way of a heel or of the ball of a foot over the ground while it touches it, m.

    Args:
        bodies: of successive frames, one or more, in world coordinates.
    """
    standing = Body(bodies[0].skeleton)
    longest = 0.0
    for side in SIDES:
        below = (0.0, -standing.transform(f"{side}_ankle").position[1], -_HEEL)
        for joint, offset in ((f"{side}_ankle", below), (f"{side}_midtarsal", ZERO)):
            touching = point_of(standing, joint, offset)[1] + TOUCHING
            longest = max(longest, _slide([point_of(body, joint, offset) for body in bodies], touching))
    return longest


def point_of(body: Body, joint: str, offset: Vec3) -> Vec3:
    """Return the place of a point at an offset from a joint, in the axes of the joint, m."""
    here = body.transform(joint)
    return add(here.position, rotate(here.rotation, offset))


def _slide(track: Iterable[Vec3], touching: float) -> float:
    longest, since = 0.0, None
    for x, y, z in track:
        if y > touching:
            since = None
            continue
        since = since or (x, z)
        longest = max(longest, math.dist(since, (x, z)))
    return longest


def velocities(bodies: Sequence[Body], joint: str) -> NDArray[np.float64]:
    """Return the velocities of the position of a joint from frame to frame, (F - 1, 3), m/s."""
    return np.diff([body.transform(joint).position for body in bodies], axis=0) / _FRAME


def accelerations(bodies: Sequence[Body], joint: str) -> NDArray[np.float64]:
    """Return the accelerations of the position of a joint in all frames but the first and the last, m/s²."""
    return _changes(velocities(bodies, joint))


def angular_accelerations(bodies: Sequence[Body], joint: str) -> NDArray[np.float64]:
    """Return the accelerations of the turn of a joint in all frames but the first and the last, rad/s²."""
    return _changes(_turns([body.rotation(joint) for body in bodies]))


def _turns(rotations: Sequence[Quat]) -> NDArray[np.float64]:
    """Return the angular velocities from frame to frame, (F - 1, 3), rad/s."""
    return np.array([rotation_vector(difference(before, after)) for before, after in pairwise(rotations)]) / _FRAME


def _changes(moving: NDArray[np.float64]) -> NDArray[np.float64]:
    changes: NDArray[np.float64] = np.linalg.norm(np.diff(moving, axis=0), axis=1) / _FRAME
    return changes


def arm_ranges(bodies: Iterable[Body]) -> dict[str, float]:
    """Return the furthest that forearms and hands of some bodies turn, degrees; 0 if they do not turn that way.

    Neutral is the default pose: the arm hangs, with the thumb forward.

    Returns:
        ``pronation_deg`` and ``supination_deg``, which elbow and wrist joint share; ``radial_deg`` and ``ulnar_deg``,
        the deviations of the hand to the side of the thumb and of the little finger.
    """
    turns = [arm_turns(body, side) for body in bodies for side in SIDES]
    pronation, deviation = ([0.0, *(turn[which] for turn in turns)] for which in (0, 1))
    return {
        "pronation_deg": round(max(pronation), 1),
        "supination_deg": round(-min(pronation), 1),
        "radial_deg": round(max(deviation), 1),
        "ulnar_deg": round(-min(deviation), 1),
    }


def arm_turns(body: Body, side: str) -> tuple[float, float]:
    """Return the pronation of a forearm and the radial deviation of its hand, degrees; negative the other way."""
    turns = ArmAnatomy.of(body.skeleton, side).turns(body.rotation(f"{side}_elbow"), body.rotation(f"{side}_wrist"))
    return math.degrees(turns.pronation), math.degrees(turns.deviation)
