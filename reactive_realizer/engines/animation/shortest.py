"""The shortest durations of motions: how fast the limits of the body let them be (`speed_limit`)."""

import math
from collections.abc import Iterable, Sequence
from itertools import accumulate, pairwise

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.quaternion import angle, difference
from reactive_realizer.embodiment.speed_limit import WRIST_ACCELERATION, WRIST_SPEED, fastest
from reactive_realizer.embodiment.vector import distance

_STARTING = WRIST_SPEED / (2.0 * WRIST_ACCELERATION)
"""Time that a wrist loses while it accelerates to its highest speed, s."""

_WRISTS = tuple(f"{side}_wrist" for side in SIDES)


def moving_time(bodies: Sequence[Body], joints: Iterable[str]) -> float:
    """Return the time in which the body moves through several poses at its highest speeds, s.

    Args:
        bodies: two or more, with equal roots.
        joints: that turn.
    """
    return sum(_step_times(bodies, list(joints)))


def from_rest(moving: float) -> float:
    """Return the duration of a movement that starts at rest and would take some time at its highest speed, s."""
    # On the way of a short movement, the speed only rises.
    return moving + _STARTING if moving > _STARTING else 2.0 * math.sqrt(moving * _STARTING)


def shortest_duration(bodies: Sequence[Body], joints: Iterable[str]) -> float:
    """Return the shortest duration of a motion from rest through several poses, evenly spaced in time, s.

    The body may fall behind where the motion is fastest, and has caught up with it at the end: from no pose on does the
    rest of the way take more than the rest of the time.

    Args:
        bodies: two or more, with equal roots.
        joints: that turn.
    """
    steps = _step_times(bodies, list(joints))
    return from_rest(max(left * len(steps) / number for number, left in enumerate(accumulate(reversed(steps)), 1)))


def _step_times(bodies: Sequence[Body], joints: Sequence[str]) -> list[float]:
    """Return the time that each step between two bodies takes at the highest speeds, s."""
    return [_step_time(before, after, joints) for before, after in pairwise(bodies)]


def _step_time(before: Body, after: Body, joints: Sequence[str]) -> float:
    pairs = ((joint, before.rotation(joint), after.rotation(joint)) for joint in joints)
    turning = max(
        (angle(difference(one, two)) / fastest(joint) for joint, one, two in pairs if one != two), default=0.0
    )
    wrists = (wrist for wrist in _WRISTS if wrist in before.skeleton)
    ways = (distance(before.transform(wrist).position, after.transform(wrist).position) for wrist in wrists)
    return max(turning, max(ways, default=0.0) / WRIST_SPEED)
