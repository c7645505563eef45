"""What a mouth does while an utterance sounds."""

from bisect import bisect_left, bisect_right
from collections.abc import Mapping
from itertools import pairwise

from reactive_realizer.engines.speech.tts import Utterance
from reactive_realizer.engines.speech.viseme_steps import SHORTEST_STEP, Step, steps_between, wanted_visemes
from reactive_realizer.engines.speech.visemes import SILENCE, VisemeTable, default_table


class VisemeTrack:
    """The visemes of an utterance, with smooth steps between them.

    An utterance without phonemes, or too short to open the mouth and close it again, leaves the mouth closed.
    """

    def __init__(self, utterance: Utterance, table: VisemeTable | None = None) -> None:
        self._table = table or default_table()
        self._visemes = [SILENCE]
        self._steps: list[Step] = []
        if utterance.duration >= 2 * SHORTEST_STEP:
            wanted = wanted_visemes(utterance, self._table)
            self._visemes = [viseme for viseme, _ in wanted]
            self._steps = steps_between(wanted, utterance.duration)

    def weights(self, time: float) -> Mapping[str, float]:
        """Weights of ARKit blend shapes, 0..1, at a time from the start of the utterance, s."""
        return self._table.blend(self.visemes(time))

    def visemes(self, time: float) -> Mapping[str, float]:
        """Weights of the visemes that the mouth is in or between, 0..1, sum 1."""
        first = bisect_right(self._steps, time, key=lambda step: step.end)
        last = bisect_left(self._steps, time, key=lambda step: step.begin)
        made = [1.0, *(_made(step, time) for step in self._steps[first:last]), 0.0]
        weights: dict[str, float] = {}
        for viseme, (entered, left) in zip(self._visemes[first : last + 1], pairwise(made), strict=True):
            weights[viseme] = weights.get(viseme, 0.0) + entered - left
        return weights


def _made(step: Step, time: float) -> float:
    """How much of a step has been made, 0..1, without a jump in speed."""
    part = (time - step.begin) / (step.end - step.begin)
    return part * part * (3.0 - 2.0 * part)
