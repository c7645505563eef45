"""Accompanies what characters say: sends blocks of movements that are tied to the words."""

import logging
from collections.abc import Mapping, Sequence
from math import atan2, hypot, inf, radians
from typing import Final

from reactive_realizer.bml.behaviors import LIVELINESS, Gaze
from reactive_realizer.bml.document import parse
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.vector import subtract
from reactive_realizer.embodiment.world import World
from reactive_realizer.engine.effects import Reached
from reactive_realizer.engine.sound_unit import Speaking
from reactive_realizer.limits import Limits
from reactive_realizer.liveliness.accompanied_speech import AccompaniedSpeech
from reactive_realizer.liveliness.movement import block_of
from reactive_realizer.liveliness.word_classes import WordClasses
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.bml_scheduler import BMLScheduler

logger = logging.getLogger(__name__)

_AHEAD: Final = radians(30.0)
"""A target that is further aside is nobody to whom a character speaks, rad, unless it was asked to look there."""


class Accompanist:
    """Plans the movements of each phrase when the one before begins, and of the first two when the speech begins.

    So the plan follows the words as they are heard, a change of the liveliness takes effect with the next word, and the
    work is spread over the speech.

    Args:
        scheduler: of the blocks.
        figures: of the characters, by id.
        world: the targets of their eyes.
        limits: on the blocks.
        classes: of the words with which people move.
    """

    def __init__(
        self,
        scheduler: BMLScheduler,
        figures: Mapping[str, Humanoid],
        world: World,
        limits: Limits,
        classes: WordClasses,
    ) -> None:
        self._scheduler = scheduler
        self._figures = figures
        self._world = world
        self._limits = limits
        self._classes = classes
        self._speeches: dict[PlanUnit, AccompaniedSpeech] = {}
        self._looked_at: dict[str, str] = {}
        """By character, the target of the last gaze that was asked for."""
        scheduler.listen_to_points(self._follow)

    def _follow(self, reached: Sequence[Reached]) -> None:
        for unit, sync, time in [(each.unit, each.point.id, each.time) for each in reached]:
            if sync == "start" and isinstance(unit.behavior, Gaze) and not unit.accompanies:
                self._looked_at[unit.block.character] = unit.behavior.target
            elif unit in self._speeches or (sync == "start" and LIVELINESS[1] in unit.parameters):
                try:
                    self._accompany(unit, sync, time)
                except Exception:  # a speech goes on without movements
                    logger.exception("%s/%s:%s is not accompanied any more", *unit.block, unit.behavior.id)
                    self._speeches.pop(unit, None)

    def _accompany(self, unit: PlanUnit, sync: str, time: GlobalTime) -> None:
        """Plan movements for a speech that has reached a point."""
        if unit in self._speeches:
            self._continue(self._speeches[unit], sync, time)
        elif isinstance(unit, Speaking):
            speech = AccompaniedSpeech(unit, unit, self._classes, self._listener(unit.block.character))
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
        asked = (unit for block in blocks if block.accompanied is None for unit in block.live_units)
        return [unit for unit in asked if unit is not speech]

    def _listener(self, character: str) -> str | None:
        """What a character looked at when it was last asked to, or else the target that is nearest ahead."""
        looked_at = self._looked_at.get(character)
        if looked_at is not None and self._world.position(looked_at) is not None:
            return looked_at
        aside = ((self._aside(character, target), target) for target in self._world.targets if target != character)
        return min(((angle, target) for angle, target in aside if angle <= _AHEAD), default=(0.0, None))[1]

    def _aside(self, character: str, target: str) -> float:
        """The angle between straight ahead of a character and a target, rad."""
        eyes, position = self._world.position(character), self._world.position(target)
        if eyes is None or position is None:
            return inf
        x, y, z = self._figures[character].to_own_axes(subtract(position, eyes))
        return atan2(hypot(x, y), z)
