"""Mixed dynamics (thesis, chapter 3 and 8.7): controllers move joints by forces beside motions that are exact."""

import itertools
import math

import numpy as np
import pytest
from lxml import etree

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.joints import LEFT_ARM
from reactive_realizer.embodiment.quaternion import angle, difference
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

BALANCE = '<bmlt:controller id="balance" class="BalanceController" start="{}"/>'
LOOSE = '<bmlt:controller id="loose" class="CompoundController" name="leftarmhang" start="{}"/>'


def angles(pilot: RealizerPilot, joint: str) -> list[float]:
    """How far a joint is turned in each frame, degrees."""
    return [math.degrees(angle(body.rotation(joint))) for body in pilot.bodies()]


def kicks(pilot: RealizerPilot, joints: frozenset[str]) -> float:
    """The greatest change of the speed of joints between two frames, degrees/s."""
    bodies = pilot.bodies()
    turns = [
        [math.degrees(angle(difference(a.rotation(joint), b.rotation(joint)))) for joint in sorted(joints)]
        for a, b in itertools.pairwise(bodies)
    ]
    return float(np.abs(np.diff(np.array(turns) / 0.02, axis=0)).max())


def height(pilot: RealizerPilot) -> float:
    """Of the head above the ground in the last frame, m."""
    return pilot.bodies()[-1].transform("skullbase").position[1]


async def test_a_figure_that_balances_sways_and_stands(pilot: RealizerPilot) -> None:
    pilot.watch()
    pilot.block("b", BALANCE.format(1))
    await pilot.advance(0.9)
    tall = height(pilot)
    await pilot.advance(5)
    roots = np.array([body.root for body in pilot.bodies()])
    assert height(pilot) > 0.97 * tall
    assert 0.001 < np.ptp(roots[-100:], axis=0).max() < 0.03
    assert kicks(pilot, frozenset({"l_hip", "l_knee", "l_ankle"})) < 100.0
    assert pilot.feedback.warnings == []


async def test_what_the_arms_do_moves_the_body_that_balances_but_not_the_arms() -> None:
    async def conduct(behaviors: str) -> RealizerPilot:
        async with open_pilot(SceneOptions(voice="text")) as pilot:
            pilot.watch()
            beats = (
                f'<bmlt:procanimation id="c{n}" name="conduct-3-beat" start="{1 + 2 * n}" end="{3 + 2 * n}"/>'
                for n in range(2)
            )
            pilot.block("b", "".join((*beats, behaviors)))
            await pilot.advance(4)
            return pilot

    loose, plain = [await conduct(behaviors) for behaviors in (BALANCE.format(0), "")]
    for joint in ("r_shoulder", "r_elbow", "r_wrist"):
        pairs = zip(loose.bodies(), plain.bodies(), strict=True)
        assert max(angle(difference(a.rotation(joint), b.rotation(joint))) for a, b in pairs) < 1e-4
    points = [
        {each.id: each.element.get("globalTime") for each in pilot.feedback.of("syncPointProgress") if ":c" in each.id}
        for pilot in (loose, plain)
    ]
    assert points[0] == points[1]
    assert max(angles(loose, "l_hip")) > 1.2 > max(angles(plain, "l_hip"))


async def test_a_gesture_takes_a_loose_arm_and_gives_it_back_without_a_jump(pilot: RealizerPilot) -> None:
    pilot.watch()
    pilot.block("b", LOOSE.format(0.5) + '<gesture id="g" lexeme="OFFER" mode="LEFT_HAND" start="1.2"/>')
    await pilot.advance(6)
    assert kicks(pilot, LEFT_ARM & frozenset({"l_shoulder", "l_elbow"})) < 160.0
    assert max(angles(pilot, "l_elbow")) > 60.0
    assert angles(pilot, "l_elbow")[-1] < 25.0
    for point in ("start", "ready", "stroke", "relax", "end"):
        assert pilot.feedback.reached(f"b:g:{point}")


async def test_a_controller_is_persistent_and_ends_with_a_replacing_block(pilot: RealizerPilot) -> None:
    pilot.watch()
    limp = '<bmlt:parameter name="joints" value="l_shoulder l_elbow"/>'
    pilot.block("b", f'<bmlt:controller id="loose" class="RagdollController" start="0.5">{limp}</bmlt:controller>')
    await pilot.advance(0.4)
    rest = angles(pilot, "l_elbow")[-1]
    await pilot.advance(4)
    assert not pilot.feedback.reached("b:loose:end")
    loose = angles(pilot, "l_elbow")[-1]
    pilot.block("c", composition="REPLACE")
    await pilot.advance(2)
    assert pilot.feedback.reached("b:loose:end")
    assert abs(rest - loose) > 5.0
    assert angles(pilot, "l_elbow")[-1] == pytest.approx(rest, abs=1.0)


async def test_a_controller_may_have_an_end(pilot: RealizerPilot) -> None:
    pilot.block("b", '<bmlt:controller id="x" class="RagdollController" start="0.5" end="2"/>')
    await pilot.advance(3)
    assert pilot.feedback.time("b:x:end") == pytest.approx(2.0)
    assert pilot.feedback.reached("b:end")


async def test_a_push_moves_a_figure_that_balances_and_it_recovers(pilot: RealizerPilot) -> None:
    pilot.watch()
    pilot.block("b", BALANCE.format(0))
    await pilot.advance(3)
    before = pilot.bodies()[-1].root
    pilot.push("vt10", (0.0, 0.0, 40.0), 1.0)
    await pilot.advance(1)
    assert pilot.bodies()[-1].root[2] - before[2] > 0.01
    await pilot.advance(4)
    assert pilot.bodies()[-1].root == pytest.approx(before, abs=0.01)
    assert pilot.feedback.of("fall") == []


async def test_a_figure_that_is_pushed_hard_falls_tells_it_once_and_is_put_back_by_a_replacing_block(
    pilot: RealizerPilot,
) -> None:
    pilot.watch()
    pilot.block("b", BALANCE.format(0))
    await pilot.advance(1.5)
    standing = height(pilot)
    pilot.push("vt10", (0.0, 0.0, 300.0), 0.5)
    await pilot.advance(2.5)
    (fall,) = pilot.feedback.of("fall")
    assert fall.id == "b:balance"
    assert fall.element.get("characterId") == "alice"
    assert 2.0 < fall.global_time < 3.5
    assert height(pilot) < 0.5 * standing
    pilot.block("c", composition="REPLACE")
    await pilot.advance(4)
    assert height(pilot) == pytest.approx(standing, abs=0.03)
    assert len(pilot.feedback.of("fall")) == 1


async def test_a_push_without_bounds_ends_the_controllers_with_a_warning_and_motions_go_on(
    pilot: RealizerPilot,
) -> None:
    pilot.watch()
    pilot.block("b", BALANCE.format(0) + '<gesture id="g" lexeme="BEAT" start="3"/>')
    await pilot.advance(2)
    standing = height(pilot)
    pilot.push("vt10", (0.0, 0.0, 1e9), 1.0)
    await pilot.advance(4)
    assert pilot.feedback.warnings == [("b:balance", "EXECUTION_FAILURE")]
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "the simulation of the body cannot go on" in warning.text
    assert pilot.feedback.reached("b:g:end")
    assert height(pilot) == pytest.approx(standing, abs=0.03)
    assert all(np.isfinite(frame.rotations).all() and np.isfinite(frame.root).all() for frame in pilot.frames["alice"])


async def test_a_figure_that_no_controller_moves_does_not_give_way(pilot: RealizerPilot) -> None:
    pilot.watch()
    pilot.push("vt10", (0.0, 0.0, 1e9), 1.0)
    pilot.push("nowhere", (0.0, 0.0, 1.0), 1.0)
    await pilot.advance(1)
    assert np.ptp([body.root for body in pilot.bodies()], axis=0).max() < 0.01


@pytest.mark.parametrize(
    ("attributes", "why"),
    [
        ('class="DanceController"', "there is no controller 'DanceController'; available: BalanceController"),
        ('class="CompoundController" name="nothing"', "nothing"),
        ('class="HingeJointController"', "HingeJointController needs the parameter 'joint'"),
    ],
)
async def test_a_controller_that_cannot_be_made_is_warned_of(pilot: RealizerPilot, attributes: str, why: str) -> None:
    pilot.block("b", f'<bmlt:controller id="x" {attributes}/><head id="n" lexeme="NOD" start="0"/>')
    await pilot.advance(3)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert warning.id == "b:x"
    assert why in warning.text
    assert pilot.feedback.reached("b:n:end")


@pytest.mark.parametrize(
    ("kind", "parameters", "why"),
    [
        ("HingeJointController", {"joint": "l_tail"}, "no segment of the physical body turns about l_tail"),
        ("HingeJointController", {"joint": "l_elbow", "axis": "7"}, "'7' is not an axis"),
        ("BallJointController", {"joint": "l_elbow", "ksx": "1e12"}, "a number from 0 to 10000"),
        ("BalanceController", {"pelvisheight": "tall"}, "tall"),
        ("RagdollController", {"joints": "l_elbow l_tail"}, "l_tail"),
    ],
)
async def test_wrong_parameters_of_a_controller_are_warned_of(
    pilot: RealizerPilot, kind: str, parameters: dict[str, str], why: str
) -> None:
    given = "".join(f'<bmlt:parameter name="{name}" value="{value}"/>' for name, value in parameters.items())
    pilot.block("b", f'<bmlt:controller id="x" class="{kind}">{given}</bmlt:controller>')
    await pilot.advance(1)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert warning.id == "b:x"
    assert why in warning.text


async def test_parameters_of_a_controller_change_while_it_acts(pilot: RealizerPilot) -> None:
    pilot.watch()
    pilot.block("b", BALANCE.format(0))
    await pilot.advance(3)
    high = pilot.bodies()[-1].root[1]
    pilot.block(
        "c",
        '<bmlt:parametervaluechange id="p" target="b:balance" paramId="pelvisheight" start="0" end="1.5">'
        '<bmlt:trajectory type="linear" targetValue="0.8"/></bmlt:parametervaluechange>',
    )
    await pilot.advance(4)
    assert high - pilot.bodies()[-1].root[1] > 0.1
    assert max(angles(pilot, "l_knee")[-50:]) > 40.0
    assert pilot.feedback.warnings == []
    assert pilot.feedback.of("fall") == []


async def test_sessions_with_forces_are_equal_to_the_byte() -> None:
    async def play() -> tuple[list[str], list[bytes]]:
        async with open_pilot(SceneOptions(voice="text")) as pilot:
            pilot.watch()
            pilot.block("b", BALANCE.format(0) + LOOSE.format(0.2))
            await pilot.advance(1)
            pilot.push("vt10", (30.0, 0.0, 300.0), 0.5)
            await pilot.advance(2)
            frames = [frame.rotations.tobytes() for frame in pilot.frames["alice"]]
            return [etree.tostring(message.element, encoding="unicode") for message in pilot.feedback.messages], frames

    first, again = await play(), await play()
    assert any("<fall" in xml for xml in first[0])
    assert first == again
