"""A voice that is read: captions at two words a second, which can be stretched (thesis 8.11, TextEngine)."""

from types import MappingProxyType
from typing import Final

from reactive_realizer.engine.tts import Utterance, VoiceCapabilities, Word, word_spans

_WORD: Final = 0.5
"""Duration of every word, s (thesis 8.11)."""
STRETCH: Final = (0.5, 3.0)
"""Four words a second, which is as fast as most people read, to two words in three seconds."""


class CaptionVoice:
    """A `TTSBinding` without sound, whose utterances can be stretched. `synthesize` returns at once."""

    async def start(self) -> None:
        """Does nothing."""

    async def close(self) -> None:
        """Does nothing."""

    async def voices(self) -> tuple[str, ...]:
        """No names: the one voice accepts every name."""
        return ()

    async def capabilities(self) -> VoiceCapabilities:
        """Silence, in any language, without markup, that can be stretched."""
        return VoiceCapabilities(sound=False, stretch=STRETCH)

    def synthesize(self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None = None) -> Utterance:
        """The utterance of a plain text; see `TTSBinding.synthesize`. The voice is ignored."""
        spans = word_spans(text)
        words = tuple(Word(text[first:last], _WORD * index, first, last) for index, (first, last) in enumerate(spans))
        duration = _WORD * len(words)
        unmarked = Utterance(text, duration, words, MappingProxyType({}), stretch=STRETCH)
        times = {name: unmarked.time_of_character(index) for name, index in marks}
        return Utterance(text, duration, words, MappingProxyType(times), stretch=STRETCH)
