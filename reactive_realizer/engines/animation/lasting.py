"""What ended and stays: the last poses of shifts (BML 1.0)."""

from collections.abc import Iterator

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.engines.animation.motion_unit import Moment, MotionUnit

_BELOW = -2


class Lasting:
    """The motions that have ended and stay, one of each name; they lie below all others of their kind."""

    def __init__(self) -> None:
        self._motions: dict[str, MotionUnit] = {}

    def keep(self, motion: MotionUnit) -> None:
        """A motion has ended: if it lasts, it takes the place of the one before."""
        if motion.lasts is not None:
            self._motions[motion.lasts] = motion

    def clear(self) -> None:
        """Nothing stays."""
        self._motions.clear()

    @property
    def motions(self) -> tuple[MotionUnit, ...]:
        """In no particular order."""
        return tuple(self._motions.values())

    def layers(self, now: GlobalTime, body: Body) -> Iterator[Layer]:
        """What they show."""
        for motion in self._motions.values():
            posed = motion.pose(Moment(1.0, now, body))
            yield Layer(motion.kind, posed.rotations, posed.weight, _BELOW, posed.root)
