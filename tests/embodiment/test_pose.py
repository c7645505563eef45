"""Layers of motion become one pose."""

import math

import pytest

from reactive_realizer.embodiment.pose import Layer, LayerKind, compose
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, from_axis_angle, multiply
from reactive_realizer.embodiment.skeleton import Skeleton

SKELETON = Skeleton(
    ("HumanoidRoot", "vl5", "skullbase"), (-1, 0, 1), ((0.0, 1.0, 0.0), (0.0, 0.2, 0.0), (0.0, 0.3, 0.0))
)


def about_x(degrees: float) -> Quat:
    return from_axis_angle((1.0, 0.0, 0.0), math.radians(degrees))


def about_y(degrees: float) -> Quat:
    return from_axis_angle((0.0, 1.0, 0.0), math.radians(degrees))


def test_without_layers_the_figure_is_in_the_default_pose():
    assert compose(SKELETON, []).pose == dict.fromkeys(SKELETON.joints, IDENTITY)


def test_a_gesture_replaces_what_gaze_does_to_a_joint_whatever_the_order_they_come_in():
    gaze = Layer(LayerKind.GAZE, {"skullbase": about_y(40), "vl5": about_y(10)})
    gesture = Layer(LayerKind.GESTURE, {"skullbase": about_x(5)})
    for layers in ([gaze, gesture], [gesture, gaze]):
        assert compose(SKELETON, layers).pose == {
            "HumanoidRoot": IDENTITY,
            "vl5": about_y(10),
            "skullbase": about_x(5),
        }


def test_of_two_gestures_the_one_of_higher_priority_lies_above():
    low = Layer(LayerKind.GESTURE, {"vl5": about_x(10)}, priority=1)
    high = Layer(LayerKind.GESTURE, {"vl5": about_x(20)}, priority=2)
    assert compose(SKELETON, [high, low]).pose["vl5"] == about_x(20)


def test_a_layer_of_half_weight_goes_half_the_way():
    layers = [Layer(LayerKind.BASE, {"vl5": about_x(10)}), Layer(LayerKind.GESTURE, {"vl5": about_x(50)}, weight=0.5)]
    assert compose(SKELETON, layers).pose["vl5"] == pytest.approx(about_x(30))


def test_a_nod_turns_a_head_that_looks_aside_about_its_own_ears():
    layers = [Layer(LayerKind.ADDITIVE, {"skullbase": about_x(10)}), Layer(LayerKind.GAZE, {"skullbase": about_y(60)})]
    assert compose(SKELETON, layers).pose["skullbase"] == pytest.approx(multiply(about_y(60), about_x(10)))


def test_two_additive_layers_add_up_and_weigh_in():
    layers = [
        Layer(LayerKind.ADDITIVE, {"vl5": about_x(10)}),
        Layer(LayerKind.ADDITIVE, {"vl5": about_x(8)}, weight=0.5),
    ]
    assert compose(SKELETON, layers).pose["vl5"] == pytest.approx(about_x(14))


def test_the_steady_pose_leaves_the_additive_layers_out():
    layers = [Layer(LayerKind.GAZE, {"vl5": about_y(30)}), Layer(LayerKind.ADDITIVE, {"vl5": about_x(10)})]
    assert compose(SKELETON, layers).steady["vl5"] == about_y(30)


def test_joints_that_the_skeleton_lacks_are_left_out():
    assert "l_pinky1" not in compose(SKELETON, [Layer(LayerKind.GESTURE, {"l_pinky1": about_x(10)})]).pose
