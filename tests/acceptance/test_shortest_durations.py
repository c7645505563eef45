"""Timings that leave a body too little time: something gives way, and a warning says what."""

import pytest

from reactive_realizer.testing.pilot import RealizerPilot

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
    assert "g from start to stroke: needs 0.36 s, has 0.00 s" in text
    assert pilot.feedback.time("b:s:start") == 2.0
    assert pilot.feedback.time("b:g:stroke") - pilot.feedback.time("b:g:start") > 0.36


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
    assert "p from start to ready: needs 0.29 s, has 0.05 s" in text
    assert pilot.feedback.time("b:p:start") == 0.5
    assert pilot.feedback.time("b:p:ready") > 0.5 + 0.29


async def test_a_hurried_gesture_that_has_just_enough_time_keeps_its_ties(pilot: RealizerPilot) -> None:
    pilot.block("b", '<pointing id="p" target="bluebox" start="0.5" ready="0.8"/>')
    await pilot.advance(3)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:p:ready") == 0.8


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
