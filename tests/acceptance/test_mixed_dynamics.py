"""Mixed dynamics (thesis, chapter 3 and 8.7): controllers move joints by forces beside motions that are exact."""

import itertools
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from lxml import etree

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.joints import LEFT_ARM, ROOT
from reactive_realizer.embodiment.quaternion import angle, difference
from reactive_realizer.realizer.inputs import TickInputs
from reactive_realizer.realizer.session import replay
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
    assert 0.0002 < np.ptp(roots[-100:], axis=0).max() < 0.03
    assert kicks(pilot, frozenset({"l_hip", "l_knee", "l_ankle"})) < 100.0
    assert pilot.feedback.warnings == []


async def test_a_figure_that_begins_to_balance_leans_over_its_feet_without_a_jerk(pilot: RealizerPilot) -> None:
    pilot.watch()
    pilot.block("b", BALANCE.format(0))
    await pilot.advance(3)
    for joint in (ROOT, "skullbase"):
        places = np.array([body.transform(joint).position for body in pilot.bodies()])
        velocities = np.diff(places, axis=0) / 0.02
        assert places[-1][2] - places[0][2] > 0.03
        assert np.abs(velocities).max() < 0.1
        assert velocities[:, 2].min() > -0.02


async def test_a_figure_that_conducts_and_balances_from_its_first_frame_on_stands(pilot: RealizerPilot) -> None:
    """Nothing was shown before: its arms do not come from their rest, and their way does not throw it."""
    pilot.block("b", BALANCE.format(0) + '<bmlt:procanimation id="c" name="conduct-3-beat" start="0" end="2"/>')
    await pilot.advance(0.1)
    pilot.watch()
    await pilot.advance(2)
    assert np.ptp([body.root for body in pilot.bodies()], axis=0).max() < 0.1  # it leans over its feet
    assert pilot.feedback.of("fall") == []


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


@pytest.mark.parametrize("direction", [0.48, 0.64, 0.8, 3.0])
async def test_a_figure_falls_in_any_direction_without_a_warning(pilot: RealizerPilot, direction: float) -> None:
    pilot.block("b", BALANCE.format(0))
    await pilot.advance(0.13)
    pilot.push("vl5", (300.0 * math.sin(direction), 0.0, 300.0 * math.cos(direction)), 0.2)
    await pilot.advance(2.5)
    assert pilot.feedback.warnings == []
    assert len(pilot.feedback.of("fall")) == 1


async def test_a_fall_names_the_controller_of_the_root(pilot: RealizerPilot) -> None:
    pilot.block("b", BALANCE.format(0) + LOOSE.format(0.1))
    await pilot.advance(0.5)
    pilot.push("vt10", (0.0, 0.0, 300.0), 0.5)
    await pilot.advance(2)
    assert [fall.id for fall in pilot.feedback.of("fall")] == ["b:balance"]


async def test_a_figure_that_lies_down_has_not_fallen(pilot: RealizerPilot) -> None:
    pilot.watch()
    pilot.block("b", '<posture id="p" start="0" end="9"><stance type="LYING"/></posture>' + LOOSE.format(0.5))
    await pilot.advance(4)
    assert height(pilot) < 0.5
    assert pilot.feedback.of("fall") == []


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


LOW = '<bmlt:parameter name="pelvisheight" value="0.8"/>'
SAME = '<bmlt:parameter name="replacementgroup" value="{}"/>'


async def test_a_session_that_was_watched_is_replayed_exactly_without_a_viewer() -> None:
    session: list[TickInputs] = []
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.realizer.record(session.append)
        pilot.watch()
        pilot.block("c", '<bmlt:procanimation id="c" name="conduct-3-beat" start="0.3" end="2.3"/>')
        pilot.block("b", BALANCE.format(1))
        await pilot.advance(2)
        pilot.push("vt10", (30.0, 0.0, 300.0), 0.5)
        await pilot.advance(2)
        (fall,) = pilot.feedback.of("fall")
    async with open_pilot(SceneOptions(voice="text")) as again:
        await replay(again.realizer, session)
        assert [etree.tostring(each.element) for each in again.feedback.messages] == [
            etree.tostring(each.element) for each in pilot.feedback.messages
        ]
        assert again.feedback.of("fall")[0].global_time == fall.global_time


def hips(pilot: RealizerPilot, times: Sequence[float]) -> list[float]:
    """The height of the hips at some times, m."""
    return [pilot.bodies()[round(time / 0.02)].transform("l_hip").position[1] for time in times]


async def test_of_one_replacement_group_the_controller_acts_that_started_last(pilot: RealizerPilot) -> None:
    """Thesis C.5, example 49."""
    pilot.watch()
    same = SAME.format("balance")
    pilot.block(
        "b",
        f'<bmlt:controller id="high" class="BalanceController" start="0">{same}</bmlt:controller>'
        f'<bmlt:controller id="low" class="BalanceController" start="1" end="2.5">{LOW}{same}</bmlt:controller>',
    )
    await pilot.advance(4)
    before, low, after = hips(pilot, (0.9, 2.4, 3.9))
    assert before - low > 0.1
    assert after == pytest.approx(before, abs=0.02)
    assert pilot.feedback.warnings == []


async def test_a_controller_takes_the_place_of_a_persistent_posture(pilot: RealizerPilot) -> None:
    """Thesis C.5, example 50."""
    pilot.watch()
    controller = f'<bmlt:controller id="low" class="BalanceController" start="1">{LOW}{SAME}</bmlt:controller>'
    pilot.block("b", f'<posture id="p"><stance type="STANDING"/></posture>{controller.format("posture")}')
    await pilot.advance(2.5)
    before, low = hips(pilot, (0.9, 2.4))
    assert before - low > 0.1
    assert pilot.feedback.warnings == []


async def test_no_controller_gives_an_arm_to_a_gesture(pilot: RealizerPilot) -> None:
    """Thesis 6.6.7, example 19."""
    pilot.watch()
    same = SAME.format("arm")
    pilot.block(
        "b",
        '<bmlt:controller id="loose" class="CompoundController" name="leftarmhang" start="0">'
        f'<bmlt:parameter name="shoulder:anglez" value="1.2"/><bmlt:parameter name="shoulder:ksz" value="100"/>{same}'
        "</bmlt:controller>"
        f'<bmlt:controller id="none" class="NoController" start="1" end="2">{same}</bmlt:controller>',
    )
    await pilot.advance(3)
    raised, taken, again = [angles(pilot, "l_shoulder")[round(time / 0.02)] for time in (0.9, 1.9, 2.9)]
    assert raised > 35.0
    assert taken < 25.0
    assert again > 35.0
    assert pilot.feedback.warnings == []


async def test_a_controller_may_describe_a_posture(pilot: RealizerPilot) -> None:
    """Thesis 6.6.6, example 18b."""
    pilot.watch()
    pilot.block(
        "b",
        '<posture id="p" start="0" end="2"><stance type="STANDING"/><description priority="1" type="bmlt:controller">'
        f'<bmlt:controller id="p" class="BalanceController">{LOW}</bmlt:controller></description></posture>',
    )
    await pilot.advance(3.5)
    low, after = hips(pilot, (1.9, 3.4))
    assert after - low > 0.1
    assert pilot.feedback.time("b:p:end") == pytest.approx(2.0)
    assert pilot.feedback.warnings == []


async def test_an_interrupted_arm_relaxes_into_a_controller(pilot: RealizerPilot) -> None:
    """Thesis 6.5.2, example 10c."""
    pilot.watch()
    pilot.block("talk", '<gesture id="g" lexeme="OFFER" mode="LEFT_HAND" start="0" end="4"/>')
    await pilot.advance(1.5)
    raised = angles(pilot, "l_elbow")[-1]
    pilot.block(
        "yield",
        '<bmlt:interrupt id="i" target="talk"/>'
        '<bmlt:controller id="relax" class="CompoundController" name="leftarmhang"/>',
    )
    await pilot.advance(2)
    assert raised > 60.0
    assert angles(pilot, "l_elbow")[-1] < 30.0
    assert kicks(pilot, frozenset({"l_shoulder", "l_elbow"})) < 160.0
    assert pilot.feedback.warnings == []


HANGING = """<CompoundController xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt">
  <required>
    <Controller class="hmi.physics.controller.BallJointController" id="upper">
      <bmlt:parameter name="joint" value="r_shoulder"/></Controller>
    <Controller class="hmi.physics.controller.HingeJointController" id="lower">
      <bmlt:parameter name="joint" value="r_elbow"/></Controller>
  </required>
  <desired>
    <Controller class="hmi.physics.controller.HingeJointController" id="hand">
      <bmlt:parameter name="joint" value="r_wrist"/><bmlt:parameter name="axis" value="2"/></Controller>
  </desired>
</CompoundController>"""


async def hung(folder: Path, text: str, joint: str) -> float:
    """How far a joint has moved when a compound controller has let it hang for a second, degrees."""
    (folder / "controllers").mkdir()
    (folder / "controllers/hanging.xml").write_text(text)
    async with open_pilot(SceneOptions(voice="text", assets=(folder,))) as pilot:
        pilot.watch()
        pilot.block("b", '<bmlt:controller id="x" class="CompoundController" name="hanging"/>')
        await pilot.advance(1)
        assert pilot.feedback.warnings == []
        return abs(angles(pilot, joint)[-1] - angles(pilot, joint)[0])


async def test_a_compound_controller_may_name_java_classes(tmp_path: Path) -> None:
    assert await hung(tmp_path, HANGING, "r_elbow") > 3.0


async def test_a_published_compound_controller_is_played_unchanged(tmp_path: Path, shared_cases: Path) -> None:
    assert await hung(tmp_path, (shared_cases / "asap/controllers/left_arm_hang.xml").read_text(), "l_elbow") > 3.0


@pytest.mark.parametrize(
    ("part", "why"),
    [
        ('class="BallJointController" id="x"', "BallJointController needs the parameter 'joint'"),
        ('class="DanceController" id="x"', "there is no controller 'DanceController'"),
        ('class="RagdollController"', "id"),
    ],
)
async def test_a_compound_controller_with_a_wrong_part_is_warned_of_with_its_line(
    tmp_path: Path, part: str, why: str
) -> None:
    (tmp_path / "controllers").mkdir()
    (tmp_path / "controllers/odd.xml").write_text(
        f"<CompoundController>\n<required><Controller {part}/></required></CompoundController>"
    )
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,))) as pilot:
        pilot.block("b", '<bmlt:controller id="x" class="CompoundController" name="odd"/><head id="n" lexeme="NOD"/>')
        await pilot.advance(2)
        (warning,) = pilot.feedback.of("warningFeedback")
        assert warning.id == "b:x"
        assert "odd.xml, line 2" in warning.text
        assert why in warning.text
        assert pilot.feedback.reached("b:n:end")


async def test_a_desired_part_that_cannot_be_made_is_left_out(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    desired = '<desired><Controller class="DanceController" id="y"/></desired></CompoundController>'
    assert await hung(tmp_path, HANGING.replace("</CompoundController>", desired), "r_elbow") > 3.0
    assert "there is no controller 'DanceController'" in caplog.text
