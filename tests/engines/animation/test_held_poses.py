"""What of a gesture does not change is found once, and found again where it does."""

import pytest

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import from_axis_angle
from reactive_realizer.embodiment.vector import UP
from reactive_realizer.engines.animation.arms.gesture_motion_unit import GestureMotionUnit
from reactive_realizer.engines.animation.motion_unit import Moment
from reactive_realizer.engines.animation.procedural.proc_animation_reader import read_proc_animation

REACH = """
<ProcAnimation prefDuration="1">
  <Parameter sid="a" value="1"/>
  <EndEffector target="r_wrist" local="{}" translation="0 - 0.1 - 0.05*a;{};0.3"/>
  <Rotation target="r_index1" rotation="0;0;0.3"/>
</ProcAnimation>
"""
HOLD = 0.5
"""A phase at which the hands wait."""


@pytest.fixture
def reaching(tmp_path, skeleton):
    """A gesture to a place from the shoulder, or in the figure's axes."""

    def make(local: bool) -> GestureMotionUnit:
        path = tmp_path / "reach.xml"
        path.write_text(REACH.format(str(local).lower(), "-0.1" if local else "1.1"), encoding="utf-8")
        gesture = GestureMotionUnit(read_proc_animation(path).on(skeleton), {}, Body(skeleton))
        gesture.start(Body(skeleton))
        return gesture

    return make


def poses(gesture, *bodies):
    return [gesture.pose(Moment(HOLD, 0.0, body)).rotations for body in bodies]


def test_a_hand_that_waits_at_a_place_stays_there_while_the_trunk_turns(reaching, skeleton) -> None:
    straight = Body(skeleton)
    turned = straight.posed({"vl5": from_axis_angle(UP, 0.3)})
    first, second = poses(reaching(False), straight, turned)
    before, after = straight.posed(first).place("r_wrist"), turned.posed(second).place("r_wrist")
    assert after.position == pytest.approx(before.position, abs=1e-6)


def test_one_that_waits_before_the_shoulder_turns_with_it_and_is_the_same_pose(reaching, skeleton) -> None:
    straight = Body(skeleton)
    first, second = poses(reaching(True), straight, straight.posed({"vl5": from_axis_angle(UP, 0.3)}))
    assert first == second


def test_a_parameter_that_is_changed_while_the_hand_waits_is_seen_at_once(reaching, skeleton) -> None:
    gesture, body = reaching(True), Body(skeleton)
    (before,) = poses(gesture, body)
    gesture.parameters["a"] = 2.0
    (after,) = poses(gesture, body)
    assert after["r_shoulder"] != before["r_shoulder"]
    assert after["r_index1"] == before["r_index1"]
