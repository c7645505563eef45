"""Speeches with either kind of voice."""

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.engine.tts import Utterance, Word
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.testing.pilot import open_pilot

VOICES = ["text", pytest.param("espeak", marks=pytest.mark.speech)]


@pytest.mark.parametrize("voice", VOICES)
@pytest.mark.parametrize("text", ["<text/>", "<text>...</text>", '<text><sync id="m"/></text>'])
async def test_a_speech_without_a_word_is_dropped_with_a_warning_and_the_rest_of_the_block_plays(
    voice: str, text: str
) -> None:
    async with open_pilot(SceneOptions(voice=voice)) as pilot:
        pilot.block("b", f'<speech id="s">{text}</speech><wait id="w" duration="0.1"/>')
        await pilot.advance(1)
        assert pilot.feedback.warnings == [("b:s", "CANNOT_CREATE_BEHAVIOR")]
        assert "no word" in pilot.feedback.of("warningFeedback")[0].text
        assert pilot.feedback.reached("b:w:end")


async def test_signs_of_which_the_voice_makes_no_sound_are_nothing_to_say(monkeypatch: pytest.MonkeyPatch) -> None:
    def synthesize(text: str, marks: object, voice: str | None) -> Utterance:
        return Utterance(text, 0.0, (Word(text, 0.0, 0, len(text)),), {})

    monkeypatch.setattr(TextVoice, "synthesize", staticmethod(synthesize))
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.block("b", '<speech id="s"><text>\u0301\u0302</text></speech><wait id="w" duration="0.1"/>')
        await pilot.advance(1)
        (warning,) = pilot.feedback.of("warningFeedback")
        assert "no words" in warning.text
        assert pilot.feedback.reached("b:w:end")


@pytest.mark.parametrize("voice", VOICES)
async def test_a_speech_starts_with_its_block_and_reports_its_mark(voice: str) -> None:
    async with open_pilot(SceneOptions(voice=voice)) as pilot:
        pilot.block("b", '<speech id="s"><text>Put it <sync id="m"/>here.</text></speech>')
        await pilot.advance(3)
        assert not pilot.feedback.warnings
        times = [pilot.feedback.time(f"b:s:{sync}") for sync in ("start", "m", "end")]
        assert times == sorted(times)
        assert times[0] == pilot.feedback.time("b:start")
