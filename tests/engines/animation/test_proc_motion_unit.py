"""A procedural animation as it is played: where it begins, where it lies, what it owns."""

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import angle, difference, from_euler
from reactive_realizer.engines.animation.motion_unit import Moment, Resource
from reactive_realizer.engines.animation.procedural.proc_motion_unit import ProcMotionUnit, kind_of
from reactive_realizer.errors import RealizerError

RISING = '<Rotation target="r_elbow" rotation="0-0.5-t;0;0"/>'


def rotation(unit, phase, body, joint="r_elbow"):
    posed = unit.pose(Moment(phase, GlobalTime(0.0), body))
    assert posed.weight == 1.0
    return posed.rotations[joint]


def gap(a, b):
    return angle(difference(a, b))


@pytest.mark.parametrize(("duration", "arrived"), [(3.0, 0.1), (0.4, 0.25)])
def test_it_begins_where_the_body_is_and_soon_plays_as_the_file_says(read, skeleton, duration, arrived):
    unit = ProcMotionUnit(read(RISING, f'prefDuration="{duration}"'), {}, LayerKind.GESTURE)
    body = Body(skeleton, {"r_elbow": from_euler(-1.5, 0.0, 0.3)})
    unit.start(body)
    assert rotation(unit, 0.0, body) == pytest.approx(body.rotation("r_elbow"))
    lacks = [
        gap(rotation(unit, arrived * i / 20, body), from_euler(-0.5 - arrived * i / 20, 0.0, 0.0)) for i in range(21)
    ]
    assert lacks == sorted(lacks, reverse=True)
    assert lacks[-1] == pytest.approx(0.0, abs=1e-6)
    for phase in (arrived, 0.6, 1.0):
        assert rotation(unit, phase, body) == pytest.approx(from_euler(-0.5 - phase, 0.0, 0.0))


def test_what_begins_where_the_body_is_plays_as_the_file_says_from_the_first_frame(read, skeleton):
    unit = ProcMotionUnit(read(RISING), {}, LayerKind.GESTURE)
    body = Body(skeleton, {"r_elbow": from_euler(-0.5, 0.0, 0.0)})
    unit.start(body)
    for phase in (0.0, 0.1, 0.2, 0.9):
        assert rotation(unit, phase, body) == pytest.approx(from_euler(-0.5 - phase, 0.0, 0.0))


def test_at_its_first_frame_it_is_as_far_as_the_time_since_its_start(read, skeleton):
    unit = ProcMotionUnit(read(RISING), {}, LayerKind.GESTURE)
    body = Body(skeleton, {"r_elbow": from_euler(-0.5, 0.0, 0.0)})
    unit.start(body)
    assert rotation(unit, 0.013, body) == pytest.approx(from_euler(-0.513, 0.0, 0.0))


def test_one_that_joins_late_sets_out_from_where_the_body_is_too(read, skeleton):
    unit = ProcMotionUnit(read(RISING), {}, LayerKind.GESTURE)
    body = Body(skeleton, {"r_elbow": from_euler(0.0, 0.0, 0.0)})
    unit.start(body)
    assert rotation(unit, 0.5, body) == pytest.approx(body.rotation("r_elbow"))
    assert rotation(unit, 0.75, body) == pytest.approx(from_euler(-1.25, 0.0, 0.0))


def test_a_root_that_is_moved_sets_out_from_where_it_is(read, skeleton):
    animation = read('<EndEffector target="root" local="true" translation="0;0-0.2;0"/>')
    unit = ProcMotionUnit(animation, {}, LayerKind.FULL_BODY)
    body = Body(skeleton, {}, (0.1, 0.0, 0.0))
    unit.start(body)
    roots = [unit.pose(Moment(phase, GlobalTime(0.0), body)).root for phase in (0.0, 0.25)]
    assert roots == [pytest.approx((0.1, 0.0, 0.0)), pytest.approx((0.0, -0.2, 0.0))]


def test_what_is_added_begins_as_the_file_says(read, skeleton):
    unit = ProcMotionUnit(read(RISING), {}, LayerKind.ADDITIVE)
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
def test_what_moves_legs_or_the_root_lies_below_gaze_and_gestures_and_owns_the_stance(read, content, kind, owns):
    animation = read(content)
    assert kind_of(animation) is kind
    assert ProcMotionUnit(animation, {}, kind).resources == owns


def test_a_parameter_that_changes_while_it_plays_changes_the_motion_and_not_its_timing(read, skeleton):
    content = (
        '<Rotation target="vc4" rotation="a*t;0;0"/><KeyPosition id="stroke" time="a/4"/><Parameter sid="a" value="1"/>'
    )
    unit = ProcMotionUnit(read(content, 'prefDuration="2*a"'), {}, LayerKind.ADDITIVE)
    unit.parameters["a"] = 3.0
    assert rotation(unit, 0.5, Body(skeleton), "vc4") == pytest.approx(from_euler(1.5, 0.0, 0.0))
    assert (unit.preferred_duration, unit.key_positions["stroke"]) == (2.0, 0.25)


@pytest.mark.parametrize("times", [100.0, 101.0, -1.0, 1e9])
def test_nothing_repeats_its_stroke_more_than_a_hundred_times(read, times):
    animation = read(RISING + '<KeyPosition id="stroke" time="0.5/r"/><Parameter sid="r" value="1"/>')
    if times <= 100.0 and times > 0.0:
        assert "stroke:100" in ProcMotionUnit(animation, {"r": times}, LayerKind.ADDITIVE).key_positions
    else:
        with pytest.raises(RealizerError, match="the parameter r is a number from 0 to 100, which"):
            ProcMotionUnit(animation, {"r": times}, LayerKind.ADDITIVE)
