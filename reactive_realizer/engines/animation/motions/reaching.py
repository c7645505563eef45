"""Reaching: durations and speed profiles of hand movements, and the key positions that follow."""

import math
from collections.abc import Sequence
from itertools import accumulate

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.quaternion import slerp
from reactive_realizer.engines.animation.kinematics import path_length
from reactive_realizer.engines.animation.motion_unit import GESTURE_POINTS


def reach_duration(start: Body, goal: Body, joints: frozenset[str]) -> float:
    """Return the preferred duration of a movement of the hands between two poses, s.

    The peak speed of a reach is about twice its mean speed (1.9 times for minimum jerk). With these numbers a wrist
    stays below 2 m/s, and a fingertip, which also swings about the wrist, below 2.5 m/s.

    Args:
        start: the body with its hands at the start.
        goal: the body with its hands at the goal.
        joints: that turn, each along its shortest arc; only hands of arms that turn at the shoulder count.
    """
    between = {joint: slerp(start.rotation(joint), goal.rotation(joint), 0.5) for joint in joints}
    bodies = (start, start.posed(between), goal)
    sides = [side for side in SIDES if f"{side}_shoulder" in joints]
    return max(0.25 + 0.75 * path_length("wrist", sides, bodies), 0.84 * path_length("middle3", sides, bodies))


def gesture_key_positions(durations: Sequence[float]) -> dict[str, float]:
    """Return the phases of the seven points of a gesture, from the durations of the six phases between them, s."""
    total, times = sum(durations), accumulate(durations[:-1], initial=0.0)
    return {**{point: time / total for point, time in zip(GESTURE_POINTS, times, strict=False)}, "end": 1.0}


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


def _symmetric(t: float, steepness: float) -> float:
    done, left = math.pow(t, steepness), math.pow(1.0 - t, steepness)
    return done / (done + left)
