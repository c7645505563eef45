"""The voice of a character: texts of speeches become utterances, which are remembered."""

from collections.abc import AsyncGenerator, AsyncIterator
from typing import Final, NamedTuple

from reactive_realizer.bml.markup import Markup
from reactive_realizer.bml.speech import VOICE, Speech
from reactive_realizer.engine.engine import Part
from reactive_realizer.engine.tts import MarkupTTSBinding, TTSBinding, Utterance
from reactive_realizer.errors import CreationFault, RealizerError
from reactive_realizer.sized_cache import SizedCache

_REMEMBERED_BYTES: Final = 16 * 1024 * 1024
"""Size of the utterances that are remembered for repetition: six minutes of speech at 22 kHz."""

_BYTES_A_CHARACTER: Final = 70
"""Size of an utterance without its sound: a word takes 200 to 400 bytes."""


class NothingToSay(CreationFault):
    """A speech without words that sound."""

    code = "nothing-to-say"
    template = "its text contains no words"


class _Text(NamedTuple):
    """A text to be synthesized.

    Attributes:
        text: plain.
        marks: the id of each, and the index of the character that it precedes.
        voice: its name; None for the default one.
        markup: of the text.
    """

    text: str
    marks: tuple[tuple[str, int], ...]
    voice: str | None
    markup: tuple[Markup, ...]


class Synthesis:
    """Has speeches spoken by the voice that they name, or else by that of their character.

    What is said again need not be synthesized again. Utterances are remembered when they are planned or extended, not
    when they are synthesized: so a replay remembers the same ones at the same ticks.

    Args:
        tts: the text-to-speech system.
        voice: of the character; None for the default one.
    """

    def __init__(self, tts: TTSBinding, voice: str | None) -> None:
        self._tts = tts
        self._voice = voice
        self._spoken: SizedCache[_Text, Utterance] = SizedCache(_REMEMBERED_BYTES)

    def speak(self, speech: Speech) -> Utterance | AsyncGenerator[Part, None]:
        """The utterance of a speech if it is known or made at once; otherwise the slow work that makes it.

        Raises:
            RealizerError: the voice cannot speak it.
        """
        text = self._text(speech)
        if (known := self._spoken.get(text)) is not None:
            return known
        if text.markup and isinstance(self._tts, MarkupTTSBinding):
            spoken = self._tts.synthesize_markup(*text)
        else:
            spoken = self._tts.synthesize(text.text, text.marks, text.voice)
        if not isinstance(spoken, Utterance):
            return _parts(spoken)
        self.remember(speech, spoken)
        return spoken

    def remember(self, speech: Speech, utterance: Utterance) -> None:
        """Remember the utterance of a speech if it is complete."""
        if utterance.complete:
            size = len(utterance.audio) + _BYTES_A_CHARACTER * len(utterance.text)
            self._spoken.add(self._text(speech), utterance, size)

    def left_out(self, speech: Speech, utterance: Utterance) -> tuple[str, ...]:
        """The markup of a speech that the voice does not follow, each kind once, as it is written."""
        if not speech.markup:
            return ()
        left_out = utterance.left_out if isinstance(self._tts, MarkupTTSBinding) else speech.markup
        return tuple(dict.fromkeys(each.written for each in left_out))

    def _text(self, speech: Speech) -> _Text:
        marks = tuple((mark.id, mark.char_index) for mark in speech.marks)
        return _Text(speech.text, marks, speech.extensions.get(VOICE, self._voice), speech.markup)


def check_words(utterance: Utterance) -> None:
    """Check that there is something to say, and that some of it has sound: a sign can be a word without sound.

    Raises:
        RealizerError: ``nothing-to-say``.
    """
    if not utterance.words or utterance.duration == 0.0:
        raise RealizerError(NothingToSay())


async def _parts(spoken: AsyncIterator[Utterance]) -> AsyncGenerator[Part, None]:
    """An utterance as slow work, each time that more of it is made.

    Raises:
        RealizerError: ``nothing-to-say``, so that the next form of the speech is made.
    """
    async for utterance in spoken:
        check_words(utterance)
        yield Part(utterance, utterance.complete)
