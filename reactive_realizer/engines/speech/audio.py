"""The sound of an utterance as a file."""

import io
import wave

from reactive_realizer.engine.tts import Utterance


def wav_bytes(utterance: Utterance) -> bytes:
    """A WAV file, mono, 16 bit, at the sample rate of the utterance."""
    file = io.BytesIO()
    with wave.open(file, "wb") as sound:
        sound.setnchannels(1)
        sound.setsampwidth(2)
        sound.setframerate(utterance.sample_rate)
        sound.writeframes(utterance.audio)
    return file.getvalue()
