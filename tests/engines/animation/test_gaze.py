"""Looking at things."""

import math
from itertools import pairwise

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from reactive_realizer.bml.words import Influence
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer, LayerKind, compose
from reactive_realizer.embodiment.quaternion import (
    IDENTITY,
    angle,
    conjugate,
    from_axis_angle,
    from_euler,
    multiply,
    rotate,
)
from reactive_realizer.embodiment.vector import Vec3, add, dot, subtract, unit
from reactive_realizer.engines.animation.gaze.gaze_motion_unit import GazeMotionUnit
from reactive_realizer.engines.animation.gaze.turning import (
    EYE_PITCH,
    EYE_YAW,
    EYES,
    aim_eyes,
    eye_point,
    gaze_joints,
    offset_target,
    turn_toward,
)

from .showing import shown as rotations

REST: dict = {}


def direction(yaw: float, pitch: float, far: float = 2.0) -> Vec3:
    """A way to the figure's left by yaw and up by pitch, degrees."""
    turn = from_euler(-math.radians(pitch), math.radians(yaw), 0.0)
    return rotate(turn, (0.0, 0.0, far))


def target_at(body: Body, yaw: float, pitch: float, far: float = 2.0) -> Vec3:
    return add(eye_point(body), direction(yaw, pitch, far))


def shown(unit: GazeMotionUnit, phase: float, body: Body, *more: Layer) -> Body:
    """The body with a gaze and more layers, the eyes last."""
    layers = [Layer(LayerKind.BASE, body.pose), Layer(LayerKind.GAZE, rotations(unit, phase, body)), *more]
    head = Body(body.skeleton, compose(body.skeleton, layers).pose)
    return Body(body.skeleton, compose(body.skeleton, [*layers, unit.eye_layer(phase, head)]).pose)


def error(body: Body, eye: str, target: Vec3) -> float:
    """Between where an eye looks and where the target is, degrees."""
    place = body.place(eye)
    looks = rotate(place.rotation, (0.0, 0.0, 1.0))
    return math.degrees(math.acos(min(1.0, dot(looks, unit(subtract(target, place.position))))))


@settings(derandomize=True, max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.floats(-105, 105), st.floats(-45, 45), st.floats(0.7, 20.0), st.sampled_from(list(Influence)[1:]))
def test_at_ready_both_eyes_are_on_the_target_within_a_degree(skeleton, yaw, pitch, far, influence):
    body = Body(skeleton)
    target = target_at(body, yaw, pitch, far)
    unit = GazeMotionUnit(lambda: target, influence)
    unit.start(body)
    for phase in (unit.key_positions["ready"], 0.5, unit.key_positions["relax"]):
        for eye in EYES:
            assert error(shown(unit, phase, body), eye, target) < 1.0


@pytest.mark.parametrize(("yaw", "pitch"), [(108, 0), (0, 55), (0, -55)])
def test_the_head_goes_further_than_usual_where_the_eyes_could_not_make_up_for_the_rest(skeleton, yaw, pitch):
    body = Body(skeleton)
    target = target_at(body, yaw, pitch)
    unit = GazeMotionUnit(lambda: target, Influence.HEAD)
    assert all(error(shown(unit, 0.5, body), eye, target) < 1.0 for eye in EYES)


def test_the_eyes_stay_on_the_target_while_the_head_nods_and_the_chest_breathes(skeleton):
    body = Body(skeleton)
    target = target_at(body, 40, 10)
    unit = GazeMotionUnit(lambda: target, Influence.HEAD)
    for nod in (-0.15, 0.1, 0.25):
        layer = Layer(
            LayerKind.ADDITIVE, {"skullbase": from_axis_angle((1.0, 0.0, 0.0), nod), "vt6": from_euler(0.02, 0.0, 0.0)}
        )
        for eye in EYES:
            assert error(shown(unit, 0.5, body, layer), eye, target) < 1.0


def test_a_gaze_of_the_eyes_turns_nothing_else(skeleton):
    body = Body(skeleton)
    target = target_at(body, 20, -10)
    unit = GazeMotionUnit(lambda: target, Influence.EYES)
    assert unit.joints == frozenset()
    for eye in EYES:
        assert error(shown(unit, 0.5, body), eye, target) < 1.0


def test_each_influence_takes_in_the_joints_of_the_one_before_it():
    sets = [set(gaze_joints(influence)) for influence in Influence]
    assert sets == sorted(sets, key=len)
    assert all(small <= large for small, large in pairwise(sets))
    assert sets[1] == {"vc4", "skullbase"}


def test_the_eyes_turn_no_further_than_eyes_do(skeleton):
    body = Body(skeleton)
    for yaw, pitch in ((120, 0), (-170, 60), (0, -80)):
        for rotation in aim_eyes(body, target_at(body, yaw, pitch)).values():
            ahead = rotate(rotation, (0.0, 0.0, 1.0))
            assert abs(math.atan2(ahead[0], ahead[2])) <= EYE_YAW + 1e-9
            assert abs(math.asin(ahead[1])) <= EYE_PITCH + 1e-9


@pytest.mark.parametrize("influence", list(Influence)[1:])
def test_the_head_goes_most_of_the_way_to_the_side_and_less_of_the_way_up(skeleton, influence):
    body = Body(skeleton)
    for yaw, pitch, least, most in ((50, 0, 0.55, 0.95), (0, 30, 0.35, 0.75)):
        head = body.posed(turn_toward(body, target_at(body, yaw, pitch), influence)).place("skullbase").rotation
        assert least < math.degrees(angle(head)) / max(yaw, pitch) < most


def test_the_gaze_begins_where_the_head_is_and_ends_at_rest_without_a_jump(skeleton):
    aside = {"skullbase": from_axis_angle((0.0, 1.0, 0.0), -0.5), "vc4": IDENTITY}
    body = Body(skeleton, aside)
    target = target_at(Body(skeleton), 45, 5)
    unit = GazeMotionUnit(lambda: target, Influence.HEAD)
    unit.start(body)
    assert rotations(unit, 0.0, body)["skullbase"] == pytest.approx(aside["skullbase"])
    assert rotations(unit, 1.0, Body(skeleton))["skullbase"] == pytest.approx(IDENTITY)
    poses = [rotations(unit, i / 200, Body(skeleton))["skullbase"] for i in range(201)]
    steps = [angle(multiply(conjugate(a), b)) for a, b in pairwise(poses)]
    assert max(steps) < 0.06
    assert steps[0] < 1e-3 > steps[-1]


def test_the_eyes_are_there_before_the_head(skeleton):
    body = Body(skeleton)
    target = target_at(body, 30, 0)
    unit = GazeMotionUnit(lambda: target, Influence.HEAD)
    unit.start(body)
    halfway = shown(unit, 0.5 * unit.key_positions["ready"], body)
    assert all(error(halfway, eye, target) < 1.0 for eye in EYES)
    assert angle(halfway.place("skullbase").rotation) < 0.7 * angle(shown(unit, 0.5, body).place("skullbase").rotation)


def test_a_target_that_moves_is_followed(skeleton):
    body = Body(skeleton)
    at = [target_at(body, 20, 0)]
    unit = GazeMotionUnit(lambda: at[0], Influence.HEAD)
    before = rotations(unit, 0.5, body)
    at[0] = target_at(body, -20, 0)
    assert rotations(unit, 0.5, body) != before
    assert all(error(shown(unit, 0.5, body), eye, at[0]) < 1.0 for eye in EYES)


@pytest.mark.parametrize(
    ("word", "yaw", "pitch"),
    [("RIGHT", -1, 0), ("LEFT", 1, 0), ("UP", 0, 1), ("DOWN", 0, -1), ("UPRIGHT", -1, 1), ("DOWNLEFT", 1, -1)],
)
def test_an_offset_lies_beside_the_target_as_the_figure_sees_it(skeleton, word, yaw, pitch):
    body = Body(skeleton)
    target = target_at(body, 0, 0)
    way = unit(subtract(offset_target(body, target, math.radians(20), word), eye_point(body)))
    assert math.degrees(math.acos(way[2])) == pytest.approx(20.0, abs=0.5)
    assert (round(way[0], 6) > 0) - (round(way[0], 6) < 0) == yaw
    assert (round(way[1], 6) > 0) - (round(way[1], 6) < 0) == pitch


def test_a_gaze_with_an_offset_looks_there_with_eyes_and_head(skeleton):
    body = Body(skeleton)
    target = target_at(body, 0, 0)
    unit = GazeMotionUnit(lambda: target, Influence.HEAD, offset_angle=25.0, offset_direction="LEFT")
    beside = target_at(body, 25, 0)
    assert all(error(shown(unit, 0.5, body), eye, beside) < 1.5 for eye in EYES)
