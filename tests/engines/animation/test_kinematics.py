"""The kinematic state of a body, and its history."""

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.quaternion import angle, difference, from_axis_angle
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.kinematics import BodySample, KinematicState, MotionHistory

X: Vec3 = (1.0, 0.0, 0.0)


@pytest.mark.parametrize("step", [0.01, -0.01])
def test_three_samples_give_velocity_and_acceleration(skeleton: Skeleton, step: float) -> None:
    bodies = [Body(skeleton, {"r_elbow": from_axis_angle(X, 0.3 * t + 2.0 * t * t)}) for t in (2 * step, step, 0.0)]
    moving = KinematicState.second_order(
        *(BodySample(GlobalTime(t), body) for t, body in zip((2 * step, step, 0.0), bodies, strict=True))
    )
    assert moving.body is bodies[-1]
    assert moving.velocity("r_elbow") == pytest.approx((0.3, 0.0, 0.0))
    assert moving.acceleration("r_elbow") == pytest.approx((4.0, 0.0, 0.0))
    assert moving.velocity("l_elbow") == moving.acceleration("l_elbow") == (0.0, 0.0, 0.0)


class Followed:
    """The history of a body that changes from frame to frame."""

    def __init__(self, *frames: tuple[float, Body]) -> None:
        self.body = frames[0][1]
        self.trail = MotionHistory(lambda: self.body)
        for time, body in frames:
            self.trail.start_frame(GlobalTime(time))
            self.body = body


def test_a_body_is_extrapolated_from_the_last_two_frames(skeleton: Skeleton) -> None:
    bodies = [Body(skeleton, {"r_elbow": from_axis_angle(X, -0.1 * i)}) for i in range(4)]
    moving = Followed(*((0.02 * i, body) for i, body in enumerate(bodies))).trail.state_at(GlobalTime(0.07))
    assert moving.velocity("r_elbow") == pytest.approx((-5.0, 0.0, 0.0))
    assert angle(difference(moving.body.rotation("r_elbow"), from_axis_angle(X, -0.35))) < 1e-6
    assert moving.velocity("l_elbow") == (0.0, 0.0, 0.0)


def test_a_joint_that_was_set_elsewhere_is_not_extrapolated(skeleton: Skeleton) -> None:
    there = Body(skeleton, {"r_elbow": from_axis_angle(X, -1.0)})
    trail = Followed((0.02, Body(skeleton)), (0.04, there)).trail
    assert trail.state_at(GlobalTime(0.05)) == KinematicState(there, {}, {})


def test_a_body_without_recent_frames_has_no_velocity(skeleton: Skeleton) -> None:
    there = Body(skeleton, {"r_elbow": from_axis_angle(X, -0.1)})
    never, once = MotionHistory(lambda: there), Followed((0.02, Body(skeleton)), (0.04, there)).trail
    for trail in (never, once):
        assert trail.state_at(GlobalTime(3.0)) == KinematicState(there, {}, {})
        assert trail.latest(GlobalTime(3.0)) is None
    assert once.state_at(GlobalTime(0.05)).velocities
    assert once.latest(GlobalTime(0.05)) == (0.04, there)
    assert once.latest(GlobalTime(0.03)) is None
