"""The shortest durations of motions: how fast the limits of the body let them be (`speed_limit`)."""

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from functools import lru_cache
from itertools import accumulate, pairwise

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import LEFT_ARM, RIGHT_ARM, SIDES
from reactive_realizer.embodiment.quaternion import angle, difference
from reactive_realizer.embodiment.speed_limit import WRIST_ACCELERATION, WRIST_BRAKE, WRIST_SPEED, fastest
from reactive_realizer.embodiment.vector import distance

_STARTING = WRIST_SPEED / (2.0 * WRIST_ACCELERATION)
"""Time that a wrist loses while it accelerates to its highest speed, s; other joints lose no more."""

_BRAKING = WRIST_SPEED / (2.0 * WRIST_BRAKE)
"""Time that a wrist loses while it brakes from its highest speed, s."""

_ARMS = LEFT_ARM | RIGHT_ARM

Profile = Callable[[float], float]
"""The completed share of a movement, 0 to 1, after a share of its time."""

_SHARES = 100
"""Number of shares of the time at which a profile is examined."""

_STEP, _FEWEST, _MOST = 0.08, 2, 16
"""Duration of the steps in which the speed of a motion is measured, s, and limits of their number."""

_WRISTS = tuple(f"{side}_wrist" for side in SIDES)


def moving_time(bodies: Sequence[Body], joints: Iterable[str]) -> float:
    """Return the time in which the body moves through several poses at its highest speeds, s.

    Args:
        bodies: two or more, with equal roots.
        joints: that turn.
    """
    return sum(_step_times(bodies, list(joints)))


def turning_time(before: Body, after: Body, joints: Iterable[str]) -> float:
    """Return the time in which joints turn from one pose to another at their highest speeds, s."""
    pairs = ((joint, before.rotation(joint), after.rotation(joint)) for joint in joints)
    return max((angle(difference(one, two)) / fastest(joint) for joint, one, two in pairs if one != two), default=0.0)


def from_rest(moving: float, joints: Collection[str] = ()) -> float:
    """Return the duration of a movement that starts at rest and would take some time at its highest speed, s.

    Args:
        moving: that time, s.
        joints: that turn; hands that arms carry end at rest, too.
    """
    lost = _STARTING if _ARMS.isdisjoint(joints) else _STARTING + _BRAKING
    # On a short way, the highest speed is not reached.
    return moving + lost if moving > lost else 2.0 * math.sqrt(moving * lost)


@lru_cache
def lag(profile: Profile) -> float:
    """Return the factor by which a movement with a profile is slower than at its highest speed, so that it is not late.

    A limb that falls behind where the profile is fastest has caught up with it at the end.
    """
    shares = (number / _SHARES for number in range(_SHARES))
    return max((1.0 - profile(share)) / (1.0 - share) for share in shares)


def shortest_duration(
    body_at: Callable[[float], Body], begin: float, end: float, duration: float, joints: Collection[str]
) -> float:
    """Return the shortest duration of the part of a motion between two of its phases, starting at rest, s.

    The body may fall behind where the motion is fastest, and has caught up with it at the end: from no phase on does
    the rest of the way take more than the rest of the time.

    Args:
        body_at: returns the body at a phase of the motion, always with the same root.
        begin: first phase, 0 to 1.
        end: last phase, 0 to 1.
        duration: preferred, s; the result is not longer.
        joints: that turn.
    """
    count = min(max(_FEWEST, math.ceil(duration / _STEP)), _MOST)
    bodies = [body_at(begin + (end - begin) * number / count) for number in range(count + 1)]
    left = accumulate(reversed(_step_times(bodies, list(joints))))
    return min(duration, from_rest(max(time * count / number for number, time in enumerate(left, 1)), joints))


def shortest_parts(
    body_at: Callable[[float], Body], key_positions: Mapping[str, float], duration: float, joints: Collection[str]
) -> dict[str, float]:
    """Return the shortest durations of all parts of a motion, by the points at which they end (`MotionUnit`), s.

    Args:
        body_at: returns the body at a phase of the motion, always with the same root.
        key_positions: of its points, in order.
        duration: preferred, s; no part is longer than that.
        joints: that turn.
    """
    parts = ((point, begin, end) for (_, begin), (point, end) in pairwise(key_positions.items()) if begin < end)
    return {
        point: shortest_duration(body_at, begin, end, duration * (end - begin), joints) for point, begin, end in parts
    }


def _step_times(bodies: Sequence[Body], joints: Sequence[str]) -> list[float]:
    """Return the time that each step between two bodies takes at the highest speeds, s."""
    skeleton = bodies[0].skeleton
    moved = [wrist for wrist in _WRISTS if wrist in skeleton and not set(joints).isdisjoint(skeleton.chain(wrist))]
    return [_step_time(before, after, joints, moved) for before, after in pairwise(bodies)]


def _step_time(before: Body, after: Body, joints: Sequence[str], wrists: Sequence[str]) -> float:
    ways = (distance(before.transform(wrist).position, after.transform(wrist).position) for wrist in wrists)
    return max(turning_time(before, after, joints), max(ways, default=0.0) / WRIST_SPEED)
