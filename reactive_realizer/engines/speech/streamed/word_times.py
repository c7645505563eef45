"""When the words of a streamed speech begin: as a client or the aligner says, and otherwise as estimated."""

import unicodedata
from collections.abc import Sequence
from itertools import accumulate
from typing import Final

import numpy as np

from reactive_realizer.engines.speech.streamed.sound_levels import SpokenTime
from reactive_realizer.errors import CreationFault, RealizerError

_CHARACTER: Final = 0.065
"""Duration of a character, s, before anything is known: with five letters and a space a word, 150 words a minute."""
_ENOUGH: Final = 20
"""Number of characters after which the rate of a voice is known."""


class OtherWords(CreationFault):
    """Times of words that the text of the speech does not have."""

    code = "other-words"
    template = "times of words in the stream '{stream}' are ignored from '{word}' on: {reason}"
    stream: str
    word: str
    reason: str


class GivenWords:
    """The times that a client gives for the words of a text, in its order.

    Args:
        stream: its name, for messages.
        words: of the text.

    Attributes:
        begins: of the first words, s.
    """

    def __init__(self, stream: str, words: Sequence[str]) -> None:
        self.begins: list[float] = []
        self._stream = stream
        self._words = [*map(_plain, words)]
        self._ignored = False

    def add(self, given: Sequence[tuple[str, float]]) -> None:
        """Take the times of further words; punctuation alone is skipped.

        Raises:
            RealizerError: "other-words". Times that follow are ignored.
        """
        for written, begin in given:
            word = _plain(written)
            if self._ignored or not word:
                continue
            number = len(self.begins)
            reason = None
            if number == len(self._words):
                reason = "the text has no more words"
            elif word != self._words[number]:
                reason = f"the text has '{self._words[number]}' there"
            elif begin < (self.begins or [0.0])[-1]:
                reason = f"{begin:g} s is before the word that precedes it"
            if reason is not None:
                self._ignored = True
                raise RealizerError(OtherWords(stream=self._stream, word=written, reason=reason))
            self.begins.append(begin)


def word_begins(
    words: Sequence[str], known: Sequence[float], spoken: SpokenTime, *, ended: bool
) -> tuple[list[float], float]:
    """The starts of all words, and the end of the last one, s.

    Words whose starts are unknown are spread over the time that is speech, in proportion to their numbers of
    characters. As long as more may arrive, they are assumed to be spoken as fast as those before.

    Args:
        words: of the text.
        known: starts of the first words, s.
        spoken: the time that is speech in what has arrived.
        ended: whether nothing follows.
    """
    places = [*accumulate((len(word) + 1 for word in words), initial=0)]
    anchors = {places[number]: spoken.at(begin) for number, begin in enumerate(known)} or {0: 0.0}
    if len(known) < len(words) or not ended:
        last, at = max(anchors.items())
        character = at / last if last >= _ENOUGH else _CHARACTER
        end = spoken.total if ended else at + (places[-1] - last) * character
        anchors[places[-1]] = max(end, at)
    estimated = [spoken.time(float(each)) for each in np.interp(places, [*anchors], [*anchors.values()])]
    begins = [*known, *estimated[len(known) :]]
    return [*accumulate(begins[: len(words)], max)], max(begins)


def _plain(word: str) -> str:
    """A word without punctuation, for comparison."""
    return "".join(letter for letter in unicodedata.normalize("NFKC", word).casefold() if letter.isalnum())
