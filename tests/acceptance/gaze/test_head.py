"""Trunk, neck and head in gazes (D. Tweed's model; thesis 4.2.2), in frames."""

import math
import re
from itertools import pairwise
from typing import Any

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.quaternion import angle, conjugate, difference, multiply, rotate
from reactive_realizer.embodiment.quaternion import between as shortest
from reactive_realizer.embodiment.vector import FORWARD, subtract, unit
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .seen import FAR, at, between, miss, place, put, sight, speeds


@pytest.mark.parametrize(("yaw", "pitch"), [(40, 0), (-40, 0), (0, 30), (0, -30), (40, 25), (-40, 25)])
async def test_the_head_turns_by_nine_tenths_to_the_side_by_three_tenths_up_and_rolls_by_donders_law(
    pilot: RealizerPilot, yaw: int, pitch: int
) -> None:
    put(pilot, "t", yaw, pitch, FAR)
    pilot.block("b", '<gaze id="g" target="t" start="0" end="4"/>')
    await pilot.advance(2)
    first, last = (body.transform("skullbase").rotation for body in (pilot.bodies()[4], pilot.bodies()[-1]))
    _, x, y, z = multiply(last, conjugate(first))
    whole = shortest(FORWARD, unit(subtract(place(pilot, yaw, pitch, FAR), place(pilot, 0, 0, 0.0))))
    # A figure that breathes is never quite still.
    assert (x, y, z) == pytest.approx((0.3 * whole[1], 0.9 * whole[2], -0.15 * whole[1] * whole[2]), abs=0.012)


async def test_the_final_head_pose_does_not_depend_on_the_initial_one(pilot: RealizerPilot) -> None:
    put(pilot, "first", -40, 25)
    put(pilot, "second", 35, 20)
    gazes = '<gaze id="a" target="first" start="0" end="3"/><gaze id="b" target="second" start="{}" end="{}"/>'
    pilot.block("b", gazes.format(3.0, 6.0))
    await pilot.advance(5)
    around = pilot.bodies()[-1].transform("skullbase").rotation
    async with open_pilot(SceneOptions(voice="text")) as other:
        other.watch()
        await other.advance(0.1)
        put(other, "second", 35, 20)
        other.block("b", '<gaze id="b" target="second" start="3" end="6"/>')
        await other.advance(5)
        straight = other.bodies()[-1].transform("skullbase").rotation
    assert math.degrees(angle(difference(around, straight))) < 0.1


async def test_the_head_turns_about_one_axis_and_fastest_half_way(pilot: RealizerPilot) -> None:
    put(pilot, "t", 50, 20)
    pilot.block("b", '<gaze id="g" target="t" start="0" ready="1" end="4"/>')
    await pilot.advance(1.2)
    shown = pilot.bodies()
    start, ready = (at(pilot, pilot.feedback.time(f"b:g:{sync}")) for sync in ("start", "ready"))
    first = shown[start].transform("skullbase").rotation
    turns = [difference(first, body.transform("skullbase").rotation) for body in shown[start : ready + 1]]
    axes = [unit(turn[1:]) for turn in turns[15:]]
    assert max(between(axis, axes[-1]) for axis in axes) < 4
    steps = [angle(b) - angle(a) for a, b in pairwise(turns)]
    assert abs(steps.index(max(steps)) - len(steps) / 2) <= 2
    assert max(steps) == pytest.approx(1.875 * angle(turns[-1]) / len(steps), rel=0.1)


SLOW = '<bmlt:parameter name="speed" value="20"/>'


@pytest.mark.parametrize("element", ["gaze", "gazeShift", "headDirectionShift"])
async def test_a_behavior_may_limit_the_speed_of_the_head(pilot: RealizerPilot, element: str) -> None:
    put(pilot, "t", 40, 0)
    pilot.block("b", f'<{element} id="g" target="t" start="0">{SLOW}</{element}>')
    await pilot.advance(8)
    arrival = "ready" if element == "gaze" else "end"
    arrived = pilot.feedback.time(f"b:g:{arrival}")
    assert 3.0 < arrived < 4.5
    fastest = math.degrees(max(speeds(pilot.bodies()[: at(pilot, arrived)], "skullbase")))
    assert fastest == pytest.approx(20.0, rel=0.15)
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("roll", [15, -15])
async def test_a_behavior_may_tilt_the_head_without_losing_its_target(pilot: RealizerPilot, roll: int) -> None:
    there = put(pilot, "t", 20, 0)
    tilt = f'<bmlt:parameter name="roll" value="{roll}"/>'
    pilot.block("b", f'<gaze id="g" target="t" start="0" end="6">{tilt}</gaze>')
    await pilot.advance(3)
    body = pilot.bodies()[-1]
    ear = rotate(body.transform("skullbase").rotation, (1.0, 0.0, 0.0))
    assert math.degrees(math.asin(ear[1])) == pytest.approx(roll, abs=2)
    assert miss(body, there) < 0.5
    assert pilot.feedback.warnings == []


async def test_a_limit_beyond_the_usual_speed_of_a_head_changes_nothing(pilot: RealizerPilot) -> None:
    put(pilot, "t", 40, 0)
    pilot.block("b", '<gaze id="g" target="t" start="0"/>')
    await pilot.advance(4)
    pilot.block("c", f'<gaze id="g" target="t" start="0">{SLOW.replace("20", "800")}</gaze>')
    await pilot.advance(4)
    usual, limited = (pilot.feedback.time(f"{name}:g:ready") for name in "bc")
    assert limited - 4.0 == pytest.approx(usual)


@pytest.mark.parametrize(
    ("influence", "joints"),
    [
        ("EYES", set()),
        ("HEAD", {"vc4", "skullbase"}),
        ("SHOULDER", {"vt10", "vt6", "vc4", "skullbase"}),
        ("WAIST", {"vl5", "vt10", "vt6", "vc4", "skullbase"}),
        ("WHOLE", {"vl5", "vt10", "vt6", "vc4", "skullbase"}),
    ],
)
async def test_an_influence_turns_its_joints_and_no_others(pilot: RealizerPilot, influence: str, joints: Any) -> None:
    put(pilot, "t", 60 if joints else 20, 0)
    pilot.block("b", f'<gaze id="g" target="t" influence="{influence}" start="0" end="4"/>')
    await pilot.advance(2)
    first, last = pilot.bodies()[4], pilot.bodies()[-1]
    spine = ("vl5", "vt10", "vt6", "vc4", "skullbase", "l_hip", "r_hip", "HumanoidRoot")
    turned = {joint for joint in spine if angle(difference(first.rotation(joint), last.rotation(joint))) > 0.05}
    assert turned == joints


@pytest.mark.parametrize("written", [str.lower, str.upper])
async def test_a_behavior_may_set_the_weight_of_each_group_of_joints(pilot: RealizerPilot, written: Any) -> None:
    """By the names that SmartBody has for them, in any case."""
    put(pilot, "t", 40, 0)
    weights = {"back": 0.5, "chest": 0, "neck": 0.25, "head": 0.25, "eyes": 1}
    said = "".join(f'<bmlt:parameter name="{written(name)}" value="{weight}"/>' for name, weight in weights.items())
    pilot.block("b", f'<gaze id="g" target="t" start="0" end="4">{said}</gaze>')
    await pilot.advance(2)
    assert not pilot.feedback.warnings
    first, last = pilot.bodies()[4], pilot.bodies()[-1]
    turns = {
        joint: math.degrees(angle(difference(first.rotation(joint), last.rotation(joint))))
        for joint in ("vl5", "vt10", "vt6", "vc4", "skullbase")
    }
    assert turns == pytest.approx({"vl5": 18, "vt10": 0, "vt6": 0, "vc4": 9, "skullbase": 9}, abs=1.0)


@pytest.mark.parametrize("name", ["head", "HEAD"])
async def test_the_weights_of_a_gaze_may_change_while_it_plays(pilot: RealizerPilot, name: str) -> None:
    target = put(pilot, "t", 30, 0)
    pilot.block(
        "b",
        '<gaze id="g" target="t" start="0" end="6"/>'
        f'<bmla:parametervaluechange id="p" target="b:g" paramId="{name}" start="2" end="3">'
        '<bmla:trajectory type="linear" targetValue="0"/></bmla:parametervaluechange>',
    )
    await pilot.advance(4)
    shown = pilot.bodies()
    assert not pilot.feedback.warnings
    assert math.degrees(angle(shown[at(pilot, 1.9)].rotation("skullbase"))) > 10
    assert math.degrees(angle(shown[-1].rotation("skullbase"))) < 2
    assert max(speeds(shown[at(pilot, 1.9) :], "skullbase")) < 0.6
    assert max(miss(body, target) for body in shown[at(pilot, 1.9) :]) < 0.5


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize(("influence", "furthest"), [("HEAD", 77.4), ("SHOULDER", 106.0), ("WAIST", 126.1)])
async def test_joints_turn_to_their_limits_for_a_target_behind(
    pilot: RealizerPilot, influence: str, furthest: float, side: int
) -> None:
    """The limits of the joints, and 40.5 degrees of the eyes; then it is said by how much the target is missed.

    The figure sits, so that it does not turn on its feet.
    """
    target = put(pilot, "t", side * 174, 0, FAR)
    pilot.block("a", '<postureShift id="p" start="0" end="1"><stance type="SITTING"/></postureShift>')
    await pilot.advance(2)
    first = pilot.bodies()[-1]
    pilot.block("b", f'<gaze id="g" target="t" influence="{influence}" start="0" ready="1.5" end="6"/>')
    await pilot.advance(3)
    last = pilot.bodies()[-1]
    assert between(sight(first, "skullbase"), sight(last, "skullbase")) == pytest.approx(furthest, abs=1.5)
    assert miss(last, target) == pytest.approx(174 - furthest - 40.5, abs=2.0)
    (warning,) = pilot.feedback.of("warningFeedback")
    (said,) = re.findall(r"stays (\d+) degrees short", warning.text)
    assert int(said) == pytest.approx(174 - furthest - 40.5, abs=2.0)
