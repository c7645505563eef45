"""Nods and shakes."""

import math

import pytest

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat
from reactive_realizer.engines.animation.motion_unit import GESTURE_POINTS, completed
from reactive_realizer.engines.animation.procedural.proc_animation_reader import read_proc_animation
from reactive_realizer.engines.animation.procedural.proc_motion_unit import ProcMotionUnit

from .showing import shown


@pytest.fixture
def head(animations, skeleton):
    def unit(name: str, **parameters: float):
        motion = ProcMotionUnit(
            read_proc_animation(animations / f"smartbody/{name}.xml"), parameters, LayerKind.ADDITIVE
        )
        return motion, lambda phase: shown(motion, phase, Body(skeleton))["skullbase"]

    return unit


def about(axis: int, q: Quat) -> float:
    return 2.0 * math.atan2(q[axis], q[0])


@pytest.mark.parametrize("name", ["nod", "shake"])
@pytest.mark.parametrize("repeats", [1, 2, 3])
def test_it_begins_and_ends_at_rest(head, name, repeats):
    _, turn = head(name, a=1.0, r=repeats)
    step = 1e-4
    for phase, inside in ((0.0, step), (1.0, 1.0 - step)):
        assert turn(phase) == pytest.approx(IDENTITY, abs=1e-9)
        axis = 1 if name == "nod" else 2
        assert abs(about(axis, turn(inside))) / step < 0.02


@pytest.mark.parametrize(("name", "axis", "first"), [("nod", 1, 1.0), ("shake", 2, 1.0)])
@pytest.mark.parametrize("repeats", [1, 2, 3])
def test_each_stroke_is_at_a_peak_a_nod_goes_down_and_a_shake_to_the_left_first(head, name, axis, first, repeats):
    unit, turn = head(name, a=0.5, r=repeats)
    strokes = [unit.key_positions["stroke"]]
    if repeats > 1:
        strokes = [unit.key_positions[f"stroke:{i}"] for i in range(1, repeats + 1)]
        assert f"stroke:{repeats + 1}" not in unit.key_positions
    assert strokes == sorted(strokes)
    for phase in strokes:
        peak = first * about(axis, turn(phase))
        assert peak > 0.05
        assert first * about(axis, turn(phase - 0.01)) < peak > first * about(axis, turn(phase + 0.01))


@pytest.mark.parametrize("name", ["nod", "shake"])
def test_the_amount_is_the_amplitude_and_may_change_while_it_plays(head, name):
    unit, turn = head(name, a=0.5)
    stroke = unit.key_positions["stroke"]
    small = 1.0 - turn(stroke)[0]
    unit.parameters["a"] = 1.0
    assert 1.0 - turn(stroke)[0] == pytest.approx(4.0 * small, rel=0.05)


@pytest.mark.parametrize("name", ["nod", "shake"])
def test_more_repeats_take_longer(head, name):
    once, _ = head(name)
    thrice, _ = head(name, r=3)
    assert thrice.preferred_duration > 2.0 * once.preferred_duration
    assert once.limits[0] < once.preferred_duration < once.limits[1]


def test_a_parameter_that_the_animation_does_not_know_is_of_no_effect(head):
    unit, _ = head("nod", priority=3.0)
    assert unit.parameters == {"a": 0.5, "r": 1.0}


@pytest.mark.parametrize(
    "authored",
    [{}, {"stroke": 0.4}, {"ready": 0.2, "relax": 0.9}, {"strokeStart": 0.3, "strokeEnd": 0.5, "beat1": 0.7}],
)
def test_missing_points_coincide_with_their_neighbors_and_all_are_in_order(authored):
    keys = completed(authored)
    assert [point for point in keys if point in GESTURE_POINTS] == list(GESTURE_POINTS)
    assert list(keys.values()) == sorted(keys.values())
    assert authored.items() <= keys.items()
    assert keys["ready"] == authored.get("ready", 0.0)
    assert keys["strokeEnd"] == authored.get("strokeEnd", keys["relax"])
