"""Timings that leave a body too little time: something gives way, and a warning says what."""

import math

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

NOD = '<head id="n" lexeme="NOD" stroke="g:stroke"/>'
TOLD = "there is too little time for"


def texts(pilot: RealizerPilot, id_: str) -> list[str]:
    return [message.text for message in pilot.feedback.of("warningFeedback") if message.id == id_]


async def test_a_stroke_that_cannot_meet_the_first_word_loses_its_tie(pilot: RealizerPilot) -> None:
    await pilot.advance(2)
    pilot.block(
        "b",
        '<speech id="s" start="0"><text><sync id="w"/>Hello there.</text></speech>'
        '<gesture id="g" lexeme="BEAT" stroke="s:w"/>',
    )
    await pilot.advance(3)
    (text,) = texts(pilot, "b:g")
    assert "g:stroke = s:w is dropped" in text
    assert "g from start to stroke: needs 0.44 s, has 0.00 s" in text
    assert pilot.feedback.time("b:s:start") == 2.0
    assert pilot.feedback.time("b:g:stroke") - pilot.feedback.time("b:g:start") > 0.36


SPEECH = '<speech id="s"{}><text><sync id="w"/>I see what <sync id="m"/>you mean.</text></speech>'


async def test_every_strategy_gives_up_a_tie_to_a_word_that_comes_too_soon_and_says_need_and_room(
    any_strategy: RealizerPilot,
) -> None:
    beat = '<gesture id="g" lexeme="BEAT" stroke="s:w"/>'
    any_strategy.block("b", SPEECH.format(' start="0"') + beat + NOD)
    await any_strategy.advance(4)
    (text,) = texts(any_strategy, "b:g") or texts(any_strategy, "b:s")
    assert " is dropped: there is too little time for g from start to stroke: needs 0.44 s, has 0.00 s" in text
    assert len(any_strategy.feedback.warnings) == 1
    assert any_strategy.feedback.reached("b:s:w")
    assert any_strategy.feedback.time("b:g:stroke") == any_strategy.feedback.time("b:n:stroke") > 0.36


async def test_a_speech_without_a_given_time_waits_for_a_stroke_that_needs_more_time(
    any_strategy: RealizerPilot,
) -> None:
    any_strategy.block("b", SPEECH.format("") + '<gesture id="g" lexeme="BEAT" start="0.2" stroke="s:w"/>')
    await any_strategy.advance(4)
    assert any_strategy.feedback.warnings == []
    assert any_strategy.feedback.time("b:g:start") == 0.2
    assert any_strategy.feedback.time("b:s:start") == pytest.approx(any_strategy.feedback.time("b:g:stroke"))


@pytest.mark.parametrize("order", [1, -1])
async def test_a_speech_is_whole_if_a_nod_ties_its_word_to_an_external_time_that_comes_too_soon(
    any_strategy: RealizerPilot, order: int
) -> None:
    any_strategy.predict("t", "hit", 1.1)
    await any_strategy.advance(1)
    nod = '<head id="n" lexeme="NOD" stroke="s:m" end="anticipators:t:hit+0.2"/>'
    any_strategy.block("b", "".join([SPEECH.format(""), nod][::order]))
    await any_strategy.advance(3)
    assert any_strategy.feedback.time("b:s:start") == 1.0
    assert any_strategy.feedback.reached("b:s:end")
    assert any_strategy.feedback.reached("b:n:end")
    assert [id_ for id_, _ in any_strategy.feedback.warnings] == ["b:n"]


async def test_speech_without_a_tie_waits_for_the_stroke_on_its_first_word(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        '<speech id="s"><text><sync id="w"/>Hello there.</text></speech><gesture id="g" lexeme="BEAT" stroke="s:w"/>',
    )
    await pilot.advance(3)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:g:stroke") == pytest.approx(pilot.feedback.time("b:s:w"))


async def test_a_pointing_that_has_too_little_time_is_ready_when_it_can_be(pilot: RealizerPilot) -> None:
    pilot.block("b", '<pointing id="p" target="bluebox" start="0.5" ready="0.55"/>')
    await pilot.advance(3)
    (text,) = texts(pilot, "b:p")
    assert "p:ready = 0.55 is dropped" in text
    assert "p from start to ready: needs 0.30 s, has 0.05 s" in text
    assert pilot.feedback.time("b:p:start") == 0.5
    assert pilot.feedback.time("b:p:ready") > 0.5 + 0.30


async def test_a_warning_shows_a_shortage_of_less_than_a_hundredth_of_a_second(pilot: RealizerPilot) -> None:
    pilot.block("b", '<head id="n" lexeme="TILT" start="1" end="1.1"/>')
    await pilot.advance(3)
    (text,) = texts(pilot, "b:n")
    assert text.endswith("n from start to end: needs 0.101 s, has 0.100 s")


async def test_a_hurried_gesture_that_has_just_enough_time_keeps_its_ties(pilot: RealizerPilot) -> None:
    pilot.block("b", '<pointing id="p" target="bluebox" start="0.5" ready="0.82"/>')
    await pilot.advance(3)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:p:ready") == 0.82


async def test_a_block_fails_if_a_required_tie_leaves_too_little_time(pilot: RealizerPilot) -> None:
    pilot.block("b", '<required><pointing id="p" target="bluebox" start="0.5" ready="0.55"/></required>')
    await pilot.advance(2)
    assert TOLD in texts(pilot, "b:p")[0]
    assert pilot.feedback.status("b") == "FAILED"


async def test_a_tie_that_is_not_required_gives_way_to_one_that_is(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        '<pointing id="p" target="bluebox" start="0.5"/>'
        '<required><constraint id="c"><synchronize><sync ref="p:ready"/><sync ref="0.55"/></synchronize></constraint>'
        "</required>",
    )
    await pilot.advance(3)
    assert "p:start = 0.5 is dropped" in texts(pilot, "b:p")[0]
    assert pilot.feedback.time("b:p:ready") == pytest.approx(0.55)


# --- while it plays


async def test_a_prediction_that_comes_early_hurries_a_stroke_at_most_to_its_limit(pilot: RealizerPilot) -> None:
    pilot.watch()
    pilot.predict("t", "hit", 2.0)
    pilot.block("b", '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND" stroke="anticipators:t:hit"/>')
    await pilot.advance(1.3)
    assert not pilot.feedback.reached("b:g:ready")
    pilot.predict("t", "hit", 1.4)
    await pilot.advance(3)
    stroke = pilot.feedback.time("b:g:stroke")
    assert 1.5 < stroke < 1.3 + 0.39
    (text,) = texts(pilot, "b:g")
    assert "g:stroke = anticipators:t:hit no longer holds" in text
    assert "because g:stroke needs" in text
    assert pilot.feedback.time("b:g:ready") < stroke < pilot.feedback.time("b:g:strokeEnd")
    first, last = (round(50 * pilot.feedback.time(f"b:g:{point}")) for point in ("ready", "strokeEnd"))
    heights = pilot.path("r_wrist")[:, 1]
    assert heights[round(50 * stroke)] < heights[first:last].min() + 0.02


async def test_a_prediction_that_comes_a_little_early_is_no_loss(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 2.0)
    pilot.block("b", '<gesture id="g" lexeme="BEAT" stroke="anticipators:t:hit"/>')
    await pilot.advance(1.3)
    pilot.predict("t", "hit", 1.65)
    await pilot.advance(3)
    assert pilot.feedback.warnings == []
    assert 1.65 <= pilot.feedback.time("b:g:stroke") < 1.75


async def test_a_stroke_that_waits_for_its_hand_follows_a_prediction_that_is_late_again(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 2.0)
    pilot.block(
        "b", '<gesture id="g" lexeme="BEAT" stroke="anticipators:t:hit"/><head id="n" lexeme="NOD" stroke="g:stroke"/>'
    )
    await pilot.advance(1.3)
    pilot.predict("t", "hit", 1.31)
    await pilot.advance(0.1)
    pilot.predict("t", "hit", 1.9)
    await pilot.advance(3)
    assert pilot.feedback.time("b:g:stroke") == pilot.feedback.time("b:n:stroke") == 1.9


@pytest.mark.parametrize("end", ["anticipators:t:hit", "i:start"])
async def test_points_that_are_tied_to_one_unknown_time_without_room_between_them_lose_a_tie_at_once(
    any_strategy: RealizerPilot, end: str
) -> None:
    interrupt = '<bmla:interrupt id="i" target="other" start="anticipators:t:hit"/>'
    any_strategy.block(
        "b",
        f'<gaze id="g" target="bluebox" ready="anticipators:t:hit" end="{end}"/><wait id="w" duration="1"/>{interrupt}',
    )
    await any_strategy.tick()
    assert len(any_strategy.feedback.warnings) == 1
    assert "is dropped: there is too little time for g from" in any_strategy.feedback.raw[0]
    any_strategy.predict("t", "hit", 0.5)
    await any_strategy.advance(3)
    assert "thesis" not in "".join(any_strategy.feedback.raw)


async def test_a_stroke_between_tied_points_waits_for_a_ready_that_a_prediction_makes_late(
    any_strategy: RealizerPilot,
) -> None:
    any_strategy.block(
        "b", '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND" ready="anticipators:t:go" end="anticipators:t:stop"/>'
    )
    any_strategy.predict("t", "stop", 1.14)
    await any_strategy.advance(0.05)
    any_strategy.predict("t", "go", 0.73)
    await any_strategy.advance(2)
    assert any_strategy.feedback.warnings == []
    times = {sync: any_strategy.feedback.time(f"b:g:{sync}") for sync in ("ready", "stroke", "strokeEnd", "end")}
    assert times == pytest.approx({"ready": 0.73, "stroke": 0.9223, "strokeEnd": 0.9976, "end": 1.14}, abs=1e-3)


async def test_a_word_does_not_wait_for_a_hand_that_is_late(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 3.0)
    pilot.block(
        "b",
        '<speech id="s" start="anticipators:t:hit"><text><sync id="w"/>Oh, there.</text></speech>'
        '<gesture id="g" lexeme="BEAT" stroke="s:w"/>',
    )
    await pilot.advance(1)
    pilot.predict("t", "hit", 0.9)
    await pilot.advance(3)
    assert pilot.feedback.time("b:s:start") == 1.0
    assert pilot.feedback.time("b:s:w") == 1.0
    assert pilot.feedback.time("b:g:stroke") > 1.36
    assert "g:stroke = s:w no longer holds" in texts(pilot, "b:g")[0]


async def test_a_gesture_that_follows_another_one_at_once_starts_from_its_hand(pilot: RealizerPilot) -> None:
    beat = '<gesture id="{}" lexeme="BEAT" mode="RIGHT_HAND" start="{}" stroke="{}" relax="{}" end="{}"/>'
    pilot.block("b", beat.format("g", "0", "0.7", "1", "1") + beat.format("h", "g:end", "1.3", "1.6", "1.6"))
    await pilot.advance(3)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:h:stroke") == 1.3


async def test_the_hand_is_there_at_a_stroke_whose_ready_is_unknown(pilot: RealizerPilot) -> None:
    pilot.watch()
    pilot.block("b", '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND" start="1" ready="anticipators:t:go" stroke="3"/>')
    await pilot.advance(3)
    path = pilot.path("r_wrist", "alice")
    await pilot.advance(0.5)
    assert pilot.feedback.time("b:g:ready") == pilot.feedback.time("b:g:stroke") == 3.0
    (text,) = texts(pilot, "b:g")
    assert "g from strokeStart to stroke is to last at least 0.16 s, lasts 0.00 s" in text
    assert np.linalg.norm(path[-1] - path[0]) > 0.3


async def test_a_hand_that_is_late_on_its_way_back_is_in_time_for_the_next_gesture(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        '<pointing id="a" target="bluebox" mode="LEFT_HAND" relax="1" end="1.2"/>'
        '<pointing id="p" target="greensphere" mode="LEFT_HAND" start="a:end" ready="1.56"/>',
    )
    pilot.watch()
    await pilot.advance(2.5)
    assert pilot.feedback.warnings == []
    path = pilot.path("l_wrist")
    ready, held = path[78], path[90]  # at 1.56 and 1.8 s
    assert np.linalg.norm(held - ready) < 0.01


async def test_a_gesture_after_a_retraction_that_was_too_short_is_ready_when_its_hand_is_there(
    pilot: RealizerPilot,
) -> None:
    pilot.block(
        "b",
        '<gesture id="a" lexeme="WAVE" mode="LEFT_HAND" relax="1" end="1.02"/>'
        '<gesture id="g" lexeme="CONDUIT" mode="LEFT_HAND" start="a:end" ready="1.24" strokeStart="1.4"/>',
    )
    pilot.watch()
    await pilot.advance(2)
    assert texts(pilot, "b:g") == []
    ready = pilot.feedback.time("b:g:ready")
    assert 1.22 < ready < 1.3
    path = pilot.path("l_wrist")
    assert np.linalg.norm(path[70] - path[math.ceil(ready * 50)]) < 0.01


# --- heads


async def test_a_head_needs_time_for_a_nod(pilot: RealizerPilot) -> None:
    pilot.block("b", '<head id="n" lexeme="NOD" start="0.5" end="0.52"/>')
    await pilot.advance(3)
    (text,) = texts(pilot, "b:n")
    assert "n:end = 0.52 is dropped" in text
    assert "n from strokeStart to strokeEnd: needs 0.10 s, has 0.02 s" in text
    assert pilot.feedback.time("b:n:start") == 0.5
    assert pilot.feedback.time("b:n:end") > 0.6


async def test_a_block_fails_if_a_required_nod_has_no_time(pilot: RealizerPilot) -> None:
    pilot.block("b", '<required><head id="n" lexeme="NOD" start="0.5" end="0.52"/></required>')
    await pilot.advance(2)
    assert TOLD in texts(pilot, "b:n")[0]
    assert pilot.feedback.status("b") == "FAILED"


@pytest.mark.parametrize(("lexeme", "axis"), [("NOD", 1), ("SHAKE", 2)])
@pytest.mark.parametrize("amount", [0.2, 0.5, 1.0])
async def test_a_head_that_has_just_enough_time_is_there_at_its_stroke(
    pilot: RealizerPilot, lexeme: str, axis: int, amount: float
) -> None:
    head = f'<head id="n" lexeme="{lexeme}" amount="{amount}" {{}}/>'
    pilot.watch()
    pilot.block("impossible", head.format('start="0" stroke="0"'))
    await pilot.advance(1)
    (text,) = texts(pilot, "impossible:n")
    needed = float(text.rpartition("needs ")[2].partition(" s")[0])
    pilot.block("slow", head.format('start="0"'))
    pilot.block("hurried", head.format(f'start="1" stroke="{1 + 0.02 * math.ceil(50 * needed + 0.5)}"'))
    await pilot.advance(3)
    assert len(pilot.feedback.warnings) == 1
    turns = [body.rotation("skullbase")[axis] for body in pilot.bodies()]
    slow, hurried = (turns[round(50 * pilot.feedback.time(f"{block}:n:stroke"))] for block in ("slow", "hurried"))
    assert hurried == pytest.approx(slow, abs=math.sin(0.5 * math.radians(2)))


async def test_a_prediction_that_comes_early_hurries_a_nod_at_most_to_its_limit(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 2.0)
    pilot.block("b", '<head id="n" lexeme="NOD" amount="1" start="1" stroke="anticipators:t:hit"/>')
    await pilot.advance(1)
    pilot.predict("t", "hit", 1.01)
    await pilot.advance(2)
    assert 1.05 < pilot.feedback.time("b:n:stroke") < 1.1


# --- limits that the author of a motion has set


WAVE = '<gesture id="g" lexeme="WAVE" strokeStart="0.8" stroke="1" strokeEnd="{}"/>'
BREATH = '<bmlt:procanimation id="p" name="breathe_clavicular" {}/>'


@pytest.mark.parametrize("strategy", ["convex", "embr", "smartbody"])
@pytest.mark.parametrize(
    ("end", "told"),
    [(1.0, "p from start to end is to last at least 1.20 s, lasts 1.00 s"),
     (9.0, "p from start to end is to last at most 8.00 s, lasts 9.00 s")],
)  # fmt: skip
async def test_a_constraint_that_exceeds_the_limits_of_an_author_holds_with_one_warning(
    strategy: str, end: float, told: str
) -> None:
    async with open_pilot(SceneOptions(voice="text", strategy=strategy)) as pilot:
        pilot.block("b", BREATH.format(f'start="0" end="{end}"'))
        await pilot.advance(10)
        (text,) = texts(pilot, "b:p")
        assert text.endswith(told)
        assert pilot.feedback.time("b:p:end") == end
        assert pilot.feedback.status("b") == "DONE"


@pytest.mark.parametrize(
    ("end", "told"),
    [(1.4, "g from stroke to strokeEnd is to last at least 0.66 s, lasts 0.40 s"),
     (5.0, "g from stroke to strokeEnd is to last at most 2.46 s, lasts 4.00 s")],
)  # fmt: skip
async def test_the_stroke_of_a_gesture_exceeds_the_limits_of_its_animation_only_with_a_warning(
    any_strategy: RealizerPilot, end: float, told: str
) -> None:
    any_strategy.block("b", WAVE.format(end))
    await any_strategy.advance(7)
    (text,) = texts(any_strategy, "b:g")
    assert text.endswith(told)
    assert any_strategy.feedback.time("b:g:stroke") == 1.0
    assert any_strategy.feedback.time("b:g:strokeEnd") == end


async def test_a_required_gesture_that_cannot_keep_the_limits_of_its_animation_fails_its_block(
    any_strategy: RealizerPilot,
) -> None:
    any_strategy.block("b", f'<required>{WAVE.format(1.4)}</required><head id="n" lexeme="NOD"/>')
    await any_strategy.advance(3)
    (text,) = texts(any_strategy, "b:g")
    assert text.endswith("g from stroke to strokeEnd is to last at least 0.66 s, lasts 0.40 s")
    assert any_strategy.feedback.status("b") == "FAILED"
    assert not any_strategy.feedback.reached("b:n:start")


async def test_the_ways_of_a_gesture_take_the_time_that_its_stroke_may_not(pilot: RealizerPilot) -> None:
    pilot.block("b", '<gesture id="g" lexeme="WAVE" start="0" end="7"/>')
    await pilot.advance(7.1)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:g:strokeEnd") - pilot.feedback.time("b:g:strokeStart") < 0.54 + 2.46


async def test_a_prediction_that_hurries_a_wave_beyond_its_limits_is_reported(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 2.5)
    pilot.block("b", '<gesture id="g" lexeme="WAVE" stroke="1" strokeEnd="anticipators:t:hit"/>')
    await pilot.advance(1.1)
    pilot.predict("t", "hit", 1.4)
    await pilot.advance(3)
    assert pilot.feedback.time("b:g:strokeEnd") == 1.4
    (text,) = texts(pilot, "b:g")
    assert "g from stroke to strokeEnd is to last at least 0.66 s, lasts 0.40 s" in text


@pytest.mark.parametrize("strategy", ["convex", "embr"])
@pytest.mark.parametrize(("end", "breath"), [(11.0, 8.0), (1.42, 1.2)])
async def test_what_has_no_limits_gives_way_before_the_limits_of_an_author_do(
    strategy: str, end: float, breath: float
) -> None:
    async with open_pilot(SceneOptions(voice="text", strategy=strategy)) as pilot:
        nod = f'<head id="n" lexeme="NOD" start="p:end" end="{end}"/>'
        pilot.block("b", BREATH.format('start="0"') + nod)
        await pilot.advance(end + 0.1)
        assert pilot.feedback.warnings == []
        assert pilot.feedback.time("b:p:end") == pytest.approx(breath, abs=1e-4)
        assert pilot.feedback.time("b:n:end") == end


async def test_a_prediction_that_moves_a_playing_motion_beyond_its_limits_is_reported_once(
    pilot: RealizerPilot,
) -> None:
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", BREATH.format('start="0" end="anticipators:t:hit"'))
    await pilot.advance(2)
    pilot.predict("t", "hit", 9.5)
    await pilot.advance(2)
    assert texts(pilot, "b:p") == []
    await pilot.advance(6)
    (text,) = texts(pilot, "b:p")
    assert "p from stroke to strokeEnd is to last at most 1.60 s, lasts 5.15 s" in text


async def test_an_interrupted_motion_is_not_said_to_be_too_short(pilot: RealizerPilot) -> None:
    pilot.block("b", BREATH.format('start="0"'))
    await pilot.advance(0.5)
    pilot.block("c", composition="REPLACE")
    await pilot.advance(1)
    assert pilot.feedback.warnings == []


async def test_a_head_of_the_built_in_lexicon_may_nod_slowly(pilot: RealizerPilot) -> None:
    pilot.block("b", '<head id="n" lexeme="NOD" start="0" end="4"/>')
    await pilot.advance(5)
    assert pilot.feedback.warnings == []


async def warnings_of_a_target_that_moves(away: float) -> list[str]:
    async with open_pilot(SceneOptions(voice="text", strategy="smartbody")) as pilot:
        pilot.watch()
        pilot.move("thing", (-0.5, 1.0, 1.0))
        await pilot.advance(0.1)
        pilot.block("b", '<pointing id="p" target="thing" mode="RIGHT_HAND" ready="0.5"/>')
        await pilot.advance(0.46)
        pilot.move("thing", (-0.5, 1.0 + away, 1.0))
        await pilot.advance(1.5)
        return texts(pilot, "b:p")


async def test_a_hurried_hand_whose_target_moves_is_warned_of() -> None:
    first, *_ = await warnings_of_a_target_that_moves(0.8)
    assert "at p:ready the right hand is" in first
    assert "cm away from where it should be" in first
    assert await warnings_of_a_target_that_moves(0.0) == []


async def test_a_gaze_that_must_return_at_once_loses_its_tie(pilot: RealizerPilot) -> None:
    pilot.block("b", '<gaze id="o" target="bluebox" influence="WAIST" ready="0.5" relax="1" end="1.02"/>')
    await pilot.advance(3)
    (text,) = texts(pilot, "b:o")
    assert "there is too little time for o from relax to end" in text


async def test_a_body_that_needs_time_does_not_hold_a_face_that_has_to_end(any_strategy: RealizerPilot) -> None:
    any_strategy.predict("t", "go", 0.5)
    any_strategy.predict("t", "hit", 3.0)
    any_strategy.block(
        "b",
        '<faceLexeme id="f" lexeme="RAISE_BROWS" start="anticipators:t:go" end="anticipators:t:hit"/>'
        '<postureShift id="s" end="f:attackPeak"><pose part="ARMS" lexeme="ARMS_CROSSED"/></postureShift>',
    )
    await any_strategy.advance(0.3)
    any_strategy.predict("t", "go", 0.3)
    await any_strategy.advance(0.1)
    any_strategy.predict("t", "hit", 0.45)
    await any_strategy.advance(1)
    assert [any_strategy.feedback.time(f"b:f:{sync}") for sync in ("attackPeak", "end")] == [0.45, 0.45]
    assert any_strategy.feedback.time("b:s:end") > 0.55, "the arms arrive as soon as they can"
    (text,) = texts(any_strategy, "b:s")
    assert "s:end = f:attackPeak no longer holds" in text
