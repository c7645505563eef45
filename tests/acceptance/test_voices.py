"""The voice of a speech, which its character or the speech itself names."""

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.audio import AudioStart
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

pytestmark = pytest.mark.speech

SAY = '<speech id="s"{voice}><text>Hello there, Alice.</text></speech>'


async def sound(pilot: RealizerPilot, id_: str, voice: str = "") -> bytes:
    """The sound of a speech in some voice, by default that of the character."""
    pilot.block(id_, SAY.format(voice=f' bmlt:voice="{voice}"' if voice else ""))
    await pilot.advance(3.0)
    assert pilot.feedback.status(id_) == "DONE"
    *_, start = (change for change in pilot.sounds if isinstance(change, AudioStart))
    return start.clip.sound.wav


async def test_a_speech_may_have_another_voice_than_its_character() -> None:
    async with open_pilot(SceneOptions(voice="espeak")) as pilot:
        own, british = await sound(pilot, "b1"), await sound(pilot, "b2", "en-gb")
        assert own != british
        assert await sound(pilot, "b3") == own, "what is remembered of one voice is not said with another"
        assert await sound(pilot, "b4", "en-gb") == british
        assert pilot.feedback.warnings == []


async def test_an_unknown_voice_drops_its_speech_and_the_nearest_known_one_is_named() -> None:
    async with open_pilot(SceneOptions(voice="espeak")) as pilot:
        pilot.block("b1", SAY.format(voice=' bmlt:voice="en-su"') + '<head id="nod" lexeme="NOD"/>')
        await pilot.advance(2.0)
        (warning,) = pilot.feedback.of("warningFeedback")
        assert warning.id == "b1:s"
        assert "there is no voice 'en-su'" in warning.text
        assert "did you mean 'en-us'?" in warning.text
        assert pilot.feedback.time("b1:nod:end")
