"""MURML: where hands are and point in the frames, at which times, what faces do, and what plays of wrong input."""

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import BML, MURML
from reactive_realizer.bml.vocabulary import BodyAxis
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import angle, difference, from_axis_angle, rotate
from reactive_realizer.embodiment.vector import Vec3, distance, dot, subtract, unit
from reactive_realizer.engines.animation.key_poses.arm_pose import hand_axes
from reactive_realizer.engines.animation.key_poses.gesture_space import arm_length
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .conftest import OpenStill

FRAMES = 50
"""Frames per second."""

AVATARS = ("female", "male")
POINTS = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")


def document(inside: str, more: str = 'id="g"') -> str:
    murml = f'<murmlgesture xmlns="{MURML}" {more}><murml-description>{inside}</murml-description></murmlgesture>'
    return f'<bml xmlns="{BML}" id="b">{murml}</bml>'


def static(slot: str, value: str, scope: str = "right_arm") -> str:
    return f'<static slot="{slot}" value="{value}" scope="{scope}"/>'


def dynamic(slot: str, *values: tuple[str, str], kind: str = "linear", scope: str = "right_arm") -> str:
    written = "".join(f'<value type="{type_}" name="{name}"/>' for type_, name in values)
    return f'<dynamic slot="{slot}" scope="{scope}"><dynamicElement type="{kind}">{written}</dynamicElement></dynamic>'


def together(*movements: str) -> str:
    return f"<parallel>{''.join(movements)}</parallel>"


def wrist(body: Body, side: str = "r") -> Vec3:
    return subtract(body.transform(f"{side}_wrist").position, body.transform("HumanoidRoot").position)


def heading(body: Body, axis: BodyAxis, side: str = "r") -> Vec3:
    return rotate(body.transform(f"{side}_wrist").rotation, hand_axes(side, body.skeleton)[axis])


def degrees(a: Vec3, b: Vec3) -> float:
    return math.degrees(math.acos(max(-1.0, min(1.0, dot(unit(a), unit(b))))))


def time(pilot: RealizerPilot, point: str) -> float:
    found = pilot.feedback.time(f"b:g:{point}")
    assert found is not None
    return found


def at(pilot: RealizerPilot, seconds: float) -> Body:
    return pilot.bodies()[round(seconds * FRAMES)]


async def played(pilot: RealizerPilot, inside: str, seconds: float = 3.0) -> tuple[Body, ...]:
    """The bodies at the start and at the end of the stroke."""
    pilot.perform(document(inside))
    await pilot.advance(seconds)
    return at(pilot, time(pilot, "strokeStart") + 0.02), at(pilot, time(pilot, "strokeEnd"))


@pytest.mark.parametrize("avatar", AVATARS)
async def test_a_static_hand_is_at_its_place_and_points_where_the_symbols_say(
    open_still: OpenStill, avatar: str
) -> None:
    place = (-0.2, 0.25, 0.3)
    hand = together(
        static("HandLocation", "-0.2 0.25 0.3"),
        static("ExtFingerOrientation", "DirAU"),
        static("PalmOrientation", "PalmL"),
        static("HandShape", "ASL5"),
    )
    async with open_still(avatar=avatar) as pilot:
        begun, ended = await played(pilot, hand)
        for body in (begun, ended):
            assert distance(wrist(body), place) < 0.005
            assert degrees(heading(body, BodyAxis.FINGERS), (0.0, 1.0, 1.0)) < 15.0
            assert degrees(heading(body, BodyAxis.PALM), (1.0, 0.0, 0.0)) < 15.0
        assert begun.rotation("r_index1") != at(pilot, 0.0).rotation("r_index1")
        times = [time(pilot, point) for point in POINTS]
        assert times == sorted(times)
        assert time(pilot, "strokeEnd") - time(pilot, "strokeStart") == pytest.approx(0.4, abs=0.001)
        assert distance(wrist(at(pilot, 2.9)), wrist(at(pilot, 0.0))) < 0.01
        assert pilot.feedback.warnings == []


@pytest.mark.parametrize("avatar", AVATARS)
async def test_places_are_in_proportion_to_the_body(open_still: OpenStill, avatar: str) -> None:
    there = (
        "LocShoulder LocCCenter LocNorm",
        "LocStomach LocPeripheryRight LocNorm",
        "LocHead LocPeripheryRight LocNorm",
    )
    values = [("start", there[0]), ("via", there[1]), ("end", there[2])]
    inside = dynamic("HandLocation", *values).replace('"via"', '"via" id="middle"')
    async with open_still(avatar=avatar) as pilot:
        begun, ended = await played(pilot, inside, 4.0)
        middle = at(pilot, time(pilot, "middle"))
        skeleton = begun.skeleton
        stands = Body(skeleton)
        root, shoulder, eye = (
            stands.transform(j).position[1] for j in ("HumanoidRoot", "r_shoulder", "r_eyeball_joint")
        )
        arm = arm_length(skeleton)
        assert wrist(begun) == pytest.approx((0.0, shoulder - root, 0.55 * arm), abs=0.01)
        assert wrist(middle)[1] == pytest.approx(0.3 * (shoulder - root), abs=0.01)
        assert math.degrees(math.atan2(wrist(middle)[0], wrist(middle)[2])) == pytest.approx(-50.0, abs=1.0)
        assert wrist(ended)[1] == pytest.approx(eye - root, abs=0.02)
        assert pilot.feedback.warnings == []


@pytest.mark.parametrize(("kind", "more", "bulge"), [
    ("linear", (), 0.0),
    ("curve", (("normal", "DirU"), ("extent", "Flat"), ("shape", "LeftC")), 0.25),
    ("curve", (("normal", "DirU"), ("extent", "0.1"), ("shape", "RightC")), -0.1),
])  # fmt: skip
async def test_a_hand_moves_on_a_line_or_on_a_curve(
    open_still: OpenStill, kind: str, more: tuple[tuple[str, str], ...], bulge: float
) -> None:
    ends = (("start", "-0.25 0.15 0.15"), ("end", "-0.25 0.15 0.35"))
    async with open_still() as pilot:
        await played(pilot, dynamic("HandLocation", *ends, *more, kind=kind))
        first, last = (round(FRAMES * time(pilot, point)) + 1 for point in ("strokeStart", "strokeEnd"))
        path = np.array([wrist(body) for body in pilot.bodies()[first:last]])
        assert path[:, 2].min() == pytest.approx(0.15, abs=0.01)
        assert path[:, 2].max() == pytest.approx(0.35, abs=0.01)
        assert np.diff(path[:, 2]).min() > -0.001
        aside = path[:, 0] + 0.25
        assert aside[np.abs(aside).argmax()] == pytest.approx(0.2 * bulge, abs=0.004)
        assert np.abs(path[:, 1] - 0.15).max() < 0.004


async def curve(open_still: OpenStill, shape: str, *more: tuple[str, str]) -> np.ndarray:
    """The way of a hand through a curve: ahead and to the left, in lengths of its chord."""
    ends = (("start", "-0.25 0.15 0.15"), ("end", "-0.25 0.15 0.35"))
    form = (("normal", "DirU"), ("extent", "Normal"), ("shape", shape))
    async with open_still() as pilot:
        await played(pilot, dynamic("HandLocation", *ends, *form, *more, kind="curve"))
        assert pilot.feedback.warnings == []
        first, last = (round(FRAMES * time(pilot, point)) + 1 for point in ("strokeStart", "strokeEnd"))
        path = np.array([wrist(body) for body in pilot.bodies()[first:last]])
        return np.stack([path[:, 2] - 0.15, path[:, 0] + 0.25], axis=1) / 0.2


def top(way: np.ndarray) -> float:
    """Where a curve is highest, along its chord."""
    return float(way[way[:, 1].argmax(), 0])


def breadth(way: np.ndarray) -> float:
    """How much of its chord a curve is above three quarters of its height."""
    high = way[way[:, 1] > 0.75 * way[:, 1].max(), 0]
    return float(high.max() - high.min())


async def test_a_curve_is_broad_or_pointed(open_still: OpenStill) -> None:
    sharp, usual, broad = [
        breadth(await curve(open_still, "LeftC", *more))
        for more in ((("roundness", "Sharp"),), (), (("roundness", "Broad"),))
    ]
    assert sharp < 0.25 < 0.4 < usual < 0.55 < 0.7 < broad


async def test_a_curve_is_highest_toward_its_start_or_its_end(open_still: OpenStill) -> None:
    early, usual, late = [
        top(await curve(open_still, "LeftC", *more))
        for more in ((("skewedness", "FunnelS"),), (), (("skewedness", "0.8"),))
    ]
    assert early < 0.35 < 0.45 < usual < 0.55 < 0.65 < late


async def test_one_half_of_a_double_curve_is_lower(open_still: OpenStill) -> None:
    way = await curve(open_still, "LeftS", ("skewedness", "FunnelE"))
    assert way[:, 1].max() < 0.75 * -way[:, 1].min()


@pytest.mark.parametrize("avatar", AVATARS)
async def test_two_hands_are_mirrored(open_still: OpenStill, avatar: str) -> None:
    moved = dynamic(
        "HandLocation",
        ("start", "LocLowerChest LocCenterRight LocNorm"),
        ("end", "LocStomach LocPeripheryRight LocFar"),
    )
    pose = together(moved, static("PalmOrientation", "PalmL"), static("ExtFingerOrientation", "DirA"))
    inside = f'<symmetrical dominant="right_arm" symmetry="SymMS">{pose}</symmetrical>'
    async with open_still(avatar=avatar) as pilot:
        for body in await played(pilot, inside):
            (x, y, z), (palm, _, _) = wrist(body), heading(body, BodyAxis.PALM)
            assert wrist(body, "l") == pytest.approx((-x, y, z), abs=0.005)
            assert heading(body, BodyAxis.PALM, "l")[0] == pytest.approx(-palm, abs=0.05)
            assert palm > 0.8
            assert degrees(heading(body, BodyAxis.FINGERS), (0.0, 0.0, 1.0)) < 15.0


async def test_movements_in_a_sequence_come_one_after_another(open_still: OpenStill) -> None:
    way = (("start", "-0.2 0.2 0.3"), ("direction", "DirU"), ("distance", "0.3"))
    inside = f"<sequence>{dynamic('HandLocation', *way)}{static('HandLocation', '-0.3 0.1 0.3')}</sequence>"
    async with open_still() as pilot:
        begun, ended = await played(pilot, inside)
        assert distance(wrist(begun), (-0.2, 0.2, 0.3)) < 0.005
        assert distance(wrist(ended), (-0.3, 0.1, 0.3)) < 0.005
        high = max(wrist(body)[1] for body in pilot.bodies())
        assert high == pytest.approx(0.2 + 0.3 * arm_length(begun.skeleton), abs=0.01)


async def test_the_stroke_comes_at_the_times_of_its_constraints_and_moves_with_them(pilot: RealizerPilot) -> None:
    ends = (("start", "-0.2 0.1 0.3"), ("end", "-0.2 0.3 0.3"))
    pilot.watch()
    pilot.predict("music", "beat", 2.0)
    pilot.perform(
        document(dynamic("HandLocation", *ends), 'id="g" strokeStart="1.2" strokeEnd="anticipators:music:beat"')
    )
    await pilot.advance(0.5)
    pilot.predict("music", "beat", 2.4)
    await pilot.advance(4.0)
    assert (time(pilot, "strokeStart"), time(pilot, "strokeEnd")) == pytest.approx((1.2, 2.4))
    assert distance(wrist(at(pilot, 1.22)), (-0.2, 0.1, 0.3)) < 0.01
    assert distance(wrist(at(pilot, 2.4)), (-0.2, 0.3, 0.3)) < 0.01


@pytest.mark.parametrize("avatar", AVATARS)
async def test_key_frames_turn_joints_by_roll_pitch_and_yaw_at_their_times(open_still: OpenStill, avatar: str) -> None:
    frames = (
        '<frame ftime="0.6"><posture>Humanoid (l_shoulder 3 70 0 0) (l_elbow 3 0 -40 0)</posture></frame>'
        '<frame ftime="1.2"><posture>Humanoid (l_shoulder 3 20 -30 10) (l_elbow 3 0 -40 0)</posture></frame>'
    )
    inside = f'<dynamic><keyframing easescale="10"><phase>{frames}</phase></keyframing></dynamic>'
    async with open_still(avatar=avatar) as pilot:
        pilot.perform(document(inside))
        await pilot.advance(3.0)
        first, second = at(pilot, 0.6), at(pilot, 1.2)
        raised = from_axis_angle((0.0, 0.0, 1.0), math.radians(70.0))
        assert angle(difference(first.rotation("l_shoulder"), raised)) < 0.02
        bent = from_axis_angle((1.0, 0.0, 0.0), math.radians(-40.0))
        assert angle(difference(second.rotation("l_elbow"), bent)) < 0.02
        # Roll first, then pitch, then yaw: an arm that hangs is rolled aside, pitched ahead, and turned to the left.
        hanging = rotate(second.rotation("l_shoulder"), (0.0, -1.0, 0.0))
        roll, pitch, yaw = (math.radians(each) for each in (20.0, -30.0, 10.0))
        x, y, z = math.sin(roll), -math.cos(roll), 0.0
        y, z = y * math.cos(pitch) - z * math.sin(pitch), y * math.sin(pitch) + z * math.cos(pitch)
        x, z = x * math.cos(yaw) + z * math.sin(yaw), z * math.cos(yaw) - x * math.sin(yaw)
        assert degrees(hanging, (x, y, z)) < 1.0
        assert (time(pilot, "ready"), time(pilot, "strokeEnd"), time(pilot, "relax")) == pytest.approx((0.6, 1.2, 1.2))
        assert distance(wrist(at(pilot, 2.9), "l"), wrist(at(pilot, 0.0), "l")) < 0.01
        assert pilot.feedback.warnings == []


def raised_aside(more: str, attributes: str = "") -> str:
    """Key frames that turn the left shoulder by 30 degrees about the axis ahead, from 0.6 to 1.2 s."""
    frames = "".join(
        f'<frame ftime="{ftime}"><posture>Humanoid (l_shoulder 3 30 0 0)</posture></frame>' for ftime in (0.6, 1.2)
    )
    inside = f"<dynamic><keyframing {attributes}><phase>{frames}</phase></keyframing></dynamic>"
    murml = f'<murmlgesture xmlns="{MURML}" id="g"><murml-description>{inside}</murml-description></murmlgesture>'
    return f'<bml xmlns="{BML}" id="b">{murml}{more}</bml>'


LIFTED = """<rr:keyPoses xmlns:rr="urn:reactive-realizer:1" id="k" group="LEFT_ARM" start="0">
  <rr:keyPose time="0.3" hold="3"><rr:position target="0.3 0.2 0.3" joint="l_wrist"/></rr:keyPose>
</rr:keyPoses>"""


@pytest.mark.parametrize(("attributes", "ready"), [("", 0.6), ('dont_insert_startframe="true"', 0.0)])
async def test_superposed_key_frames_are_added_to_what_the_joints_do(
    open_still: OpenStill, attributes: str, ready: float
) -> None:
    turned = dict[str, list[Body]]()
    for name, mode in (("none", ""), ("added", f'applymode="superpose" {attributes}')):
        async with open_still() as pilot:
            text = raised_aside(LIFTED, mode)
            pilot.perform(text if mode else f'<bml xmlns="{BML}" id="b">{LIFTED}</bml>')
            await pilot.advance(3.0)
            turned[name] = pilot.bodies()
            assert pilot.feedback.warnings == []
            if mode:
                assert (time(pilot, "ready"), time(pilot, "relax")) == pytest.approx((ready, 1.2))
    ways = [
        math.degrees(angle(difference(before.rotation("l_shoulder"), after.rotation("l_shoulder"))))
        for before, after in zip(turned["none"], turned["added"], strict=True)
    ]
    assert ways[round(0.9 * FRAMES)] == pytest.approx(30.0, abs=0.5)
    assert max(ways) < 30.5
    assert max(abs(after - before) for before, after in pairwise(ways)) < 8.0, "without a jump"
    assert (ways[0], ways[-1]) == pytest.approx((0.0, 0.0), abs=0.1)


async def test_other_key_frames_replace_what_the_joints_do(open_still: OpenStill) -> None:
    async with open_still() as pilot:
        pilot.perform(raised_aside(LIFTED))
        await pilot.advance(2.0)
        aside = from_axis_angle((0.0, 0.0, 1.0), math.radians(30.0))
        assert angle(difference(at(pilot, 0.9).rotation("l_shoulder"), aside)) < 0.02


FACE = (
    f'<murml-description xmlns="{MURML}"><dynamic><keyframing><phase>'
    '<frame ftime="0.5"><posture>Humanoid (jawOpen 1 80)</posture></frame>'
    '<frame ftime="1"><posture>Humanoid (jawOpen 1 0)</posture>'
    "</frame></phase></keyframing></dynamic></murml-description>"
)


async def test_key_frames_of_a_face_are_weights_at_times_and_a_form_of_other_faces(open_still: OpenStill) -> None:
    form = f'<description priority="2" type="murmlface">{FACE}</description>'
    async with open_still() as pilot:
        pilot.block("b", f'<faceLexeme id="f" lexeme="SMILE">{form}</faceLexeme>')
        await pilot.advance(2.0)
        morphs = pilot.realizer.characters["alice"].humanoid.avatar.morphs
        jaw, smile = (morphs.index(name) for name in ("jawOpen", "mouthSmileLeft"))
        weights = [frame.weights[jaw] for frame in pilot.frames["alice"]]
        assert weights[25] == pytest.approx(0.8, abs=0.01)
        assert weights[12] == pytest.approx(0.4, abs=0.05)
        assert weights[60] == pytest.approx(0.0, abs=0.01)
        assert all(frame.weights[smile] < 0.1 for frame in pilot.frames["alice"])
        assert pilot.feedback.time("b:f:attackPeak") == pytest.approx(0.5)
        assert pilot.feedback.time("b:f:end") == pytest.approx(1.0)
        assert pilot.feedback.warnings == []


async def test_a_description_of_a_gesture_is_played_by_its_priority_with_the_hand_of_its_mode(
    open_still: OpenStill,
) -> None:
    pose = f'<murml-description xmlns="{MURML}"><static slot="HandLocation" value="{{}}"/></murml-description>'
    first, second = (
        f'<description priority="{priority}" type="murmlgesture">{pose.format(place)}</description>'
        for priority, place in ((1, "0.2 0.1 0.3"), (2, "0.2 0.3 0.3"))
    )
    async with open_still() as pilot:
        pilot.block("b", f'<gesture id="g" lexeme="BEAT" mode="LEFT_HAND" stroke="1.5">{first}{second}</gesture>')
        await pilot.advance(3.0)
        assert time(pilot, "stroke") == pytest.approx(1.5)
        assert distance(wrist(at(pilot, 1.6), "l"), (0.2, 0.3, 0.3)) < 0.005
        assert pilot.feedback.warnings == []


BINDING = """<gesturebinding>
  <TimedMotionUnitSpec type="gesture">
    <constraints><constraint name="lexeme" value="HEY"/></constraints>
    <TimedMotionUnit type="MURML" file="hey.xml"/>
  </TimedMotionUnitSpec>
  <TimedMotionUnitSpec type="gesture">
    <constraints><constraint name="lexeme" value="HO"/></constraints>
    <TimedMotionUnit type="MURML">
      <murml-description xmlns="{}"><static slot="HandLocation" value="-0.2 0.1 0.3"/></murml-description>
    </TimedMotionUnit>
  </TimedMotionUnitSpec>
</gesturebinding>"""


async def test_a_binding_names_a_file_or_contains_a_description(tmp_path: Path) -> None:
    (tmp_path / "binding.xml").write_text(BINDING.format(MURML))
    inside = f"{static('HandLocation', '-0.2 0.3 0.3')}\n{static('PalmOrientation', 'PalmX')}"
    (tmp_path / "hey.xml").write_text(
        f'<murml-description xmlns="{MURML}"><parallel>{inside}</parallel></murml-description>'
    )
    human = tmp_path / "human.toml"
    human.write_text(
        '[character.alice]\navatar = "avatars/female.glb"\nidle = false\nbindings.gesture = "binding.xml"\n'
    )
    async with open_pilot(SceneOptions(human, "text", (tmp_path,), verify=True)) as pilot:
        pilot.watch()
        pilot.block("b", '<gesture id="g" lexeme="HEY" strokeEnd="1"/><gesture id="h" lexeme="HO" strokeEnd="3"/>')
        await pilot.advance(4.0)
        assert distance(wrist(at(pilot, 1.0)), (-0.2, 0.3, 0.3)) < 0.005
        assert distance(wrist(at(pilot, 3.0)), (-0.2, 0.1, 0.3)) < 0.005
        assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:g"]
        assert "hey.xml, line 2" in pilot.feedback.raw[0]


async def test_what_a_figure_lacks_is_named_and_the_rest_plays(open_still: OpenStill) -> None:
    hand = together(static("HandLocation", "-0.2 0.3 0.3"), static("HandShape", "ASLx"))
    frames = '<frame ftime="0.5"><posture>Humanoid (tail 3 1 2 3) (vc2 3 20 0 0)</posture></frame>'
    nod = f"<dynamic><keyframing><phase>{frames}</phase></keyframing></dynamic>"
    async with open_still() as pilot:
        pilot.perform(document(hand) + document(nod, 'id="n" start="b:end"').replace('id="b"', 'id="c"'))
        await pilot.advance(4.0)
        assert distance(wrist(at(pilot, time(pilot, "strokeEnd"))), (-0.2, 0.3, 0.3)) < 0.005
        tilted = at(pilot, time_of(pilot, "c:n:ready"))
        assert angle(tilted.rotation("vc4")) > 0.3
        assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:g", "c:n"]


def time_of(pilot: RealizerPilot, point: str) -> float:
    found = pilot.feedback.time(point)
    assert found is not None
    return found
