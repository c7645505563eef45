"""A sentence with the times of its sounds, and the pieces in which it is spoken."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate, pairwise
from math import ceil, floor
from typing import NamedTuple

from reactive_realizer.engine.phonetics import STRESS
from reactive_realizer.engines.speech.neural.pronunciation import Sentence, SentencePhoneme

PAUSE = 0.1
"""The shortest time between two sounds that counts as a pause, s; the space between words takes 0.025 to 0.075."""
_BEFORE, _AFTER = 0.03, 0.2
"""Sound that is kept before the first and after the last phoneme, s."""
_SHORTEST = 0.4
"""The shortest piece of a sentence that is spoken alone, s."""
_MOST = 1.4
"""The longest piece, if it can be cut at all, in wanted durations."""
_LONG_WORD = 2.0
"""The longest part of a word that is not cut, s; an address or a hundred digits are one long word to a voice."""
_WITHIN_WORD = 1.5
"""The cost of a cut in a word."""
_VOICELESS, _STOPS = frozenset("ptkfsʃθhç"), frozenset("bdg\u0261")


class FrameFormat(NamedTuple):
    """The frames in which a network counts time.

    Attributes:
        rate: sample rate, Hz.
        length: of a frame, samples.
        lag: start of a sound by the durations of the network, minus the time at which it is heard, s.
        margin: frames that are spoken before and after a piece and cut off, so that its ends sound as in the whole
            sentence.
    """

    rate: int
    length: int
    lag: float
    margin: int


class Piece(NamedTuple):
    """A part of the sound of a sentence.

    Attributes:
        frames: the first one that is spoken, and that after the last one.
        first: index of its first sample among those of the frames.
        last: index after its last sample.
    """

    frames: tuple[int, int]
    first: int
    last: int


@dataclass(frozen=True)
class TimedSentence:
    """A sentence as it sounds within an utterance, without most of the silence around it.

    Attributes:
        sentence: what is spoken.
        durations: frames of each token, with those of the silence at both ends; fractions if they are estimated.
        last: whether it ends the utterance; otherwise, the pause of its stop follows.
        format: of the frames.
    """

    sentence: Sentence
    durations: Sequence[float]
    last: bool
    format: FrameFormat

    @cached_property
    def times(self) -> list[tuple[float, float]]:
        """Start and end of its phonemes, s from its first sample."""
        offset = self._first / self.format.rate
        times = [(self._borders[each.first + 1], self._borders[each.last + 1]) for each in self.sentence.phonemes]
        return [(max(0.0, start - offset), end - offset) for start, end in times]

    @property
    def duration(self) -> float:
        """Of its sound, s."""
        return (self._end - self._first) / self.format.rate

    def pieces(self, wanted: Iterator[float]) -> list[Piece]:
        """Cut it where words begin, best after a pause, and a word of several seconds in its middle.

        Args:
            wanted: the duration of each piece, s; as many are taken as there are pieces.
        """
        cuts, rate = [0], self.format.rate
        while (cut := self._next_cut(cuts[-1] / rate, next(wanted))) is not None:
            cuts.append(floor(cut * rate))
        ends = [*(self._first + cut for cut in cuts), self._end]
        return [self._piece(*each) for each in pairwise(ends)]

    def _piece(self, first: int, last: int) -> Piece:
        length, margin = self.format.length, self.format.margin
        begin = max(0, first // length - margin)
        end = min(round(sum(self.durations)), ceil(last / length) + margin)
        return Piece((begin, end), first - begin * length, last - begin * length)

    def _next_cut(self, begin: float, wanted: float) -> float | None:
        """The best place to cut after a time, s; None to leave the rest in one piece."""
        if self.duration - begin < wanted + _SHORTEST:
            return None
        places = [(at, cost) for at, cost in self._places if begin + _SHORTEST <= at <= self.duration - _SHORTEST]
        near = [place for place in places if place[0] - begin <= _MOST * wanted]
        best = min(
            near or places[:1], key=lambda place: place[1] + abs(place[0] - begin - wanted) / wanted, default=None
        )
        return None if best is None else best[0]

    @cached_property
    def _places(self) -> list[tuple[float, float]]:
        """Where it can be cut, s, each with a cost: 0 after a pause, more the louder the sounds are there."""
        phonemes, times = self.sentence.phonemes, self.times
        places = []
        for before, after, (_, end), (start, _) in zip(phonemes, phonemes[1:], times, times[1:], strict=False):
            if start - end >= PAUSE:
                places.append((start - _BEFORE, 0.0))
            elif before.word != after.word:
                places.append((start, _cost(after)))
            elif start - (places[-1][0] if places else 0.0) >= _LONG_WORD:
                places.append((start, _WITHIN_WORD))
        return places

    @cached_property
    def _borders(self) -> list[float]:
        """When each token begins to be heard, s, and when the last one ends."""
        rate, length, lag, _ = self.format
        return [max(0.0, frames * length / rate - lag) for frames in accumulate(self.durations, initial=0.0)]

    @cached_property
    def _first(self) -> int:
        """The first sample that is kept."""
        return max(0, round((self._borders[self.sentence.phonemes[0].first + 1] - _BEFORE) * self.format.rate))

    @cached_property
    def _end(self) -> int:
        """The sample after the last one that is kept."""
        end = self._borders[self.sentence.phonemes[-1].last + 1]
        return min(
            round((end + _AFTER if self.last else max(self._borders[-2], end)) * self.format.rate),
            round(sum(self.durations) * self.format.length),
        )


def _cost(phoneme: SentencePhoneme) -> float:
    """How much a cut before a phoneme may be heard: least where it is silent, as before a voiceless stop."""
    first = phoneme.symbol.lstrip(STRESS)[:1]
    return 0.2 if first in _VOICELESS else 0.4 if first in _STOPS else 0.8
