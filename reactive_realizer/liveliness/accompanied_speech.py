"""A speech while it is accompanied: its phrases, and the blocks that were sent for them."""

from collections.abc import Mapping, Sequence
from math import inf
from typing import Final

from reactive_realizer.bml.speech import LIVELINESS, Speech
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.sound_unit import Speaking
from reactive_realizer.engine.tts import Utterance
from reactive_realizer.liveliness.movement import SOONEST, Movement, word_point
from reactive_realizer.liveliness.phrase_planner import PhrasePlanner
from reactive_realizer.liveliness.prosody import Phrase, phrases_of, with_prominence
from reactive_realizer.liveliness.word_classes import WordClasses
from reactive_realizer.planunit.plan_unit import PlanUnit

_NOTICEABLE: Final = 0.01
"""The least change of liveliness for which a phrase is planned again."""

_KEPT: Final = 2
"""Blocks of a speech that may still play: those of this phrase and of the next one."""


class AccompaniedSpeech:
    """A speech that plays.

    Args:
        unit: the speech.
        speaking: the same, as what is spoken.
        classes: of the words of its language.
        listener: to whom it is spoken; None if that is unknown.

    Attributes:
        unit: the speech.
        planned: the number of the first phrase for which nothing was planned.
    """

    def __init__(self, unit: PlanUnit, speaking: Speaking, classes: WordClasses, listener: str | None) -> None:
        self.unit = unit
        self.planned = 0
        self._speaking = speaking
        self._function_words = classes.function_words
        self._planned_for = self.liveliness
        self._sent: list[str] = []
        self._numbered = 0
        self._read: Utterance | None = None
        self._phrases: list[Phrase] = []
        self._phrase_of: Mapping[str, int] = {}
        behavior = unit.behavior
        self._marks = {mark.id for mark in behavior.marks} if isinstance(behavior, Speech) else set[str]()
        seed = f"{unit.block.block}:{unit.behavior.id}:{speaking.utterance.text}"
        self._planner = PhrasePlanner(classes, seed, listener)

    @property
    def liveliness(self) -> float:
        """The present liveliness, 0 to 1."""
        return self.unit.parameters[LIVELINESS[1]].value

    @property
    def liveliness_changed(self) -> bool:
        """Whether the liveliness is not that for which movements were planned."""
        return abs(self.liveliness - self._planned_for) > _NOTICEABLE

    def phrase_of(self, sync: str) -> int | None:
        """The number of the phrase of a word that is a sync point; None for another point."""
        self._read_utterance()
        return self._phrase_of.get(sync)

    def movements(
        self, first: int, last: int, asked_for: Sequence[PlanUnit], since: GlobalTime | None
    ) -> list[Movement]:
        """The movements for some phrases.

        Args:
            first: number of the first phrase.
            last: number after that of the last phrase; there may be fewer.
            asked_for: behaviors with which they must not interfere.
            since: the time before which none begins, if there is one.
        """
        self._read_utterance()
        self._planned_for = self.liveliness
        taken = [(each.parts, self._span(each)) for each in asked_for]
        earliest = -inf if since is None else since - self._start + SOONEST

        def busy(movement: Movement) -> bool:
            late = movement.span[0] < earliest
            return late or any(parts & movement.parts and movement.overlaps(span) for parts, span in taken)

        self.planned = max(self.planned, last)
        made: list[Movement] = []
        for index in range(first, min(last, len(self._phrases))):
            self._phrases[index] = with_prominence(
                self._phrases[index], self._speaking.utterance, self._speaking.sounds
            )
            made += self._planner.plan(self._phrases, index, self.liveliness, busy)
        return [each for each in made if all(anchor.sync in self._phrase_of for anchor in each.anchors.values())]

    def next_id(self) -> str:
        """The id of the next block that is sent."""
        self._numbered += 1
        self._sent = [*self._sent, f"{self.unit.block.block}.{self.unit.behavior.id}.lively{self._numbered}"][-_KEPT:]
        return self._sent[-1]

    @property
    def sent(self) -> Sequence[str]:
        """The ids of the blocks that may still play."""
        return tuple(self._sent)

    @property
    def _start(self) -> float:
        return self.unit.points[0].peg.value or 0.0

    def _span(self, unit: PlanUnit) -> tuple[float, float]:
        """When another behavior begins and ends, s from the start of the speech; unknown times are far away."""
        begin, end = unit.start_and_end
        return (inf if begin is None else begin - self._start), (inf if end is None else end - self._start)

    def _read_utterance(self) -> None:
        """Read the phrases, again if the voice has said more about them."""
        utterance = self._speaking.utterance
        if utterance is self._read:
            return
        self._read, self._phrases = utterance, phrases_of(utterance, self._function_words)
        points = {point.id for point in self.unit.points if point.id not in self._marks}
        words = ((word_point(word), number) for number, phrase in enumerate(self._phrases) for word in phrase.words)
        self._phrase_of = {sync: number for sync, number in words if sync in points}
