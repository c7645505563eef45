"""Persistent poses: the last poses of shifts, which stay after their behavior has ended (BML 1.0)."""

import logging
from dataclasses import replace

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.engines.animation.fade_out import FadeOut
from reactive_realizer.engines.animation.motion_unit import Moment, MotionUnit, layer_of

logger = logging.getLogger(__name__)

_BELOW = -2
"""Priority of persistent poses: below all playing motions."""

_LEAVING = -3
"""Priority of replaced poses: below their replacement, so joints that both move do not jump."""


class PersistentPoses:
    """Motions that have ended and persist, one for each name; they lie below all others of their kind."""

    def __init__(self) -> None:
        self._motions: dict[str, MotionUnit] = {}
        self._leaving: list[FadeOut] = []

    def keep(self, motion: MotionUnit, now: GlobalTime, body: Body) -> None:
        """Keep the pose of a motion that has ended, if it persists; it replaces the one before, which fades out."""
        if motion.persists_as is None:
            return
        replaced = self._motions.pop(motion.persists_as, None)
        if replaced is not None and (layer := self._layer(replaced, now, body)) is not None:
            self._leaving = [*self._left(now), FadeOut(layer, now)]
        self._motions[motion.persists_as] = motion

    def clear(self) -> None:
        """Remove all poses."""
        self._motions.clear()
        self._leaving.clear()

    @property
    def motions(self) -> tuple[MotionUnit, ...]:
        """The persistent motions; the latest is last and lies above the others."""
        return tuple(self._motions.values())

    def layers(self, now: GlobalTime, body: Body) -> tuple[Layer, ...]:
        """Return the layers of persistent poses, and of replaced ones that fade out."""
        self._leaving = self._left(now)
        leaving = (replace(fade_out.at(now), priority=_LEAVING) for fade_out in self._leaving)
        staying = (self._layer(motion, now, body) for motion in self.motions)
        return (*leaving, *(layer for layer in staying if layer is not None))

    def _left(self, now: GlobalTime) -> list[FadeOut]:
        return [fade_out for fade_out in self._leaving if not fade_out.finished(now)]

    def _layer(self, motion: MotionUnit, now: GlobalTime, body: Body) -> Layer | None:
        """Return the layer of a motion. A motion that fails is removed; its behavior has ended and cannot report it."""
        try:
            return layer_of(motion, Moment(1.0, now, body), _BELOW)
        except Exception:
            logger.exception("the persistent pose '%s' failed and is removed", motion.persists_as)
            self._motions = {name: other for name, other in self._motions.items() if other is not motion}
            return None
