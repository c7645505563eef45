"""The visemes of an utterance with the times at which the mouth makes them."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby, pairwise

from reactive_realizer.binding.mouth_shapes import SILENCE
from reactive_realizer.binding.viseme_binding import VisemeBinding
from reactive_realizer.engine.phonetics import CLOSURE, STRESS, is_plosive
from reactive_realizer.engine.tts import Phoneme, Utterance

_PAUSE = 0.08
"""Duration below which a pause does not close the mouth, s: espeak-ng has such within words."""

_LIP_PLOSIVES = frozenset("pb")


@dataclass(frozen=True, slots=True)
class TimedViseme:
    """A viseme from `start` to `end`, s from the start of the utterance."""

    name: str
    start: float
    end: float


def timed_visemes(utterance: Utterance, binding: VisemeBinding) -> list[TimedViseme]:
    """The visemes of an utterance in order, without gaps, with silence before and after it; neighbors differ."""
    onsets = [(SILENCE, 0.0), *_onsets(utterance, binding), (SILENCE, utterance.duration)]
    changes = [next(same) for _, same in groupby(onsets, key=lambda onset: onset[0])]
    ends = [start for _, start in changes[1:]]
    return [TimedViseme(*onset, end) for onset, end in zip(changes, [*ends, utterance.duration], strict=True)]


def _onsets(utterance: Utterance, binding: VisemeBinding) -> Iterator[tuple[str, float]]:
    sounding = [phoneme for phoneme in utterance.phonemes if phoneme.duration > 0.0]
    starts = [_start(before, phoneme) for before, phoneme in pairwise([Phoneme("", 0.0, 0.0), *sounding])]
    ends = [*starts[1:], *(phoneme.start + phoneme.duration for phoneme in sounding[-1:])]
    for phoneme, start, end in zip(sounding, starts, ends, strict=True):
        if not phoneme.symbol and end - start < _PAUSE:
            continue
        visemes = binding.visemes(phoneme.symbol)
        for number, viseme in enumerate(visemes):
            yield viseme, start + (end - start) * number / len(visemes)
    if ends:
        yield SILENCE, min(ends[-1], utterance.duration)


def _start(before: Phoneme, phoneme: Phoneme) -> float:
    """The start of the viseme of a phoneme, s: that of a plosive is its closure, and the lips open at its release."""
    if is_plosive(phoneme.symbol):
        return max((before.start + phoneme.start) / 2, phoneme.start - CLOSURE)
    return before.start if before.symbol.strip(STRESS) in _LIP_PLOSIVES else phoneme.start
