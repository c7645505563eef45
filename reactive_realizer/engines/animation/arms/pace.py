"""How long hands would like to take from one place to another, and the phases that follow from it."""

from collections.abc import Sequence
from itertools import accumulate

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.quaternion import slerp
from reactive_realizer.engines.animation.motion_unit import GESTURE_POINTS
from reactive_realizer.engines.animation.ways import furthest


def comfortable(start: Body, goal: Body, joints: frozenset[str]) -> float:
    """How long the hands would like to take between two poses, s.

    The peak speed of a reach is about twice its mean (1.9 times for one of minimum jerk); with these numbers a wrist
    stays below 2 m/s, and a fingertip, which also swings about the wrist, below 2.5 m/s.

    Args:
        start: the body with its hands where they set out.
        goal: the body with its hands where they are to be.
        joints: those that turn, each along its shortest arc; only the hands of arms that turn at the shoulder count.
    """
    between = {joint: slerp(start.rotation(joint), goal.rotation(joint), 0.5) for joint in joints}
    bodies = (start, start.posed(between), goal)
    sides = [side for side in SIDES if f"{side}_shoulder" in joints]
    return max(0.25 + 0.75 * furthest("wrist", sides, bodies), 0.84 * furthest("middle3", sides, bodies))


def seven_points(durations: Sequence[float]) -> dict[str, float]:
    """Phases of the seven points of a gesture, from the durations of the six phases between them, s."""
    total, times = sum(durations), accumulate(durations[:-1], initial=0.0)
    return {**{point: time / total for point, time in zip(GESTURE_POINTS, times, strict=False)}, "end": 1.0}
