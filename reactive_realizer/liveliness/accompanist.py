"""Accompanies what characters say: sends blocks of movements that are tied to the words."""

import logging
from collections.abc import Sequence

from reactive_realizer.bml.document import parse
from reactive_realizer.bml.speech import LIVELINESS
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.effects import Reached
from reactive_realizer.engine.sound_unit import Speaking
from reactive_realizer.limits import Limits
from reactive_realizer.liveliness.accompanied_speech import AccompaniedSpeech
from reactive_realizer.liveliness.listeners import Listeners
from reactive_realizer.liveliness.movement import block_of
from reactive_realizer.liveliness.word_classes import WordClasses
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.bml_scheduler import BMLScheduler

logger = logging.getLogger(__name__)


class Accompanist:
    """Plans the movements of each phrase when the one before begins, and of the first two when the speech begins.

    So the plan follows the words as they are heard, a change of the liveliness takes effect with the next word, and the
    work is spread over the speech.

    Args:
        scheduler: of the blocks.
        listeners: of the characters.
        limits: on the blocks.
        classes: of the words with which people move.
    """

    def __init__(
        self,
        scheduler: BMLScheduler,
        listeners: Listeners,
        limits: Limits,
        classes: WordClasses,
    ) -> None:
        self._scheduler = scheduler
        self._listeners = listeners
        self._limits = limits
        self._classes = classes
        self._speeches: dict[PlanUnit, AccompaniedSpeech] = {}
        scheduler.listen_to_points(self._follow)
        scheduler.listen(self._forget)

    def _follow(self, reached: Sequence[Reached]) -> None:
        for unit, sync, time in [(each.unit, each.point.id, each.time) for each in reached]:
            if unit in self._speeches or (sync == "start" and LIVELINESS[1] in unit.parameters):
                try:
                    self._accompany(unit, sync, time)
                except Exception:  # a speech goes on without movements
                    logger.exception("%s/%s:%s is not accompanied any more", *unit.block, unit.behavior.id)
                    self._speeches.pop(unit, None)

    def _forget(self, ended: BMLBlock) -> None:
        """Forget the speeches of a block that has ended: one that was interrupted has not reached its end."""
        for unit in ended.units:
            self._speeches.pop(unit, None)

    def _accompany(self, unit: PlanUnit, sync: str, time: GlobalTime) -> None:
        """Plan movements for a speech that has reached a point."""
        if unit in self._speeches:
            self._continue(self._speeches[unit], sync, time)
        elif isinstance(unit, Speaking):
            speech = AccompaniedSpeech(unit, unit, self._classes, self._listeners.of(unit.block.character))
            self._speeches[unit] = speech
            self._plan(speech, 0, 1)

    def _continue(self, speech: AccompaniedSpeech, sync: str, time: GlobalTime) -> None:
        """Plan the next phrase, unless it is planned; and this one again if the liveliness has changed."""
        if sync == "end":
            del self._speeches[speech.unit]
        elif (phrase := speech.phrase_of(sync)) is not None:
            if speech.liveliness_changed:
                self._plan(speech, phrase, phrase + 2, again=time)
            elif speech.planned < phrase + 2:
                self._plan(speech, speech.planned, phrase + 2)

    def _plan(self, speech: AccompaniedSpeech, first: int, last: int, again: GlobalTime | None = None) -> None:
        """Send the movements of some phrases.

        Args:
            speech: that they accompany.
            first: the first phrase.
            last: after the last one; there may be fewer.
            again: if other movements were sent for these phrases, when those end; those that would begin before are
                left out.
        """
        movements = speech.movements(first, last, self._asked_for(speech.unit), again)
        replaced = speech.sent if again is not None else ()
        if not movements and not replaced:
            return
        text = block_of(speech.next_id(), speech.unit, movements, replaced)
        logger.debug("%s", text)
        for parsed in parse(text, self._limits):
            if parsed.block is None or parsed.problems:
                logger.error("%s: %s", text, parsed.problems)
            else:
                self._scheduler.accompany(parsed.block)

    def _asked_for(self, speech: PlanUnit) -> list[PlanUnit]:
        """The other behaviors of its character that were asked for and have not ended."""
        blocks = self._scheduler.blocks.of(speech.block.character)
        asked = (unit for block in blocks if not block.gives_way for unit in block.live_units)
        return [unit for unit in asked if unit is not speech]
