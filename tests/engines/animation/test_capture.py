"""Motion captures in BVH, and how our figures do what the captured ones did."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import Quat, from_axis_angle, multiply, rotate
from reactive_realizer.embodiment.vector import UP, Vec3, subtract, unit
from reactive_realizer.engines.animation.keyframe.capture_reader import read_capture
from reactive_realizer.engines.animation.keyframe.clip import Clip
from reactive_realizer.engines.animation.keyframe.clip_cache import clip_in
from reactive_realizer.engines.animation.keyframe.keyframe_motion_unit import KeyframeMotionUnit
from reactive_realizer.engines.animation.keyframe.retarget import retargeted
from reactive_realizer.engines.animation.motion_unit import Moment
from reactive_realizer.errors import RealizerError

from .conftest import ASSETS

Bones = tuple[tuple[str, str | None, Vec3], ...]

T_POSE: Bones = (
    ("Hips", None, (0.0, 98.0, 0.0)),
    ("Spine", "Hips", (0.0, 12.0, 0.0)),
    ("Spine1", "Spine", (0.0, 14.0, 0.0)),
    ("Neck", "Spine1", (0.0, 24.0, 0.0)),
    ("Head", "Neck", (0.0, 10.0, 1.0)),
    ("LeftShoulder", "Spine1", (4.0, 20.0, 0.0)),
    ("LeftArm", "LeftShoulder", (14.0, 0.0, 0.0)),
    ("LeftForeArm", "LeftArm", (29.0, 0.0, 0.0)),
    ("LeftHand", "LeftForeArm", (26.0, 0.0, 0.0)),
    ("RightShoulder", "Spine1", (-4.0, 20.0, 0.0)),
    ("RightArm", "RightShoulder", (-14.0, 0.0, 0.0)),
    ("RightForeArm", "RightArm", (-29.0, 0.0, 0.0)),
    ("RightHand", "RightForeArm", (-26.0, 0.0, 0.0)),
    ("LeftUpLeg", "Hips", (9.0, -4.0, 0.0)),
    ("LeftLeg", "LeftUpLeg", (0.0, -44.0, 0.0)),
    ("LeftFoot", "LeftLeg", (0.0, -42.0, -2.0)),
    ("RightUpLeg", "Hips", (-9.0, -4.0, 0.0)),
    ("RightLeg", "RightUpLeg", (0.0, -44.0, 0.0)),
    ("RightFoot", "RightLeg", (0.0, -42.0, -2.0)),
)
"""Name, parent, way from the parent in cm."""

BONES = {
    ("LeftArm", "LeftForeArm"): ("l_shoulder", "l_elbow"),
    ("LeftForeArm", "LeftHand"): ("l_elbow", "l_wrist"),
    ("RightArm", "RightForeArm"): ("r_shoulder", "r_elbow"),
    ("RightForeArm", "RightHand"): ("r_elbow", "r_wrist"),
    ("LeftUpLeg", "LeftLeg"): ("l_hip", "l_knee"),
    ("LeftLeg", "LeftFoot"): ("l_knee", "l_ankle"),
    ("RightUpLeg", "RightLeg"): ("r_hip", "r_knee"),
    ("RightLeg", "RightFoot"): ("r_knee", "r_ankle"),
}

BIOVISION = {
    "Spine": "Chest",
    "Spine1": "Chest2",
    **{f"{side}Shoulder": f"{side}Collar" for side in ("Left", "Right")},
    **{f"{side}Arm": f"{side}Shoulder" for side in ("Left", "Right")},
    **{f"{side}ForeArm": f"{side}Elbow" for side in ("Left", "Right")},
    **{f"{side}Hand": f"{side}Wrist" for side in ("Left", "Right")},
    **{f"{side}UpLeg": f"{side}Hip" for side in ("Left", "Right")},
    **{f"{side}Leg": f"{side}Knee" for side in ("Left", "Right")},
    **{f"{side}Foot": f"{side}Ankle" for side in ("Left", "Right")},
}

Turns = dict[str, tuple[float, float, float]]
"""Degrees about z, x and y, in this order."""


def bvh(*frames: Turns, bones: Bones = T_POSE, step: float = 0.01, names=None, places=()) -> str:
    """A file with a frame for each pose; without a place the root stays where it is at rest."""
    names = names or {}

    def joint(name: str, depth: int) -> str:
        _, parent, offset = next(bone for bone in bones if bone[0] == name)
        head = "JOINT" if parent else "ROOT"
        channels = "3 Zrotation Xrotation Yrotation"
        if parent is None:
            channels = "6 Xposition Yposition Zposition Zrotation Xrotation Yrotation"
        inside = "".join(joint(child, depth + 1) for child, above, _ in bones if above == name)
        inside = inside or "End Site\n{\nOFFSET 0 0 1\n}\n"
        where = " ".join(map(str, offset if parent else (0.0, 0.0, 0.0)))
        return f"{head} {names.get(name, name)}\n{{\nOFFSET {where}\nCHANNELS {channels}\n{inside}}}\n"

    order: list[str] = []

    def walk(name: str) -> None:
        order.append(name)
        for child, above, _ in bones:
            if above == name:
                walk(child)

    root = bones[0][0]
    walk(root)
    lines = []
    for i, frame in enumerate(frames):
        place = places[i] if places else bones[0][2]
        numbers = [*place, *(angle for name in order for angle in frame.get(name, (0.0, 0.0, 0.0)))]
        lines.append(" ".join(f"{number:.6f}" for number in numbers))
    motion = f"MOTION\nFrames: {len(frames)}\nFrame Time: {step}\n" + "\n".join(lines) + "\n"
    return f"HIERARCHY\n{joint(root, 0)}{motion}"


@pytest.fixture
def capture(tmp_path: Path):
    def read(text: str):
        path = tmp_path / "some.bvh"
        path.write_text(text)
        return read_capture(path)

    return read


def turn(angles: tuple[float, float, float]) -> Quat:
    z, x, y = (math.radians(angle) for angle in angles)
    about_z, about_x = from_axis_angle((0.0, 0.0, 1.0), z), from_axis_angle((1.0, 0.0, 0.0), x)
    return multiply(multiply(about_z, about_x), from_axis_angle(UP, y))


def captured_directions(frame: Turns) -> dict[tuple[str, str], Vec3]:
    """Where the bones of the captured figure point, worked out by hand."""
    turned: dict[str, Quat] = {}
    for name, parent, _ in T_POSE:
        own = turn(frame.get(name, (0.0, 0.0, 0.0)))
        turned[name] = own if parent is None else multiply(turned[parent], own)
    ways = {name: offset for name, _, offset in T_POSE}
    return {(a, b): unit(rotate(turned[a], ways[b])) for a, b in BONES}


def directions(clip: Clip, time: float, skeleton) -> dict[tuple[str, str], Vec3]:
    body = Body(skeleton).posed(clip.rotations_at(time))
    pairs = {pair: (body.place(a).position, body.place(b).position) for pair, (a, b) in BONES.items()}
    return {pair: unit(subtract(b, a)) for pair, (a, b) in pairs.items()}


def assert_same_directions(clip: Clip, time: float, skeleton, frame: Turns) -> None:
    ours = directions(clip, time, skeleton)
    for bone, expected in captured_directions(frame).items():
        assert ours[bone] == pytest.approx(expected, abs=1e-5), bone


def test_who_rests_in_a_t_pose_and_is_not_turned_has_our_figure_in_a_t_pose(capture, skeleton):
    clip = retargeted(capture(bvh({}, {})), skeleton)
    assert_same_directions(clip, 0.0, skeleton, {})
    body = Body(skeleton).posed(clip.rotations_at(0.0))
    # Palms down: in the default pose the left palm faces the thigh, -x.
    assert rotate(body.place("l_wrist").rotation, (-1.0, 0.0, 0.0)) == pytest.approx((0.0, -1.0, 0.0), abs=0.2)


@pytest.mark.parametrize("names", [{}, {name: f"mixamorig:{name}" for name, _, _ in T_POSE}, BIOVISION])
def test_joints_are_known_by_the_names_of_several_makers(capture, skeleton, names):
    frame: Turns = {"LeftArm": (30.0, 20.0, 10.0), "RightLeg": (0.0, 40.0, 0.0), "Spine": (0.0, 10.0, 0.0)}
    assert_same_directions(retargeted(capture(bvh(frame, frame, names=names)), skeleton), 0.0, skeleton, frame)


_FEMALE = Avatar.read(ASSETS / "avatars" / "female.glb").skeleton
angles = st.tuples(*(st.floats(-80.0, 80.0) for _ in range(3)))
limbs = st.dictionaries(st.sampled_from([name for name, parent, _ in T_POSE if parent]), angles)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(limbs)
def test_our_bones_point_where_the_captured_ones_do(tmp_path_factory, frame):
    path = tmp_path_factory.mktemp("capture") / "some.bvh"
    path.write_text(bvh(frame, frame))
    assert_same_directions(retargeted(read_capture(path), _FEMALE), 0.0, _FEMALE, frame)


def test_the_figure_begins_where_it_stands_and_as_it_faces(capture, skeleton):
    """The captured one begins 3 m away, turned to its right, and walks a meter straight on."""
    frame: Turns = {"Hips": (0.0, 0.0, -90.0)}
    walk = bvh(frame, frame, places=[(300.0, 98.0, 0.0), (200.0, 98.0, 0.0)])
    clip = retargeted(capture(walk), skeleton)
    leg = -skeleton.offset("l_knee")[1] / 0.44
    assert clip.root_at(0.0) == (0.0, 0.0, 0.0)
    assert clip.root_at(0.01) == pytest.approx((0.0, 0.0, leg), abs=0.02)
    assert_same_directions(clip, 0.0, skeleton, {})


def test_a_figure_that_rests_facing_another_way_is_turned_first(capture, skeleton):
    aside = tuple((name, above, (z, y, -x)) for name, above, (x, y, z) in T_POSE)  # a quarter to its left
    clip = retargeted(capture(bvh({}, {}, bones=aside)), skeleton)
    assert_same_directions(clip, 0.0, skeleton, {})


def test_who_crouches_at_the_beginning_has_its_feet_on_our_ground(capture, skeleton):
    crouch: Turns = {f"{side}UpLeg": (0.0, -70.0, 0.0) for side in ("Left", "Right")}
    crouch |= {f"{side}Leg": (0.0, 140.0, 0.0) for side in ("Left", "Right")}
    crouch |= {f"{side}Foot": (0.0, -70.0, 0.0) for side in ("Left", "Right")}
    clip = retargeted(capture(bvh(crouch, crouch, places=[(0.0, 50.0, 0.0)] * 2)), skeleton)
    posed = KeyframeMotionUnit(clip, skeleton).pose(Moment(0.5, 0.0, Body(skeleton)))
    body = Body(skeleton).posed(posed.rotations, posed.root)
    assert body.place("l_ankle").position[1] == pytest.approx(Body(skeleton).place("l_ankle").position[1], abs=0.01)


def test_the_noise_of_a_capture_is_filtered_unless_somebody_says_otherwise(tmp_path, skeleton):
    """Thesis 3.2.2.2."""
    path = tmp_path / "noisy.bvh"
    frames: list[Turns] = [{"LeftArm": (0.0, 0.0, 10.0 + 2.0 * (-1.0) ** i)} for i in range(240)]
    path.write_text(bvh(*frames, step=1 / 120))

    def tremble(cutoff: float | None) -> float:
        clip = clip_in(path, skeleton, cutoff)
        turns = clip.rotations[60:180, clip.joints.index("l_shoulder"), :]
        return float(np.abs(np.diff(turns, axis=0)).max())

    assert tremble(None) < 0.001 < 0.02 < tremble(0.0)


def test_a_file_that_was_saved_anew_is_read_anew(tmp_path, skeleton):
    path = tmp_path / "some.bvh"
    path.write_text(bvh({}, {}))
    assert clip_in(path, skeleton, None).duration == pytest.approx(0.01)
    path.write_text(bvh({}, {}, {}))
    assert clip_in(path, skeleton, None).duration == pytest.approx(0.02)


GOOD = bvh({}, {})


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "line 1: there is no MOTION"),
        (GOOD.replace("HIERARCHY", "HIERARCH"), "line 1: 'HIERARCH' stands where HIERARCHY should"),
        (GOOD.replace("OFFSET 0.0 12.0", "OFFSET 0.0 twelve"), r"line \d+: 'twelve' is no number"),
        (GOOD.replace("OFFSET 0.0 12.0", "OFFSET 0.0 nan"), r"line \d+: 'nan' is no number"),
        (GOOD.replace("CHANNELS 3", "CHANNELS three", 1), "line 9: 'three' is no number of anything"),
        (GOOD.replace("CHANNELS 3", "CHANNELS 9" + 9000 * "9", 1), "is no number of anything"),
        (GOOD.replace("Zrotation", "Wrotation", 1), "line 5: no channel is called 'Wrotation'"),
        (GOOD.replace("JOINT Spine\n", "BONE Spine\n"), "'BONE' stands where JOINT, End Site or } should"),
        (GOOD.replace("}\nMOTION", "MOTION"), "the HIERARCHY ends too early"),
        (GOOD.replace("Frames: 2", "Frames: 3"), "numbers are not 3 frames of 60 numbers up to 1e"),
        (GOOD.replace("Frames: 2", "Frames 2"), "after MOTION should come 'Frames: N' and 'Frame Time: s'"),
        (GOOD.replace("Frame Time: 0.01", "Frame Time: 0"), "are not 2 frames of 60 numbers up to 1e.09, 0 s apart"),
        (GOOD.rstrip().removesuffix("0.000000") + "oops\n", "could not convert string to float: 'oops'"),
        (GOOD.rstrip().removesuffix("0.000000") + "inf\n", "numbers up to 1e"),
        (GOOD.rstrip().removesuffix("0.000000") + "1e300\n", "numbers up to 1e"),
        (GOOD.replace("OFFSET 0.0 12.0", "OFFSET 0.0 1e300"), r"line \d+: '1e300' is no number"),
        (bvh({}), "not 1 frames of 60 numbers up to 1e.09, 0.01 s apart, or there are not two"),
    ],
)
def test_what_is_wrong_in_a_file_is_said_with_its_line(capture, text, message):
    with pytest.raises(RealizerError, match=message) as caught:
        capture(text)
    assert caught.value.fault.code == "bad-capture"
    assert str(caught.value).startswith("some.bvh, line ")


def test_joints_that_nobody_knows_are_refused(capture, skeleton):
    strange = {name: f"bone{i}" for i, (name, _, _) in enumerate(T_POSE)}
    with pytest.raises(RealizerError, match="no joint is called in a way that is known for HumanoidRoot, l_hip"):
        retargeted(capture(bvh({}, {}, names=strange)), skeleton)


def test_who_walks_out_of_sight_is_refused(capture, skeleton):
    text = bvh({}, {}, places=[(0.0, 95.0, 0.0), (0.0, 95.0, 1e7)])
    with pytest.raises(RealizerError, match="it goes further than 10 m, by the length of its thighs"):
        retargeted(capture(text), skeleton)


def test_a_figure_that_lies_at_rest_is_refused(capture, skeleton):
    lying = tuple((name, above, (x, -z, y)) for name, above, (x, y, z) in T_POSE)
    with pytest.raises(RealizerError, match="does not rest upright"):
        retargeted(capture(bvh({}, {}, bones=lying)), skeleton)


def test_a_file_of_too_many_joints_and_frames_is_refused(capture):
    idle = "JOINT a\n{\nOFFSET 0 0 0\nCHANNELS 0\nEnd Site\n{\nOFFSET 0 0 0\n}\n}\n" * 1100
    text = f"HIERARCHY\nROOT a\n{{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n{idle}}}\nMOTION\nFrames: 1000\nFrame Time: 1\n"
    with pytest.raises(RealizerError, match="1000 frames of 1101 joints are more than 1000000 rotations"):
        capture(text + "0 " * 1000)


def test_a_file_of_100_mb_is_refused_before_it_is_read(tmp_path):
    path = tmp_path / "big.bvh"
    with path.open("wb") as file:
        file.truncate(100_000_000)
    with pytest.raises(RealizerError) as caught:
        read_capture(path)
    assert caught.value.fault.code == "asset-too-big"
