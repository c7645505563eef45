"""What a living figure does when it does nothing: breathe, sway, shift its weight, blink, glance.

A figure without it looks crashed.
"""

import math
from random import Random

from reactive_realizer.embodiment.joints import EYES
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import Quat, from_euler, multiply
from reactive_realizer.engines.animation.idle.blinks import Blinks
from reactive_realizer.engines.animation.idle.breath import Breath
from reactive_realizer.engines.animation.idle.glances import Glances
from reactive_realizer.engines.animation.idle.weight_shift import WeightShift, leaning

_WAVES = ((0.43, 1.9, 0.0), (0.31, 2.3, 1.0), (0.23, 1.3, 2.0))
"""Sway to the side, forth and about: of each a slow wave and a quicker one, rad a second, and where both begin, rad."""

_QUICKER = 0.25
"""The share of a sway that is in its quicker wave."""

_UPRIGHT = 0.1
"""m that the pelvis is lower than in standing when there is no weight to shift any more."""


class Idle:
    """Life as functions of time; two figures of different seeds do not move as one."""

    def __init__(self, random: Random) -> None:
        """Draws all that chance decides from a generator that nobody else draws from."""
        self._breath = Breath(Random(random.getrandbits(64)))
        self._sway = random.uniform(0.0, 100.0)
        self._blinks = Blinks(Random(random.getrandbits(64)))
        self._shift = WeightShift(Random(random.getrandbits(64)))
        self._glances = Glances(Random(random.getrandbits(64)))

    def layer(self, time: float, sunk: float) -> Layer:
        """What is added to the body at a time, s.

        Args:
            time: s.
            sunk: how much lower the pelvis is than in standing, m: who sits does not shift his weight.
        """
        standing = max(0.0, 1.0 - max(0.0, sunk) / _UPRIGHT)
        turns, root = leaning(self._shift.at(time) * standing)
        alive = self.rotations(time)
        joined = {joint: multiply(turns[joint], turn) if joint in turns else turn for joint, turn in alive.items()}
        return Layer(LayerKind.ADDITIVE, {**turns, **joined}, root=root)

    def rotations(self, time: float) -> dict[str, Quat]:
        """Breath and sway: the chest rises, the head stays level, the trunk is never quite still."""
        air = self._breath.air(time)
        side, forth, turn = (_wave(time + self._sway, *wave) for wave in _WAVES)
        return {
            "vl5": from_euler(0.006 * forth, 0.008 * turn, 0.006 * side),
            "vt6": from_euler(-0.016 * air, 0.0, 0.0),
            "l_sternoclavicular": from_euler(0.0, 0.0, 0.022 * air),
            "r_sternoclavicular": from_euler(0.0, 0.0, -0.022 * air),
            "vc4": from_euler(0.012 * air - 0.006 * forth, 0.0, -0.006 * side),
            "skullbase": from_euler(0.006 * forth, 0.010 * turn, 0.004 * side),
        }

    def eyes(self, time: float) -> dict[str, Quat]:
        """Rotations of eyes that look at nothing in particular."""
        yaw, pitch = self._glances.at(time)
        turn = from_euler(-pitch, yaw, 0.0)
        return dict.fromkeys(EYES, turn)

    def blink(self, time: float) -> None:
        """Blink at a time, s, as with a large turn of gaze."""
        self._blinks.ask(time)

    def weights(self, time: float) -> dict[str, float]:
        """Morph weights at a time, s."""
        closed = self._blinks.closed(time)
        return {"eyeBlinkLeft": closed, "eyeBlinkRight": closed}


def _wave(time: float, slow: float, quick: float, begin: float) -> float:
    """A sway at a time, -1 to 1: nearly all of it is below half a cycle a second, and it has no period that is seen."""
    return (1.0 - _QUICKER) * math.sin(slow * time + begin) + _QUICKER * math.sin(quick * time + begin)
