"""When a mouth goes from one viseme to the next.

Every phoneme wants its viseme for as long as it sounds. The mouth takes a step around the border between two of them; a
sound shorter than the steps at its borders is not reached in full, which is how co-articulation looks. Sounds that the
lips make (p, b, m, f, v) do not put up with that: the steps around them lie outside of them, as wide as there is room
before the next such sound.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate, groupby, pairwise
from operator import itemgetter

from reactive_realizer.engines.speech.tts import Phoneme, Utterance
from reactive_realizer.engines.speech.visemes import SILENCE, VisemeTable

STEP = 0.08
"""s from one viseme to the next, where nothing is in the way."""
SHORTEST_STEP = 0.04
"""s; where lip sounds stand closer than this allows, the lips stay together for a shorter time rather than jump."""
CLOSURE = 0.04
"""s of silence before the release of a plosive, which is its onset in an utterance (espeak-ng: 0.030-0.045 s)."""
_LIPS = frozenset({"PP", "FF"})
_LIP_PLOSIVES = frozenset("pb")
_PLOSIVES = _LIP_PLOSIVES | frozenset("tdkgcɟqɢʈɖ\u0261")
_STRESS = "ˈˌ"


@dataclass(frozen=True, slots=True)
class Step:
    """The way from one viseme to the next, in s from the start of the utterance."""

    begin: float
    end: float


def wanted_visemes(utterance: Utterance, table: VisemeTable) -> list[tuple[str, float]]:
    """The visemes of an utterance with the times from which they are wanted, s; silence first and last."""
    wanted = [(SILENCE, 0.0), *_onsets(utterance, table), (SILENCE, utterance.duration)]
    return [next(equal) for _, equal in groupby(wanted, key=itemgetter(0))]


def steps_between(wanted: Sequence[tuple[str, float]], duration: float) -> list[Step]:
    """One step between each two visemes; neither begins nor ends ever decrease.

    So each step is at every time further than the next one, and no weight is ever negative.

    Args:
        wanted: visemes with the times from which they are wanted, s.
        duration: of the utterance, s.
    """
    borders = [(left in _LIPS, entered in _LIPS, at) for (left, _), (entered, at) in pairwise(wanted)]
    opened = accumulate((at if left else 0.0 for left, _, at in borders), max)
    closed = _accumulated_back((at if entered else duration for _, entered, at in borders), min)
    steps = [_step(*border, *room) for border, *room in zip(borders, opened, closed, strict=True)]
    begins = accumulate((step.begin for step in steps), max)
    ends = _accumulated_back((step.end for step in steps), min)
    return [_widened(begin, end, duration) for begin, end in zip(begins, ends, strict=True)]


def _accumulated_back(values: Iterable[float], function: Callable[[float, float], float]) -> list[float]:
    return [*accumulate(reversed([*values]), function)][::-1]


def _step(left_lips: bool, entered_lips: bool, at: float, opened: float, closed: float) -> Step:
    """The step over one border, wherever its neighbors are.

    Args:
        left_lips: whether the lips made the sound before.
        entered_lips: whether they make the sound after.
        at: the border, s.
        opened: when the lips were free last before, s.
        closed: when they are wanted next after, s.
    """
    if left_lips and entered_lips:
        return Step(at - STEP / 4, at + STEP / 4)
    if entered_lips:
        return Step(at - min(STEP, (at - opened) / 2), at)
    if left_lips:
        return Step(at, at + min(STEP, (closed - at) / 2))
    return Step(at - STEP / 2, at + STEP / 2)


def _widened(begin: float, end: float, duration: float) -> Step:
    """A step of the shortest width at least, inside the utterance."""
    missing = max(0.0, SHORTEST_STEP - (end - begin))
    begin, end = begin - missing / 2, end + missing / 2
    return Step(max(0.0, min(begin, duration - SHORTEST_STEP)), min(duration, max(end, SHORTEST_STEP)))


def _onsets(utterance: Utterance, table: VisemeTable) -> Iterator[tuple[str, float]]:
    sounding = [phoneme for phoneme in utterance.phonemes if phoneme.duration > 0.0]
    starts = [_start(before, phoneme) for before, phoneme in pairwise([Phoneme("", 0.0, 0.0), *sounding])]
    for phoneme, (start, end) in zip(sounding, pairwise([*starts, utterance.duration]), strict=True):
        visemes = table.visemes(phoneme.symbol)
        for number, viseme in enumerate(visemes):
            yield viseme, start + (end - start) * number / len(visemes)


def _start(before: Phoneme, phoneme: Phoneme) -> float:
    """When the mouth has to be there, s: a plosive begins with its closure, and the lips open at its release."""
    if phoneme.symbol.strip(_STRESS) in _PLOSIVES:
        return max((before.start + phoneme.start) / 2, phoneme.start - CLOSURE)
    return before.start if before.symbol.strip(_STRESS) in _LIP_PLOSIVES else phoneme.start
