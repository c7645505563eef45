"""Maps time to the phase of a motion whose pegs may move while it plays."""

from collections.abc import Mapping

from reactive_realizer.clock.units import RESOLUTION, GlobalTime
from reactive_realizer.planunit.plan_unit import PlanUnit


class PhaseClock:
    """Advances the phase linearly from each key position to the next, to arrive when its sync point is due.

    If a point moves, the rate changes from now on, but not the phase itself: a motion is slowed down or sped up, and
    never jumps.

    Args:
        keys: sync id -> phase, 0 to 1, in the order in which they are reached.
    """

    def __init__(self, keys: Mapping[str, float]) -> None:
        self._keys = list(keys.items())
        self._next = 0
        self._time = GlobalTime(0.0)
        self.phase = 0.0

    def advance(self, unit: PlanUnit, now: GlobalTime) -> float:
        """The phase at a time, not before that of the last call; it stands still while the next point is unknown."""
        while self._next < len(self._keys):
            sync, phase = self._keys[self._next]
            time = unit.time(sync)
            if time is None:
                break
            if time > now + RESOLUTION:
                left = time - self._time
                self.phase += (phase - self.phase) * (now - self._time) / left
                break
            self.phase, self._time = phase, max(self._time, time)
            self._next += 1
        self._time = now
        return self.phase
