"""Gestures: preparation, stroke, hold and retraction."""

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, JointRotations, Skeleton
from reactive_realizer.embodiment.quaternion import IDENTITY, angle, difference, from_axis_angle, from_euler
from reactive_realizer.embodiment.vector import UP, Vec3, distance, subtract
from reactive_realizer.engines.animation.easing import minimum_jerk
from reactive_realizer.engines.animation.motion_unit import AMOUNT, GESTURE_POINTS, Moment
from reactive_realizer.engines.animation.motions.gesture import HOLD, GestureMotionUnit
from reactive_realizer.engines.animation.procedural.procedural_animation_reader import read_procedural_animation

from .bodies import REST_POSE, shown

GESTURES = ["beat_right", "beat_both", "offer_right", "offer_both", "greet_right", "conduct_right", "self_right"]
RAISED = {"r_shoulder": from_euler(-1.4, 0.3, -0.4), "r_elbow": from_euler(-0.9, 0.0, 0.0)}

PlanGesture = Callable[..., tuple[GestureMotionUnit, Body]]
Reach = Callable[[bool], GestureMotionUnit]


@pytest.fixture
def gesture(animations: Path, skeleton: Skeleton) -> PlanGesture:
    def plan(name: str, pose: JointRotations = REST_POSE, **parameters: float) -> tuple[GestureMotionUnit, Body]:
        rest = Body(skeleton, {**REST_POSE, **pose})
        animation = read_procedural_animation(animations / f"{name}.xml").fitted_to(skeleton)
        return GestureMotionUnit(animation, parameters, rest), rest

    return plan


def wrist(body: Body, side: str = "r") -> Vec3:
    return body.transform(f"{side}_wrist").position


@pytest.mark.parametrize("name", GESTURES)
def test_a_gesture_starts_from_the_current_arms_and_ends_in_the_rest_pose(gesture: PlanGesture, name: str) -> None:
    unit, rest = gesture(name)
    body = rest.posed(RAISED)
    unit.start(body)
    begin, end = (body.posed(shown(unit, phase, body, rest)) for phase in (0.0, 1.0))
    assert distance(wrist(begin), wrist(body)) < 1e-9
    for joint in unit.joints:
        assert angle(difference(end.rotation(joint), REST_POSE.get(joint, IDENTITY))) < 1e-6


@pytest.mark.parametrize("name", GESTURES)
@pytest.mark.parametrize("pose", [REST_POSE, RAISED], ids=["at rest", "raised"])
def test_at_its_preferred_speed_no_hand_moves_more_than_4_cm_in_20_ms(
    gesture: PlanGesture, name: str, pose: JointRotations
) -> None:
    unit, body = gesture(name, pose)
    frames = round(unit.preferred_duration / 0.02)
    for side in ("l", "r"):
        path = [wrist(body.posed(shown(unit, i / frames, body)), side) for i in range(frames + 1)]
        assert max(distance(a, b) for a, b in pairwise(path)) < 0.04


@pytest.mark.parametrize("name", GESTURES)
@pytest.mark.parametrize("pose", [REST_POSE, RAISED], ids=["at rest", "raised"])
def test_at_its_preferred_speed_no_finger_moves_more_than_5_cm_in_20_ms(
    gesture: PlanGesture, name: str, pose: JointRotations
) -> None:
    unit, body = gesture(name, pose)
    frames = round(unit.preferred_duration / 0.02)
    shapes = [body.posed(shown(unit, i / frames, body)) for i in range(frames + 1)]
    for finger in ("l_index3", "l_middle3", "l_pinky3", "r_index3", "r_middle3", "r_pinky3"):
        path = [body.transform(finger).position for body in shapes]
        assert max(distance(a, b) for a, b in pairwise(path)) < 0.05


@pytest.mark.parametrize("name", GESTURES)
def test_hands_move_smoothly_between_phases(gesture: PlanGesture, name: str) -> None:
    unit, body = gesture(name)
    step = 1e-5
    for phase in list(unit.key_positions.values())[1:-1]:
        before, at, after = (wrist(body.posed(shown(unit, phase + d, body))) for d in (-step, 0.0, step))
        assert distance(before, at) < 1e-4
        assert distance(at, after) < 1e-4


@pytest.mark.parametrize("name", GESTURES)
def test_the_hands_are_at_rest_at_ready_and_at_relax(gesture: PlanGesture, name: str) -> None:
    unit, body = gesture(name)
    step = 1e-4
    for point in ("start", "ready", "relax", "end"):
        phase = unit.key_positions[point]
        for other in (max(0.0, phase - step), min(1.0, phase + step)):
            speed = distance(*(wrist(body.posed(shown(unit, p, body))) for p in (phase, other))) / step
            assert speed / unit.preferred_duration < 0.03, (point, other)


@pytest.mark.parametrize("name", GESTURES)
def test_the_seven_points_are_in_order_and_preparation_takes_longer_from_further_away(
    gesture: PlanGesture, name: str
) -> None:
    unit, _ = gesture(name)
    assert list(unit.key_positions) == list(GESTURE_POINTS)
    assert list(unit.key_positions.values()) == sorted(unit.key_positions.values())
    ready = unit.key_positions["ready"] * unit.preferred_duration
    assert 0.3 < ready < 1.05
    there, body = gesture(name)
    again, _ = gesture(name, shown(there, there.key_positions["ready"], body))
    assert again.key_positions["ready"] * again.preferred_duration == pytest.approx(0.25, abs=0.01)


def test_a_beat_goes_down_to_its_stroke_and_lifts_a_little_before(
    gesture: PlanGesture,
) -> None:
    unit, body = gesture("beat_right")
    keys = unit.key_positions
    phases = [keys["ready"] + i * (keys["strokeEnd"] - keys["ready"]) / 100 for i in range(101)]
    heights = [wrist(body.posed(shown(unit, phase, body)))[1] for phase in phases]
    lowest = min(range(101), key=heights.__getitem__)
    assert phases[lowest] == pytest.approx(keys["stroke"], abs=0.02)
    assert heights[0] < max(heights[:lowest])
    assert max(heights) - heights[lowest] > 0.08


def test_the_hand_of_a_beat_is_in_front_of_the_belly(gesture: PlanGesture) -> None:
    unit, body = gesture("beat_right")
    at = body.posed(shown(unit, unit.key_positions["stroke"], body))
    x, y, z = subtract(wrist(at), at.transform("vt10").position)
    assert -0.35 < x < 0.0
    assert -0.1 < y < 0.25
    assert 0.15 < z < 0.45


def test_the_conductors_hand_comes_up_to_where_it_was(gesture: PlanGesture) -> None:
    unit, body = gesture("conduct_right")
    ready, relax = (wrist(body.posed(shown(unit, unit.key_positions[p], body))) for p in ("ready", "relax"))
    assert distance(ready, relax) < 0.001


def test_hands_hold_after_the_stroke_as_long_as_the_binding_says(
    gesture: PlanGesture,
) -> None:
    without, _ = gesture("offer_right")
    unit, body = gesture("offer_right", **{HOLD: 0.8})
    assert unit.preferred_duration - without.preferred_duration == pytest.approx(0.8)
    begin, end = unit.key_positions["strokeEnd"], unit.key_positions["relax"]
    assert shown(unit, begin + 0.01, body) == shown(unit, end - 0.01, body)


def test_an_arm_that_moved_after_planning_starts_from_its_current_pose(
    gesture: PlanGesture, skeleton: Skeleton
) -> None:
    unit, _ = gesture("beat_right")
    moved = Body(skeleton, {**REST_POSE, **RAISED})
    unit.start(moved)
    assert distance(wrist(moved.posed(shown(unit, 0.0, moved))), wrist(moved)) < 1e-9


def test_a_gesture_leaves_the_other_arm_alone(gesture: PlanGesture) -> None:
    unit, _ = gesture("beat_right")
    assert all(joint.startswith("r_") for joint in unit.joints)


def test_a_bigger_beat_has_a_longer_path_and_may_grow_while_it_plays(
    gesture: PlanGesture,
) -> None:
    unit, body = gesture("beat_right")
    stroke = unit.key_positions["stroke"]
    before = wrist(body.posed(shown(unit, stroke, body)))
    unit.parameters = {**unit.parameters, "a": 1.0}
    assert wrist(body.posed(shown(unit, stroke, body)))[1] < before[1] - 0.05


def test_a_reach_of_minimum_jerk_starts_and_stops_softly_and_is_symmetric() -> None:
    step = 1e-4
    assert (minimum_jerk(0.0), minimum_jerk(0.5), minimum_jerk(1.0)) == (0.0, 0.5, 1.0)
    assert minimum_jerk(step) / step < 1e-6
    for i in range(11):
        assert minimum_jerk(i / 10) + minimum_jerk(1 - i / 10) == pytest.approx(1.0)
    speeds = [(minimum_jerk(i / 100 + step) - minimum_jerk(i / 100)) / step for i in range(100)]
    assert max(speeds) == pytest.approx(1.875, abs=0.001)


@pytest.mark.parametrize("name", GESTURES)
def test_an_amount_scales_the_distance_from_the_rest_pose(gesture: PlanGesture, name: str) -> None:
    unit, rest = gesture(name)
    body = rest.posed(RAISED)
    unit.start(body)
    keys = unit.key_positions
    whole = shown(unit, keys["stroke"], body)
    unit.parameters = {**unit.parameters, AMOUNT: 0.4}
    for joint, part in shown(unit, keys["stroke"], body).items():
        begin = rest.rotation(joint)
        assert angle(difference(begin, part)) == pytest.approx(0.4 * angle(difference(begin, whole[joint])), abs=1e-6)
    assert distance(wrist(body.posed(shown(unit, 0.0, body))), wrist(body)) < 1e-9
    unit.parameters = {**unit.parameters, AMOUNT: 0.0}
    for joint, rotation in shown(unit, keys["stroke"], body).items():
        assert angle(difference(REST_POSE.get(joint, IDENTITY), rotation)) < 1e-6


@pytest.mark.parametrize("name", GESTURES)
def test_preparation_takes_longer_from_further_away(gesture: PlanGesture, name: str) -> None:
    unit, body = gesture(name)
    planned = unit.key_positions["ready"] * unit.preferred_duration
    assert unit.preparation(body).preferred == pytest.approx(planned)
    there = body.posed(shown(unit, unit.key_positions["ready"], body))
    assert unit.preparation(there).preferred < 0.3 < planned
    assert unit.preparation(there).shortest < 0.05 < unit.preparation(body).shortest < planned


def test_a_copy_has_the_same_durations_and_moves_independently(
    gesture: PlanGesture,
) -> None:
    unit, body = gesture("beat_right")
    other = unit.copy()
    assert (other.preferred_duration, other.key_positions) == (unit.preferred_duration, unit.key_positions)
    as_planned = shown(unit, 0.1, body)
    other.parameters = {**other.parameters, AMOUNT: 0.5}
    other.start(body.posed(RAISED))
    assert shown(unit, 0.1, body) == as_planned
    assert shown(other, 0.1, body) != as_planned


REACH = """
<ProcAnimation prefDuration="1">
  <Parameter sid="a" value="1"/>
  <EndEffector target="r_wrist" local="{}" translation="0 - 0.1 - 0.05*a;{};0.3"/>
  <Rotation target="r_index1" rotation="0;0;0.3"/>
</ProcAnimation>
"""
HOLDING = 0.5
"""A phase in a hold."""


@pytest.fixture
def reaching(tmp_path: Path, skeleton: Skeleton) -> Reach:
    """A gesture to a place from the shoulder, or in the figure's axes."""

    def make(local: bool) -> GestureMotionUnit:
        path = tmp_path / "reach.xml"
        path.write_text(REACH.format(str(local).lower(), "-0.1" if local else "1.1"), encoding="utf-8")
        gesture = GestureMotionUnit(read_procedural_animation(path).fitted_to(skeleton), {}, Body(skeleton))
        gesture.start(Body(skeleton))
        return gesture

    return make


def poses(gesture: GestureMotionUnit, *bodies: Body) -> list[JointRotations]:
    return [gesture.pose(Moment(HOLDING, GlobalTime(0.0), body)).rotations for body in bodies]


def test_a_hand_that_holds_a_global_goal_stays_there_while_the_trunk_turns(
    reaching: Reach,
    skeleton: Skeleton,
) -> None:
    straight = Body(skeleton)
    turned = straight.posed({"vl5": from_axis_angle(UP, 0.3)})
    first, second = poses(reaching(False), straight, turned)
    before, after = straight.posed(first).transform("r_wrist"), turned.posed(second).transform("r_wrist")
    assert after.position == pytest.approx(before.position, abs=1e-6)


def test_a_hand_that_holds_a_local_goal_turns_with_the_trunk(
    reaching: Reach,
    skeleton: Skeleton,
) -> None:
    straight = Body(skeleton)
    first, second = poses(reaching(True), straight, straight.posed({"vl5": from_axis_angle(UP, 0.3)}))
    assert first == second


def test_a_parameter_change_during_a_hold_takes_effect_at_once(
    reaching: Reach,
    skeleton: Skeleton,
) -> None:
    gesture, body = reaching(True), Body(skeleton)
    (before,) = poses(gesture, body)
    gesture.parameters = {**gesture.parameters, "a": 2.0}
    (after,) = poses(gesture, body)
    assert after["r_shoulder"] != before["r_shoulder"]
    assert after["r_index1"] == before["r_index1"]
