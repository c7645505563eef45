"""Markup that a network can follow: what is said, how it is pronounced, and how fast."""

import re
from collections.abc import Sequence
from dataclasses import replace
from math import prod
from typing import Final

from reactive_realizer.bml.markup import Markup, MarkupKind
from reactive_realizer.engine.phonetics import STRESS
from reactive_realizer.engine.tts import STOPS
from reactive_realizer.engines.speech.espeak_utterance import PronouncedWord
from reactive_realizer.engines.speech.neural.pronunciation import Alphabet

DICTIONARY: Final = frozenset({MarkupKind.SUB, MarkupKind.SAY_AS})
"""What espeak-ng, which pronounces the words, follows for the network."""
FOLLOWED: Final = DICTIONARY | {MarkupKind.PHONEME, MarkupKind.SENTENCE, MarkupKind.RATE, MarkupKind.BREAK}

_SLOWEST, _FASTEST = 0.5, 2.0
"""How much slower and faster than usual the network speaks well."""

_LONGER: Final = "[\u02d0\u02d1\u0300-\u036f\u02b0\u02b2\u02b7]*"
"""Signs that belong to the sound before them: length, diacritics."""


class MarkedRate:
    """How fast the words of a text with markup are spoken (`SpeakingRate`)."""

    def __init__(self, markup: Sequence[Markup]) -> None:
        self._rates = [each for each in markup if each.kind is MarkupKind.RATE]
        self._breaks = [each for each in markup if each.kind is MarkupKind.BREAK]

    def rate(self, word: int) -> float:
        """How many times as fast the word that begins at a character is spoken; parts within parts multiply."""
        wanted = prod(each.number for each in self._rates if each.first <= word < each.last)
        return min(max(wanted, _SLOWEST), _FASTEST)

    def silence(self, word: int, following: int) -> float:
        """The silence between a word and the following one, by their first characters, s."""
        return sum(each.number for each in self._breaks if word < each.first <= following)


def with_stops(text: str, markup: Sequence[Markup]) -> str:
    """A text of the same length, with a full stop behind each sentence that is marked and has none."""
    characters = list(text)
    for each in markup:
        sentence = text[each.first : each.last].rstrip()
        end = each.first + len(sentence)
        if each.kind is MarkupKind.SENTENCE and sentence[-1:] not in STOPS and text[end : end + 1] == " ":
            characters[end] = "."
    return "".join(characters)


def with_phonemes(
    words: Sequence[PronouncedWord], markup: Sequence[Markup], alphabet: Alphabet
) -> tuple[PronouncedWord, ...]:
    """Words with the sounds that markup gives; those of several words belong to the first of them."""
    known = sorted(alphabet.sounds, key=len, reverse=True)
    any_of_these = "|".join([*map(re.escape, known), rf"[^\s.{STRESS}]"])
    sound = re.compile(rf"[{STRESS}]*(?:{any_of_these}){_LONGER}")
    pronounced = list(words)
    for each in markup:
        if each.kind is MarkupKind.PHONEME:
            inside = [number for number, word in enumerate(words) if each.first <= word.first < each.last]
            for number in inside:
                sounds = tuple(sound.findall(each.text)) if number == inside[0] else ()
                pronounced[number] = replace(words[number], sounds=sounds)
    return tuple(pronounced)
