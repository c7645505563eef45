"""What is prominent in an utterance, and how it is divided: words with stress and pitch, in phrases."""

from collections.abc import Container, Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.engine.phonetics import PRIMARY_STRESS, SECONDARY_STRESS
from reactive_realizer.engine.sound_unit import SoundPart
from reactive_realizer.engine.tts import CLAUSE_ENDS, SENTENCE_ENDS, Phoneme, Utterance
from reactive_realizer.liveliness.pitch import STEP, pitches

MOST_WORDS: Final = 9
"""Words of a phrase; a longer one between two punctuation marks is divided."""

_STRESSES: Final = ((PRIMARY_STRESS, 1.0), (SECONDARY_STRESS, 0.5))
"""The marks of stress in IPA, and how much they count."""

_STRIKING: Final = 4.0
"""Semitones above the middle of the phrase that stand out fully.

Changes of less than three semitones are hardly noticed: J. 't Hart, "Differential sensitivity to pitch distance,
particularly in speech" (Journal of the Acoustical Society of America 69, 1981).
"""

_LONGEST: Final = 15.0
"""The longest phrase of which the pitch is estimated, s; it takes 3 ms of a tick per second.

Few phrases last more than 5 s, but a word can have thousands of letters, and a recording of one word many minutes.
"""

_WEIGHTS: Final = (0.35, 0.4, 0.25)
"""Shares of stress, pitch and content in the prominence of a word; our choice."""


@dataclass(frozen=True, slots=True)
class SpokenWord:
    """A word as it is heard.

    Attributes:
        index: in the utterance.
        text: in lowercase.
        start: s from the start of the utterance.
        end: when it stops sounding, s.
        accent: the middle of its stressed vowel, s.
        stress: of its phonemes: 1 primary, 0.5 secondary, 0 none.
        content: whether it is no function word.
        prominence: 0 to 1.
    """

    index: int
    text: str
    start: float
    end: float
    accent: float
    stress: float
    content: bool
    prominence: float = 0.0


@dataclass(frozen=True, slots=True)
class Phrase:
    """Words that are spoken in one go.

    Attributes:
        words: one or more.
        pause: silence after it, s.
        closing: the punctuation mark after it: a stop, a comma or nothing.
        sentence: the mark that ends its sentence.
        item: whether it is an item of a list.
    """

    words: tuple[SpokenWord, ...]
    pause: float
    closing: str
    sentence: str
    item: bool = False

    @property
    def start(self) -> float:
        """When it begins, s from the start of the utterance."""
        return self.words[0].start

    @property
    def end(self) -> float:
        """When its last word has sounded, s from the start of the utterance."""
        return self.words[-1].end


def phrases_of(utterance: Utterance, function_words: Container[str]) -> list[Phrase]:
    """The phrases of an utterance, without the prominence of their words."""
    words = _words(utterance, function_words)
    marks = [_mark_after(utterance, word.index) for word in words]
    phrases: list[Phrase] = []
    first = 0
    for last, mark in enumerate(marks):
        if mark or last == len(words) - 1:
            sentence = next((each for each in marks[last:] if each in SENTENCE_ENDS and each), "")
            parts = _divided(words[first : last + 1])
            for part in parts:
                follower = words[part[-1].index + 1] if part[-1].index + 1 < len(words) else None
                pause = (utterance.duration if follower is None else follower.start) - part[-1].end
                phrases.append(Phrase(tuple(part), max(0.0, pause), mark if part is parts[-1] else "", sentence))
            first = last + 1
    return _with_items(phrases)


def with_prominence(phrase: Phrase, utterance: Utterance, sounds: Iterable[SoundPart]) -> Phrase:
    """A phrase whose words have their prominence, as far as the voice tells stress and pitch.

    What a voice does not tell counts as for a content word, or as for a function word.

    Args:
        phrase: of the utterance.
        utterance: with the phonemes.
        sounds: what is made of it.
    """
    rises = _rises(phrase, utterance.sample_rate, sounds)
    stressed = bool(utterance.phonemes)
    words = []
    for word, rise in zip(phrase.words, rises, strict=True):
        content = float(word.content)
        parts = (word.stress if stressed else content, content if rise is None else rise, content)
        prominence = sum(weight * part for weight, part in zip(_WEIGHTS, parts, strict=True))
        words.append(replace(word, prominence=prominence))
    return replace(phrase, words=tuple(words))


def _words(utterance: Utterance, function_words: Container[str]) -> list[SpokenWord]:
    spoken = [phoneme for phoneme in utterance.phonemes if phoneme.symbol and phoneme.duration > 0.0]
    starts = [word.start for word in utterance.words]
    found: list[SpokenWord] = []
    position = 0
    for index, (word, (start, until)) in enumerate(
        zip(utterance.words, pairwise([*starts, utterance.duration]), strict=True)
    ):
        own: list[Phoneme] = []
        while position < len(spoken) and spoken[position].start < until:
            own.append(spoken[position])
            position += 1
        text = word.text.lower()
        stress, accent = _stress(own, start, until)
        end = own[-1].start + own[-1].duration if own else until
        found.append(SpokenWord(index, text, start, min(end, until), accent, stress, text not in function_words))
    return found


def _stress(phonemes: Sequence[Phoneme], start: float, until: float) -> tuple[float, float]:
    """The stress of a word, and the middle of its stressed vowel, s; without any, the middle of the word."""
    for mark, stress in _STRESSES:
        for phoneme in phonemes:
            if mark in phoneme.symbol:
                return stress, phoneme.start + phoneme.duration / 2.0
    return 0.0, start + min(until - start, 0.4) / 2.0


def _mark_after(utterance: Utterance, index: int) -> str:
    """The stop or comma between a word and the next one; nothing if there is none."""
    words, text = utterance.words, utterance.text
    until = words[index + 1].first if index + 1 < len(words) else len(text)
    between = text[words[index].last : until]
    return next((mark for marks in (SENTENCE_ENDS, CLAUSE_ENDS) for mark in between if mark in marks), "")


def _divided(words: Sequence[SpokenWord]) -> list[Sequence[SpokenWord]]:
    """A phrase in parts that are short enough: each begins with a function word, if there is one near its place."""
    if len(words) <= MOST_WORDS:
        return [words]
    middle = len(words) // 2
    near = sorted(range(middle - 2, middle + 3), key=lambda index: (words[index].content, abs(index - middle)))
    return [*_divided(words[: near[0]]), *_divided(words[near[0] :])]


def _with_items(phrases: list[Phrase]) -> list[Phrase]:
    """Mark the items of lists: short phrases, divided by commas, of which the last begins with a conjunction."""
    marked = list(phrases)
    for last, phrase in enumerate(phrases):
        first = last
        while first > 0 and phrases[first - 1].closing == "," and len(phrases[first - 1].words) <= MOST_WORDS // 2:
            first -= 1
        if last - first >= 2 and phrase.words[0].text in ("and", "or"):
            marked[first : last + 1] = [replace(each, item=True) for each in marked[first : last + 1]]
    return marked


def _rises(phrase: Phrase, rate: int, sounds: Iterable[SoundPart]) -> list[float | None]:
    """How much the pitch of each word stands out in its phrase, 0 to 1; None where it is not found."""
    if phrase.end - phrase.start > _LONGEST:
        return [None] * len(phrase.words)
    heard = np.zeros(max(0, int((phrase.end - phrase.start) * rate)), "<i2")
    for begin, sound, _ in sounds:
        own = np.frombuffer(sound.pcm(phrase.start - begin, phrase.end - begin), "<i2")
        first = max(0, int((begin - phrase.start) * rate))
        heard[first : first + len(own)] = own[: max(0, len(heard) - first)]
    found = pitches(heard.tobytes(), rate)
    voiced = found[~np.isnan(found)]
    if not len(voiced):
        return [None] * len(phrase.words)
    semitones = 12.0 * np.log2(found / np.median(voiced))
    return [_rise(semitones, word.start - phrase.start, word.end - phrase.start) for word in phrase.words]


def _rise(semitones: NDArray[np.float64], start: float, end: float) -> float | None:
    own = semitones[int(start / STEP) : max(int(end / STEP), int(start / STEP) + 1)]
    own = own[~np.isnan(own)]
    if not len(own):
        return None
    return float(np.clip(own.max() / _STRIKING, 0.0, 1.0))
