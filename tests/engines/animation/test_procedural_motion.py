"""Procedural animations as motions, among them nods and shakes."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, angle, difference, from_euler
from reactive_realizer.engines.animation.motion_unit import Moment, Resource
from reactive_realizer.engines.animation.motions.procedural import ProceduralMotionUnit, kind_of
from reactive_realizer.engines.animation.procedural.procedural_animation import ProceduralAnimation
from reactive_realizer.engines.animation.procedural.procedural_animation_reader import read_procedural_animation
from reactive_realizer.errors import RealizerError

from .bodies import shown

RISING = '<Rotation target="r_elbow" rotation="0-0.5-t;0;0"/>'


def rotation(unit: ProceduralMotionUnit, phase: float, body: Body, joint: str = "r_elbow") -> Quat:
    posed = unit.pose(Moment(phase, GlobalTime(0.0), body))
    assert posed.weight == 1.0
    return posed.rotations[joint]


def gap(a: Quat, b: Quat) -> float:
    return angle(difference(a, b))


def test_an_animation_that_starts_at_the_current_body_plays_the_file_from_the_first_frame(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    unit = ProceduralMotionUnit(read(RISING), {}, LayerKind.GESTURE)
    body = Body(skeleton, {"r_elbow": from_euler(-0.5, 0.0, 0.0)})
    unit.start(body)
    for phase in (0.0, 0.1, 0.2, 0.9):
        assert rotation(unit, phase, body) == pytest.approx(from_euler(-0.5 - phase, 0.0, 0.0))


def test_the_first_frame_shows_the_progress_since_the_start(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    unit = ProceduralMotionUnit(read(RISING), {}, LayerKind.GESTURE)
    body = Body(skeleton, {"r_elbow": from_euler(-0.5, 0.0, 0.0)})
    unit.start(body)
    assert rotation(unit, 0.013, body) == pytest.approx(from_euler(-0.513, 0.0, 0.0))


def test_the_root_starts_from_its_current_position(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    animation = read('<EndEffector target="root" local="true" translation="0;0-0.2;0"/>')
    unit = ProceduralMotionUnit(animation, {}, LayerKind.FULL_BODY)
    body = Body(skeleton, {}, (0.1, 0.0, 0.0))
    unit.start(body)
    roots = [unit.pose(Moment(phase, GlobalTime(0.0), body)).root for phase in (0.0, 0.25)]
    assert roots == [pytest.approx((0.1, 0.0, 0.0)), pytest.approx((0.0, -0.2, 0.0))]


def test_an_additive_animation_plays_the_file_from_the_start(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    unit = ProceduralMotionUnit(read(RISING), {}, LayerKind.ADDITIVE)
    unit.start(Body(skeleton, {"r_elbow": from_euler(-1.5, 0.0, 0.3)}))
    assert rotation(unit, 0.0, Body(skeleton)) == pytest.approx(from_euler(-0.5, 0.0, 0.0))
    assert unit.resources == frozenset()


@pytest.mark.parametrize(
    ("content", "kind", "owns"),
    [
        (RISING, LayerKind.GESTURE, {Resource.RIGHT_ARM}),
        ('<Rotation target="vl5" rotation="0;t;0"/>', LayerKind.GESTURE, set()),
        ('<Rotation target="l_knee" rotation="t;0;0"/>', LayerKind.FULL_BODY, {Resource.STANCE}),
        (
            '<Rotation target="HumanoidRoot" rotation="0;t;0"/>' + RISING,
            LayerKind.FULL_BODY,
            {Resource.STANCE, Resource.RIGHT_ARM},
        ),
        ('<EndEffector target="root" translation="0;1;0"/>', LayerKind.FULL_BODY, {Resource.STANCE}),
        ('<EndEffector target="l_ankle" translation="0;0.2;0"/>', LayerKind.FULL_BODY, {Resource.STANCE}),
    ],
)
def test_motion_of_legs_or_root_lies_below_gaze_and_gestures_and_owns_the_stance(
    read: Callable[..., ProceduralAnimation], content: str, kind: LayerKind, owns: set[str]
) -> None:
    animation = read(content)
    assert kind_of(animation) is kind
    assert ProceduralMotionUnit(animation, {}, kind).resources == owns


def test_a_parameter_change_while_playing_affects_the_motion_but_not_its_timing(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    content = (
        '<Rotation target="vc4" rotation="a*t;0;0"/><KeyPosition id="stroke" time="a/4"/><Parameter sid="a" value="1"/>'
    )
    unit = ProceduralMotionUnit(read(content, 'prefDuration="2*a"'), {}, LayerKind.ADDITIVE)
    unit.parameters = {**unit.parameters, "a": 3.0}
    assert rotation(unit, 0.5, Body(skeleton), "vc4") == pytest.approx(from_euler(1.5, 0.0, 0.0))
    assert (unit.preferred_duration, unit.key_positions["stroke"]) == (2.0, 0.25)


@pytest.mark.parametrize("times", [100.0, 101.0, -1.0, 1e9])
def test_a_stroke_repeats_at_most_a_hundred_times(read: Callable[..., ProceduralAnimation], times: float) -> None:
    animation = read(RISING + '<KeyPosition id="stroke" time="0.5/r"/><Parameter sid="r" value="1"/>')
    if times <= 100.0 and times > 0.0:
        assert "stroke:100" in ProceduralMotionUnit(animation, {"r": times}, LayerKind.ADDITIVE).key_positions
    else:
        with pytest.raises(RealizerError, match="the parameter r must be a number from 0 to 100, not"):
            ProceduralMotionUnit(animation, {"r": times}, LayerKind.ADDITIVE)


HeadMotion = Callable[..., tuple[ProceduralMotionUnit, Callable[[float], Quat]]]


@pytest.fixture
def head(animations: Path, skeleton: Skeleton) -> HeadMotion:
    def unit(name: str, **parameters: float) -> tuple[ProceduralMotionUnit, Callable[[float], Quat]]:
        motion = ProceduralMotionUnit(
            read_procedural_animation(animations / f"smartbody/{name}.xml"), parameters, LayerKind.ADDITIVE
        )
        return motion, lambda phase: shown(motion, phase, Body(skeleton))["skullbase"]

    return unit


def about(axis: int, q: Quat) -> float:
    return 2.0 * math.atan2(q[axis], q[0])


@pytest.mark.parametrize("name", ["nod", "shake"])
@pytest.mark.parametrize("repeats", [1, 2, 3])
def test_it_starts_and_ends_at_rest(head: HeadMotion, name: str, repeats: int) -> None:
    _, turn = head(name, a=1.0, r=repeats)
    step = 1e-4
    for phase, inside in ((0.0, step), (1.0, 1.0 - step)):
        assert turn(phase) == pytest.approx(IDENTITY, abs=1e-9)
        axis = 1 if name == "nod" else 2
        assert abs(about(axis, turn(inside))) / step < 0.02


@pytest.mark.parametrize(("name", "axis", "first"), [("nod", 1, 1.0), ("shake", 2, 1.0)])
@pytest.mark.parametrize("repeats", [1, 2, 3])
def test_each_stroke_is_at_a_peak_a_nod_goes_down_and_a_shake_to_the_left_first(
    head: HeadMotion,
    name: str,
    axis: int,
    first: float,
    repeats: int,
) -> None:
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
def test_the_amount_is_the_amplitude_and_may_change_while_it_plays(head: HeadMotion, name: str) -> None:
    unit, turn = head(name, a=0.5)
    stroke = unit.key_positions["stroke"]
    small = 1.0 - turn(stroke)[0]
    unit.parameters = {**unit.parameters, "a": 1.0}
    assert 1.0 - turn(stroke)[0] == pytest.approx(4.0 * small, rel=0.05)


@pytest.mark.parametrize("name", ["nod", "shake"])
def test_more_repeats_take_longer(head: HeadMotion, name: str) -> None:
    once, _ = head(name)
    thrice, _ = head(name, r=3)
    assert thrice.preferred_duration > 2.0 * once.preferred_duration


def test_an_unknown_parameter_has_no_effect(
    head: HeadMotion,
) -> None:
    unit, _ = head("nod", priority=3.0)
    assert unit.parameters == {"a": 0.5, "r": 1.0}
