"""Joints that go over to another goal."""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.inertialization import Inertialization
from reactive_realizer.embodiment.quaternion import from_axis_angle, rotation_vector

FRAME = 0.02
JOINT = "r_elbow"


@pytest.fixture
def skeleton() -> Skeleton:
    joints = ("HumanoidRoot", JOINT, "l_knee", "r_eyeball_joint")
    return Skeleton(joints, (-1, 0, 0, 0), ((0.0, 1.0, 0.0),) * len(joints))


def played(skeleton: Skeleton, goal: Callable[[float], float], switch: float, until: float, end: float) -> list[float]:
    """The angle of a joint in each frame, rad, that goes over to another motion at one time until another."""
    inertialization, angles = Inertialization(skeleton), []
    for number in range(round(end / FRAME)):
        now = GlobalTime(number * FRAME)
        if abs(now - switch) < 1e-9:
            inertialization.switch([JOINT], GlobalTime(until))
        wanted = Body(skeleton, {JOINT: from_axis_angle((1.0, 0.0, 0.0), goal(now))})
        shown = inertialization(wanted, now)
        inertialization.note_shown(shown, now)
        angles.append(rotation_vector(shown.rotation(JOINT))[0])
    return angles


def speeds(angles: list[float]) -> list[float]:
    return [(after - before) / FRAME for before, after in pairwise(angles)]


def test_a_joint_that_jumps_to_another_goal_sets_out_from_rest_and_is_there_in_time(skeleton: Skeleton) -> None:
    way = played(skeleton, lambda t: 0.0 if t < 0.099 else 1.0, 0.1, 0.5, 1.0)
    assert way == sorted(way)
    assert way[5] < 0.01
    assert way[25:] == pytest.approx([1.0] * len(way[25:]))
    assert np.abs(np.diff(speeds(way)) / FRAME).max() < 60.0


def test_a_joint_goes_on_with_its_velocity_and_acceleration(skeleton: Skeleton) -> None:
    way = played(skeleton, lambda t: 5.0 * t * t if t < 0.299 else 0.0, 0.3, 0.9, 1.5)
    going = speeds(way)
    assert going[14] == pytest.approx(going[13], abs=0.2)
    assert np.abs(np.diff(going) / FRAME).max() < 60.0
    assert way[-1] == pytest.approx(0.0, abs=1e-9)


def test_a_joint_takes_the_velocity_of_a_moving_goal(skeleton: Skeleton) -> None:
    way = played(skeleton, lambda t: 0.0 if t < 0.099 else 1.0 + 2.0 * t, 0.1, 0.6, 1.0)
    assert np.abs(np.diff(speeds(way)) / FRAME).max() < 60.0
    assert way[30:] == pytest.approx([1.0 + 2.0 * FRAME * number for number in range(30, 50)], abs=1e-9)


def test_a_joint_that_reaches_its_new_goal_by_itself_follows_it(skeleton: Skeleton) -> None:
    goal = [2.0 * FRAME * number for number in range(50)]
    assert played(skeleton, lambda t: 2.0 * t, 0.1, 0.6, 1.0) == pytest.approx(goal, abs=1e-9)


def test_without_a_switch_a_goal_is_followed_whatever_it_does(skeleton: Skeleton) -> None:
    way = played(skeleton, lambda t: 0.0 if t < 0.099 else 1.0, 9.0, 9.0, 0.3)
    assert way[4:6] == pytest.approx([0.0, 1.0])


@pytest.mark.parametrize("joint", ["l_knee", "HumanoidRoot", "r_eyeball_joint"])
def test_legs_root_and_eyes_are_left_out(skeleton: Skeleton, joint: str) -> None:
    inertialization = Inertialization(skeleton)
    for now in (0.0, 0.02):
        inertialization.note_shown(Body(skeleton), GlobalTime(now))
    inertialization.switch([joint], GlobalTime(0.5))
    goal = Body(skeleton, {joint: from_axis_angle((1.0, 0.0, 0.0), 0.4)})
    assert inertialization(goal, GlobalTime(0.04)) is goal
