"""Which of several motions plays a behavior."""

import pytest

from reactive_realizer.embodiment.body import Body
from reactive_realizer.engines.animation.candidates import Candidate, select
from reactive_realizer.engines.animation.motion_unit import Moment, MotionPose, MotionUnit


class Move(MotionUnit):
    """A motion with a duration that turns one arm and nothing else."""

    def __init__(self, arm: str, duration: float) -> None:
        self.resources = frozenset({arm})
        self.preferred_duration = duration

    def start(self, body: Body) -> None:
        """Start from anywhere."""

    def pose(self, moment: Moment) -> MotionPose:
        """Return no rotations."""
        return MotionPose({})


@pytest.mark.parametrize(
    ("moves", "taken", "time", "arm"),
    [
        ([("right", 2.0), ("left", 1.0)], set(), 1.5, "right"),
        ([("right", 2.0), ("left", 1.0)], {"right"}, 1.5, "left"),
        ([("right", 2.0), ("left", 1.0)], set(), 0.5, "left"),
        ([("right", 2.0), ("left", 2.0 - 1e-8)], set(), 0.5, "right"),
        ([("right", 2.0), ("left", 1.0)], {"left"}, 0.5, "right"),
        ([("right", 2.0), ("left", 1.0)], {"right", "left"}, 0.5, "right"),
        ([("right", 2.0), ("left", 1.0)], set(), None, "right"),
    ],
)
def test_the_first_free_motion_plays_or_in_a_hurry_a_clearly_shorter_one(
    moves: list[tuple[str, float]], taken: set[str], time: float | None, arm: str
) -> None:
    candidates = [Candidate(Move(*move)) for move in moves]
    assert select(candidates, frozenset(taken), time).motion.resources == {arm}
