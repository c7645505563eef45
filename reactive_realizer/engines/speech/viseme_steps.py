"""When a mouth goes from one viseme to the next.

Every phoneme wants its viseme for as long as it sounds. The mouth takes a step around the border between two of them;
a sound shorter than a step is not reached in full, which is how co-articulation looks. Sounds that the lips make (p, b,
m, f, v) do not put up with that: the steps around them lie outside of them, as far as there is room before the next
such sound. p, b and m keep the time to close the lips in any case, if need be a little early or late.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate, groupby, pairwise
from operator import itemgetter

from reactive_realizer.engine.tts import Phoneme, Utterance
from reactive_realizer.engines.speech.visemes import SILENCE, VisemeTable

STEP = 0.07
"""s from one viseme to the next, always: in a frame of 20 ms no weight changes by more than 0.29."""
CLOSURE = 0.04
"""s of silence before the release of a plosive, which is its onset in an utterance (espeak-ng: 0.030-0.045 s)."""
_TOUCH = 0.01
"""s that the lips stay together at least, so that a frame shows it."""
_CLOSED = "PP"
_LIPS = frozenset({_CLOSED, "FF"})
_LIP_PLOSIVES = frozenset("pb")
_PLOSIVES = _LIP_PLOSIVES | frozenset("tdkgcɟqɢʈɖ\u0261")
_STRESS = "ˈˌ"


@dataclass(frozen=True, slots=True)
class _Border:
    """Where one viseme is wanted no more and the next one is.

    Attributes:
        left: whether the lips make the viseme before.
        entered: whether they make the viseme after.
        since: from when the one before is wanted, s.
        at: the border, s.
        until: until when the one after is wanted, s.
        opened: when the lips were free last before, s.
        closed: when they are wanted next after, s.
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
        """When its step would begin, were it not for its neighbors, s."""
        if self.left == self.entered:
            return self.at - STEP / 2
        if self.entered:
            return self.at - STEP + _given(self.at - self.opened, self.until - self.at)
        return self.at - _given(self.closed - self.at, self.at - self.since)


def wanted_visemes(utterance: Utterance, table: VisemeTable) -> list[tuple[str, float]]:
    """The visemes of an utterance with the times from which they are wanted, s; silence first and last."""
    wanted = [(SILENCE, 0.0), *_onsets(utterance, table), (SILENCE, utterance.duration)]
    return [next(equal) for _, equal in groupby(wanted, key=itemgetter(0))]


def step_begins(wanted: Sequence[tuple[str, float]], duration: float) -> list[float]:
    """When the step between each two visemes begins, s; never decreasing, and the last step ends in time.

    So each step is at every time as far as the next one or further, and no weight is negative. Where wishes are out of
    order, a step begins in the middle between the latest wish before and the earliest after; for that, the time that
    closed lips need is taken out of the time line and put back.

    Args:
        wanted: visemes with the times from which they are wanted, s.
        duration: of the utterance, s, a step at least.
    """
    closings = sum(viseme == _CLOSED for viseme, _ in wanted)
    closing = min(STEP + _TOUCH, (duration - STEP) / max(closings, 1))
    kept = [*accumulate(closing * (left == _CLOSED) for (left, _), _ in pairwise(wanted))]
    wishes = [border.wish - time for border, time in zip(_borders(wanted, duration), kept, strict=True)]
    latest = duration - STEP - closing * closings
    after, before = accumulate(wishes, max), _from_the_end(accumulate(reversed(wishes), min))
    middles = [(early + late) / 2 for early, late in zip(after, before, strict=True)]
    return [max(0.0, min(middle, latest)) + time for middle, time in zip(middles, kept, strict=True)]


def _given(room: float, hold: float) -> float:
    """What lips give of the time that they are together, s.

    Args:
        room: between them and the next or last time that lips are together, s; a sound there needs two steps.
        hold: how long they are together, s.
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
    """When the mouth has to be there, s: a plosive begins with its closure, and the lips open at its release."""
    if phoneme.symbol.strip(_STRESS) in _PLOSIVES:
        return max((before.start + phoneme.start) / 2, phoneme.start - CLOSURE)
    return before.start if before.symbol.strip(_STRESS) in _LIP_PLOSIVES else phoneme.start
