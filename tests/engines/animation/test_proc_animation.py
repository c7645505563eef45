"""ProcAnimation files: what they say, and what is wrong with them."""

import math

import pytest

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import IDENTITY, angle, from_axis_angle, from_euler, rotate
from reactive_realizer.embodiment.vector import subtract
from reactive_realizer.engines.animation.procedural.proc_animation import ProcAnimation
from reactive_realizer.engines.animation.procedural.proc_animation_reader import read_proc_animation
from reactive_realizer.engines.animation.procedural.proc_motion_unit import ProcMotionUnit
from reactive_realizer.errors import RealizerError

from .showing import shown


@pytest.fixture
def read(tmp_path):
    def read_text(content: str, durations: str = 'prefDuration="1"') -> ProcAnimation:
        path = tmp_path / "some.xml"
        path.write_text(f"<ProcAnimation {durations}>\n{content}\n</ProcAnimation>")
        return read_proc_animation(path)

    return read_text


def test_a_rotation_is_a_formula_of_phase_and_parameters(read, skeleton):
    animation = read('<Rotation target="vc4" rotation="a*t;0;0.1"/><Parameter sid="a" value="0.5"/>')
    assert animation.joints == {"vc4"}
    assert animation.sample(0.5, {"a": 0.8}, Body(skeleton)) == {"vc4": from_euler(0.4, 0.0, 0.1)}


def test_a_name_that_nobody_declares_is_a_parameter_of_value_0(read):
    animation = read('<Rotation target="vc4" rotation="xoff;0;0"/><KeyPosition id="stroke" time="0.5 + late"/>')
    assert animation.parameters == {"late": 0.0, "xoff": 0.0}


def test_equal_durations_mean_that_nobody_wrote_limits(read):
    assert read("", 'prefDuration="2" minDuration="2" maxDuration="2.0"').timing({}).limits is None
    assert read("", 'prefDuration="2"').timing({}).limits is None
    assert read("", 'prefDuration="2" minDuration="1" maxDuration="3"').timing({}).limits == (1.0, 3.0)


def test_durations_and_key_positions_may_depend_on_parameters(read):
    animation = read('<KeyPosition id="stroke" time="0.5/r"/><Parameter sid="r" value="1"/>', 'prefDuration="0.5*r"')
    timing = animation.timing({"r": 4.0})
    assert timing.duration == 2.0
    assert timing.key_positions == {"stroke": 0.125}


@pytest.mark.parametrize("side", ["l", "r"])
def test_a_local_end_effector_brings_the_wrist_to_a_place_from_the_shoulder_that_leans_with_the_trunk(
    read, skeleton, side
):
    animation = read(f'<EndEffector target="{side}_wrist" local="true" translation="0.05;-0.2;0.25" swivel="0.3"/>')
    for lean in (IDENTITY, from_axis_angle((1.0, 0.0, 0.0), 0.4)):
        body = Body(skeleton, {"vl5": lean})
        moved = body.posed(animation.sample(0.0, {}, body))
        way = subtract(moved.place(f"{side}_wrist").position, moved.place(f"{side}_shoulder").position)
        assert way == pytest.approx(rotate(lean, (0.05, -0.2, 0.25)), abs=1e-6)


@pytest.mark.parametrize("side", ["l", "r"])
def test_an_end_effector_that_is_not_local_brings_the_wrist_to_a_place_above_the_ground(read, skeleton, side):
    x = 0.15 if side == "l" else -0.15
    animation = read(f'<EndEffector target="{side}_wrist" local="false" translation="{x};1.15;0.3"/>')
    body = Body(skeleton, {"vl5": from_axis_angle((0.0, 1.0, 0.0), 0.2)})
    moved = body.posed(animation.sample(0.0, {}, body))
    assert moved.place(f"{side}_wrist").position == pytest.approx((x, 1.15, 0.3), abs=1e-6)


def test_keyframes_turn_a_hand_in_the_figures_axes_wherever_the_arm_is(read, skeleton):
    palm_to_the_front = "0;0.7071068;0;0.7071068"
    animation = read(
        '<EndEffector target="r_wrist" local="true" translation="-0.2;0.1;0.2"/>'
        '<Keyframes target="r_wrist" encoding="quaternion">'
        f'<Keyframe time="0" local="false" value="{palm_to_the_front}"/>'
        f'<Keyframe time="1" local="false" value="{palm_to_the_front}"/></Keyframes>'
    )
    body = Body(skeleton, {"vl5": from_axis_angle((0.0, 1.0, 0.0), 0.3)})
    for phase in (0.0, 0.4, 1.0):
        hand = body.posed(animation.sample(phase, {}, body)).place("r_wrist").rotation
        # In the default pose the right palm faces the figure's left, fingers down.
        assert rotate(hand, (1.0, 0.0, 0.0)) == pytest.approx((0.0, 0.0, 1.0), abs=1e-6)
        assert rotate(hand, (0.0, -1.0, 0.0)) == pytest.approx((0.0, 1.0, 0.0), abs=1e-6)


def test_between_keyframes_a_joint_turns_evenly_the_short_way(read, skeleton):
    animation = read(
        '<Keyframes target="vc4" encoding="quaternion"><Keyframe time="0.2" local="true" value="1;0;0;0"/>'
        f'<Keyframe time="0.7" local="true" value="{math.cos(0.3)};{math.sin(0.3)};0;0"/></Keyframes>'
    )
    turns = [angle(animation.sample(phase, {}, Body(skeleton))["vc4"]) for phase in (0.0, 0.2, 0.45, 0.7, 1.0)]
    assert turns == pytest.approx([0.0, 0.0, 0.3, 0.6, 0.6], abs=1e-6)


def test_the_forearm_makes_half_of_the_wrists_twist_and_the_hand_stays_as_it_is(read, skeleton):
    arm = '<EndEffector target="l_wrist" local="true" translation="0;-0.2;0.25"/>'
    plain, twisted = (
        read(arm + f'<Rotation target="l_wrist" rotation="0;{twist};0"/>').sample(0.0, {}, Body(skeleton))
        for twist in (0.0, 1.2)
    )
    assert angle(twisted["l_wrist"]) == pytest.approx(0.6, abs=1e-6)
    before, after = (Body(skeleton, pose).place("l_wrist") for pose in (plain, twisted))
    assert before.position == pytest.approx(after.position, abs=1e-9)
    assert rotate(before.rotation, rotate(from_euler(0.0, 1.2, 0.0), (1.0, 0.0, 0.0))) == pytest.approx(
        rotate(after.rotation, (1.0, 0.0, 0.0)), abs=1e-6
    )


def test_in_the_mirror_the_left_arm_does_what_the_right_arm_did(skeleton, animations):
    animation = read_proc_animation(animations / "greet_right.xml")
    mirrored = animation.mirrored()
    assert mirrored.joints == {joint.replace("r_", "l_", 1) for joint in animation.joints}
    for phase in (0.0, 0.3, 0.8):
        right, left = animation.sample(phase, {}, Body(skeleton)), mirrored.sample(phase, {}, Body(skeleton))
        for joint, (w, x, y, z) in right.items():
            assert left[joint.replace("r_", "l_", 1)] == pytest.approx((w, x, -y, -z), abs=0.02)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (
            '<Rotation target="vc4" rotation="0;sin(;0"/>',
            r"line 2, <Rotation>: rotation: it ends too early at character 5",
        ),
        ('<Rotation target="vc4" rotation="0;0"/>', r"line 2, <Rotation>: rotation needs 3 formulas .* not 2"),
        ('<Rotation rotation="0;0;0"/>', r"line 2, <Rotation>: the attribute target is missing"),
        ('\n<Parameter sid="a" value="much"/>', r"line 3, <Parameter>: value='much' is no number"),
        ('<Parameter sid="a" value="nan"/>', r"<Parameter>: value='nan' is no number"),
        ('<Parameter sid="t" value="1"/>', r"a parameter may not be called t"),
        ('<KeyPosition id="stroke" time="t"/>', r"a duration or key time depends on t"),
        ('<Keyframes target="vc4" encoding="euler"/>', r"<Keyframes>: keyframes are read only with encoding"),
        ('<Keyframes target="vc4" encoding="quaternion"/>', r"<Keyframes>: no Keyframe inside"),
        ("<Rotation", r"some\.xml, line \d, <ProcAnimation>: "),
    ],
)
def test_a_wrong_file_is_refused_by_file_line_element_and_reason(read, content, message):
    with pytest.raises(RealizerError, match=message) as caught:
        read(content)
    assert caught.value.fault.code == "bad-asset"
    assert "some.xml" in str(caught.value)


@pytest.mark.parametrize("head", ['<!DOCTYPE x [<!ENTITY a "b">]><ProcAnimation/>', "<gesturebinding/>", "", "junk"])
def test_a_file_that_is_no_animation_is_refused(tmp_path, head):
    path = tmp_path / "some.xml"
    path.write_text(head)
    with pytest.raises(RealizerError, match=r"some\.xml, line"):
        read_proc_animation(path)


@pytest.mark.parametrize("formula", ["1/(t-0.5)", "log(t-1)", "exp(2000*t)", "1e308*10*t"])
def test_where_a_formula_has_no_value_there_is_no_motion_and_the_phase_is_named(read, skeleton, formula):
    animation = read(f'<Rotation target="vc4" rotation="{formula};0;0"/>')
    with pytest.raises(RealizerError, match=r"some\.xml gives no pose at phase 0\.5"):
        animation.sample(0.5, {}, Body(skeleton))


def test_a_keyframe_that_is_no_rotation_is_no_motion(read, skeleton):
    keyframe = '<Keyframe time="0" local="true" value="t;0;0;0"/>'
    animation = read(f'<Keyframes target="vc4" encoding="quaternion">{keyframe}</Keyframes>')
    with pytest.raises(RealizerError, match="a keyframe of length 0"):
        animation.sample(0.0, {}, Body(skeleton))


@pytest.mark.parametrize(
    ("content", "durations"),
    [("", 'prefDuration="r"'), ('<KeyPosition id="stroke" time="1.5"/>', 'prefDuration="1"')],
)
def test_a_motion_of_no_duration_or_with_points_outside_it_cannot_be_planned(read, content, durations):
    with pytest.raises(RealizerError, match="gives no pose"):
        ProcMotionUnit(read(content, durations), {}, LayerKind.ADDITIVE)


def test_what_is_not_realized_is_left_out_and_noted(read, caplog):
    with caplog.at_level("INFO"):
        animation = read('<SkeletonInterpolator parts="x"/><EndEffector target="root" translation="0;0;0"/>')
    assert animation.joints == frozenset()
    assert [record.message for record in caplog.records] == [
        "some.xml, line 2: <SkeletonInterpolator > is not realized",
        "some.xml, line 2: <EndEffector root> is not realized",
    ]


def test_every_animation_of_the_peer_is_read_and_has_a_pose_at_every_phase(shared_cases, skeleton):
    files = sorted((shared_cases / "asap" / "procanimation").rglob("*.xml"))
    assert len(files) == 11
    for path in files:
        unit = ProcMotionUnit(read_proc_animation(path), {}, LayerKind.ADDITIVE)
        assert unit.preferred_duration > 0.0
        for step in range(51):
            rotations = shown(unit, step / 50, Body(skeleton))
            assert rotations.keys() == unit.joints


def test_every_animation_of_ours_is_read_and_has_a_pose_at_every_phase(animations, skeleton):
    for path in animations.glob("*.xml"):
        unit = ProcMotionUnit(read_proc_animation(path), {}, LayerKind.ADDITIVE)
        for step in range(51):
            assert shown(unit, step / 50, Body(skeleton)).keys() == unit.joints
