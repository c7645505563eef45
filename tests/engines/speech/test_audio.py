"""The sound of an utterance as a WAV file."""

import io
import wave

from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.speech.audio import wav_bytes


def test_a_wav_file_holds_the_samples_as_they_are():
    audio = bytes(range(200))
    with wave.open(io.BytesIO(wav_bytes(Utterance("a", 0.1, (), {}, (), audio, 1000)))) as sound:
        assert (sound.getnchannels(), sound.getsampwidth(), sound.getframerate()) == (1, 2, 1000)
        assert sound.readframes(1000) == audio
