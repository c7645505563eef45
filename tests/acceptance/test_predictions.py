"""Predictions: when they are sent, and their content."""

from pathlib import Path
from typing import Any

import pytest
from lxml import etree

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.realizer.inputs import BmlText
from reactive_realizer.testing.pilot import RealizerPilot, block, open_pilot

HIT = "anticipators:test:hit"
NOD = f'<head id="h" lexeme="NOD" end="{HIT}"/>'


def said_at(pilot: RealizerPilot, name: str) -> list[Any]:
    return [line.time for line in pilot.feedback.predictions(name)]


def status(line: Any) -> Any:
    return next(value for name, value in line.element[0].attrib.items() if name.endswith("status"))


async def test_a_block_that_starts_at_once_is_predicted_once_with_all_known_times(pilot: RealizerPilot) -> None:
    pilot.block("b", '<head id="h" lexeme="NOD" amount="0.4" start="1" end="3"/>')
    await pilot.tick()
    (line,) = pilot.feedback.predictions("b")
    block, head = line.element
    assert (block.get("globalStart"), block.get("globalEnd"), status(line)) == ("0", "3", "IN_EXEC")
    assert (head.get("id"), head.get("start"), head.get("end")) == ("b:h", "1", "3")
    assert (head.get("lexeme"), head.get("amount")) == ("NOD", "0.4")
    assert line.element.get("characterId") == "alice"


async def test_predictions_do_not_change_with_the_clock_alone(pilot: RealizerPilot) -> None:
    pilot.block("b", NOD)
    pilot.block("next", '<speech id="s"><text>Then this.</text></speech>', composition="APPEND")
    await pilot.advance(2)
    assert said_at(pilot, "b") == said_at(pilot, "next") == [0.0]


async def test_predictions_from_outside_do_not_move_the_ticks_of_the_metronome(
    pilot: RealizerPilot, caplog: pytest.LogCaptureFixture
) -> None:
    pilot.block("b", '<head id="h" lexeme="NOD" stroke="anticipators:metronome:tick3"/>')
    await pilot.tick()
    pilot.predict("metronome", "tick3", 1.5)
    await pilot.tick()
    assert pilot.feedback.predicted("b:h:stroke") == 3.0
    assert "'metronome' is a metronome" in caplog.text


async def test_an_unknown_end_is_predicted_as_the_last_known_point(pilot: RealizerPilot) -> None:
    pilot.block("b", f'{NOD}<wait id="w" duration="2"/>')
    await pilot.tick()
    assert pilot.feedback.predicted("b:end") == 2.0
    head = pilot.feedback.predictions("b")[-1].element[1]
    assert head.get("end") is None


async def test_the_prediction_of_a_block_that_waits_for_an_unknown_time_assumes_now(pilot: RealizerPilot) -> None:
    pilot.block("b", NOD)
    await pilot.advance(0.5)
    pilot.block("next", '<wait id="w" duration="1"/>', composition="APPEND")
    await pilot.tick()
    assert (pilot.feedback.predicted("next:start"), pilot.feedback.predicted("next:end")) == (0.5, 1.5)
    assert status(pilot.feedback.predictions("next")[0]) == "LURKING"


async def test_a_prediction_is_repeated_when_a_time_moves_by_more_than_a_millisecond_or_becomes_known(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", NOD)
    pilot.block("next", composition="APPEND")
    await pilot.advance(0.1)
    for time, said in [(3.0, 2), (3.0005, 2), (3.0009, 2), (3.0015, 3), (2.0, 4), (None, 5), (2.5, 6)]:
        pilot.predict("test", "hit", time)
        await pilot.advance(0.1)
        assert len(pilot.feedback.predictions("b")) == said
        assert len(pilot.feedback.predictions("next")) == said
        if time is not None:
            assert pilot.feedback.predicted("b:end") == pytest.approx(time, abs=1e-3)
            assert pilot.feedback.predicted("next:start") == pytest.approx(time, abs=1e-3)


async def test_several_moves_in_a_tick_cause_one_prediction(pilot: RealizerPilot) -> None:
    pilot.block("b", NOD)
    await pilot.advance(0.1)
    for time in (3.0, 4.0, 5.0):
        pilot.predict("test", "hit", time)
    await pilot.tick()
    assert len(pilot.feedback.predictions("b")) == 2
    assert pilot.feedback.predicted("b:end") == 5.0


async def test_the_prediction_of_a_block_that_moves_all_the_time_is_reported_ten_times_a_second_and_the_last_one_too(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", NOD)
    for each in range(1, 96):
        pilot.predict("test", "hit", 3.0 + each / 100)
        await pilot.tick()
    assert said_at(pilot, "b") == pytest.approx([each / 10 for each in range(10)])
    await pilot.advance(0.2)
    assert said_at(pilot, "b")[10:] == [1.0]
    assert pilot.feedback.predicted("b:end") == 3.95


async def test_before_a_block_progresses_it_is_predicted_as_it_has_moved(pilot: RealizerPilot) -> None:
    pilot.predict("test", "hit", 3.0)
    pilot.block("b", '<wait id="w" start="0.5" end="3"/><wait id="v" start="1" end="anticipators:test:hit"/>')
    await pilot.advance(0.48)
    for time in (4.0, 5.0):
        pilot.predict("test", "hit", time)
        await pilot.tick()
    await pilot.advance(0.05)
    about = [(line.kind, line.time) for line in pilot.feedback.messages if line.time > 0.0]
    assert about == [("predictionFeedback", 0.48), ("predictionFeedback", 0.5), ("syncPointProgress", 0.5)]
    assert pilot.feedback.predicted("b:end") == 5.0


async def test_moving_predictions_of_many_behaviors_share_a_rate_and_each_is_reported_in_the_end(
    tmp_path: Path,
) -> None:
    human = tmp_path / "human.toml"
    human.write_text("[character.alice]\n[limits]\npredicted_behaviors_per_second = 100\n")
    async with open_pilot(SceneOptions(human, voice="text")) as pilot:
        for name in "abcdef":
            pilot.block(name, NOD)
        await pilot.advance(1)
        for each in range(50):
            pilot.predict("test", "hit", 3.0 + each / 100)
            await pilot.tick()
        moved = [line for line in pilot.feedback.messages if line.kind == "predictionFeedback" and line.time > 1]
        assert len(moved) == pytest.approx(25, abs=2), "each counts as its behavior and itself"
        assert {line.id for line in moved} == set("abcdef")
        await pilot.advance(1)
        assert [pilot.feedback.predicted(f"{name}:end") for name in "abcdef"] == [3.49] * 6


async def test_moving_predictions_of_one_client_do_not_delay_those_of_another(tmp_path: Path) -> None:
    human = tmp_path / "human.toml"
    human.write_text("[character.alice]\n[limits]\npredicted_behaviors_per_second = 400\n")
    waits = "".join(f'<wait id="w{i}" start="{HIT}" duration="1"/>' for i in range(100))
    async with open_pilot(SceneOptions(human, voice="text")) as pilot:
        pilot.predict("test", "hit", 7.0)
        for i in range(5):
            pilot.realizer.put(BmlText(block(f"many{i}", waits), "one"))
        pilot.realizer.put(BmlText(block("few", NOD), "another"))
        await pilot.advance(5)
        for each in range(100):
            pilot.predict("test", "hit", 7.0 + each / 100)
            await pilot.tick()
        times = [time for time in said_at(pilot, "few") if time > 5]
        assert len(times) >= 9
        assert sum(len([time for time in said_at(pilot, f"many{i}") if time > 5]) for i in range(5)) == 2, (
            "a report counts 101 of its 200 a second"
        )


async def test_changes_in_the_tick_in_which_a_block_starts_are_in_its_prediction(pilot: RealizerPilot) -> None:
    right = '<gesture id="{}" lexeme="BEAT" mode="RIGHT_HAND" start="0" end="{}"/>'
    pilot.block("b", right.format("one", 2) + right.format("two", 5))
    await pilot.tick()
    (line,) = pilot.feedback.predictions("b")
    assert line.element[0].get("globalEnd") == "2"
    assert [element.get("id") for element in list(line.element)[1:]] == ["b:one"]


async def test_a_waiting_block_is_predicted_again_when_it_starts(pilot: RealizerPilot) -> None:
    pilot.block("one", '<wait id="w" duration="0.5"/>')
    pilot.block("two", '<wait id="w" duration="0.5"/>', composition="APPEND")
    await pilot.advance(2)
    assert said_at(pilot, "two") == [0.0, 0.5]
    assert [status(line) for line in pilot.feedback.predictions("two")] == ["LURKING", "IN_EXEC"]
    assert {line.element[0].get("globalStart") for line in pilot.feedback.predictions("two")} == {"0.5"}


async def test_an_empty_block_is_predicted_too(pilot: RealizerPilot) -> None:
    pilot.block("b")
    await pilot.tick()
    assert [(line.kind, line.id) for line in pilot.feedback.messages] == [
        ("predictionFeedback", "b"),
        ("blockProgress", "b:start"),
        ("blockProgress", "b:end"),
    ]


async def test_an_inline_sync_of_a_speech_has_its_predicted_time(pilot: RealizerPilot) -> None:
    pilot.block("b", '<speech id="s"><text>Well <sync id="now"/>then.</text></speech>')
    await pilot.advance(3)
    speech = pilot.feedback.predictions("b")[0].element[1]
    sync = next(child for child in speech.iter() if etree.QName(child).localname == "sync")
    predicted = next(float(value) for name, value in sync.attrib.items() if str(name).endswith("time"))
    assert predicted == pytest.approx(pilot.feedback.time("b:s:now"))


async def test_an_ended_block_is_not_predicted(pilot: RealizerPilot) -> None:
    pilot.predict("test", "hit", 1.0)
    pilot.block("b", NOD)
    await pilot.advance(2)
    said = len(pilot.feedback.messages)
    pilot.predict("test", "hit", 5.0)
    await pilot.advance(1)
    assert len(pilot.feedback.messages) == said


async def test_the_last_prediction_of_a_block_has_the_times_of_the_tick_in_which_it_ends(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 2.0)
    pilot.block("b", '<wait id="w" start="0" end="anticipators:t:hit"/>')
    await pilot.advance(1.0)
    pilot.predict("t", "hit", 0.5)
    await pilot.tick()
    assert pilot.feedback.time("b:end") == pilot.feedback.time("b:w:end") == 1.0
    assert pilot.feedback.predicted("b:end") == pilot.feedback.predicted("b:w:end") == 1.0


async def test_a_behavior_that_is_dropped_in_the_tick_in_which_it_begins_is_predicted_before(
    pilot: RealizerPilot,
) -> None:
    shift = '<gazeShift id="{}" target="bluebox" start="0" end="{}"/>'
    pilot.block("b", shift.format("q", "s:end-1") + shift.format("s", "anticipators:events:asked"))
    await pilot.tick()
    assert pilot.feedback.reached("b:q:start")
    first = next(message for message in pilot.feedback.messages if message.kind == "predictionFeedback")
    assert first.predicted("b:q:start") == 0.0


async def test_points_that_are_reached_in_the_tick_in_which_their_behavior_is_dropped_are_predicted(
    any_strategy: RealizerPilot,
) -> None:
    pilot = any_strategy
    pilot.predict("test", "hit", 1.0)
    arm = 'lexeme="BEAT" mode="LEFT_HAND"'
    first = f'<gesture id="g" {arm} stroke="{HIT}" end="other:end"/>'
    other = f'<gesture id="other" {arm} start="{HIT}" end="anticipators:test:unknown"/>'
    pilot.block("b", f'{first}{other}<wait id="w" duration="3"/>')
    await pilot.advance(1.1)
    assert [name for name, _ in pilot.feedback.warnings] == ["b:other", "b:g"]
    assert pilot.feedback.time("b:g:stroke") == pilot.feedback.time("b:g:end") == 1.0
    before, after = [line for line in pilot.feedback.predictions("b") if line.time == 1.0]
    gesture = before.element.find("{*}gesture")
    assert gesture is not None
    assert gesture.get("stroke") == "1"
    assert after.element.find("{*}gesture") is None
