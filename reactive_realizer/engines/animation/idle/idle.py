"""What a living figure does when it does nothing: breathe, sway, blink. A figure without it looks crashed."""

import math
from bisect import bisect_right
from random import Random

from reactive_realizer.embodiment.quaternion import Quat, from_euler

_BREATHS = 0.25
"""Hz, of a person at rest."""

_BLINK = 0.15
"""s, from open to open."""

_BLINK_PAUSE = (2.0, 6.0)
"""s, shortest and longest from one blink to the next."""

_CLOSING = 0.35
"""Lids close in this share of a blink and open in the rest."""


class Idle:
    """Breath, sway and blinks as functions of time; two figures of different seeds do not move as one."""

    def __init__(self, random: Random) -> None:
        """Draws phases and blinks from a generator that nobody else draws from."""
        self._random = random
        self._breath = random.random()
        self._sway = random.uniform(0.0, 100.0)
        self._blinks = [random.uniform(*_BLINK_PAUSE)]

    def rotations(self, time: float) -> dict[str, Quat]:
        """Additive rotations at a time, s: the chest rises, the head stays level, the trunk is never quite still."""
        air = self._air(time)
        # Three slow waves without a common period, each well below a degree.
        side = math.sin(0.43 * (time + self._sway))
        forth = math.sin(0.31 * (time + self._sway) + 1.0)
        turn = math.sin(0.23 * (time + self._sway) + 2.0)
        return {
            "vl5": from_euler(0.006 * forth, 0.008 * turn, 0.006 * side),
            "vt6": from_euler(-0.016 * air, 0.0, 0.0),
            "l_sternoclavicular": from_euler(0.0, 0.0, 0.022 * air),
            "r_sternoclavicular": from_euler(0.0, 0.0, -0.022 * air),
            "vc4": from_euler(0.012 * air - 0.006 * forth, 0.0, -0.006 * side),
            "skullbase": from_euler(0.006 * forth, 0.010 * turn, 0.004 * side),
        }

    def _air(self, time: float) -> float:
        """How full the lungs are, 0..1; breathing in is the quicker half."""
        turn = 2.0 * math.pi * (_BREATHS * time + self._breath)
        return 0.5 - 0.5 * math.cos(turn + 0.4 * math.sin(turn))

    def weights(self, time: float) -> dict[str, float]:
        """Morph weights at a time, s."""
        closed = self._lids(time)
        return {"eyeBlinkLeft": closed, "eyeBlinkRight": closed}

    def _lids(self, time: float) -> float:
        """How far the lids are closed, 0..1."""
        while self._blinks[-1] <= time:
            self._blinks.append(self._blinks[-1] + self._random.uniform(*_BLINK_PAUSE))
        last = bisect_right(self._blinks, time) - 1
        passed = (time - self._blinks[last]) / _BLINK if last >= 0 else 1.0
        if passed >= 1.0:
            return 0.0
        share = passed / _CLOSING if passed < _CLOSING else (1.0 - passed) / (1.0 - _CLOSING)
        return share * share * (3.0 - 2.0 * share)
