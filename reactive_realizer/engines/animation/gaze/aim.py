"""What is looked at, beside a target or at it."""

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType

from reactive_realizer.bml.words import OffsetDirection
from reactive_realizer.embodiment.vector import FORWARD, UP, Vec3, add, cross, distance, rejected, scale, unit
from reactive_realizer.engines.animation.gaze.eyes import direction

_HALF = math.sqrt(0.5)
_SIDES: Mapping[OffsetDirection, tuple[float, float]] = MappingProxyType(
    {
        OffsetDirection.RIGHT: (-1.0, 0.0),
        OffsetDirection.LEFT: (1.0, 0.0),
        OffsetDirection.UP: (0.0, 1.0),
        OffsetDirection.DOWN: (0.0, -1.0),
        OffsetDirection.UPRIGHT: (-_HALF, _HALF),
        OffsetDirection.UPLEFT: (_HALF, _HALF),
        OffsetDirection.DOWNLEFT: (_HALF, -_HALF),
        OffsetDirection.DOWNRIGHT: (-_HALF, -_HALF),
    }
)
"""To the left and up, as the figure sees it."""


class Aim:
    """A point that moves with its target.

    Args:
        target: where it is now, in the figure's frame, m.
        degrees: between the target and what is looked at, seen from between the eyes (BML's offsetAngle).
        side: toward which.
    """

    def __init__(
        self, target: Callable[[], Vec3], degrees: float = 0.0, side: OffsetDirection = OffsetDirection.RIGHT
    ) -> None:
        self._target = target
        self._offset = math.radians(degrees)
        self._side = _SIDES[side]

    def point(self, eyes: Vec3) -> Vec3:
        """Where to look from between the eyes, all in the figure's frame, m; as far away as the target."""
        target = self._target()
        way = direction(eyes, target) if self._offset else None
        if way is None:
            return target
        left, up = self._side
        upward = _across(way)
        aside = add(scale(cross(upward, way), left), scale(upward, up))
        turned = add(scale(way, math.cos(self._offset)), scale(aside, math.sin(self._offset)))
        return add(eyes, scale(turned, distance(eyes, target)))


def _across(way: Vec3) -> Vec3:
    """The unit vector across a direction that is upward; of straight up and down, backward and forward."""
    try:
        return unit(rejected(UP, way))
    except ZeroDivisionError:
        return scale(FORWARD, -way[1])
