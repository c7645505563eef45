"""Speeches that SSML describes: their sync points, and what is told of what cannot be spoken."""

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.audio import AudioStart
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

SSML = """
<speech id="s"><text>Take the <sync id="m"/>red one.</text>
  <description priority="{}" type="application/ssml+xml">
    <speak xmlns="http://www.w3.org/2001/10/synthesis">{}</speak>
  </description>{}
</speech>
"""
SLOW = 'Take <break time="2s"/> the <mark name="m"/><prosody rate="50%">red</prosody> one.'
BEAT = '<gesture id="g" lexeme="BEAT" stroke="s:m"/>'
ESPEAK = SceneOptions(voice="espeak")


async def say(pilot: RealizerPilot, ssml: str, other: str = "", priority: int = 1) -> None:
    pilot.block("b", SSML.format(priority, ssml, other) + BEAT)
    await pilot.advance(6.0)
    assert pilot.feedback.status("b") == "DONE"


def shown(pilot: RealizerPilot) -> str:
    (start,) = (change for change in pilot.sounds if isinstance(change, AudioStart))
    assert start.clip.caption is not None
    return start.clip.caption.text


@pytest.mark.speech
async def test_a_mark_is_the_sync_point_of_the_speech() -> None:
    async with open_pilot(ESPEAK) as pilot:
        await say(pilot, SLOW)
        assert pilot.feedback.warnings == []
        start, mark = pilot.feedback.time("b:s:start"), pilot.feedback.time("b:s:m")
        assert mark - start > 2.0
        assert pilot.feedback.time("b:g:stroke") == mark


@pytest.mark.speech
async def test_a_mark_that_only_ssml_has_can_be_referred_to() -> None:
    async with open_pilot(ESPEAK) as pilot:
        nod = '<head id="nod" lexeme="NOD" start="s:extra"/>'
        pilot.block("b", SSML.format(1, f'{SLOW} <mark name="extra"/>Yes.', "") + nod)
        await pilot.advance(6.0)
        assert pilot.feedback.warnings == []
        assert pilot.feedback.time("b:nod:start") == pilot.feedback.time("b:s:extra")


@pytest.mark.speech
async def test_what_the_voice_cannot_do_is_told_once_and_the_rest_is_spoken() -> None:
    strange = (
        '<phoneme ph="a">the</phoneme> <audio src="x.wav"/><phoneme ph="b">very</phoneme> <mark name="m"/>red one.'
    )
    async with open_pilot(ESPEAK) as pilot:
        await say(pilot, f"Take {strange}")
        (warning,) = pilot.feedback.of("warningFeedback")
        assert 'the voice cannot do <phoneme alphabet="ipa">, <audio>; the rest of the SSML is followed' in warning.text
        assert shown(pilot) == "Take the very red one."


async def test_a_voice_without_markup_speaks_the_text_of_the_ssml_and_tells_what_it_left_out() -> None:
    async with open_pilot(SceneOptions(voice="captions")) as pilot:
        await say(pilot, 'Take the <mark name="m"/><emphasis>blue</emphasis> one.')
        assert shown(pilot) == "Take the blue one."
        (warning,) = pilot.feedback.of("warningFeedback")
        assert "the voice cannot do <emphasis>" in warning.text


@pytest.mark.speech
async def test_a_better_description_that_cannot_be_spoken_is_told_and_the_next_one_is() -> None:
    mary = '<description priority="2" type="maryxml"><maryxml xmlns="http://mary.dfki.de/2002/MaryXML"/></description>'
    async with open_pilot(ESPEAK) as pilot:
        await say(pilot, 'Have the <mark name="m"/>blue one.', mary)
        assert shown(pilot) == "Have the blue one."
        (warning,) = pilot.feedback.of("warningFeedback")
        assert "line 5" in warning.text
        assert "a description in MaryXML cannot be spoken" in warning.text


@pytest.mark.speech
async def test_a_worse_description_is_not_mentioned() -> None:
    mary = '<description priority="2" type="maryxml"/>'
    async with open_pilot(ESPEAK) as pilot:
        await say(pilot, 'Have the <mark name="m"/>blue one.', mary, priority=3)
        assert pilot.feedback.warnings == []


@pytest.mark.speech
async def test_ssml_without_a_mark_of_the_text_is_told_and_the_text_is_spoken() -> None:
    async with open_pilot(ESPEAK) as pilot:
        await say(pilot, "Have the blue one.")
        assert shown(pilot) == "Take the red one."
        (warning,) = pilot.feedback.of("warningFeedback")
        assert "these are missing: m" in warning.text
