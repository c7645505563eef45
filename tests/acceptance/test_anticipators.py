"""Behavior that is tied to external events: a key, the end of a turn, an exercise, and music."""

from collections.abc import AsyncIterator
from math import exp
from pathlib import Path
from random import Random

import pytest

from anticipators.speech_stop import SpeechStop
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import BMLA
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

HUMAN = """
[character.alice]
[anticipator.spacebar]
kind = "spacebar"
[anticipator.user]
kind = "speech_stop"
[anticipator.trainer]
kind = "exercise"
names = ["down", "up"]
[anticipator.orchestra]
kind = "conducting"
[anticipator.metronome]
kind = "metronome"
"""
NOD = '<head id="h" lexeme="NOD" start="anticipators:{}"/>'
REPLY = '<speech id="s" start="anticipators:user:stop+0.2"><text>I see what you mean.</text></speech>'


@pytest.fixture
async def pilot(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    human = tmp_path / "human.toml"
    human.write_text(HUMAN)
    async with open_pilot(SceneOptions(human, "text")) as pilot:
        yield pilot


async def until(pilot: RealizerPilot, time: float) -> None:
    while pilot.now < time - 1e-9:
        await pilot.tick()


# --- the space bar


async def test_a_nod_starts_with_the_key_and_a_later_block_waits_for_the_next_press(pilot: RealizerPilot) -> None:
    pilot.block("one", NOD.format("spacebar:press"))
    await until(pilot, 1.0)
    pilot.event("spacebar", "press")
    await until(pilot, 1.5)
    pilot.block("two", NOD.format("spacebar:press"))
    await until(pilot, 3.0)
    assert pilot.feedback.time("one:h:start") == 1.0
    assert not pilot.feedback.reached("two:h:start")
    pilot.event("spacebar", "press")
    await until(pilot, 6.0)
    assert pilot.feedback.time("two:h:start") == 3.0
    assert pilot.feedback.warnings == []


async def test_a_behavior_at_an_offset_from_the_key_is_not_delayed_by_another_press(pilot: RealizerPilot) -> None:
    pilot.block("b", NOD.format("spacebar:release+0.5"))
    await until(pilot, 1.0)
    for _ in range(30):
        pilot.event("spacebar", "release")
        await pilot.tick()
    await until(pilot, 4.0)
    assert pilot.feedback.time("b:h:start") == 1.5
    assert pilot.feedback.status("b") == "DONE"


async def test_a_block_follows_the_first_key_press_after_its_arrival_even_if_it_is_planned_later(
    pilot: RealizerPilot,
) -> None:
    solved_aside = "".join(f'<wait id="w{n}" duration="0.1"/>' for n in range(60))
    pilot.block("b", NOD.format("spacebar:press+0.5") + solved_aside)
    await pilot.tick()
    assert pilot.feedback.predictions("b")[-1].element[0].get(f"{{{BMLA}}}status") == "IN_PREP"
    pilot.event("spacebar", "press")
    await until(pilot, 2.0)
    assert pilot.feedback.time("b:h:start") == pytest.approx(0.51)


async def test_a_block_in_preparation_keeps_its_predicted_point_when_other_blocks_end(
    pilot: RealizerPilot,
) -> None:
    solved_aside = "".join(f'<wait id="w{n}" duration="0.1"/>' for n in range(60))
    pilot.block("other", NOD.format("spacebar:press"))
    pilot.block("b", NOD.format("spacebar:press") + solved_aside)
    pilot.block("stop", **{"bmla:interrupt": "other"})
    await until(pilot, 1.0)
    pilot.event("spacebar", "press")
    await until(pilot, 3.0)
    assert pilot.feedback.time("b:h:start") == 1.0


async def test_a_chunk_that_is_planned_again_keeps_the_time_of_an_earlier_key_press(
    pilot: RealizerPilot,
) -> None:
    pilot.block("a", '<wait id="w" duration="1"/>')
    pilot.block("b", NOD.format("spacebar:press+1"), **{"bmla:chunkAfter": "a"})
    await until(pilot, 0.5)
    pilot.event("spacebar", "press")
    await until(pilot, 3.0)
    assert pilot.feedback.time("b:h:start") == 1.5


async def test_a_nod_on_a_key_starts_at_the_press_and_is_as_fast_as_the_head_can_be(pilot: RealizerPilot) -> None:
    pilot.block("b", '<head id="h" lexeme="NOD" stroke="anticipators:spacebar:press"/>')
    await until(pilot, 1.0)
    pilot.event("spacebar", "press")
    await until(pilot, 4.0)
    assert pilot.feedback.time("b:h:start") == 1.0
    assert pilot.feedback.time("b:h:stroke") == pytest.approx(1.05, abs=0.01)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.status("b") == "DONE"


async def test_a_gesture_on_a_key_starts_at_the_press_and_is_as_fast_as_the_hand_can_be(pilot: RealizerPilot) -> None:
    pilot.block("b", '<gesture id="g" lexeme="BEAT" stroke="anticipators:spacebar:press"/>')
    await until(pilot, 1.0)
    pilot.event("spacebar", "press")
    await until(pilot, 4.0)
    assert pilot.feedback.time("b:g:start") == 1.0
    assert pilot.feedback.time("b:g:stroke") == pytest.approx(1.44, abs=0.01)
    assert "needs 0.44 s, has 0.00 s" in pilot.feedback.of("warningFeedback")[0].text
    assert pilot.feedback.status("b") == "DONE"


# --- the end of the user's turn


async def test_the_answer_starts_when_the_turn_of_the_user_is_over(pilot: RealizerPilot) -> None:
    pilot.block("b", REPLY)
    pilot.event("user", "voice", 1.0)
    await until(pilot, 1.0)
    pilot.event("user", "voice", 0.0)
    await until(pilot, 1.3)
    thinking = pilot.feedback.predicted("b:s:start")
    assert thinking == pytest.approx(1.0 + 0.88 + 0.2, abs=0.01)
    pilot.event("user", "voice", 1.0)
    await until(pilot, 3.0)
    assert not pilot.feedback.reached("b:s:start")
    pilot.event("user", "voice", 0.0)
    await pilot.tick()
    pilot.event("user", "words", text="and so I came here.")
    await until(pilot, 8.0)
    assert pilot.feedback.time("b:s:start") == pytest.approx(3.0 + 0.18 + 0.2, abs=0.01)
    assert pilot.feedback.status("b") == "DONE"
    assert pilot.feedback.warnings == []


async def test_a_turn_that_is_resumed_delays_the_answer_unless_it_has_started(pilot: RealizerPilot) -> None:
    pilot.block("b", REPLY)
    pilot.block("c", NOD.format("user:stop"))
    pilot.event("user", "words", text="I see.")
    await until(pilot, 0.3)
    assert pilot.feedback.reached("c:h:start")
    pilot.event("user", "words", text="I see. But tell me,")
    await until(pilot, 1.9)
    assert not pilot.feedback.reached("b:s:start")
    await until(pilot, 2.4)
    assert pilot.feedback.reached("b:s:start")
    pilot.event("user", "words", text="I see. But tell me, when")
    await until(pilot, 6.0)
    assert [pilot.feedback.status(block) for block in "bc"] == ["DONE", "DONE"]
    assert pilot.feedback.warnings == []


async def test_an_answer_that_is_sent_long_after_the_turn_waits_for_the_next_turn(pilot: RealizerPilot) -> None:
    pilot.block("early", NOD.format("user:stop"))
    pilot.event("user", "voice", 1.0)
    await until(pilot, 1.0)
    pilot.event("user", "voice", 0.0)
    await until(pilot, 8.0)
    pilot.block("b", REPLY)
    await until(pilot, 10.0)
    assert not pilot.feedback.reached("b:s:start")
    pilot.event("user", "voice", 1.0)
    await until(pilot, 11.0)
    pilot.event("user", "voice", 0.0)
    await until(pilot, 16.0)
    assert pilot.feedback.time("b:s:start") == pytest.approx(12.08, abs=0.01)
    assert pilot.feedback.warnings == []


async def test_an_answer_that_is_sent_just_after_the_turn_waits_for_the_next_turn(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", REPLY)
    pilot.event("user", "voice", 1.0)
    await until(pilot, 1.0)
    pilot.event("user", "voice", 0.0)
    pilot.event("user", "words", text="Hello you there.")
    await until(pilot, 1.6)
    assert pilot.feedback.time("b:s:start") == pytest.approx(1.38, abs=0.01)
    pilot.block("c", REPLY)
    pilot.block("d", NOD.format("user:stop"))
    await until(pilot, 5.0)
    assert pilot.feedback.status("b") == "DONE"
    pilot.event("user", "voice", 1.0)
    await until(pilot, 6.0)
    pilot.event("user", "voice", 0.0)
    await until(pilot, 12.0)
    assert pilot.feedback.time("c:s:start") == pytest.approx(6.88 + 0.2, abs=0.01)
    assert pilot.feedback.time("d:h:start") == pytest.approx(6.88, abs=0.01)
    assert pilot.feedback.warnings == []


async def test_earlier_and_later_answers_wait_for_the_end_of_a_resumed_turn(pilot: RealizerPilot) -> None:
    pilot.block("before", NOD.format("user:stop+0.5"))
    pilot.event("user", "words", text="I see.")
    await until(pilot, 0.4)
    pilot.block("since", NOD.format("user:stop+0.5"))
    pilot.event("user", "words", text="I see. But tell me")
    await until(pilot, 5.0)
    starts = [pilot.feedback.time(f"{block}:h:start") for block in ("before", "since")]
    assert starts == pytest.approx([0.4 + 0.88 + 0.5] * 2, abs=0.01)
    assert pilot.feedback.warnings == []


async def test_repeated_equal_turns_are_each_answered(pilot: RealizerPilot) -> None:
    for number in range(3):
        pilot.block(f"b{number}", NOD.format("user:stop"))
        pilot.event("user", "words", text="Yes.")
        await until(pilot, 5.0 * (number + 1))
    assert [pilot.feedback.time(f"b{n}:h:start") for n in range(3)] == pytest.approx([0.19, 5.19, 10.19], abs=0.01)


async def test_a_turn_whose_words_are_withdrawn_is_not_answered(pilot: RealizerPilot) -> None:
    pilot.block("b", NOD.format("user:stop"))
    pilot.event("user", "words", text="um")
    await until(pilot, 0.3)
    pilot.event("user", "words", text="")
    await until(pilot, 4.0)
    assert not pilot.feedback.reached("b:h:start")


# --- an exercise


def squat(time: float) -> float:
    """Magnitude of acceleration (m/s²) of somebody who is down at every odd second, and up 0.8 s after it."""
    moments = [second + part for second in range(1, 30, 2) for part in (0.0, 0.8)]
    return 9.81 + sum(8.0 * exp(-(((time - moment) / 0.08) ** 2)) for moment in moments)


async def test_a_trainer_moves_ahead_of_the_user(pilot: RealizerPilot) -> None:
    random = Random(1)
    for number in range(1, 8):
        pilot.block(f"b{number}", '<gesture id="g" lexeme="BEAT" stroke="anticipators:trainer:down-0.3"/>')
        while pilot.now < 6 + 2 * number:
            pilot.event("trainer", "sample", abs(squat(pilot.now) + random.gauss(0.0, 0.4)))
            await pilot.tick()
    strokes = [line.global_time for line in pilot.feedback.of("syncPointProgress") if line.id.endswith(":g:stroke")]
    assert len(strokes) == 7
    assert all(stroke % 2 == pytest.approx(0.7, abs=0.15) for stroke in strokes)
    assert pilot.feedback.warnings == []


async def test_a_peak_may_be_named_by_its_number(pilot: RealizerPilot) -> None:
    pilot.block("b", NOD.format("trainer:7-0.5"))
    while pilot.now < 9:
        pilot.event("trainer", "sample", squat(pilot.now))
        await pilot.tick()
    assert pilot.feedback.time("b:h:start") == pytest.approx(6.5, abs=0.1)


# --- a music


async def test_a_conductor_follows_an_orchestra_that_speeds_up_loses_a_beat_and_doubles_one(
    pilot: RealizerPilot,
) -> None:
    random = Random(4)
    beats = [1.0]
    for number in range(1, 24):
        beats.append(beats[-1] + 0.9 * 0.985**number)
    taps = [beat + random.gauss(0.0, 0.01) for number, beat in enumerate(beats, start=1) if number != 11]
    taps = sorted([*taps, beats[16] + 0.08])
    strokes = {number: f"b:g{number}:stroke" for number in range(6, 24, 3)}
    gesture = '<gesture id="g{0}" lexeme="BEAT" mode="RIGHT_HAND" stroke="anticipators:orchestra:beat{0}"/>'
    pilot.block("b", "".join(gesture.format(number) for number in strokes))
    for tap in taps:
        await until(pilot, tap)
        pilot.event("orchestra", "beat")
    await pilot.advance(5)
    for number, stroke in strokes.items():
        assert pilot.feedback.time(stroke) == pytest.approx(beats[number - 1], abs=0.07)
    assert pilot.feedback.status("b") == "DONE"
    assert pilot.feedback.warnings == []


# --- names of points


@pytest.mark.parametrize(
    ("point", "known"),
    [
        ("spacebar:pres", "press, release"),
        ("metronome:beat3", "tickN"),
        ("metronome:tick", "tickN"),
        ("orchestra:1", "beatN"),
        ("trainer:sideways", "N, down, up"),
        ("user:start", "stop"),
    ],
)
async def test_a_behavior_at_an_unknown_point_is_dropped_at_once_with_its_place(
    pilot: RealizerPilot, point: str, known: str
) -> None:
    pilot.block("b", f'<wait id="w" duration="0.1"/>\n{NOD.format(point)}')
    await pilot.tick()
    (warning,) = pilot.feedback.of("warningFeedback")
    anticipator, _, sync = point.partition(":")
    assert warning.id == "b:h"
    assert warning.text.startswith("line 2, column 1: ")
    assert f"the anticipator '{anticipator}' has no point '{sync}'; it has {known}" in warning.text
    await pilot.advance(0.2)
    assert pilot.feedback.status("b") == "DONE"


async def test_a_constraint_at_an_unknown_point_is_dropped_at_once(pilot: RealizerPilot) -> None:
    tie = '<constraint id="c"><after ref="anticipators:spacebar:pres"><sync ref="w:start"/></after></constraint>'
    pilot.block("b", f'<wait id="w" duration="0.1"/>{tie}')
    await pilot.advance(0.2)
    assert pilot.feedback.warnings == [("b", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.status("b") == "DONE"


@pytest.mark.parametrize("point", ["trainer:down", "trainer:12", "metronome:tick400", "orchestra:beat1", "anyone:hit"])
async def test_a_behavior_at_a_known_point_and_one_at_a_point_of_clients_wait(pilot: RealizerPilot, point: str) -> None:
    pilot.block("b", NOD.format(point))
    await pilot.advance(0.2)
    assert pilot.feedback.warnings == []
    assert not pilot.feedback.reached("b:end")


# --- what nobody should say


SAID = [
    ("user", "voice", float("nan")),
    ("user", "voice", None),
    ("user", "voice", -3.0),
    ("trainer", "sample", float("inf")),
    ("trainer", "sample", -1.0),
    ("trainer", "sample", None),
    ("orchestra", "beat", float("nan")),
    ("spacebar", "kick", None),
]


@pytest.mark.parametrize(("anticipator", "name", "value"), SAID)
async def test_an_invalid_event_has_no_effect(
    pilot: RealizerPilot, anticipator: str, name: str, value: float | None, caplog: pytest.LogCaptureFixture
) -> None:
    pilot.block("b", '<wait id="w" duration="1"/>')
    pilot.event(anticipator, name, value)
    pilot.event(anticipator, name, text="\ud800 no \x00 words \U0001f600")
    await pilot.advance(2)
    assert pilot.feedback.status("b") == "DONE"
    assert pilot.feedback.warnings == []
    assert "is skipped" in caplog.text


@pytest.mark.parametrize("anticipator", ["spacebar", "user", "trainer", "orchestra"])
async def test_predictions_from_outside_cannot_move_the_points_of_an_anticipator(
    pilot: RealizerPilot, anticipator: str, caplog: pytest.LogCaptureFixture
) -> None:
    sync = {"spacebar": "press", "user": "stop", "trainer": "1", "orchestra": "beat1"}[anticipator]
    pilot.block("b", NOD.format(f"{anticipator}:{sync}"))
    pilot.predict(anticipator, sync, 0.5)
    pilot.event("metronome", "press")
    pilot.event("metronome", "beat")
    await pilot.advance(1)
    assert not pilot.feedback.reached("b:h:start")
    assert f"'{anticipator}' is a" in caplog.text


async def test_a_thousand_events_a_second_cause_no_more_feedback_than_ten(pilot: RealizerPilot) -> None:
    pilot.block("b", NOD.format("user:stop+1"))
    pilot.block("c", NOD.format("orchestra:beat4"))
    pilot.event("user", "voice", 1.0)
    for _ in range(100):
        for _ in range(10):
            pilot.event("user", "voice", 0.0)
            pilot.event("orchestra", "beat")
            pilot.event("trainer", "sample", squat(pilot.now))
        await pilot.tick()
    assert len(pilot.feedback.predictions("b")) <= 3
    assert len(pilot.feedback.predictions("c")) <= 5
    await pilot.advance(5)
    assert [pilot.feedback.status(block) for block in "bc"] == ["DONE", "DONE"]


async def test_of_a_thousand_contradictory_predictions_a_second_the_last_of_each_tick_counts(
    pilot: RealizerPilot,
) -> None:
    random = Random(2)
    pilot.block("b", NOD.format("partner:hit"))
    for _ in range(100):
        for _ in range(9):
            pilot.predict("partner", "hit", random.choice([None, -1e9, 0.0, 5.0, 7.0, float("nan"), float("inf")]))
        pilot.predict("partner", "hit", 3.0)
        await pilot.tick()
    assert len(pilot.feedback.predictions("b")) == 1
    await pilot.advance(4)
    assert pilot.feedback.time("b:h:start") == 3.0
    assert pilot.feedback.status("b") == "DONE"


async def test_an_anticipator_that_fails_is_reported_once_and_keeps_its_predictions(
    pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    pilot.block("b", NOD.format("metronome:tick1"))
    pilot.block("c", NOD.format("user:stop"))
    pilot.event("user", "words", text="I see.")
    await until(pilot, 0.1)
    monkeypatch.setattr(SpeechStop, "_words", lambda *_: 1 / 0)
    for _ in range(3):
        pilot.event("user", "words", text="I see you.")
        await pilot.tick()
    await pilot.advance(3)
    assert [pilot.feedback.time(f"{block}:h:start") for block in "bc"] == pytest.approx([1.0, 0.19], abs=0.01)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert (warning.id, warning.time) == ("anticipators:user", 0.1)
    assert "'user' has failed and predicts nothing more: ZeroDivisionError" in warning.text
    assert caplog.text.count("the anticipator 'user' has failed") == 2  # the failure, and the feedback
