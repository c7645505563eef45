"""The elements of BMLT that play motion as it was made: animations, keyframes, noise, transitions (thesis app. C)."""

from pathlib import Path
from threading import current_thread

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.engines.animation.keyframe import clip_cache
from reactive_realizer.engines.animation.keyframe.capture import Capture
from reactive_realizer.engines.animation.keyframe.capture_reader import read_capture
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

SWING = """
<ProcAnimation prefDuration="2">
  <Rotation target="r_shoulder" rotation="0 - 0.6 - a*sin(2*pi*t);0;0"/>
  <Rotation target="r_elbow" rotation="0 - 0.4 - 0.3*sin(2*pi*t);0;0"/>
  <Parameter sid="a" value="0.5"/>
  <KeyPosition id="beat1" time="0.25"/><KeyPosition id="beat2" time="0.75"/>
</ProcAnimation>
"""
KEYS = "0 1 0 0 0  1 1 0 0 -0.8  2 1 0 0 -0.2"
WAVE = f"""
<SkeletonInterpolator parts="r_shoulder" encoding="R" rotationEncoding="axisangles">
  <KeyPosition id="up" time="1" leave="true"/>{KEYS}
</SkeletonInterpolator>
"""
BOW = """HIERARCHY
ROOT Hips { OFFSET 0 0 0 CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
 JOINT Spine { OFFSET 0 10 0 CHANNELS 3 Zrotation Xrotation Yrotation
  JOINT Head { OFFSET 0 50 0 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 0 10 0 } } }
 JOINT LeftUpLeg { OFFSET 9 0 0 CHANNELS 3 Zrotation Xrotation Yrotation
  JOINT LeftLeg { OFFSET 0 -44 0 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 0 -44 0 } } }
 JOINT RightUpLeg { OFFSET -9 0 0 CHANNELS 3 Zrotation Xrotation Yrotation
  JOINT RightLeg { OFFSET 0 -44 0 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 0 -44 0 } } } }
MOTION
Frames: 3
Frame Time: 0.5
0 98 0  0 0 0  0 0 0   0 0 0  0 0 0  0 0 0  0 0 0  0 0 0
0 98 0  0 0 0  0 30 0  0 0 0  0 0 0  0 0 0  0 0 0  0 0 0
0 98 0  0 0 0  0 0 0   0 0 0  0 0 0  0 0 0  0 0 0  0 0 0
"""
FILES = {"moves/swing.xml": SWING, "moves/wave.xml": WAVE, "captures/bow.bvh": BOW}
PERLIN = '<bmlt:noise id="x" type="perlin" joint="vl5"><bmlt:parameter name="{}" value="{}"/></bmlt:noise>'
ARM = '<bmlt:parameter name="joints" value="r_shoulder,r_elbow r_wrist"/>'


@pytest.fixture
async def pilot(tmp_path: Path):
    for name, text in FILES.items():
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,), verify=True)) as pilot:
        pilot.watch()
        yield pilot


def angles(pilot: RealizerPilot, joint: str, axis: int = 1) -> dict[float, float]:
    """Of each frame, by time: how far a joint is turned about x (1), y (2) or z (3), rad."""
    (frames,) = pilot.frames.values()
    index = next(iter(pilot.realizer.characters.values())).humanoid.avatar.skeleton.joints.index(joint)
    return {
        round(float(frame.time), 2): 2.0 * float(np.arctan2(frame.rotations[index][axis], frame.rotations[index][0]))
        for frame in frames
    }


def told(pilot: RealizerPilot) -> str:
    """The text of the first warning."""
    return str(pilot.feedback.of("warningFeedback")[0].element.text)


def after_start(pilot: RealizerPilot, *points: str) -> list[float]:
    """How long after the start of its block points of block b came, s: it starts when its files have been read."""
    return [round(pilot.feedback.time(f"b:{point}") - pilot.feedback.time("b:start"), 6) for point in points]


async def test_a_procedural_animation_is_found_by_its_name_and_takes_parameters(pilot) -> None:
    pilot.block(
        "b",
        '<bmlt:procanimation id="p" name="swing" start="0"><bmlt:parameter name="a" value="0.2"/></bmlt:procanimation>',
    )
    await pilot.advance(3)
    assert not pilot.feedback.warnings
    assert pilot.feedback.time("b:p:end") == 2.0
    assert angles(pilot, "r_shoulder")[0.5] == pytest.approx(-0.8, abs=0.01)


async def test_a_procedural_animation_is_found_by_its_file_too(pilot) -> None:
    pilot.block("b", '<bmlt:procanimation id="p" fileName="Humanoids/moves/swing.xml" start="0"/>')
    await pilot.advance(3)
    assert not pilot.feedback.warnings
    assert angles(pilot, "r_shoulder")[0.5] == pytest.approx(-1.1, abs=0.01)


async def test_the_key_positions_of_an_animation_are_sync_points_that_others_name(pilot) -> None:
    """Thesis, example 47: beats of a conducting pattern on ticks."""
    pilot.block(
        "b",
        """
        <bmlt:procanimation id="conduct" name="swing"/>
        <head id="nod" lexeme="NOD" start="conduct:beat2"/>
        <constraint><synchronize><sync ref="conduct:start"/><sync ref="1"/></synchronize></constraint>
        <constraint><synchronize><sync ref="conduct:beat1"/><sync ref="2"/></synchronize></constraint>
        <constraint><synchronize><sync ref="conduct:beat2"/><sync ref="2.4"/></synchronize></constraint>
        """,
    )
    await pilot.advance(5)
    assert not pilot.feedback.warnings
    told = [
        pilot.feedback.time(f"b:{point}") for point in ("conduct:start", "conduct:beat1", "conduct:beat2", "nod:start")
    ]
    assert told == [1.0, 2.0, 2.4, 2.4]
    assert angles(pilot, "r_shoulder")[2.0] == pytest.approx(-1.1, abs=0.02)
    assert angles(pilot, "r_shoulder")[2.4] == pytest.approx(-0.1, abs=0.02)


async def test_a_sync_point_that_the_animation_does_not_know_is_told_with_those_that_it_knows(pilot) -> None:
    pilot.block("b", '<bmlt:procanimation id="p" name="swing"/><head id="nod" lexeme="NOD" start="p:beat3"/>')
    await pilot.advance(3)
    assert pilot.feedback.warnings == [("b:nod", "IMPOSSIBLE_TO_SCHEDULE")]
    assert "'p' has no sync point 'beat3'" in told(pilot)
    assert "beat1" in told(pilot)


async def test_an_animation_played_as_a_gesture_has_a_preparation_and_a_retraction(pilot) -> None:
    pilot.block("b", '<bmlt:procanimationgesture id="p" name="swing" start="0"/>')
    await pilot.advance(6)
    assert not pilot.feedback.warnings
    times = [pilot.feedback.time(f"b:p:{sync}") for sync in ("start", "ready", "relax", "end")]
    assert times == sorted(times)
    assert times[1] > 0.2
    assert times[3] > times[2] + 0.2


@pytest.mark.parametrize("inside", ["", WAVE, WAVE.replace("<SkeletonInterpolator", '<SkeletonInterpolator xmlns=""')])
async def test_keys_of_a_file_or_of_bml_itself_are_played(pilot, inside) -> None:
    name = "" if inside else 'name="wave"'
    pilot.block("b", f'<bmlt:keyframe id="k" {name} start="0">{inside}</bmlt:keyframe>')
    await pilot.advance(3)
    assert not pilot.feedback.warnings
    assert after_start(pilot, "k:up", "k:end") == [1.0, 2.0]
    shown = angles(pilot, "r_shoulder")
    assert [shown[time] for time in (0.5, 1.0, 1.5)] == pytest.approx([-0.4, -0.8, -0.5], abs=0.01)


async def test_keys_are_played_in_the_time_that_bml_gives_them(pilot) -> None:
    pilot.block("b", '<bmlt:keyframe id="k" name="wave" start="0" end="4"/>')
    await pilot.advance(5)
    assert angles(pilot, "r_shoulder")[2.0] == pytest.approx(-0.8, abs=0.01)


async def test_a_capture_is_played_by_its_name(pilot) -> None:
    pilot.block("b", '<bmlt:keyframe id="k" name="bow" start="1"/>')
    await pilot.advance(3)
    assert not pilot.feedback.warnings
    assert after_start(pilot, "k:end") == [2.0]
    assert angles(pilot, "vl5")[1.5] == pytest.approx(np.radians(30.0), abs=0.05)
    (frames,) = pilot.frames.values()
    feet = pilot.path("l_ankle") + [frame.root for frame in frames]
    assert np.ptp(feet[70:100], axis=0).max() < 0.001
    assert feet[:, 1].min() > feet[0, 1] - 0.005


@pytest.mark.parametrize(("frames", "warnings"), [("3", []), ("9", [("b:k", "CANNOT_CREATE_BEHAVIOR")])])
async def test_a_capture_is_read_once_and_aside_of_the_ticks_also_if_it_is_wrong(
    pilot, tmp_path, monkeypatch, frames, warnings
) -> None:
    threads = []

    def read(path: Path) -> Capture:
        threads.append(current_thread())
        return read_capture(path)

    monkeypatch.setattr(clip_cache, "read_capture", read)
    (tmp_path / "captures" / "bow.bvh").write_text(BOW.replace("Frames: 3", f"Frames: {frames}"))
    pilot.block("b", '<bmlt:keyframe id="k" name="bow" start="0"/><wait id="w" start="0" end="1"/>')
    await pilot.advance(2)
    assert pilot.feedback.warnings == warnings
    assert "b:w:end" in pilot.feedback.progress
    assert len(threads) == 1
    assert current_thread() not in threads


async def test_a_keyframe_animation_is_mirrored_first_and_then_confined_to_joints(pilot) -> None:
    """Thesis C.1.2."""
    mirror = '<bmlt:parameter name="mirror" value="true"/><bmlt:parameter name="joints" value="l_shoulder"/>'
    pilot.block("b", f'<bmlt:keyframe id="k" name="wave" start="0">{mirror}</bmlt:keyframe>')
    await pilot.advance(1.2)
    assert not pilot.feedback.warnings
    assert angles(pilot, "l_shoulder")[1.0] == pytest.approx(-0.8, abs=0.01)
    assert angles(pilot, "r_shoulder")[1.0] > -0.2


async def test_a_gentle_interrupt_lets_it_go_on_to_the_next_point_where_it_may_be_left(pilot) -> None:
    pilot.block("b", '<bmlt:keyframe id="k" name="wave" start="0"/>')
    pilot.block("c", '<bmla:interrupt id="i" target="b" start="0.5" speech="WORD"/>')
    await pilot.advance(3)
    assert after_start(pilot, "k:up", "k:end") == [1.0, 1.0]


async def test_another_interrupt_breaks_it_off(pilot) -> None:
    pilot.block("b", '<bmlt:keyframe id="k" name="wave" start="0"/>')
    pilot.block("c", '<bmla:interrupt id="i" target="b" start="0.5"/>')
    await pilot.advance(3)
    assert pilot.feedback.time("b:k:end") == 0.5
    assert "b:k:up" not in pilot.feedback.progress


async def test_a_successor_may_take_over_at_such_a_point(pilot) -> None:
    pilot.block(
        "b", '<bmlt:keyframe id="k" name="wave" start="0"/><bmlt:procanimation id="p" name="swing" start="k:up"/>'
    )
    await pilot.advance(4)
    assert not pilot.feedback.warnings
    assert after_start(pilot, "k:end", "p:end") == [1.0, 3.0]
    turns = np.array(list(angles(pilot, "r_shoulder").values()))
    assert np.abs(np.diff(turns)).max() < 0.12


async def test_where_it_may_not_be_left_the_arm_is_taken(pilot) -> None:
    pilot.block(
        "b", '<bmlt:keyframe id="k" name="wave" start="0"/><bmlt:procanimation id="p" name="swing" start="1.2"/>'
    )
    await pilot.advance(4)
    assert pilot.feedback.warnings == [("b:p", "IMPOSSIBLE_TO_SCHEDULE")]


async def test_noise_stirs_a_joint_as_long_as_it_plays(pilot) -> None:
    stir = '<bmlt:parameter name="basefreqx" value="0.5"/><bmlt:parameter name="baseamplitudex" value="0.3"/>'
    pilot.block("b", f'<bmlt:noise id="n" type="perlin" joint="vl5" start="1" end="9">{stir}</bmlt:noise>')
    await pilot.advance(10.5)
    assert not pilot.feedback.warnings
    shown = angles(pilot, "vl5")
    still = [angle for time, angle in shown.items() if time < 1.0 or time > 9.8]
    stirred = [angle for time, angle in shown.items() if 1.5 < time < 9.0]
    assert np.ptp(still) < 0.05 < 0.15 < np.ptp(stirred)
    assert np.abs(np.diff(list(shown.values()))).max() < 0.05


async def test_noise_grows_while_it_plays(pilot) -> None:
    pilot.block(
        "b",
        """
        <bmlt:noise id="n" type="perlin" joint="vl5" start="0" end="12">
          <bmlt:parameter name="baseamplitudex" value="0.02"/></bmlt:noise>
        <bmla:parametervaluechange id="more" target="n" paramId="baseamplitudex" start="4" end="6">
          <bmla:trajectory type="linear" targetValue="0.4"/></bmla:parametervaluechange>
        """,
    )
    await pilot.advance(12)
    assert not pilot.feedback.warnings
    shown = angles(pilot, "vl5")
    early, late = ([a for time, a in shown.items() if low < time < low + 4.0] for low in (0.0, 7.0))
    assert np.ptp(late) > 3.0 * np.ptp(early)


async def test_two_sessions_of_the_same_seed_stir_alike_and_two_noises_differently() -> None:
    async def session(id_: str) -> list[float]:
        async with open_pilot(SceneOptions(voice="text")) as pilot:
            pilot.watch()
            pilot.block(
                "b",
                f'<bmlt:noise id="{id_}" type="perlin" joint="vl5" start="0" end="3">'
                '<bmlt:parameter name="baseamplitudex" value="0.3"/></bmlt:noise>',
            )
            await pilot.advance(3)
            return list(angles(pilot, "vl5").values())

    assert await session("n") == await session("n") != await session("m")


def transition(kind: str) -> str:
    return f"""
        <bmlt:procanimation id="a" name="swing" start="0" end="1.6"/>
        <bmlt:transition id="t" class="{kind}" start="a:end" end="3">{ARM}</bmlt:transition>
        <bmlt:procanimation id="c" name="swing" start="t:end"/>
    """


@pytest.mark.parametrize(
    "kind", ["SlerpTransition", "HermiteTransition", "hmi.animation.transitions.HermiteTransitionMU"]
)
@pytest.mark.parametrize("joint", ["r_shoulder", "r_elbow"])
async def test_a_transition_leads_from_the_last_pose_of_one_motion_to_the_first_of_the_next(pilot, kind, joint) -> None:
    pilot.block("b", transition(kind))
    await pilot.advance(3.2)
    assert not pilot.feedback.warnings
    turns = angles(pilot, joint)
    steps = np.abs(np.diff(list(turns.values())))
    assert steps.max() < 0.09  # a joint that jumped would take more than 4 rad/s
    assert turns[3.0] == pytest.approx(-0.6 if joint == "r_shoulder" else -0.4, abs=0.01)


@pytest.mark.parametrize("joint", ["r_shoulder", "r_elbow"])
async def test_a_hermite_transition_leaves_and_arrives_as_fast_as_the_motions_around_it(pilot, joint) -> None:
    """Thesis 4.2.4: continuous in rotation and angular velocity, as frames show it."""
    pilot.block("b", transition("HermiteTransition"))
    await pilot.advance(4)
    turns = angles(pilot, joint)
    times = np.array(list(turns))
    speeds = np.diff(list(turns.values())) / np.diff(times)
    changes = np.abs(np.diff(speeds))[(times[1:-1] > 1.3) & (times[1:-1] < 3.3)]
    assert changes.max() < 0.35  # rad/s from frame to frame; the speeds at the ends are near 2 and 1.6 rad/s


async def test_what_follows_a_transition_is_not_held_back_by_it(pilot) -> None:
    """What is left of a transition lies below, also where a clip follows."""
    pilot.block(
        "b",
        f"""
        <bmlt:procanimation id="a" name="swing" start="0" end="1.6"/>
        <bmlt:transition id="t" class="HermiteTransition" start="a:end" end="3">{ARM}</bmlt:transition>
        <bmlt:keyframe id="k" name="wave" start="t:end"/>
        """,
    )
    await pilot.advance(4)
    assert not pilot.feedback.warnings
    turns = angles(pilot, "r_shoulder")
    assert [turns[3.0 + time] for time in (0.0, 0.1, 0.2, 0.5)] == pytest.approx([0.0, -0.08, -0.16, -0.4], abs=0.02)


async def test_a_slerp_transition_leaves_and_arrives_at_rest(pilot) -> None:
    pilot.block("b", transition("SlerpTransition"))
    await pilot.advance(4)
    turns = angles(pilot, "r_shoulder")
    assert turns[1.64] == pytest.approx(turns[1.6], abs=0.005)
    assert turns[3.0] == pytest.approx(turns[2.96], abs=0.02)


async def test_a_transition_to_nothing_leads_to_rest(pilot) -> None:
    pilot.block(
        "b",
        f'<bmlt:procanimation id="a" name="swing" start="0" end="1.5"/>'
        f'<bmlt:transition id="t" class="SlerpTransition" start="a:end">{ARM}</bmlt:transition>',
    )
    await pilot.advance(4)
    assert not pilot.feedback.warnings
    turns = angles(pilot, "r_shoulder")
    end = round(pilot.feedback.time("b:t:end"), 2)
    assert turns[end] == pytest.approx(turns[3.9], abs=0.03)


async def test_a_transition_leads_to_the_posture_that_the_figure_is_in_by_then(pilot) -> None:
    pilot.block(
        "b",
        f"""
        <posture id="p" start="0" ready="2" relax="5"><pose part="ARMS" lexeme="ARMS_CROSSED"/></posture>
        <bmlt:transition id="t" class="SlerpTransition" start="3" end="4">{ARM}</bmlt:transition>
        """,
    )
    await pilot.advance(4.5)
    assert not pilot.feedback.warnings
    turns = angles(pilot, "r_elbow")
    assert abs(turns[2.9] - turns[0.0]) > 0.5
    assert turns[3.98] == pytest.approx(turns[2.9], abs=0.02)


async def test_a_transition_whose_end_moves_away_goes_there_more_slowly(pilot) -> None:
    pilot.predict("partner", "hit", 2.0)
    pilot.block(
        "b",
        f"""
        <bmlt:transition id="t" class="HermiteTransition" start="1" end="anticipators:partner:hit">
          {ARM}</bmlt:transition>
        <bmlt:procanimation id="c" name="swing" start="t:end"/>
        """,
    )
    await pilot.advance(1.5)
    pilot.predict("partner", "hit", 3.0)
    await pilot.advance(2)
    assert not pilot.feedback.warnings
    turns = angles(pilot, "r_shoulder")
    assert turns[3.0] == pytest.approx(-0.6, abs=0.02)
    assert np.abs(np.diff(list(turns.values()))).max() < 0.09


async def test_a_transition_of_which_nobody_knows_the_end_waits_where_it_is(pilot) -> None:
    pilot.predict("partner", "hit", 2.0)
    pilot.block(
        "b",
        f"""
        <bmlt:transition id="t" class="SlerpTransition" start="1" end="anticipators:partner:hit">{ARM}</bmlt:transition>
        <bmlt:procanimation id="c" name="swing" start="t:end"/>
        """,
    )
    await pilot.advance(0.5)
    pilot.predict("partner", "hit", None)
    await pilot.advance(1.5)
    pilot.predict("partner", "hit", 2.8)
    await pilot.advance(1.5)
    assert not pilot.feedback.warnings
    turns = angles(pilot, "r_shoulder")
    assert turns[1.9] == pytest.approx(turns[1.1], abs=0.01)
    assert turns[2.8] == pytest.approx(-0.6, abs=0.02)
    assert np.abs(np.diff(list(turns.values()))).max() < 0.09


@pytest.mark.parametrize(
    ("xml", "said"),
    [
        ('<bmlt:procanimation id="x" name="nowhere"/>', "no file 'nowhere.xml' among the assets"),
        ('<bmlt:procanimation id="x"/>', "<procanimation> needs a file, or the name of one"),
        ('<bmlt:keyframe id="x" name="nowhere"/>', "no file 'nowhere.bvh' among the assets"),
        ('<bmlt:keyframe id="x" name="../secret"/>', "it may not leave the folders"),
        (f'<bmlt:keyframe id="x" name="wave">{ARM.replace("joints", "mirror")}</bmlt:keyframe>',
         "mirror='r_shoulder,r_elbow r_wrist' is neither true nor false"),
        (f'<bmlt:keyframe id="x">{WAVE.strip().replace("true", "maybe")}</bmlt:keyframe>',
         "x, line 2, <KeyPosition>: leave='maybe' is neither true nor false"),
        (f'<bmlt:keyframe id="x">{WAVE.strip().replace(KEYS, "0 1 0")}</bmlt:keyframe>',
         "x, line 1, <SkeletonInterpolator>: 3 numbers are no rows of 5"),
        (f'<bmlt:keyframe id="x">{WAVE.strip().replace("up", "a b")}</bmlt:keyframe>',
         "x, line 2, <KeyPosition>: id='a b' cannot name a sync point"),
        (f'<bmlt:keyframe id="x" name="wave">{ARM.replace("r_shoulder,r_elbow r_wrist", "l_knee")}</bmlt:keyframe>',
         "this figure has no l_knee, which <keyframe> needs"),
        ('<bmlt:keyframe id="x" name="wave"><bmlt:parameter name="filter" value="-3"/></bmlt:keyframe>',
         "the parameter filter is a number from 0 to 1e+06, which '-3' is not"),
        (PERLIN.format("persistencex", "1e300"),
         "the parameter persistencex is a number from 0 to 1, which '1e+300' is not"),
        (PERLIN.format("basefreqx", "fast"),
         "the parameter basefreqx is a number from 0 to 1000, which 'fast' is not"),
        ('<bmlt:procanimation id="x" name="swing"><bmlt:parameter name="a" value="much"/></bmlt:procanimation>',
         "the parameter a is a number from -inf to inf, which 'much' is not"),
        ('<head id="x" lexeme="NOD"><bmlt:parameter name="amount" value="7"/></head>',
         "the parameter amount is a number from 0 to 1, which '7' is not"),
        ('<head id="x" lexeme="NOD"><bmlt:parameter name="repetition" value="1e9"/></head>',
         "the parameter r is a number from 0 to 100, which '1e+09' is not"),
        ('<gesture id="x" lexeme="BEAT"><bmlt:parameter name="amount" value="1.5"/></gesture>',
         "the parameter amount is a number from 0 to 1, which '1.5' is not"),
        ('<gesture id="x" lexeme="BEAT"><bmlt:parameter name="postStrokeHoldDuration" value="-3"/></gesture>',
         "the parameter postStrokeHoldDuration is a number from 0 to 600, which '-3' is not"),
        ('<gaze id="x" target="bluebox"><bmlt:parameter name="back" value="-1"/></gaze>',
         "the parameter back is a number from 0 to 1, which '-1' is not"),
        ('<bmlt:noise id="x" type="perlin" joint="tail"/>', "this figure has no tail, which <noise> needs"),
        ('<bmlt:noise id="x" type="white" joint="vl5"/>', "nothing in the binding plays <noise>"),
        ('<bmlt:transition id="x" class="Teleport"/>', "no transition is called 'Teleport'; known are SlerpTransition"),
    ],
)  # fmt: skip
async def test_what_cannot_be_played_is_said_with_its_reason_and_the_rest_goes_on(pilot, xml, said) -> None:
    pilot.block("b", f'{xml}<head id="nod" lexeme="NOD"/>')
    await pilot.advance(2)
    assert pilot.feedback.warnings == [("b:x", "CANNOT_CREATE_BEHAVIOR")]
    assert said in told(pilot)
    assert "b:nod:end" in pilot.feedback.progress


async def test_a_name_that_several_files_bear_is_told_with_all_of_them(pilot, tmp_path) -> None:
    (tmp_path / "again").mkdir()
    (tmp_path / "again" / "swing.xml").write_text(SWING)
    pilot.block("b", '<bmlt:procanimation id="x" name="swing"/>')
    await pilot.advance(1)
    assert pilot.feedback.warnings == [("b:x", "CANNOT_CREATE_BEHAVIOR")]
    assert "again/swing.xml, moves/swing.xml" in told(pilot)


async def test_the_peers_own_examples_play(shared_cases) -> None:
    for path, joint in {
        "bmlt-internalkeyframe.xml": "skullbase",
        "bmlt-perlin_noise_random_movement.xml": "vl5",
        "bmlt-procanimation.xml": "skullbase",
    }.items():
        async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
            pilot.watch()
            pilot.perform((shared_cases / "asap" / "bml" / path).read_bytes())
            await pilot.advance(4)
            assert not pilot.feedback.warnings
            assert max(np.ptp(list(angles(pilot, joint, axis).values())) for axis in (1, 2, 3)) > 0.015


async def test_a_point_of_its_own_may_be_tied_by_an_attribute_of_its_name(pilot) -> None:
    pilot.block("b", '<bmlt:procanimation id="a" name="conduct-3-beat" start="0.3" beat2="2.5"/>')
    await pilot.advance(6)
    assert pilot.feedback.time("b:a:start") == 0.3
    assert pilot.feedback.time("b:a:beat2") == 2.5
    assert pilot.feedback.warnings == []


async def test_an_attribute_that_names_no_point_of_it_drops_it_and_says_which_there_are(pilot) -> None:
    pilot.block("b", '<bmlt:procanimation id="a" name="conduct-3-beat" beat9="2.5"/>')
    await pilot.advance(1)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "beat9" in str(warning.element.text)
    assert "beat1, beat2, beat3" in str(warning.element.text)


async def test_a_transition_may_describe_a_gesture_whose_points_it_has_then(pilot) -> None:
    described = (
        '<gesture id="g" lexeme="BEAT" start="0.2" end="1.5"><description priority="1" type="transition">'
        '<bmlt:transition class="SlerpTransition"/></description></gesture>'
    )
    pilot.block("b", described)
    await pilot.advance(3)
    assert pilot.feedback.time("b:g:start") == 0.2
    assert pilot.feedback.time("b:g:end") == 1.5
    assert pilot.feedback.warnings == []


async def test_what_a_clip_turns_and_the_figure_has_not_is_logged_once(tmp_path, caplog) -> None:
    rows = "0 1 0 0 0 1 0 0 0 1 1 0 0 0 1 0 0 0"
    wagging = f'<SkeletonInterpolator parts="skullbase tail" encoding="R">{rows}</SkeletonInterpolator>'
    (tmp_path / "wagging.xml").write_text(wagging)
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,))) as pilot:
        for number in range(3):
            pilot.block(f"b{number}", '<bmlt:keyframe id="k" name="wagging"/>')
            await pilot.advance(1.5)
        assert pilot.feedback.warnings == []
    assert caplog.text.count("wagging.xml leaves out what it has not, or the figure has not: tail") == 1
