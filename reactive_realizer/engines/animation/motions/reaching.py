"""Reaching: durations and speed profiles of hand movements, and the key positions that follow."""

import math
from collections.abc import Sequence
from functools import lru_cache, partial
from itertools import accumulate

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.quaternion import slerp
from reactive_realizer.engines.animation.easing import minimum_jerk
from reactive_realizer.engines.animation.kinematics import path_length
from reactive_realizer.engines.animation.motion_unit import GESTURE_POINTS, PhaseDuration
from reactive_realizer.engines.animation.shortest import Profile, from_rest, lag, moving_time

_SHARES = (0.25, 0.5, 0.75)
"""Shares of a way at which a hand is sought: hands move on arcs, which are longer than their chords."""


def reach(start: Body, goal: Body, joints: frozenset[str], profile: Profile = minimum_jerk) -> PhaseDuration:
    """Return the duration of a movement of the hands between two poses.

    The peak speed of a reach is about twice its mean speed (1.9 times for minimum jerk). With these numbers a wrist
    prefers to stay below 2 m/s, and a fingertip, which also swings about the wrist, below 2.5 m/s.

    Args:
        start: the body with its hands at the start.
        goal: the body with its hands at the goal.
        joints: that turn, each along its shortest arc; only hands of arms that turn at the shoulder count.
        profile: of their speed.
    """
    bodies = [start, *(_between(start, goal, joints, share) for share in _SHARES), goal]
    sides = [side for side in SIDES if f"{side}_shoulder" in joints]
    halves = bodies[::2]
    preferred = max(0.25 + 0.75 * path_length("wrist", sides, halves), 0.84 * path_length("middle3", sides, halves))
    shortest = from_rest(lag(profile) * moving_time(bodies, joints), joints)
    return PhaseDuration(max(preferred, shortest), shortest)


def _between(start: Body, goal: Body, joints: frozenset[str], share: float) -> Body:
    """Return the body after a share of its way."""
    return start.posed({joint: slerp(start.rotation(joint), goal.rotation(joint), share) for joint in joints})


def gesture_key_positions(durations: Sequence[float]) -> dict[str, float]:
    """Return the phases of the seven points of a gesture, from the durations of the six phases between them, s."""
    total, times = sum(durations), accumulate(durations[:-1], initial=0.0)
    return {**{point: time / total for point, time in zip(GESTURE_POINTS, times, strict=False)}, "end": 1.0}


def shortest_phases(durations: Sequence[PhaseDuration]) -> dict[str, float]:
    """Return the shortest durations of the phases of a gesture by the point at which each ends (`MotionUnit`).

    A retraction may be cut short: the next gesture starts from there, or the motion fades out.
    """
    return {point: each.shortest for point, each in zip(GESTURE_POINTS[1:-1], durations[:-1], strict=True)}


def sigmoid(progress: float, steepness: float, asymmetry: float) -> float:
    """Return the completed share of a reach, 0 to 1, after a share of its time (thesis 4.2.2).

    The speed rises from 0 to a single peak and falls to 0 again, a bell. Reaching hands move like this, and mostly slow
    down for longer than they speed up (R. Plamondon and A. Alimi, "Speed/accuracy trade-offs in target-directed
    movements", Behavioral and Brain Sciences 20, 1997). Each half of the bell is half of that of the symmetric sigmoid
    ``t^k / (t^k + (1 - t)^k)``, stretched equally in time and distance, so that speed and acceleration agree where they
    meet.

    Args:
        progress: share of the time, limited to 0 to 1.
        steepness: k, ratio of peak speed to mean speed, above 1; from 2 on the hand starts and stops softly.
        asymmetry: by how much longer it speeds up than it slows down, as a share of the time, between -1 and 1.
    """
    t = min(1.0, max(0.0, progress))
    rising = 0.5 * (1.0 + asymmetry)
    if t <= rising:
        return 2.0 * rising * _symmetric(0.5 * t / rising, steepness)
    falling = 1.0 - rising
    return 1.0 - 2.0 * falling * _symmetric(0.5 * (1.0 - t) / falling, steepness)


@lru_cache
def sigmoid_profile(steepness: float, asymmetry: float) -> Profile:
    """Return the `sigmoid` with these values; equal profiles are the same object."""
    return partial(sigmoid, steepness=steepness, asymmetry=asymmetry)


def _symmetric(t: float, steepness: float) -> float:
    done, left = math.pow(t, steepness), math.pow(1.0 - t, steepness)
    return done / (done + left)
