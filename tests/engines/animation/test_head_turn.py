"""How trunk, neck and head share a gaze: Tweed's model (thesis 4.2.2)."""

import math

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from reactive_realizer.bml.vocabulary import Influence
from reactive_realizer.embodiment.body import Body, JointRotations, Skeleton
from reactive_realizer.embodiment.quaternion import (
    IDENTITY,
    Quat,
    angle,
    conjugate,
    difference,
    from_axis_angle,
    from_euler,
    multiply,
    power,
    rotate,
)
from reactive_realizer.embodiment.quaternion import between as shortest
from reactive_realizer.embodiment.vector import FORWARD, Vec3, add, scale, unit
from reactive_realizer.engines.animation.gaze.eyes import eye_range
from reactive_realizer.engines.animation.gaze.head_turn import (
    GAZE_WEIGHTS,
    JOINT_GROUPS,
    default_weights,
    head_turn,
    joint_weights,
)
from reactive_realizer.engines.animation.gaze.head_turn import head_turn_toward as turned_toward

from .gazes import between, target_at, way

WILLING = 0.8

frontal = given(st.floats(-80, 80), st.floats(-40, 40))
equation = settings(
    derandomize=True, max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def head_turn_toward(body: Body, rest: JointRotations, target: Vec3, weights: dict[str, float]) -> JointRotations:
    """Toward a point, whatever the eyes."""
    return turned_toward(body, rest, lambda _: target, weights).rotations


def head_of(body: Body, rotations: JointRotations) -> Quat:
    return body.posed(rotations).transform("skullbase").rotation


@equation
@frontal
def test_the_head_makes_nine_tenths_of_the_horizontal_three_tenths_of_the_vertical_and_donders_roll(
    yaw: float, pitch: float
) -> None:
    whole = shortest(FORWARD, way(yaw, pitch))
    _, x, y, z = head_turn(way(yaw, pitch), 1.0, 10.0)
    assert x == pytest.approx(0.3 * whole[1], abs=1e-9)
    assert y == pytest.approx(0.9 * whole[2], abs=1e-9)
    assert z == pytest.approx(-0.15 * whole[1] * whole[2], abs=1e-9)


@equation
@frontal
def test_the_head_leaves_no_more_than_a_comfortable_turn_to_the_eyes(yaw: float, pitch: float) -> None:
    turn = head_turn(way(yaw, pitch), 1.0, WILLING)
    left = shortest(FORWARD, rotate(conjugate(turn), way(yaw, pitch)))
    assert angle(left) <= WILLING * eye_range(left) + 1e-6


def test_a_head_without_the_eyes_points_at_the_target() -> None:
    assert between(rotate(head_turn(way(40, 25), 1.0, 0.0), FORWARD), way(40, 25)) < 1e-4


@equation
@given(st.floats(-70, 70), st.floats(-35, 35), st.sampled_from(list(Influence)[1:]))
def test_the_head_turns_the_same_with_any_joints(
    skeleton: Skeleton, yaw: float, pitch: float, influence: Influence
) -> None:
    body = Body(skeleton)
    target = target_at(body, yaw, pitch, 1000.0)
    turned = head_of(body, head_turn_toward(body, {}, target, default_weights(influence)))
    alone = head_turn(way(yaw, pitch), 1.0, WILLING)
    # At a thousand meters it does not matter from where the figure looks.
    assert angle(difference(turned, alone)) < 2e-3


def test_all_joints_turn_about_one_axis_so_that_the_head_does_on_its_way(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    goal = head_turn_toward(body, {}, target_at(body, 50, 20), default_weights(Influence.WAIST))
    axes = []
    for part in (0.2, 0.5, 0.9):
        _, x, y, z = head_of(body, {joint: power(turn, part) for joint, turn in goal.items()})
        axes.append(unit((x, y, z)))
    assert all(between(axis, axes[0]) < 1e-3 for axis in axes)


def test_a_leaning_trunk_keeps_leaning_under_a_gaze_of_the_waist(skeleton: Skeleton) -> None:
    leaning = {"vl5": from_euler(0.2, 0.0, 0.0), "vt6": from_euler(0.0, 0.0, 0.1)}
    body = Body(skeleton, leaning)
    straight_ahead = target_at(body, 0, 0)
    ahead = body.transform("skullbase").rotation
    target = add(straight_ahead, scale(rotate(ahead, FORWARD), 5.0))
    rotations = head_turn_toward(body, leaning, target, default_weights(Influence.WAIST))
    for joint in ("vl5", "vt6", "vc4"):
        assert angle(difference(rotations[joint], leaning.get(joint, IDENTITY))) < 0.1


def test_joints_over_a_leaning_trunk_turn_the_head_as_one(skeleton: Skeleton) -> None:
    leaning = {"vl5": from_euler(0.15, 0.0, 0.1), "vt6": from_euler(0.1, 0.2, 0.0)}
    body = Body(skeleton, leaning)
    ahead = body.transform("skullbase").rotation
    # Far away, in the axes of the head as the trunk carries it.
    target = scale(rotate(ahead, way(30, 10)), 1e4)
    turned = head_of(body, head_turn_toward(body, leaning, target, default_weights(Influence.WAIST)))
    assert angle(difference(turned, multiply(ahead, head_turn(way(30, 10), 1.0, WILLING)))) < 1e-3


def test_each_influence_includes_the_joints_of_the_one_before() -> None:
    sets = [set(joint_weights(default_weights(influence))) for influence in Influence]
    assert sets == [
        set(),
        {"vc4", "skullbase"},
        {"vt10", "vt6", "vc4", "skullbase"},
        {"vl5", "vt10", "vt6", "vc4", "skullbase"},
        {"vl5", "vt10", "vt6", "vc4", "skullbase"},
    ]


def test_the_groups_are_those_of_the_back_up_to_the_eyes() -> None:
    assert list(GAZE_WEIGHTS) == ["back", "chest", "neck", "head", "eyes"]
    assert all(sum(joints.values()) == 1.0 for joints in JOINT_GROUPS.values())


def test_weights_share_the_turn(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    target = target_at(body, 30, 0)
    turns = {
        joint: math.degrees(angle(turn))
        for joint, turn in head_turn_toward(
            body, {}, target, {"back": 0.25, "chest": 0.0, "neck": 0.25, "head": 0.5, "eyes": 1.0}
        ).items()
    }
    assert set(turns) == {"vl5", "vc4", "skullbase"}
    assert turns["vl5"] == pytest.approx(turns["vc4"])
    assert turns["skullbase"] == pytest.approx(2 * turns["vc4"])


def test_weights_below_one_turn_the_head_less_and_weights_above_one_no_further(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    target = target_at(body, 20, 0)

    def yaw(neck: float, head: float) -> float:
        weights = {"back": 0.0, "chest": 0.0, "neck": neck, "head": head, "eyes": 1.0}
        return angle(head_of(body, head_turn_toward(body, {}, target, weights)))

    assert yaw(0.2, 0.2) == pytest.approx(0.4 * yaw(0.5, 0.5))
    assert yaw(1.0, 1.0) == pytest.approx(yaw(0.5, 0.5))


def test_other_joints_make_up_for_a_joint_at_its_limit(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    weights = {"back": 0.0, "chest": 0.0, "neck": 0.9, "head": 0.1, "eyes": 1.0}
    turns = head_turn_toward(body, {}, target_at(body, 60, 0), weights)
    assert angle(turns["vc4"]) == pytest.approx(0.6)
    assert math.degrees(angle(turns["vc4"]) + angle(turns["skullbase"])) == pytest.approx(54, abs=1.0)


@pytest.mark.parametrize(("yaw", "pitch"), [(180, 0), (179, 10), (-179, 10), (150, -60), (0, 90), (0, -90), (90, 89)])
@pytest.mark.parametrize("influence", list(Influence)[1:])
def test_no_joint_exceeds_its_limit_for_any_target(
    skeleton: Skeleton, yaw: float, pitch: float, influence: Influence
) -> None:
    body = Body(skeleton)
    turns = head_turn_toward(body, {}, target_at(body, yaw, pitch), default_weights(influence))
    path_length = {"vl5": 0.35, "vt10": 0.25, "vt6": 0.25, "vc4": 0.6, "skullbase": 0.75}
    for joint, turn in turns.items():
        assert math.sqrt(sum(part * part for part in turn)) == pytest.approx(1.0)
        assert angle(turn) <= path_length[joint] + 1e-9


@pytest.mark.parametrize("side", [1, -1])
def test_the_head_turns_to_a_target_behind_over_the_shoulder(skeleton: Skeleton, side: int) -> None:
    body = Body(skeleton)
    turned = head_of(
        body, head_turn_toward(body, {}, target_at(body, side * 170, 15), default_weights(Influence.WAIST))
    )
    nose = rotate(turned, FORWARD)
    assert side * math.degrees(math.atan2(nose[0], nose[2])) > 70
    assert abs(nose[1]) < 0.5


def test_a_target_between_the_eyes_turns_nothing(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    turns = head_turn_toward(body, {}, target_at(body, 0, 0, 0.0), default_weights(Influence.WAIST))
    assert all(angle(turn) == 0.0 for turn in turns.values())


def test_current_rotations_of_the_joints_have_no_effect(skeleton: Skeleton) -> None:
    aside = Body(skeleton, {"skullbase": from_axis_angle((0.0, 1.0, 0.0), -0.5)})
    body = Body(skeleton)
    target = target_at(body, 30, 10)
    weights = default_weights(Influence.HEAD)
    assert head_turn_toward(aside, {}, target, weights) == head_turn_toward(body, {}, target, weights)


@pytest.mark.parametrize("weight", [5e-324, 1e-300, 1e-12])
def test_a_tiny_weight_turns_very_little(skeleton: Skeleton, weight: float) -> None:
    body = Body(skeleton)
    weights = {"back": 0.0, "chest": 0.0, "neck": 0.0, "head": weight, "eyes": 1.0}
    assert angle(head_turn_toward(body, {}, target_at(body, 20, 0), weights)["skullbase"]) < 1e-9
    assert angle(head_turn_toward(body, {}, target_at(body, 90, 0), weights)["skullbase"]) > 0.5
