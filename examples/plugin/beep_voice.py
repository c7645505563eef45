"""A voice that beeps once per word, every 0.4 s."""

import re

import numpy as np

from reactive_realizer.engine.tts import Utterance, VoiceCapabilities, Word

_RATE = 16_000
_WORD = 0.4


class BeepVoice:
    """Plays a tone of 0.3 s for each word."""

    async def start(self) -> None:
        """Does nothing: there is nothing to prepare."""

    async def close(self) -> None:
        """Does nothing: there is nothing to release."""

    async def voices(self) -> tuple[str, ...]:
        """No names, since there is only one voice."""
        return ()

    async def capabilities(self) -> VoiceCapabilities:
        """Sound, for texts in any language."""
        return VoiceCapabilities(sound=True)

    def synthesize(self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None) -> Utterance:
        """Beeps for a text; a mark has the time of the word after it."""
        spans = [found.span() for found in re.finditer(r"\w+(?:['.:]\w+)*", text)]
        words = tuple(Word(text[a:b], _WORD * n, a, b) for n, (a, b) in enumerate(spans))
        times = {name: _WORD * sum(last <= index for _, last in spans) for name, index in marks}
        return Utterance(text, _WORD * len(words), words, times, audio=_beep() * len(words), sample_rate=_RATE)


def _beep() -> bytes:
    time = np.arange(round(_WORD * _RATE)) / _RATE
    return np.where(time < 0.3, 8000 * np.sin(2 * np.pi * 440 * time), 0).astype("<i2").tobytes()
