"""What ended and stays: the last poses of shifts (BML 1.0)."""

import logging
from dataclasses import replace

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.engines.animation.motion_unit import Moment, MotionUnit, layer_of
from reactive_realizer.engines.animation.release import Release

logger = logging.getLogger(__name__)

_BELOW = -2
"""Priority of what stays: whatever plays lies above it."""

_LEAVING = -3
"""Priority of what leaves: who is replaced lies below who replaces him, so the joints that both move do not notice."""


class Lasting:
    """The motions that have ended and stay, one of each name; they lie below all others of their kind."""

    def __init__(self) -> None:
        self._motions: dict[str, MotionUnit] = {}
        self._leaving: list[Release] = []

    def keep(self, motion: MotionUnit, now: GlobalTime, body: Body) -> None:
        """A motion has ended: if it lasts, it takes the place of the one before, which eases out."""
        if motion.lasts is None:
            return
        replaced = self._motions.pop(motion.lasts, None)
        if replaced is not None and (layer := self._layer(replaced, now, body)) is not None:
            self._leaving = [*self._left(now), Release(layer, now)]
        self._motions[motion.lasts] = motion

    def clear(self) -> None:
        """Nothing stays."""
        self._motions.clear()
        self._leaving.clear()

    @property
    def motions(self) -> tuple[MotionUnit, ...]:
        """The one that ended last at the end: it lies above the others."""
        return tuple(self._motions.values())

    def layers(self, now: GlobalTime, body: Body) -> tuple[Layer, ...]:
        """What they show, and what is left of those that they have replaced."""
        self._leaving = self._left(now)
        leaving = (replace(release.at(now), priority=_LEAVING) for release in self._leaving)
        staying = (self._layer(motion, now, body) for motion in self.motions)
        return (*leaving, *(layer for layer in staying if layer is not None))

    def _left(self, now: GlobalTime) -> list[Release]:
        return [release for release in self._leaving if not release.over(now)]

    def _layer(self, motion: MotionUnit, now: GlobalTime, body: Body) -> Layer | None:
        """What one shows; one that fails stays no longer: its behavior has ended and cannot be told of it."""
        try:
            return layer_of(motion, Moment(1.0, now, body), _BELOW)
        except Exception:
            logger.exception("what was to stay as '%s' failed and is gone", motion.lasts)
            self._motions = {name: other for name, other in self._motions.items() if other is not motion}
            return None
