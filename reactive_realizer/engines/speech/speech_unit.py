"""The plan unit of a speech."""

from collections.abc import Mapping

from reactive_realizer.binding.asset_file import parse_boolean
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import WORDS, Speech
from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time
from reactive_realizer.engine.tts import Utterance, Word
from reactive_realizer.engines.speech.hearing import Hearing
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Parameter, Range
from reactive_realizer.planunit.plan_unit import DuePoint, PlanUnit
from reactive_realizer.planunit.timing import PhaseKind, timing_at
from reactive_realizer.reactive.graph import Graph

VOICE = "voice"
VOLUME_RANGE = Range(0.0, 100.0)

_VOLUME_OF_GAIN_1 = 50.0
"""The volume with a gain of 1."""


class SpeechUnit(PlanUnit):
    """An utterance. Its timing is rigid, and a character speaks one at a time.

    Attributes:
        utterance: words and audio, with their times.
        hearing: what is known of its sound since its start, None before.
        cut: time at which it was interrupted, None if it was not.

    Raises:
        RealizerError: "not-a-flag", of the attribute for words.
    """

    def __init__(self, block: BlockKey, behavior: Speech, utterance: Utterance, graph: Graph) -> None:
        marks = {mark.id: utterance.marks[mark.id] for mark in behavior.marks}
        self._words = _word_points(behavior, utterance)
        inside = marks | {sync: word.start for sync, (_, word) in self._words.items()}
        offsets = {"start": 0.0, **dict(sorted(inside.items(), key=lambda each: each[1])), "end": utterance.duration}
        super().__init__(block, behavior, timing_at(offsets, PhaseKind.RIGID), frozenset({VOICE}))
        self.utterance = utterance
        self.hearing: Hearing | None = None
        self.cut: GlobalTime | None = None
        self._volume = Parameter(graph, str(self.key("volume")), _VOLUME_OF_GAIN_1, VOLUME_RANGE)
        self.parameters["volume"] = self._volume

    @property
    def gain(self) -> float:
        """The gain of its audio; 1 is as synthesized."""
        return self._volume.value / _VOLUME_OF_GAIN_1

    def on_start(self, time: GlobalTime) -> None:
        """Notes the time of the start."""
        self.hearing = Hearing(time, self.utterance.duration)

    def on_finish(self, time: GlobalTime) -> None:
        """Notes whether the speech ends early."""
        if self.hearing is not None and self.position(time) < self.utterance.duration - RESOLUTION:
            self.cut = time

    def position(self, time: GlobalTime) -> float:
        """The position in the utterance that is heard at a time, s; 0 before it has started."""
        return 0.0 if self.hearing is None else time - self.hearing.origin

    @property
    def origin(self) -> Time:
        """When its first sample is heard: at its start or, if it has drifted, as if all had been heard like this."""
        return self.time("start") if self.hearing is None else self.hearing.origin

    def gentle_end(self, time: GlobalTime) -> GlobalTime:
        """The end of the present word: the start of the next one, or the end of the speech."""
        if self.hearing is None:
            return time
        return GlobalTime(self.hearing.origin + self.utterance.next_word(self.position(time)))

    def due_at_cut(self, now: GlobalTime, *, end: bool = True) -> list[DuePoint]:
        """The due points without a word that would begin with the cut."""
        due = super().due_at_cut(now, end=end)
        return [each for each in due if each.point.id not in self._words or each.time < now - RESOLUTION]

    def details(self, sync: str, time: GlobalTime) -> Mapping[str, str]:
        """Of a word, its index and text; of the end, what was heard: the last word, and the number of characters."""
        if sync in self._words:
            index, word = self._words[sync]
            return {"word": str(index), "text": word.text}
        return self._heard(time) if sync == "end" else {}

    def _heard(self, time: GlobalTime) -> Mapping[str, str]:
        position = self.position(time)
        begun = self.utterance.words_begun(position)
        if not begun:
            return {"word": "-1", "text": "", "heard": "0"}
        whole = position >= self.utterance.duration - RESOLUTION
        heard = len(self.utterance.text) if whole else begun[-1].last
        return {"word": str(len(begun) - 1), "text": begun[-1].text, "heard": str(heard)}


def wants_words(behavior: Behavior) -> bool:
    """Whether the words of a speech are sync points.

    Raises:
        RealizerError: "not-a-flag".
    """
    return parse_boolean(WORDS[1], behavior.extensions.get(WORDS, "false"))


def _word_points(behavior: Speech, utterance: Utterance) -> dict[str, tuple[int, Word]]:
    """The sync points of words, with their indices, if the behavior wants them; a mark keeps its name."""
    if not wants_words(behavior):
        return {}
    marks = {mark.id for mark in behavior.marks}
    points = {f"word{index}": (index, word) for index, word in enumerate(utterance.words)}
    return {sync: each for sync, each in points.items() if sync not in marks}
