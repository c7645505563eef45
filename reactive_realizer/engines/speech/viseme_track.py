"""What a mouth does while an utterance sounds."""

from bisect import bisect_left, bisect_right
from collections.abc import Mapping
from itertools import pairwise

from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.speech.viseme_steps import STEP, step_begins, wanted_visemes
from reactive_realizer.engines.speech.visemes import SILENCE, VisemeTable, default_table


class VisemeTrack:
    """The visemes of an utterance, with steps of an even speed between them.

    Softer at its ends, a step would be abrupt in its middle.

    An utterance without phonemes, or too short to open the mouth and close it again, leaves the mouth closed.
    """

    def __init__(self, utterance: Utterance, table: VisemeTable | None = None) -> None:
        self._table = table or default_table()
        self._visemes = [SILENCE]
        self._begins: list[float] = []
        if utterance.duration >= 2 * STEP:
            wanted = wanted_visemes(utterance, self._table)
            self._visemes = [viseme for viseme, _ in wanted]
            self._begins = step_begins(wanted, utterance.duration)

    def weights(self, time: float) -> Mapping[str, float]:
        """Weights of ARKit blend shapes, 0..1, at a time from the start of the utterance, s."""
        return self._table.blend(self.visemes(time))

    def visemes(self, time: float) -> Mapping[str, float]:
        """Weights of the visemes that the mouth is in or between, 0..1, sum 1."""
        first = bisect_right(self._begins, time - STEP)
        last = bisect_left(self._begins, time)
        made = [1.0, *((time - begin) / STEP for begin in self._begins[first:last]), 0.0]
        weights: dict[str, float] = {}
        for viseme, (entered, left) in zip(self._visemes[first : last + 1], pairwise(made), strict=True):
            weights[viseme] = weights.get(viseme, 0.0) + entered - left
        return weights
