"""Gestures of a block that follow each other closely take over the arm from one another."""

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.motion_laws import accelerations
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

BEAT = '<gesture id="g{0}" lexeme="BEAT" mode="RIGHT_HAND" stroke="{1}"/>'


def beats(period: float) -> str:
    return "".join(BEAT.format(number, 1 + number * period) for number in range(4))


async def test_beats_half_a_second_apart_all_play(still: RealizerPilot) -> None:
    still.block("b", beats(0.5))
    await still.advance(4)
    told = still.feedback
    assert told.warnings == []
    start = told.time("b:start")
    assert [told.time(f"b:g{number}:stroke") - start for number in range(4)] == pytest.approx([1.0, 1.5, 2.0, 2.5])
    for number in range(3):
        assert told.time(f"b:g{number}:end") == told.time(f"b:g{number + 1}:start")
    assert accelerations(still.bodies(), "r_wrist").max() < 60.0


async def test_they_do_with_the_strategy_of_embr_too() -> None:
    async with open_pilot(SceneOptions(voice="text", strategy="embr", verify=True)) as pilot:
        pilot.block("b", beats(0.6))
        await pilot.advance(5)
        assert pilot.feedback.warnings == []
        assert all(pilot.feedback.reached(f"b:g{number}:stroke") for number in range(4))


async def test_a_gesture_that_takes_over_waits_for_a_stroke_that_is_predicted_later(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 1.5)
    later = '<gesture id="g2" lexeme="OFFER" mode="RIGHT_HAND" stroke="anticipators:t:hit+0.8"/>'
    pilot.block("b", BEAT.format(1, "anticipators:t:hit") + later)
    await pilot.advance(0.3)
    pilot.predict("t", "hit", 2.0)
    await pilot.advance(4)
    told = pilot.feedback
    assert told.warnings == []
    assert told.time("b:g1:stroke") == pytest.approx(2.0)
    assert told.time("b:g2:stroke") == pytest.approx(2.8)
    assert told.time("b:g1:relax") <= told.time("b:g2:start")


async def test_beats_too_close_for_one_hand_are_played_by_both_or_refused(pilot: RealizerPilot) -> None:
    pilot.block("b", BEAT.format(0, 1) + '<gesture id="g1" lexeme="BEAT" stroke="1.2"/>' + BEAT.format(2, 1.1))
    await pilot.advance(4)
    assert pilot.feedback.reached("b:g0:stroke")
    assert pilot.feedback.reached("b:g1:stroke")
    assert pilot.feedback.warnings == [("b:g2", "IMPOSSIBLE_TO_SCHEDULE")]


async def test_an_arm_whose_end_is_tied_is_not_taken_over(pilot: RealizerPilot) -> None:
    pilot.block("b", BEAT.format(0, 1).replace("/>", ' end="2.2"/>') + BEAT.format(1, 1.6))
    await pilot.advance(4)
    assert pilot.feedback.warnings == [("b:g1", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.time("b:g0:end") == pytest.approx(pilot.feedback.time("b:start") + 2.2)


@pytest.mark.parametrize("period", [0.3, 0.4])
async def test_strokes_too_close_for_one_hand_are_played_by_both_in_turn(still: RealizerPilot, period: float) -> None:
    any_hand = BEAT.replace(' mode="RIGHT_HAND"', "")
    still.block("b", "".join(any_hand.format(number, 1 + number * period) for number in range(4)))
    await still.advance(4)
    told = still.feedback
    assert told.warnings == []
    strokes = [told.time(f"b:g{number}:stroke") - told.time("b:start") for number in range(4)]
    assert strokes == pytest.approx([1 + number * period for number in range(4)])
    for hand in ("l_wrist", "r_wrist"):
        assert accelerations(still.bodies(), hand).max() < 60.0


async def test_a_lexeme_whose_hand_is_named_does_not_change_hands(still: RealizerPilot) -> None:
    still.block("b", beats(0.3))
    await still.advance(4)
    assert still.feedback.reached("b:g0:stroke")
    assert ("b:g1", "IMPOSSIBLE_TO_SCHEDULE") in still.feedback.warnings
    heights = [body.transform("l_wrist").position[1] for body in still.bodies()]
    assert max(heights) - min(heights) < 0.005


# --- partial retraction


def lowest_between(pilot: RealizerPilot, hand: str) -> float:
    """How low a hand gets between the strokes of two gestures: 0 as at rest, 1 as at the relax of the first one."""
    told, heights = pilot.feedback, pilot.path(hand)[:, 1]
    first, last = (round(50 * told.time(point)) for point in ("b:g0:relax", "b:g1:start"))
    return float((heights[first : last + 1].min() - heights[0]) / (heights[first] - heights[0]))


@pytest.mark.parametrize(("stroke", "waits"), [(2.8, True), (3.2, True), (3.6, False)])
async def test_an_arm_whose_next_stroke_comes_within_two_seconds_waits_halfway(
    still: RealizerPilot, stroke: float, waits: bool
) -> None:
    still.block("b", BEAT.format(0, 1) + BEAT.format(1, stroke))
    await still.advance(6)
    assert still.feedback.warnings == []
    assert 0.3 < lowest_between(still, "r_wrist") < 0.6 if waits else lowest_between(still, "r_wrist") < 0.02
    assert accelerations(still.bodies(), "r_wrist").max() < 30.0
    assert still.path("r_wrist")[-1] == pytest.approx(still.path("r_wrist")[0], abs=1e-3)


async def test_only_the_arm_that_the_next_gesture_needs_waits(still: RealizerPilot) -> None:
    still.block("b", BEAT.format(0, 1).replace("RIGHT_HAND", "BOTH_HANDS") + BEAT.format(1, 3.2))
    await still.advance(2.5)
    assert lowest_between(still, "r_wrist") > 0.3
    assert lowest_between(still, "l_wrist") < 0.02


@pytest.mark.parametrize("gives_up", ["", '<bmla:interrupt id="i" target="b" include="g1"/>'])
async def test_an_arm_rests_if_the_stroke_that_it_waits_for_is_dropped_or_comes_later(
    still: RealizerPilot, gives_up: str
) -> None:
    still.predict("t", "hit", 3.0)
    still.block("b", BEAT.format(0, 1) + BEAT.format(1, "anticipators:t:hit"))
    await still.advance(2.0)
    waiting = still.path("r_wrist")[-1]
    if gives_up:
        still.block("i", gives_up)
    else:
        still.predict("t", "hit", 8.0)
    await still.advance(3.0)
    assert waiting[1] > still.path("r_wrist")[0][1] + 0.05
    assert still.path("r_wrist")[-1] == pytest.approx(still.path("r_wrist")[0], abs=1e-3)
    assert accelerations(still.bodies(), "r_wrist").max() < 30.0
