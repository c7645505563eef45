"""Poses that persist after their behavior."""

import math
from collections.abc import Callable

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.pose import LayerKind, compose
from reactive_realizer.embodiment.quaternion import angle, from_axis_angle
from reactive_realizer.embodiment.vector import UP
from reactive_realizer.engines.animation.motion_unit import Moment, MotionPose, MotionUnit
from reactive_realizer.engines.animation.persistent_poses import PersistentPoses


class Turned(MotionUnit):
    """A motion that turns joints to the left by an angle, rad."""

    kind = LayerKind.GAZE

    def __init__(self, persists_as: str | None, radians: float, *joints: str) -> None:
        self.persists_as = persists_as
        self.joints = frozenset(joints)
        self._rotations = {joint: from_axis_angle(UP, radians) for joint in joints}

    def start(self, body: Body) -> None:
        """Starts from any body."""

    def pose(self, moment: Moment) -> MotionPose:
        return MotionPose(self._rotations)


@pytest.fixture
def lasting() -> PersistentPoses:
    return PersistentPoses()


@pytest.fixture
def turn(lasting: PersistentPoses, skeleton: Skeleton) -> Callable[[str, float], float]:
    """The angle of a joint under the persistent poses at a time, rad."""
    return lambda joint, now: angle(
        compose(skeleton, lasting.layers(GlobalTime(now), Body(skeleton))).shown.pose[joint]
    )


def test_a_pose_persists_until_another_one_with_its_name_ends(
    lasting: PersistentPoses, turn: Callable[[str, float], float], skeleton: Skeleton
) -> None:
    lasting.keep(Turned("gaze", 0.5, "skullbase"))
    assert turn("skullbase", 1.0) == turn("skullbase", 100.0) == pytest.approx(0.5)
    lasting.keep(Turned("head", 0.3, "vc4"))
    assert (turn("skullbase", 100.0), turn("vc4", 100.0)) == pytest.approx((0.5, 0.3))
    lasting.keep(Turned("gaze", 0.2, "skullbase"))
    assert turn("skullbase", 101.0) == turn("skullbase", 101.3) == pytest.approx(0.2)
    assert len(lasting.motions) == 2


def test_the_joints_of_a_replaced_pose_are_released(
    lasting: PersistentPoses, turn: Callable[[str, float], float]
) -> None:
    assert lasting.keep(Turned("gaze", 0.5, "skullbase", "vl5")) == frozenset()
    assert lasting.keep(Turned("gaze", 0.2, "skullbase")) == {"skullbase", "vl5"}
    assert turn("vl5", 2.0) == 0.0


def test_other_motions_do_not_persist(lasting: PersistentPoses, skeleton: Skeleton) -> None:
    lasting.keep(Turned(None, 0.5, "skullbase"))
    assert lasting.layers(GlobalTime(1.0), Body(skeleton)) == ()


def test_clearing_removes_all_poses_at_once(lasting: PersistentPoses, skeleton: Skeleton) -> None:
    lasting.keep(Turned("gaze", 0.5, "skullbase"))
    lasting.keep(Turned("gaze", 0.2, "skullbase"))
    lasting.clear()
    assert lasting.layers(GlobalTime(1.1), Body(skeleton)) == ()


def test_a_failing_pose_is_removed_and_others_persist(
    lasting: PersistentPoses, turn: Callable[[str, float], float], skeleton: Skeleton, caplog: pytest.LogCaptureFixture
) -> None:
    lasting.keep(Turned("gaze", math.nan, "skullbase"))
    lasting.keep(Turned("head", 0.3, "vc4"))
    assert (turn("skullbase", 1.0), turn("vc4", 1.0)) == pytest.approx((0.0, 0.3))
    assert [motion.persists_as for motion in lasting.motions] == ["head"]
    assert "'gaze' failed" in caplog.text
