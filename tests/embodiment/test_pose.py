"""Composition of layers."""

import math

import pytest

from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.embodiment.pose import Layer, LayerKind, checked, compose
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, from_axis_angle, multiply
from reactive_realizer.errors import RealizerError

SKELETON = Skeleton(
    ("HumanoidRoot", "vl5", "skullbase"), (-1, 0, 1), ((0.0, 1.0, 0.0), (0.0, 0.2, 0.0), (0.0, 0.3, 0.0))
)


def about_x(degrees: float) -> Quat:
    return from_axis_angle((1.0, 0.0, 0.0), math.radians(degrees))


def about_y(degrees: float) -> Quat:
    return from_axis_angle((0.0, 1.0, 0.0), math.radians(degrees))


def test_without_layers_the_figure_is_in_the_default_pose() -> None:
    assert compose(SKELETON, []).shown.pose == dict.fromkeys(SKELETON.joints, IDENTITY)


def test_a_gesture_lies_over_a_gaze_in_any_order_of_layers() -> None:
    gaze = Layer(LayerKind.GAZE, {"skullbase": about_y(40), "vl5": about_y(10)})
    gesture = Layer(LayerKind.GESTURE, {"skullbase": about_x(5)})
    for layers in ([gaze, gesture], [gesture, gaze]):
        assert compose(SKELETON, layers).shown.pose == {
            "HumanoidRoot": IDENTITY,
            "vl5": about_y(10),
            "skullbase": about_x(5),
        }


def test_a_layer_with_a_higher_priority_lies_above() -> None:
    low = Layer(LayerKind.GESTURE, {"vl5": about_x(10)}, priority=1)
    high = Layer(LayerKind.GESTURE, {"vl5": about_x(20)}, priority=2)
    assert compose(SKELETON, [high, low]).shown.pose["vl5"] == about_x(20)


def test_a_layer_with_half_weight_turns_half_as_far() -> None:
    layers = [Layer(LayerKind.BASE, {"vl5": about_x(10)}), Layer(LayerKind.GESTURE, {"vl5": about_x(50)}, weight=0.5)]
    assert compose(SKELETON, layers).shown.pose["vl5"] == pytest.approx(about_x(30))


def test_a_nod_turns_a_head_that_looks_aside_about_its_own_axis() -> None:
    layers = [Layer(LayerKind.ADDITIVE, {"skullbase": about_x(10)}), Layer(LayerKind.GAZE, {"skullbase": about_y(60)})]
    assert compose(SKELETON, layers).shown.pose["skullbase"] == pytest.approx(multiply(about_y(60), about_x(10)))


def test_additive_layers_add_up_by_their_weights() -> None:
    layers = [
        Layer(LayerKind.ADDITIVE, {"vl5": about_x(10)}),
        Layer(LayerKind.ADDITIVE, {"vl5": about_x(8)}, weight=0.5),
    ]
    assert compose(SKELETON, layers).shown.pose["vl5"] == pytest.approx(about_x(14))


def test_the_steady_pose_leaves_the_additive_layers_out() -> None:
    layers = [Layer(LayerKind.GAZE, {"vl5": about_y(30)}), Layer(LayerKind.ADDITIVE, {"vl5": about_x(10)})]
    assert compose(SKELETON, layers).steady.pose["vl5"] == about_y(30)


def test_joints_that_the_skeleton_lacks_are_left_out() -> None:
    assert "l_pinky1" not in compose(SKELETON, [Layer(LayerKind.GESTURE, {"l_pinky1": about_x(10)})]).shown.pose


def test_layers_above_the_additive_ones_are_part_of_the_steady_pose() -> None:
    layers = [Layer(LayerKind.END_EFFECTOR, {"vl5": about_y(30)}), Layer(LayerKind.ADDITIVE, {"vl5": about_x(10)})]
    composed = compose(SKELETON, layers)
    assert composed.shown.pose["vl5"] == composed.steady.pose["vl5"] == about_y(30)


def test_the_root_is_displaced_by_weight_and_further_by_additive_layers() -> None:
    layers = [
        Layer(LayerKind.POSTURE, {}, weight=0.5, root=(0.0, -0.4, 0.0)),
        Layer(LayerKind.ADDITIVE, {}, root=(0.02, 0.0, 0.0)),
        Layer(LayerKind.GESTURE, {"vl5": about_x(10)}),
    ]
    composed = compose(SKELETON, layers)
    assert composed.shown.root == pytest.approx((0.02, -0.2, 0.0))
    assert composed.steady.root == pytest.approx((0.0, -0.2, 0.0))


@pytest.mark.parametrize(
    ("layer", "said"),
    [
        (Layer(LayerKind.GESTURE, {"vl5": about_x(10), "skullbase": (math.nan, 0.0, 0.0, 0.0)}), "sets skullbase to"),
        (Layer(LayerKind.GESTURE, {"skullbase": (0.0, 0.0, 0.0, 0.0)}), "sets skullbase to"),
        (Layer(LayerKind.GESTURE, {"skullbase": (math.inf, 0.0, 0.0, 0.0)}), "sets skullbase to"),
        (Layer(LayerKind.GESTURE, {}, weight=math.nan), "sets its weight to nan"),
        (Layer(LayerKind.GESTURE, {}, root=(0.0, math.inf, 0.0)), "sets HumanoidRoot's place to"),
    ],
)
def test_an_invalid_rotation_is_refused_with_the_name_of_the_joint(layer: Layer, said: str) -> None:
    with pytest.raises(RealizerError, match=said):
        checked(layer)


def test_joints_may_weigh_less_than_their_layer() -> None:
    half = Layer(LayerKind.GESTURE, {"vl5": about_x(40), "skullbase": about_x(40)}, 0.5, weights={"vl5": 0.5})
    composed = compose(SKELETON, [half]).shown.pose
    assert composed["vl5"] == pytest.approx(about_x(10))
    assert composed["skullbase"] == pytest.approx(about_x(20))


def test_the_weight_of_the_root_joint_applies_to_its_displacement() -> None:
    layer = Layer(LayerKind.GESTURE, {}, root=(0.0, 0.0, 1.0), weights={"HumanoidRoot": 0.25})
    assert compose(SKELETON, [layer]).shown.root == pytest.approx((0.0, 0.0, 0.25))
