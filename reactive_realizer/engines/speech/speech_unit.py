"""The plan unit of a speech."""

from collections.abc import Mapping

from reactive_realizer.bml.behaviors import Speech
from reactive_realizer.clock.units import RESOLUTION, GlobalTime
from reactive_realizer.engine.tts import Utterance
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Parameter, Range
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import PhaseKind, timing_at
from reactive_realizer.reactive.cell import Source
from reactive_realizer.reactive.graph import Graph

VOICE = "voice"
VOLUME_RANGE = Range(0.0, 100.0)

_VOLUME_OF_GAIN_1 = 50.0
"""The volume with a gain of 1."""


class SpeechUnit(PlanUnit):
    """An utterance. Its timing is rigid, and a character speaks one at a time.

    Attributes:
        utterance: words and audio, with their times.
        started: time of its start, None before.
        cut: time at which it was interrupted, None if it was not.
    """

    def __init__(self, block: BlockKey, behavior: Speech, utterance: Utterance, graph: Graph) -> None:
        offsets = {"start": 0.0, **{mark.id: utterance.marks[mark.id] for mark in behavior.marks}}
        timing = timing_at({**offsets, "end": utterance.duration}, PhaseKind.RIGID)
        super().__init__(block, behavior, timing, frozenset({VOICE}))
        self.utterance = utterance
        self.started: GlobalTime | None = None
        self.cut: GlobalTime | None = None
        self._volume = Source(graph, str(self.key("volume")), _VOLUME_OF_GAIN_1)
        self.parameters["volume"] = Parameter(self._volume, VOLUME_RANGE)

    @property
    def gain(self) -> float:
        """The gain of its audio; 1 is as synthesized."""
        return self._volume.value / _VOLUME_OF_GAIN_1

    def on_start(self, time: GlobalTime) -> None:
        """Notes the time of the start."""
        self.started = time

    def on_finish(self, time: GlobalTime) -> None:
        """Notes whether the speech ends early."""
        if self.started is not None and time < self.started + self.utterance.duration - RESOLUTION:
            self.cut = time

    def gentle_end(self, time: GlobalTime) -> GlobalTime:
        """The end of the present word: the start of the next one, or the end of the speech."""
        if self.started is None:
            return time
        return GlobalTime(self.started + self.utterance.next_word(time - self.started))

    def end_details(self, time: GlobalTime) -> Mapping[str, str]:
        """The last word that began, and the number of characters heard up to its end."""
        begun = self.utterance.words_begun(time - self.started) if self.started is not None else ()
        if not begun:
            return {"word": "-1", "text": "", "heard": "0"}
        return {"word": str(len(begun) - 1), "text": begun[-1].text, "heard": str(begun[-1].last)}
