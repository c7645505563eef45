"""Fillers hold the floor: a speech may ask the character to go on with "uhm" until its next words arrive."""

import pytest

from reactive_realizer.bml.names import BMLIS, OWN
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

FILLER = "a.s.filler"


def say(text: str = "one two", attributes: str = 'bmlis:generatefiller="true"', id_: str = "s") -> str:
    return f'<speech xmlns:bmlis="{BMLIS}" xmlns:rr="{OWN}" id="{id_}" {attributes}><text>{text}</text></speech>'


def said(pilot: RealizerPilot) -> list[str]:
    """The points of fillers that were reached."""
    return [each.id for each in pilot.feedback.of("syncPointProgress") if ".filler:" in each.id]


async def test_a_filler_follows_a_speech_whose_successor_is_not_there(pilot: RealizerPilot) -> None:
    pilot.block("a", say())
    await pilot.advance(10)
    ended = pilot.feedback.time("a:s:end")
    assert pilot.feedback.time("a:end") == ended
    assert 0.3 < pilot.feedback.time(f"{FILLER}:filler1:start") - ended < 0.5
    assert f"{FILLER}:filler3:end" in said(pilot)
    assert pilot.feedback.status(FILLER) == "DONE"
    assert pilot.feedback.warnings == []


async def test_the_eyes_look_away_as_long_as_the_floor_is_held(pilot: RealizerPilot) -> None:
    pilot.block("a", say())
    await pilot.advance(10)
    assert pilot.feedback.time(f"{FILLER}:away:start") == pilot.feedback.time(f"{FILLER}:filler1:start")
    assert pilot.feedback.time(f"{FILLER}:away:end") > pilot.feedback.time(f"{FILLER}:filler3:end")


async def test_nothing_is_said_unless_it_is_asked_for(pilot: RealizerPilot) -> None:
    for attributes in ("", 'bmlis:generatefiller="false"'):
        pilot.block("a", say(attributes=attributes))
        await pilot.advance(5)
    assert said(pilot) == []


async def test_nothing_is_said_before_a_successor_that_is_there(pilot: RealizerPilot) -> None:
    pilot.block("a", say())
    pilot.block("b", '<head id="n" lexeme="NOD"/>', composition="APPEND")
    await pilot.advance(10)
    assert said(pilot) == []
    assert pilot.feedback.time("b:start") == pilot.feedback.time("a:end")


async def test_nothing_is_said_while_the_same_block_speaks_on(pilot: RealizerPilot) -> None:
    pilot.block("a", say() + say("three", 'start="s:end+2"', "t"))
    await pilot.advance(10)
    assert said(pilot) == []


@pytest.mark.parametrize("speech", ["now", "word"])
async def test_nothing_is_said_after_a_speech_that_was_interrupted(pilot: RealizerPilot, speech: str) -> None:
    pilot.block("a", say("one two three four"))
    await pilot.advance(0.5)
    pilot.block("stop", f'<bmla:interrupt id="i" target="a" speech="{speech}"/>')
    await pilot.advance(5)
    assert said(pilot) == []


async def test_it_fills_the_time_in_which_a_successor_waits_and_ends_when_it_starts(pilot: RealizerPilot) -> None:
    pilot.block("a", say())
    waiting = '<speech id="t" start="anticipators:answer:ready"><text>three</text></speech>'
    pilot.block("b", waiting, composition="APPEND")
    await pilot.advance(3)
    assert f"{FILLER}:filler1:end" in said(pilot)
    pilot.predict("answer", "ready", pilot.now)
    await pilot.advance(3)
    assert pilot.feedback.status(FILLER) == "INTERRUPTED"
    assert abs(pilot.feedback.time(f"{FILLER}:end") - pilot.feedback.time("b:t:start")) < 0.02
    assert f"{FILLER}:filler3:start" not in said(pilot)
    assert pilot.feedback.warnings == []


async def test_a_block_that_is_merged_and_does_not_speak_leaves_the_floor_held(pilot: RealizerPilot) -> None:
    pilot.block("a", say())
    await pilot.advance(1.7)
    pilot.block("b", '<head id="n" lexeme="NOD"/>')
    await pilot.advance(8)
    assert pilot.feedback.status(FILLER) == "DONE"


async def test_an_appended_block_does_not_wait_for_a_filler(pilot: RealizerPilot) -> None:
    pilot.block("a", say())
    await pilot.advance(1.7)
    assert f"{FILLER}:filler1:start" in said(pilot)
    pilot.block("b", '<head id="n" lexeme="NOD"/>', composition="APPEND")
    await pilot.advance(0.05)
    assert pilot.feedback.reached("b:start")
    assert pilot.feedback.status(FILLER) == "INTERRUPTED"


async def test_a_filler_is_interrupted_like_any_block(pilot: RealizerPilot) -> None:
    pilot.block("a", say())
    await pilot.advance(1.7)
    pilot.block("stop", f'<bmla:interrupt id="i" target="{FILLER}"/>')
    await pilot.advance(5)
    assert pilot.feedback.status(FILLER) == "INTERRUPTED"
    assert f"{FILLER}:filler2:start" not in said(pilot)
    assert pilot.feedback.warnings == []


async def test_the_same_speech_has_the_same_fillers() -> None:
    told = []
    for _ in range(2):
        async with open_pilot() as pilot:
            pilot.block("a", say())
            await pilot.advance(10)
            told.append(pilot.feedback.raw)
    assert told[0] == told[1]


async def test_a_value_that_is_neither_true_nor_false_is_told(pilot: RealizerPilot) -> None:
    pilot.block("a", say(attributes='bmlis:generatefiller="perhaps"'))
    await pilot.advance(3)
    assert [each.text for each in pilot.feedback.of("warningFeedback") if "generatefiller" in each.text]
