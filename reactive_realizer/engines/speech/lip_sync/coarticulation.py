"""Co-articulation by dominance functions.

Every sound has a weight for every morph target, and a dominance over time, which is greatest while it sounds and falls
exponentially before and after. The weight that is shown is the mean of those of the sounds, weighted by dominance. So a
sound with little dominance, such as a t, takes the shape of its neighbors, and lips are rounded early for a u.

The source is M. M. Cohen and D. W. Massaro, *Modeling coarticulation in synthetic visual speech* (1993). Here, the
distance in time counts from the sound and not from its center, so that a long vowel keeps its shape throughout.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Mapping, Sequence
from math import exp

from reactive_realizer.binding.mouth_shapes import Articulator, MouthShape
from reactive_realizer.engines.speech.lip_sync.timed_visemes import TimedViseme

_REACH = 8.0
"""Number of time constants after which a dominance is neglected: 3e-4 of its maximum."""


class Coarticulation:
    """The mouth of an utterance as its sounds shape each other.

    Args:
        visemes: of the utterance, in order and without gaps.
        shapes: by viseme.
        articulators: by name.
    """

    def __init__(
        self, visemes: Sequence[TimedViseme], shapes: Mapping[str, MouthShape], articulators: Mapping[str, Articulator]
    ) -> None:
        self._visemes = visemes
        self._shapes = shapes
        self._articulators = articulators
        self._starts = [each.start for each in visemes]
        self._ends = [each.end for each in visemes]

    def weights(self, name: str, time: float) -> dict[str, float]:
        """Weights, 0..1, of the morph targets of an articulator at a time, s from the start of the utterance.

        Visemes that hold the articulator in a contact take no part: `Contacts` shows them.
        """
        articulator = self._articulators[name]
        first = bisect_left(self._ends, time - _REACH * articulator.after)
        last = bisect_right(self._starts, time + _REACH * articulator.before)
        total = 0.0
        sums = dict.fromkeys(articulator.morphs, 0.0)
        for viseme in self._visemes[first:last]:
            shape = self._shapes[viseme.name]
            if name in shape.contact:
                continue
            dominance = shape.dominance.get(name, 1.0) * _presence(articulator, viseme, time)
            total += dominance
            for morph, target in shape.morphs.items():
                if morph in sums:
                    sums[morph] += dominance * target
        return {morph: value / total for morph, value in sums.items() if value > 0.0}


def _presence(articulator: Articulator, viseme: TimedViseme, time: float) -> float:
    """The dominance of a viseme as a share of its maximum, 0..1."""
    if time < viseme.start:
        return exp((time - viseme.start) / articulator.before)
    return exp((viseme.end - time) / articulator.after) if time > viseme.end else 1.0
