"""How long hands would like to take from one place to another, and the phases that follow from it."""

from collections.abc import Sequence
from itertools import accumulate, pairwise

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import slerp
from reactive_realizer.embodiment.vector import distance
from reactive_realizer.engines.animation.motion_unit import GESTURE_POINTS


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
    sides = [side for side in ("l", "r") if f"{side}_shoulder" in joints]
    return max(0.25 + 0.75 * _furthest("wrist", sides, bodies), 0.84 * _furthest("middle3", sides, bodies))


def _furthest(joint: str, sides: Sequence[str], bodies: Sequence[Body]) -> float:
    """The longer of the ways of a joint of the left and of the right arm, m; 0 where there is none."""
    names = [name for side in sides if (name := f"{side}_{joint}") in bodies[0].skeleton]
    paths = [[body.place(name).position for body in bodies] for name in names]
    return max((sum(distance(a, b) for a, b in pairwise(path)) for path in paths), default=0.0)


def seven_points(durations: Sequence[float]) -> dict[str, float]:
    """Phases of the seven points of a gesture, from the durations of the six phases between them, s."""
    total, times = sum(durations), accumulate(durations[:-1], initial=0.0)
    return {**{point: time / total for point, time in zip(GESTURE_POINTS, times, strict=False)}, "end": 1.0}
