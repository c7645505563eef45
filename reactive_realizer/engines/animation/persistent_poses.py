"""Persistent poses: the last poses of shifts, which stay after their behavior has ended (BML 1.0)."""

import logging

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.engines.animation.motion_unit import Moment, MotionUnit, layer_of

logger = logging.getLogger(__name__)

_BELOW = -2
"""Priority of persistent poses: below all playing motions."""


class PersistentPoses:
    """Motions that have ended and persist, one for each name; they lie below all others of their kind."""

    def __init__(self) -> None:
        self._motions: dict[str, MotionUnit] = {}

    def keep(self, motion: MotionUnit) -> frozenset[str]:
        """Keep the pose of a motion that has ended, if it persists; return the joints of the one that it replaces."""
        if motion.persists_as is None:
            return frozenset()
        replaced = self._motions.pop(motion.persists_as, None)
        self._motions[motion.persists_as] = motion
        return frozenset() if replaced is None else replaced.joints

    def clear(self) -> frozenset[str]:
        """Remove all poses; return their joints."""
        joints = frozenset[str]().union(*(motion.joints for motion in self.motions))
        self._motions.clear()
        return joints

    @property
    def motions(self) -> tuple[MotionUnit, ...]:
        """The persistent motions; the latest is last and lies above the others."""
        return tuple(self._motions.values())

    def layers(self, now: GlobalTime, body: Body) -> tuple[Layer, ...]:
        """Return the layers of persistent poses."""
        staying = (self._layer(motion, now, body) for motion in self.motions)
        return tuple(layer for layer in staying if layer is not None)

    def _layer(self, motion: MotionUnit, now: GlobalTime, body: Body) -> Layer | None:
        """Return the layer of a motion. A motion that fails is removed; its behavior has ended and cannot report it."""
        try:
            return layer_of(motion, Moment(1.0, now, body), _BELOW)
        except Exception:
            logger.exception("the persistent pose '%s' failed and is removed", motion.persists_as)
            self._motions = {name: other for name, other in self._motions.items() if other is not motion}
            return None
