"""What a living figure does when it does nothing: breathe, sway, shift its weight, blink, glance.

A figure without it looks crashed.
"""

import math
from random import Random

from reactive_realizer.embodiment.joints import EYES
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import Quat, from_euler, multiply
from reactive_realizer.engines.animation.idle.blinks import Blinks
from reactive_realizer.engines.animation.idle.glances import Glances
from reactive_realizer.engines.animation.idle.weight_shift import WeightShift, leaning

_BREATHS = 0.25
"""Hz, of a person at rest."""

_UPRIGHT = 0.1
"""m that the pelvis is lower than in standing when there is no weight to shift any more."""


class Idle:
    """Life as functions of time; two figures of different seeds do not move as one."""

    def __init__(self, random: Random) -> None:
        """Draws all that chance decides from a generator that nobody else draws from."""
        self._breath = random.random()
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
