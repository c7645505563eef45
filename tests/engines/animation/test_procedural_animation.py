"""ProcAnimation files: content and errors."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import IDENTITY, angle, from_axis_angle, from_euler, multiply, rotate
from reactive_realizer.embodiment.vector import Vec3, add, distance
from reactive_realizer.engines.animation.expression.compiler import compile_formulas
from reactive_realizer.engines.animation.motions.procedural import ProceduralMotionUnit
from reactive_realizer.engines.animation.procedural.effector_track import EffectorTrack
from reactive_realizer.engines.animation.procedural.procedural_animation import ProceduralAnimation
from reactive_realizer.engines.animation.procedural.procedural_animation_reader import read_procedural_animation
from reactive_realizer.errors import RealizerError

STILL = '<Rotation target="vc4" rotation="0;0;0"/>'


def test_a_rotation_is_a_formula_of_phase_and_parameters(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    animation = read('<Rotation target="vc4" rotation="a*t;0;0.1"/><Parameter sid="a" value="0.5"/>')
    assert animation.joints == {"vc4"}
    assert animation.sample(0.5, {"a": 0.8}, Body(skeleton)).rotations == {"vc4": from_euler(0.4, 0.0, 0.1)}


def test_an_undeclared_name_is_a_parameter_with_value_0(read: Callable[..., ProceduralAnimation]) -> None:
    animation = read('<Rotation target="vc4" rotation="xoff;0;0"/><KeyPosition id="stroke" time="0.5 + late"/>')
    assert animation.parameters == {"late": 0.0, "xoff": 0.0}


def test_equal_durations_are_no_limits(read: Callable[..., ProceduralAnimation]) -> None:
    assert read(STILL, 'prefDuration="2" minDuration="2" maxDuration="2.0"').timing({}).limits is None
    assert read(STILL, 'prefDuration="2"').timing({}).limits is None
    assert read(STILL, 'prefDuration="2" minDuration="1" maxDuration="3"').timing({}).limits == (1.0, 3.0)


def test_durations_and_key_positions_may_depend_on_parameters(read: Callable[..., ProceduralAnimation]) -> None:
    points = '<KeyPosition id="stroke" time="0.5/r"/><Parameter sid="r" value="1"/>'
    animation = read(STILL + points, 'prefDuration="0.5*r"')
    timing = animation.timing({"r": 4.0})
    assert timing.duration == 2.0
    assert timing.key_positions == {"stroke": 0.125}


def test_global_keyframes_turn_a_hand_in_the_figures_axes(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    palm_inward = "0.7071068;-0.7071068;0;0"
    animation = read(
        '<EndEffector target="r_wrist" local="true" translation="0;-0.23;0.21"/>'
        '<Keyframes target="r_wrist" encoding="quaternion">'
        f'<Keyframe time="0" local="false" value="{palm_inward}"/>'
        f'<Keyframe time="1" local="false" value="{palm_inward}"/></Keyframes>'
    ).fitted_to(skeleton)
    body = Body(skeleton, {"vl5": from_axis_angle((0.0, 1.0, 0.0), 0.3)})
    for phase in (0.0, 0.4, 1.0):
        hand = body.posed(animation.sample(phase, {}, body).rotations).transform("r_wrist").rotation
        # In the default pose the right palm faces the figure's left, fingers down.
        assert rotate(hand, (1.0, 0.0, 0.0)) == pytest.approx((1.0, 0.0, 0.0), abs=1e-6)
        assert rotate(hand, (0.0, -1.0, 0.0)) == pytest.approx((0.0, 0.0, 1.0), abs=1e-6)


@pytest.mark.parametrize(
    ("encoding", "value"),
    [
        ("quaternion", "0.8775826; 0.4794255*t; 0; 0"),
        ("axisangles", "2; 0; 0; t"),
        ("euler", "t; 0; 0"),
    ],
)
def test_keyframes_are_quaternions_or_turns_about_axes_or_angles(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton, encoding: str, value: str
) -> None:
    keyframe = f'<Keyframe time="0" value="{value}"/>'
    animation = read(f'<Keyframes target="vc4" encoding="{encoding}">{keyframe}</Keyframes>')
    rotation = animation.sample(1.0, {}, Body(skeleton)).rotations["vc4"]
    assert rotation == pytest.approx(from_axis_angle((1.0, 0.0, 0.0), 1.0), abs=1e-6)


@pytest.mark.parametrize("encoding", ["quaternion", "axisangles", "euler"])
def test_mirroring_works_for_every_encoding_of_keyframes(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton, encoding: str
) -> None:
    value = {"quaternion": "0.8;0.4;0.3;0.2", "axisangles": "1;2;3;0.7", "euler": "0.4;0.3;0.2"}[encoding]
    frames = f'<Keyframes target="l_wrist" encoding="{encoding}"><Keyframe time="0" value="{value}"/></Keyframes>'
    animation = read(frames)
    w, x, y, z = animation.sample(0.0, {}, Body(skeleton)).rotations["l_wrist"]
    mirrored = animation.mirrored().sample(0.0, {}, Body(skeleton)).rotations["r_wrist"]
    assert mirrored == pytest.approx((w, x, -y, -z))


def test_a_rotation_that_is_not_local_is_in_the_figures_axes(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    animation = read('<Rotation target="skullbase" local="false" rotation="0;0.4;0"/>')
    body = Body(skeleton, {"vl5": from_euler(0.3, 0.2, 0.1)})
    head = body.posed(animation.sample(0.0, {}, body).rotations).transform("skullbase").rotation
    assert head == pytest.approx(from_euler(0.0, 0.4, 0.0))


def test_a_global_rotation_of_the_root_is_its_local_rotation(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    for local in ("true", "false"):
        animation = read(f'<Rotation target="HumanoidRoot" local="{local}" rotation="0;0.4;0"/>')
        rotations = animation.sample(0.0, {}, Body(skeleton)).rotations
        assert rotations == {"HumanoidRoot": pytest.approx(from_euler(0.0, 0.4, 0.0))}


def test_an_interpolator_is_stretched_to_the_duration_of_the_animation(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    animation = read(
        '<SkeletonInterpolator rotationEncoding="axisangles" encoding="R" parts="l_thumb1 vc4">'
        "2 1 0 0 0.2 0 1 0 0\n 6 1 0 0 0.6 0 1 0 0.8</SkeletonInterpolator>"
    )
    turned = animation.sample(0.25, {}, Body(skeleton)).rotations
    assert turned["l_thumb1"] == pytest.approx(from_axis_angle((1.0, 0.0, 0.0), 0.3))
    assert turned["vc4"] == pytest.approx(from_axis_angle((0.0, 1.0, 0.0), 0.2))
    mirrored = animation.mirrored().sample(0.25, {}, Body(skeleton)).rotations
    assert mirrored["r_thumb1"] == pytest.approx(turned["l_thumb1"])
    assert mirrored["vc4"] == pytest.approx(from_axis_angle((0.0, 1.0, 0.0), -0.2))
    assert animation.restricted_to(frozenset({"vc4"})).sample(0.25, {}, Body(skeleton)).rotations == {
        "vc4": turned["vc4"]
    }


def test_joints_are_turned_from_the_root_outward_in_any_order_of_the_file(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    hand = '<Rotation target="l_index1" local="false" rotation="0;0;0"/>'
    trunk = '<Keyframes target="vl5" encoding="euler"><Keyframe time="0" value="0.2;0.3;0.1"/></Keyframes>'
    arm = '<EndEffector target="l_wrist" translation="0.2;1.2;0.3"/>'
    animation = read(hand + arm + trunk).fitted_to(skeleton)
    body = Body(skeleton)
    moved = body.posed(animation.sample(0.0, {}, body).rotations)
    assert moved.transform("l_index1").rotation == pytest.approx(IDENTITY, abs=1e-9)
    assert moved.transform("l_wrist").position == pytest.approx((0.2, 1.2, 0.3), abs=1e-6)


def test_joints_that_a_figure_lacks_are_left_out_and_logged_once(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton, caplog: pytest.LogCaptureFixture
) -> None:
    animation = read('<Rotation target="tail" rotation="1;0;0"/><Rotation target="vc4" rotation="t;0;0"/>')
    with caplog.at_level("WARNING"):
        fitted = animation.fitted_to(skeleton)
        assert fitted.lacking == {"tail"}
        for phase in (0.0, 0.5, 1.0):
            assert fitted.sample(phase, {}, Body(skeleton)).rotations == {"vc4": from_euler(phase, 0.0, 0.0)}
    assert [record.message for record in caplog.records] == ["some.xml: this figure cannot turn tail; left out"]


def test_vertebrae_turn_for_those_that_a_figure_lacks(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    parts = {"vl1": "0;0.1;0", "vl5": "0.2*t;0;0", "vl3": "0;0;0.3*a", "vc2": "0;0.4;0", "vt1": "0.1;0;0"}
    animation = read(
        "".join(f'<Rotation target="{joint}" rotation="{turn}"/>' for joint, turn in parts.items())
        + '<Parameter sid="a" value="0.5"/>'
    )
    posed = animation.fitted_to(skeleton).sample(0.5, {"a": 0.5}, Body(skeleton)).rotations
    assert set(posed) == {"vl5", "vt6", "vc4"}
    lumbar = multiply(multiply(from_euler(0.1, 0.0, 0.0), from_euler(0.0, 0.0, 0.15)), from_euler(0.0, 0.1, 0.0))
    assert posed["vl5"] == pytest.approx(lumbar)
    assert posed["vc4"] == pytest.approx(from_euler(0.0, 0.4, 0.0))
    assert posed["vt6"] == pytest.approx(from_euler(0.1, 0.0, 0.0))


def test_a_limb_with_a_bone_without_a_length_is_left_out(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    offsets = [
        (0.0, 0.0, 0.0) if joint == "l_wrist" else offset
        for joint, offset in zip(skeleton.joints, skeleton.offsets, strict=True)
    ]
    stump = replace(skeleton, offsets=tuple(offsets))
    both = "".join(f'<EndEffector target="{side}_wrist" translation="0;1;0.2"/>' for side in "lr")
    assert read(both).fitted_to(stump).joints == {"r_shoulder", "r_elbow"}


def test_an_animation_is_restricted_to_joints_after_mirroring(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    arm = (
        '<EndEffector target="r_wrist" local="true" translation="-0.1;0;0.2"/><Rotation target="vc4" rotation="1;0;0"/>'
    )
    mirrored = read(arm + '<Rotation target="r_thumb1" rotation="0;0.1;0"/>').mirrored()
    assert mirrored.restricted_to(frozenset({"l_thumb1", "r_shoulder"})).joints == {"l_thumb1"}
    assert mirrored.restricted_to(frozenset({"l_elbow"})).joints == {"l_shoulder", "l_elbow"}
    with pytest.raises(
        RealizerError, match=r"turns none of l_hip, r_thumb1; it turns l_elbow, l_shoulder, l_thumb1, vc4"
    ):
        mirrored.restricted_to(frozenset({"r_thumb1", "l_hip"}))


def test_between_keyframes_a_joint_turns_evenly_the_short_way(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    animation = read(
        '<Keyframes target="vc4" encoding="quaternion"><Keyframe time="0.2" local="true" value="1;0;0;0"/>'
        f'<Keyframe time="0.7" local="true" value="{math.cos(0.3)};{math.sin(0.3)};0;0"/></Keyframes>'
    )
    turns = [
        angle(animation.sample(phase, {}, Body(skeleton)).rotations["vc4"]) for phase in (0.0, 0.2, 0.45, 0.7, 1.0)
    ]
    assert turns == pytest.approx([0.0, 0.0, 0.3, 0.6, 0.6], abs=1e-6)


def test_a_mirrored_animation_exchanges_the_arms(skeleton: Skeleton, animations: Path) -> None:
    animation = read_procedural_animation(animations / "greet_right.xml")
    mirrored = animation.mirrored()
    assert mirrored.joints == {joint.replace("r_", "l_", 1) for joint in animation.joints}
    for phase in (0.0, 0.3, 0.8):
        right, left = (each.sample(phase, {}, Body(skeleton)).rotations for each in (animation, mirrored))
        for joint, (w, x, y, z) in right.items():
            assert left[joint.replace("r_", "l_", 1)] == pytest.approx((w, x, -y, -z), abs=0.02)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (
            '<Rotation target="vc4" rotation="0;sin(;0"/>',
            r"line 2, <Rotation>: rotation: it ends unexpectedly at character 5",
        ),
        ('<Rotation target="vc4" rotation="0;0"/>', r"line 2, <Rotation>: rotation needs 3 formulas .* not 2"),
        ('<Rotation rotation="0;0;0"/>', r"line 2, <Rotation>: the attribute target is missing"),
        ('\n<Parameter sid="a" value="much"/>', r"line 3, <Parameter>: value='much' is not a number"),
        ('<Parameter sid="a" value="nan"/>', r"<Parameter>: value='nan' is not a number"),
        ('<Parameter sid="t" value="1"/>', r"a parameter may not be called t"),
        (
            '<Rotation target="vc4" rotation="0;0;0"/>'
            + "".join(f'<Parameter sid="p{n}" value="1"/>' for n in range(1001)),
            r"line 1, <ProcAnimation>: more than 1000 parameters in one file",
        ),
        ('<KeyPosition id="a:b" time="0"/>', r"line 2, <KeyPosition>: id='a:b' cannot name a sync point"),
        (
            '<KeyPosition id="stroke" time="0"/>\n<KeyPosition id="stroke" time="1"/>',
            r"line 3, <KeyPosition>: a second KeyPosition with id='stroke'",
        ),
        ('<Parameter sid="a" value="1"/>', r"line 1, <ProcAnimation>: it has no tracks"),
        ('<KeyPosition id="stroke" time="t"/>', r"a duration or key time depends on t"),
        (
            '<Keyframes target="vc4" encoding="polar"/>',
            r"<Keyframes>: encoding='polar': known are quaternion, axisangles, euler",
        ),
        (
            '<Keyframes target="vc4" encoding="euler"><Keyframe time="0" value="1;0;0;0"/></Keyframes>',
            r"<Keyframe>: value needs 3 formulas .* not 4",
        ),
        (
            '<EndEffector target="l_elbow" translation="0;0;0"/>',
            r"<EndEffector>: no end effector 'l_elbow'; known are l_wrist, r_wrist, l_ankle, r_ankle, root, Humanoid",
        ),
        ('<Rotation target="vc4" local="maybe" rotation="0;0;0"/>', r"<Rotation>: local='maybe' must be true or "),
        ('<Rotashun target="vc4"/>', r"line 2, <Rotashun>: known are SkeletonInterpolator, Rotation"),
        (
            '<SkeletonInterpolator parts="vc4" encoding="T1R">0 0 0 0 1 0 0 0 1 0 0 0 1 0 0 0</SkeletonInterpolator>',
            r"only R",
        ),
        ('<Keyframes target="vc4" encoding="quaternion"/>', r"<Keyframes>: no Keyframe inside"),
        ("<Rotation", r"some\.xml, line \d, <ProcAnimation>: "),
    ],
)
def test_an_invalid_file_is_refused_with_file_line_element_and_reason(
    read: Callable[..., ProceduralAnimation], content: str, message: str
) -> None:
    with pytest.raises(RealizerError, match=message) as with_reached_root:
        read(content)
    assert with_reached_root.value.fault.code == "bad-asset"
    assert "some.xml" in str(with_reached_root.value)


def test_no_shortest_duration_is_longer_than_the_longest(read: Callable[..., ProceduralAnimation]) -> None:
    with pytest.raises(
        RealizerError, match=r"some\.xml, line 1, <ProcAnimation>: it lasts at least 3 s and at most 2 s"
    ):
        read(STILL, 'prefDuration="2" minDuration="2+1" maxDuration="2"')
    assert read(STILL, 'prefDuration="2" minDuration="2" maxDuration="2*a"').joints == {"vc4"}


@pytest.mark.parametrize("head", ['<!DOCTYPE x [<!ENTITY a "b">]><ProcAnimation/>', "<gesturebinding/>", "", "junk"])
def test_a_file_that_is_no_animation_is_refused(tmp_path: Path, head: str) -> None:
    path = tmp_path / "some.xml"
    path.write_text(head)
    with pytest.raises(RealizerError, match=r"some\.xml, line"):
        read_procedural_animation(path)


@pytest.mark.parametrize("formula", ["1/(t-0.5)", "log(t-1)", "exp(2000*t)", "1e308*10*t"])
def test_a_formula_without_a_value_is_reported_with_its_phase(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton, formula: str
) -> None:
    animation = read(f'<Rotation target="vc4" rotation="{formula};0;0"/>')
    with pytest.raises(RealizerError, match=r"some\.xml gives no pose at phase 0\.5"):
        animation.sample(0.5, {}, Body(skeleton))


@pytest.mark.parametrize("value", ["t;0;0;0", "1e200;0;1e200;0"])
def test_a_keyframe_that_is_not_a_rotation_is_reported(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton, value: str
) -> None:
    keyframe = f'<Keyframe time="0" local="true" value="{value}"/>'
    animation = read(f'<Keyframes target="vc4" encoding="quaternion">{keyframe}</Keyframes>')
    with pytest.raises(RealizerError, match=r"gives no pose at phase 0: the rotation of vc4 is undefined"):
        animation.sample(0.0, {}, Body(skeleton))


@pytest.mark.parametrize(
    ("content", "durations"),
    [
        ("", 'prefDuration="r"'),
        ('<KeyPosition id="stroke" time="1.5"/>', 'prefDuration="1"'),
        ('<KeyPosition id="start" time="0.5"/>', 'prefDuration="1"'),
        ('<KeyPosition id="end" time="0.5"/>', 'prefDuration="1"'),
        ("", 'prefDuration="1" minDuration="2" maxDuration="1+a"'),
    ],
)
def test_a_motion_without_a_duration_or_with_points_outside_cannot_be_planned(
    read: Callable[..., ProceduralAnimation], content: str, durations: str
) -> None:
    reasons = r"it would last 0 s|key positions lie from 0 to 1, start at 0 and end at 1|at least 2 s and at most 1 s"
    with pytest.raises(RealizerError, match=reasons):
        ProceduralMotionUnit(read(STILL + content, durations), {}, LayerKind.ADDITIVE)


def test_files_may_contain_start_and_end(read: Callable[..., ProceduralAnimation]) -> None:
    points = '<KeyPosition id="start" time="0"/><KeyPosition id="stroke" time="0.5"/><KeyPosition id="end" time="1"/>'
    motion = ProceduralMotionUnit(read(STILL + points), {}, LayerKind.ADDITIVE)
    assert motion.key_positions == {"start": 0.0, "stroke": 0.5, "end": 1.0}


def test_formulas_win_over_keyframes_and_keyframes_over_interpolators(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    clip = '<SkeletonInterpolator encoding="R" parts="vc4">0 0.8 0.6 0 0 1 0.8 0.6 0 0</SkeletonInterpolator>'
    keyed = '<Keyframes target="vc4" encoding="euler"><Keyframe time="0" value="0.2;0;0"/></Keyframes>'
    turned = '<Rotation target="vc4" rotation="0.1;0;0"/>'
    for content, expected in ((turned + keyed + clip, 0.1), (keyed + clip, 0.2), (clip, 2 * math.asin(0.6))):
        rotations = read(content).fitted_to(skeleton).sample(0.0, {}, Body(skeleton)).rotations
        assert rotations == {"vc4": pytest.approx(from_euler(expected, 0.0, 0.0))}


def test_tracks_of_joints_that_an_end_effector_controls_are_left_out_and_logged(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton, caplog: pytest.LogCaptureFixture
) -> None:
    arm = '<EndEffector target="l_wrist" local="true" translation="0;-0.2;0.25"/>'
    with caplog.at_level("INFO"):
        animation = read(arm + '<Rotation target="l_elbow" rotation="1;0;0"/>')
    assert [record.message for record in caplog.records] == [
        "l_elbow is controlled by an EndEffector; its other tracks are ignored"
    ]
    assert animation.sample(0.0, {}, Body(skeleton)) == read(arm).sample(0.0, {}, Body(skeleton))


def look_through(path: Path, skeleton: Skeleton) -> None:
    """Check that an animation has a pose at every phase, reaches its goals, and reports no fault."""
    animation = read_procedural_animation(path).fitted_to(skeleton)
    unit = ProceduralMotionUnit(animation, {}, LayerKind.ADDITIVE)
    assert unit.preferred_duration > 0.0
    effectors = [track for track in animation.tracks if isinstance(track, EffectorTrack)]
    names = (ProceduralAnimation.TIME, *unit.parameters)
    paths = [(track, compile_formulas(track.formulas, names)) for track in effectors]
    for phase in (step / 50 for step in range(51)):
        posed = animation.sample(phase, unit.parameters, Body(skeleton))
        rotations = posed.rotations
        assert posed.fault is None
        assert rotations.keys() == unit.joints
        assert all(math.isclose(math.hypot(*rotation), 1.0, abs_tol=1e-6) for rotation in rotations.values())
        for track, formulas in paths:
            x, y, z, _ = formulas(phase, *unit.parameters.values())
            assert missed(track, (x, y, z), Body(skeleton, rotations)) < 0.01


def missed(track: EffectorTrack, goal: Vec3, body: Body) -> float:
    """The distance of the end of a limb from its goal, m; 0 for goals out of reach."""
    first, _, end = (body.transform(joint).position for joint in track.chain)
    if track.local:
        goal = add(first, rotate(body.transform(str(body.skeleton.parent(track.chain[0]))).rotation, goal))
    reach = track.limb.of(body.skeleton, track.side).reach
    return distance(goal, end) if 0.6 * reach < distance(first, goal) < reach else 0.0


def test_every_animation_in_the_style_of_published_ones_has_a_pose_at_every_phase_and_reaches_its_goals(
    tests_data: Path, skeleton: Skeleton
) -> None:
    files = sorted((tests_data / "procanimation").glob("*.xml"))
    assert len(files) == 6
    for path in files:
        look_through(path, skeleton)


def test_every_published_animation_has_a_pose_at_every_phase_and_reaches_its_goals(
    shared_cases: Path, skeleton: Skeleton
) -> None:
    files = sorted((shared_cases / "asap" / "procanimation").rglob("*.xml"))
    assert len(files) == 11
    for path in files:
        look_through(path, skeleton)


def test_every_animation_of_the_package_has_a_pose_at_every_phase_and_reaches_its_goals(
    animations: Path, skeleton: Skeleton
) -> None:
    files = sorted(animations.rglob("*.xml"))
    assert len(files) == 54
    for path in files:
        look_through(path, skeleton)
