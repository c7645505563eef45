"""From a text and the sounds of its words to the tokens of a network, sentence by sentence."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol
from unicodedata import normalize

from reactive_realizer.engine.phonetics import STRESS
from reactive_realizer.engine.tts import CLAUSE_ENDS, SENTENCE_ENDS
from reactive_realizer.engines.speech.espeak_utterance import PronouncedWord

_MOST_TOKENS = 510
_LONG = 300
"""Tokens after which a sentence is cut at the next comma: the sooner it is spoken, and it has to fit."""
_SENTENCE_ENDS = frozenset(SENTENCE_ENDS + "\n")
_SPACE = " "


@dataclass(frozen=True, slots=True)
class Alphabet:
    """The characters that a network knows.

    Attributes:
        tokens: the number of each letter and sign of IPA.
        stops: the number of each character that may be between two words, or after the last one.
        sounds: how sounds in IPA are written; one that is not listed is written as it is, without the omitted signs.
        omitted: signs of IPA that are not written.
    """

    tokens: Mapping[str, int]
    stops: Mapping[str, int]
    sounds: Mapping[str, str] = field(default_factory=dict)
    omitted: str = ""

    def write(self, sound: str) -> list[int]:
        """The tokens of a sound in IPA, with stress marks in front; none for one that it cannot write."""
        bare = sound.lstrip(STRESS)
        written = self.sounds.get(bare)
        if written is None:
            written = "".join(each for each in bare if each not in self.omitted)
        characters = sound[: len(sound) - len(bare)] + written
        known = (each if each in self.tokens else normalize("NFD", each) for each in characters)
        return [self.tokens[each] for each in "".join(known) if each in self.tokens]

    def punctuate(self, between: str, *, last: bool) -> list[int]:
        """The tokens of the text between two words, or after the last one: stops, quotation marks and one space."""
        joined = _SPACE.join(between.split())
        spaced = (_SPACE * between[:1].isspace() + joined + _SPACE * between[-1:].isspace()) if joined else _SPACE
        return [self.stops[each] for each in (spaced.rstrip() if last else spaced) if each in self.stops]


@dataclass(frozen=True, slots=True)
class SentencePhoneme:
    """A phoneme within a sentence.

    Attributes:
        symbol: IPA, stress marks included.
        word: index of its word in the text.
        first: index of its first token in the sentence.
        last: index after its last token.
    """

    symbol: str
    word: int
    first: int
    last: int


@dataclass(slots=True)
class Sentence:
    """What the network speaks at once.

    Attributes:
        tokens: 1 to 510.
        phonemes: in their order.
        rate: how many times as fast it is spoken.
        silence: after it, s, beside the pause of its stop.
    """

    tokens: list[int] = field(default_factory=list)
    phonemes: list[SentencePhoneme] = field(default_factory=list)
    rate: float = 1.0
    silence: float = 0.0


class SpeakingRate(Protocol):
    """How fast the words of a text are spoken."""

    def rate(self, word: int) -> float:
        """How many times as fast the word that begins at a character is spoken."""
        ...

    def silence(self, word: int, following: int) -> float:
        """The silence between a word and the following one, by their first characters, s."""
        ...


def sentences(
    text: str, words: Sequence[PronouncedWord], alphabet: Alphabet, rate: SpeakingRate | None = None, stop: float = 0.0
) -> Iterator[Sentence]:
    """The sentences of a text; a long one is cut at a clause, or between words if it has none, or else within a word.

    One is also cut at a silence, and where the rate changes.

    Args:
        text: plain text.
        words: all of its words.
        alphabet: of the network.
        rate: of its words; None if all have the usual one.
        stop: silence between two sentences, s, in addition to the pause that the network makes.
    """
    sentence = Sentence()
    for number, word in enumerate(words):
        spoken = [(sound, alphabet.write(sound)) for sound in word.sounds]
        if len(sentence.tokens) + sum(len(tokens) for _, tokens in spoken) > _MOST_TOKENS and sentence.phonemes:
            yield sentence
            sentence = Sentence()
        following = words[number + 1].first if number + 1 < len(words) else len(text)
        sentence.rate = 1.0 if rate is None else rate.rate(word.first)
        for symbol, tokens in spoken:
            if len(sentence.tokens) + len(tokens) > _MOST_TOKENS:
                yield from [sentence] if sentence.phonemes else ()
                sentence = Sentence(rate=sentence.rate)
            _append(
                sentence,
                SentencePhoneme(symbol, number, len(sentence.tokens), len(sentence.tokens) + len(tokens)),
                tokens,
            )
        sentence.silence = 0.0 if rate is None else rate.silence(word.first, following)
        between = text[word.last : following] if word.pause else _SPACE
        changes = rate is not None and (sentence.silence > 0 or rate.rate(following) != sentence.rate)
        stops = _ends(between, len(sentence.tokens))
        ends = following == len(text) or changes or stops
        sentence.silence += stop if stops and following < len(text) else 0.0
        room = _MOST_TOKENS - len(sentence.tokens)
        sentence.tokens += alphabet.punctuate(between, last=ends)[:room]
        if ends and sentence.phonemes:
            yield sentence
            sentence = Sentence()


def _append(sentence: Sentence, phoneme: SentencePhoneme, tokens: Sequence[int]) -> None:
    sentence.tokens += tokens
    if tokens:
        sentence.phonemes.append(phoneme)


def _ends(between: str, length: int) -> bool:
    """Whether a sentence of a number of tokens ends at the text between two words."""
    if _SENTENCE_ENDS & set(between):
        return True
    return length > _LONG and not set(CLAUSE_ENDS).isdisjoint(between)
