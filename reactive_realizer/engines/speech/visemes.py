"""Lip sync: from the phonemes of an utterance to visemes, and to the blend shapes of a face.

The mouth holds the viseme of a phoneme for as long as it sounds, and takes a step around the border between two
visemes. A sound that is shorter than a step is not reached in full: this is co-articulation. The lip sounds (p, b, m,
f, v) are exempt: the steps around them lie outside of them, as far as there is room before the next lip sound. p, b and
m always keep the time to close the lips, if need be a little early or late.
"""

import re
import tomllib
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from itertools import accumulate, groupby, pairwise
from operator import itemgetter
from typing import Self

from reactive_realizer.engine.tts import Phoneme, Utterance

SILENCE = "sil"
"""The viseme of a closed mouth at rest."""

STEP = 0.07
"""Duration of every step from one viseme to the next, s: in a frame of 20 ms no weight changes by more than 0.29."""
CLOSURE = 0.04
"""Silence before the release of a plosive, s; the release is its onset in an utterance (espeak-ng: 0.030-0.045 s)."""
_TOUCH = 0.01
"""The shortest time for which the lips stay together, s, so that a frame shows it."""
_CLOSED = "PP"
_LIPS = frozenset({_CLOSED, "FF"})
_LIP_PLOSIVES = frozenset("pb")
_PLOSIVES = _LIP_PLOSIVES | frozenset("tdkgcɟqɢʈɖ\u0261")
_STRESS = "ˈˌ"


@dataclass(frozen=True, slots=True)
class VisemeTable:
    """The mouth shapes of speech, as a table that users can edit.

    Attributes:
        phonemes: viseme of each letter or pair of letters of the International Phonetic Alphabet, pairs first.
        morphs: weights, 0..1, of ARKit blend shapes for each viseme except silence.
    """

    phonemes: Mapping[str, str]
    morphs: Mapping[str, Mapping[str, float]]

    @classmethod
    def from_toml(cls, text: str) -> Self:
        """Reads the format of assets/visemes/visemes.toml."""
        table = tomllib.loads(text)
        phonemes = [(letters, viseme) for viseme, listed in table["phonemes"].items() for letters in listed]
        return cls(dict(sorted(phonemes, key=lambda entry: len(entry[0]), reverse=True)), table["morphs"])

    def visemes(self, symbol: str) -> tuple[str, ...]:
        """The visemes of a phoneme, in order: two for a diphthong, silence for a pause, none for an unknown sound."""
        if not symbol:
            return (SILENCE,)
        return tuple(self.phonemes[letters] for letters in re.findall("|".join(self.phonemes), symbol))

    def blend(self, weights: Mapping[str, float]) -> dict[str, float]:
        """Weights of ARKit blend shapes, 0..1, for weights of visemes whose sum is at most 1."""
        blended: dict[str, float] = {}
        for viseme, weight in weights.items():
            for morph, share in self.morphs.get(viseme, {}).items():
                blended[morph] = blended.get(morph, 0.0) + weight * share
        return blended


@cache
def default_table() -> VisemeTable:
    """The table in the package."""
    return VisemeTable.from_toml((files("reactive_realizer") / "assets/visemes/visemes.toml").read_text("utf-8"))


class VisemeTrack:
    """The visemes of an utterance, with steps of constant speed between them.

    Steps with soft ends would be too fast in the middle. An utterance without phonemes, or too short to open the mouth
    and close it again, leaves the mouth closed.
    """

    def __init__(self, utterance: Utterance, table: VisemeTable | None = None) -> None:
        self._table = table or default_table()
        self._visemes = [SILENCE]
        self._begins: list[float] = []
        if utterance.duration >= 2 * STEP:
            wanted = _wanted_visemes(utterance, self._table)
            self._visemes = [viseme for viseme, _ in wanted]
            self._begins = _step_begins(wanted, utterance.duration)

    def weights(self, time: float) -> Mapping[str, float]:
        """Weights of ARKit blend shapes, 0..1, at a time from the start of the utterance, s."""
        return self._table.blend(self.visemes(time))

    def visemes(self, time: float) -> Mapping[str, float]:
        """Weights of the visemes at a time from the start of the utterance, s; 0..1, with sum 1."""
        first = bisect_right(self._begins, time - STEP)
        last = bisect_left(self._begins, time)
        made = [1.0, *((time - begin) / STEP for begin in self._begins[first:last]), 0.0]
        weights: dict[str, float] = {}
        for viseme, (entered, left) in zip(self._visemes[first : last + 1], pairwise(made), strict=True):
            weights[viseme] = weights.get(viseme, 0.0) + entered - left
        return weights


@dataclass(frozen=True, slots=True)
class _Border:
    """The border between two visemes.

    Attributes:
        left: whether the viseme before it is made with the lips.
        entered: whether the viseme after it is made with the lips.
        since: start of the viseme before, s.
        at: the border, s.
        until: end of the viseme after, s.
        opened: end of the last lip sound, s.
        closed: start of the next lip sound, s.
    """

    left: bool
    entered: bool
    since: float
    at: float
    until: float
    opened: float
    closed: float

    @property
    def wish(self) -> float:
        """The start of its step without regard to the neighboring steps, s."""
        if self.left == self.entered:
            return self.at - STEP / 2
        if self.entered:
            return self.at - STEP + _yielded(self.at - self.opened, self.until - self.at)
        return self.at - _yielded(self.closed - self.at, self.at - self.since)


def _wanted_visemes(utterance: Utterance, table: VisemeTable) -> list[tuple[str, float]]:
    """The visemes of an utterance with their start times, s; silence first and last."""
    wanted = [(SILENCE, 0.0), *_onsets(utterance, table), (SILENCE, utterance.duration)]
    return [next(equal) for _, equal in groupby(wanted, key=itemgetter(0))]


def _step_begins(wanted: Sequence[tuple[str, float]], duration: float) -> list[float]:
    """The start of the step between each two visemes, s; never decreasing, and the last step ends in time.

    So each step is always as far as the next one or further, and no weight is negative. Where wishes are out of order,
    a step begins in the middle between the latest wish before and the earliest after. Meanwhile the time that closed
    lips need is taken out of the time line.

    Args:
        wanted: visemes with their start times, s.
        duration: of the utterance, s, at least one step.
    """
    closings = sum(viseme == _CLOSED for viseme, _ in wanted)
    closing = min(STEP + _TOUCH, (duration - STEP) / max(closings, 1))
    kept = [*accumulate(closing * (left == _CLOSED) for (left, _), _ in pairwise(wanted))]
    wishes = [border.wish - time for border, time in zip(_borders(wanted, duration), kept, strict=True)]
    latest = duration - STEP - closing * closings
    after, before = accumulate(wishes, max), _from_the_end(accumulate(reversed(wishes), min))
    middles = [(early + late) / 2 for early, late in zip(after, before, strict=True)]
    return [max(0.0, min(middle, latest)) + time for middle, time in zip(middles, kept, strict=True)]


def _yielded(room: float, hold: float) -> float:
    """The time that a lip sound yields to a step beside it, s.

    Args:
        room: time to the previous or next lip sound, s; the sound between them needs two steps.
        hold: duration of the lip sound, s.
    """
    return max(0.0, min(STEP - room / 2, hold - _TOUCH))


def _borders(wanted: Sequence[tuple[str, float]], duration: float) -> list[_Border]:
    lips = [(left in _LIPS, entered in _LIPS) for (left, _), (entered, _) in pairwise(wanted)]
    times = [at for _, at in wanted[1:]]
    opened = accumulate((at if left else 0.0 for (left, _), at in zip(lips, times, strict=True)), max)
    wanted_from = [at if entered else duration for (_, entered), at in zip(lips, times, strict=True)]
    closed = _from_the_end(accumulate(reversed(wanted_from), min))
    spans = zip([0.0, *times], times, [*times[1:], duration], strict=False)
    rows = zip(lips, spans, opened, closed, strict=True)
    return [_Border(*sides, *span, free, taken) for sides, span, free, taken in rows]


def _from_the_end(values: Iterable[float]) -> list[float]:
    return [*values][::-1]


def _onsets(utterance: Utterance, table: VisemeTable) -> Iterator[tuple[str, float]]:
    sounding = [phoneme for phoneme in utterance.phonemes if phoneme.duration > 0.0]
    starts = [_start(before, phoneme) for before, phoneme in pairwise([Phoneme("", 0.0, 0.0), *sounding])]
    for phoneme, (start, end) in zip(sounding, pairwise([*starts, utterance.duration]), strict=True):
        visemes = table.visemes(phoneme.symbol)
        for number, viseme in enumerate(visemes):
            yield viseme, start + (end - start) * number / len(visemes)


def _start(before: Phoneme, phoneme: Phoneme) -> float:
    """The start of the viseme of a phoneme, s: that of a plosive is its closure, and the lips open at its release."""
    if phoneme.symbol.strip(_STRESS) in _PLOSIVES:
        return max((before.start + phoneme.start) / 2, phoneme.start - CLOSURE)
    return before.start if before.symbol.strip(_STRESS) in _LIP_PLOSIVES else phoneme.start
