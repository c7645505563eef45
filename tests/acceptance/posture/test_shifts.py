"""`postureShift` (BML 1.0), which stays, from BML to feedback and frames."""

from pathlib import Path

import pytest

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.vector import subtract
from reactive_realizer.engine.lexicon import lexicon_of
from reactive_realizer.testing.pilot import RealizerPilot

from .standing import CROSSED, SIT, STAND, apart, body, crossed, sits


async def test_a_shift_stays_and_a_posture_returns_to_it(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<postureShift id="s">{SIT}</postureShift><posture id="p" start="3" end="7">{CROSSED}</posture>')
    await pilot.advance(11)
    assert pilot.feedback.progress[-1] == "b:end"
    for time in (2.9, 5.0, 8.0, 10.9):
        assert sits(body(pilot, time)), time
    assert crossed(body(pilot, 5.0))
    assert not crossed(body(pilot, 8.0))


GETTING_UP = 1.61
"""s that standing up from a chair takes."""


async def test_getting_up_takes_its_time_after_failed_plans(pilot: RealizerPilot) -> None:
    pilot.block("a", f'<postureShift id="s">{SIT}</postureShift>')
    await pilot.advance(3)
    assert lexicon_of(pilot.realizer.characters["alice"].engines)
    pilot.block("b", f'<postureShift id="s">{STAND}</postureShift>')
    await pilot.advance(3)
    assert pilot.feedback.time("b:s:end") - pilot.feedback.time("b:s:start") == pytest.approx(GETTING_UP, abs=0.02)


async def test_getting_up_takes_its_time_also_if_it_is_planned_together_with_sitting_down(pilot: RealizerPilot) -> None:
    pilot.block(
        "b", f'<postureShift id="down">{SIT}</postureShift><postureShift id="up" start="3">{STAND}</postureShift>'
    )
    await pilot.advance(6)
    assert pilot.feedback.time("b:up:end") - pilot.feedback.time("b:up:start") == pytest.approx(GETTING_UP, abs=0.02)


async def test_getting_up_takes_its_time_also_above_a_posture_that_sits_on(pilot: RealizerPilot) -> None:
    pilot.block("a", f'<posture id="p" start="0" end="12">{SIT}</posture>')
    await pilot.advance(4)
    pilot.block("b", f'<postureShift id="s">{STAND}</postureShift>')
    await pilot.advance(3)
    assert pilot.feedback.time("b:s:end") - pilot.feedback.time("b:s:start") == pytest.approx(GETTING_UP, abs=0.02)
    spine = [shown.rotation("vl5")[1] for shown in pilot.bodies()[200:280]]
    assert max(spine) - spine[0] > 0.1, "and one bows meanwhile"


async def test_getting_up_takes_its_time_when_it_replaces_everything(pilot: RealizerPilot) -> None:
    """A shift to sit has ended; a posture that sits still plays."""
    for number, sitting in enumerate(
        (f'<postureShift id="s">{SIT}</postureShift>', f'<posture id="p">{SIT}</posture>')
    ):
        pilot.block(f"a{number}", sitting)
        await pilot.advance(2.5)
        pilot.block(f"b{number}", f'<postureShift id="s">{STAND}</postureShift>', composition="REPLACE")
        await pilot.advance(3)
        start, end = (pilot.feedback.time(f"b{number}:s:{sync}") for sync in ("start", "end"))
        assert end - start == pytest.approx(GETTING_UP, abs=0.02)


async def test_moving_the_arms_takes_no_longer_for_a_sitting_figure(pilot: RealizerPilot) -> None:
    pilot.block("a", f'<posture id="p" start="0" end="12">{SIT}</posture>')
    await pilot.advance(4)
    pilot.block("b", f'<postureShift id="s">{CROSSED}</postureShift>')
    await pilot.advance(3)
    assert pilot.feedback.time("b:s:end") - pilot.feedback.time("b:s:start") < 1.0


async def test_a_shift_of_a_block_that_could_not_be_planned_is_not_expected(pilot: RealizerPilot) -> None:
    nobody = '<required><gesture id="g" lexeme="NOBODY_KNOWS"/></required>'
    pilot.block("a", f'<postureShift id="s">{SIT}</postureShift>{nobody}')
    await pilot.advance(0.1)
    assert not pilot.feedback.reached("a:start")
    pilot.block("b", f'<postureShift id="s">{SIT}</postureShift>')
    await pilot.advance(3)
    assert pilot.feedback.time("b:s:end") - pilot.feedback.time("b:s:start") == pytest.approx(GETTING_UP, abs=0.02)


async def test_a_later_shift_keeps_what_it_does_not_name(pilot: RealizerPilot) -> None:
    pilot.block("a", f'<postureShift id="s">{CROSSED}</postureShift>')
    await pilot.advance(2)
    pilot.block("b", f'<postureShift id="s">{SIT}</postureShift>')
    await pilot.advance(3)
    assert crossed(body(pilot, 4.9))
    assert sits(body(pilot, 4.9))


async def test_replacing_everything_restores_standing(pilot: RealizerPilot) -> None:
    pilot.block("a", f'<postureShift id="s">{SIT}{CROSSED}</postureShift>')
    await pilot.advance(3)
    pilot.block("b", composition="REPLACE")
    await pilot.advance(3)
    first, last = body(pilot, 0.02), body(pilot, 5.9)
    assert first.root == pytest.approx(last.root, abs=0.05)
    assert max(apart(first, last, joint) for joint in ("l_shoulder", "r_elbow", "l_wrist")) < 2.0


async def test_a_cut_shift_leaves_the_previous_posture(pilot: RealizerPilot) -> None:
    pilot.block("a", f'<postureShift id="s" end="2">{SIT}</postureShift>')
    await pilot.advance(1.2)
    pilot.block("b", '<bmla:interrupt id="i" target="a"/>')
    await pilot.advance(3)
    assert body(pilot, 1.1).root[1] < -0.05
    assert body(pilot, 4.0).root[1] == pytest.approx(0.0, abs=0.03)


async def test_sitting_down_takes_longer_than_crossing_the_arms(pilot: RealizerPilot) -> None:
    pilot.block("a", f'<postureShift id="s">{SIT}</postureShift>')
    pilot.block("b", f'<postureShift id="s">{CROSSED}</postureShift>', composition="APPEND")
    await pilot.advance(6)
    sitting, crossing = (pilot.feedback.time(f"{b}:s:end") - pilot.feedback.time(f"{b}:s:start") for b in "ab")
    assert 1.4 < sitting < 2.2
    assert 0.45 < crossing < 1.1


SWITCH = """
<postureShift id="one" start="1"><stance type="STANDING"/><pose part="ARMS" lexeme="ARMS_FORWARD"/></postureShift>
<postureShift id="two" start="4"><stance type="STANDING"/><pose part="ARMS" lexeme="ARMS_SPREAD"/></postureShift>
"""


def reach(shown: Body) -> tuple[float, float]:
    """How far the left wrist is to the side of and in front of the shoulder, m."""
    x, _, z = subtract(shown.transform("l_wrist").position, shown.transform("l_shoulder").position)
    return x, z


async def test_arms_go_forward_and_then_apart(pilot: RealizerPilot) -> None:
    pilot.block("b", SWITCH)
    await pilot.advance(8)
    assert pilot.feedback.warnings == []
    forward, spread = reach(body(pilot, 3.9)), reach(body(pilot, 7.9))
    assert forward[1] > 0.35 > 0.1 > abs(forward[0])
    assert spread[0] > 0.35 > 0.1 > abs(spread[1])


async def test_asaprealizers_posture_example_plays(pilot: RealizerPilot, shared_cases: Path) -> None:
    pilot.perform((shared_cases / "asap" / "bml" / "postureshift.xml").read_bytes())
    await pilot.advance(10)
    assert pilot.feedback.warnings == []
    assert reach(body(pilot, 5.9))[1] > 0.35
    assert reach(body(pilot, 9.9))[0] > 0.35
