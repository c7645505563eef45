"""`posture` (BML 1.0), from BML to feedback and frames."""

import pytest

from reactive_realizer.embodiment.vector import distance, subtract
from reactive_realizer.testing.pilot import RealizerPilot

from .standing import CROSSED, SIT, STAND, apart, body, crossed, sits


async def test_a_posture_comes_holds_and_goes_back(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<posture id="p" start="1" ready="2" relax="4" end="5">{CROSSED}</posture>')
    await pilot.advance(6)
    assert pilot.feedback.progress == ["b:start", "b:p:start", "b:p:ready", "b:p:relax", "b:relax", "b:p:end", "b:end"]
    assert [crossed(body(pilot, time)) for time in (0.9, 2.1, 3.9, 5.1)] == [False, True, True, False]
    assert apart(body(pilot, 5.5), body(pilot, 0.5), "l_shoulder") < 2.0


async def test_a_posture_without_times_takes_its_own(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<posture id="p">{CROSSED}</posture>')
    await pilot.advance(5)
    start, ready, relax, end = (pilot.feedback.time(f"b:p:{sync}") for sync in ("start", "ready", "relax", "end"))
    assert 0.6 < ready - start < 1.1
    assert relax - ready == pytest.approx(2 * (ready - start), abs=4e-6)  # feedback has microseconds
    assert end - relax == pytest.approx(ready - start, abs=4e-6)


async def test_one_stance_has_one_owner(pilot: RealizerPilot) -> None:
    pilot.block("a", f'<posture id="p" start="0" end="4">{CROSSED}</posture>')
    await pilot.advance(0.5)
    pilot.block("b", f'<posture id="p">{SIT}</posture>')
    await pilot.advance(6)
    ((about, _),) = pilot.feedback.warnings
    assert about == "b:p"
    assert not any(map(sits, pilot.bodies()))


async def test_a_posture_of_a_draft_without_an_end_continues_until_the_next(pilot: RealizerPilot) -> None:
    pilot.perform(f'<bml id="a"><posture id="p">{SIT}</posture></bml>')
    await pilot.advance(8)
    assert not pilot.feedback.reached("a:p:end")
    assert sits(body(pilot, 7.9))
    pilot.block("b", f'<posture id="p" start="0" end="4">{STAND}</posture>')
    await pilot.advance(7)
    assert body(pilot, 10.0).root[1] == pytest.approx(0.0, abs=0.03)
    assert sits(body(pilot, 14.9))


@pytest.mark.parametrize(
    ("children", "says"),
    [
        ('<pose part="ARMS" lexeme="ARMS_WINGED"/>', "ARMS_AKIMBO, ARMS_CROSSED"),
        ('<stance type="CROUCHING"/><pose part="LEGS" lexeme="LEGS_CROSSED"/>', "CROUCHING"),
        ('<pose part="LEGS" lexeme="ARMS_CROSSED"/>', "arms_crossed"),
    ],
)
async def test_an_impossible_posture_is_dropped_with_the_reason(pilot: RealizerPilot, children: str, says: str) -> None:
    pilot.block("b", f'<posture id="p">{children}</posture><head id="n" lexeme="NOD"/>')
    await pilot.advance(3)
    (line,) = pilot.feedback.of("warningFeedback")
    assert (line.id, line.element.get("type")) == ("b:p", "CANNOT_CREATE_BEHAVIOR")
    assert says in line.text
    assert pilot.feedback.reached("b:n:end")


DRAFT = '<bml id="a"><posture id="p" stance="sitting" shape="crossed" part="arms" end="4"/></bml>'


async def test_a_posture_of_a_draft_says_its_shape_and_part(pilot: RealizerPilot) -> None:
    pilot.perform(DRAFT)
    await pilot.advance(4)
    assert pilot.feedback.warnings == []
    assert any(crossed(shown) and sits(shown) for shown in pilot.bodies())


CROSSED_LEGS = '<pose part="LEGS" lexeme="LEGS_CROSSED"/>'
CROUCH = '<stance type="CROUCHING"/>'


async def test_a_pose_that_does_not_exist_in_a_stance_is_left_out_during_it(
    pilot: RealizerPilot,
) -> None:
    pilot.block("a", f'<postureShift id="s" end="2">{SIT}{CROSSED_LEGS}{CROSSED}</postureShift>')
    await pilot.advance(3)
    pilot.block("b", f'<posture id="p" start="0" ready="2" relax="4" end="6">{CROUCH}</posture>')
    await pilot.advance(8)
    assert pilot.feedback.warnings == []
    assert "b:p:end" in pilot.feedback.progress
    assert body(pilot, 6.0).root[1] < -0.45, "lower than a seat"
    assert crossed(body(pilot, 6.0)), "arms can"
    assert apart(body(pilot, 10.5), body(pilot, 2.9), "r_hip") < 2.0


async def test_a_pose_whose_stance_never_comes_is_left_out(pilot: RealizerPilot) -> None:
    pilot.block("a", f'<postureShift id="s" end="2">{CROUCH}</postureShift>')
    await pilot.advance(3)
    pilot.block("b", f'<postureShift id="s" start="0" end="3">{SIT}</postureShift>')
    pilot.block("c", f'<posture id="p">{CROSSED_LEGS}</posture>', composition="APPEND")
    await pilot.advance(1)
    pilot.block("d", '<bmla:interrupt id="i" target="b"/>')
    await pilot.advance(8)
    assert pilot.feedback.warnings == []
    assert "c:p:end" in pilot.feedback.progress


async def test_a_gesture_starts_from_crossed_arms_and_returns_to_them(pilot: RealizerPilot) -> None:
    pilot.block("a", f'<postureShift id="s">{CROSSED}</postureShift>')
    await pilot.advance(2)
    pilot.block("b", '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND"/>')
    await pilot.advance(4)
    stroke = pilot.feedback.time("b:g:stroke")
    assert not crossed(body(pilot, stroke))
    assert apart(body(pilot, stroke), body(pilot, 1.9), "l_shoulder") < 2.0
    assert apart(body(pilot, 5.9), body(pilot, 1.9), "r_shoulder") < 2.0
    assert crossed(body(pilot, 5.9))


async def test_gestures_of_a_sitting_figure_are_in_front_of_its_chest(pilot: RealizerPilot) -> None:
    gesture = '<gesture id="g" lexeme="OFFER" mode="RIGHT_HAND"/>'
    pilot.block("a", gesture)
    await pilot.advance(5)
    pilot.block("b", f'<postureShift id="s">{SIT}</postureShift>')
    await pilot.advance(3)
    pilot.block("c", gesture)
    await pilot.advance(5)
    ways = []
    for block in "ac":
        shown = body(pilot, pilot.feedback.time(f"{block}:g:stroke"))
        ways.append(subtract(shown.transform("r_wrist").position, shown.transform("r_shoulder").position))
    assert distance(*ways) < 0.05
