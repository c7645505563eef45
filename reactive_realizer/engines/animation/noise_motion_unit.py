"""A joint that stirs at random (thesis C.1.7)."""

from collections.abc import Mapping
from math import pi
from random import Random

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import from_euler
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.expression.noise import PerlinNoise
from reactive_realizer.engines.animation.motion_unit import Moment, MotionUnit, Posed
from reactive_realizer.planunit.parameter import Range

JOINT = "joint"
"""The parameter that says which joint stirs."""

_AXES = "xyz"
_OCTAVES = 4
_PERIOD = 256.0
_EASE_IN = 0.5
"""s in which it sets in; how it leaves is the engine's (`Release`)."""

_DEFAULTS: Mapping[str, float] = {
    **{f"basefreq{axis}": 1.0 for axis in _AXES},
    **{f"baseamplitude{axis}": 0.0 for axis in _AXES},
    **{f"persistence{axis}": 0.5 for axis in _AXES},
    **{f"offset{axis}": 0.0 for axis in _AXES},
}
"""Cycles in a second, rad, the weight of each octave against the one before, rad."""

RANGES: Mapping[str, Range] = {
    **{f"basefreq{axis}": Range(0.0, 1000.0) for axis in _AXES},
    **{f"baseamplitude{axis}": Range(-pi, pi) for axis in _AXES},
    **{f"persistence{axis}": Range(0.0, 1.0) for axis in _AXES},
    **{f"offset{axis}": Range(-pi, pi) for axis in _AXES},
}
"""The values of these that mean something."""


class NoiseMotionUnit(MotionUnit):
    """Turns one joint by Perlin noise, about each of its axes by itself, further than whatever else turns it.

    About an axis it turns by `offset` plus at most `baseamplitude`, rad. Time passes for it in cycles of `basefreq`: a
    frequency that changes while it plays changes how fast it goes on, and nothing jumps.
    """

    kind = LayerKind.ADDITIVE
    fixed = frozenset({JOINT})
    preferred_duration = 1.0

    def __init__(self, joint: str, parameters: Mapping[str, float], seed: int) -> None:
        """Prepares a motion.

        Args:
            joint: H-Anim name.
            parameters: values for some of its parameters; names that it does not know are of no effect.
            seed: of its randomness.
        """
        self.parameters = {name: parameters.get(name, value) for name, value in _DEFAULTS.items()}
        self.ranges = RANGES
        self.joints = frozenset({joint})
        self._joint = joint
        random = Random(seed)
        self._noises = [PerlinNoise(random.randrange(2**32)) for _ in _AXES]
        self._cycles = [random.uniform(0.0, _PERIOD) for _ in _AXES]
        self._since: GlobalTime | None = None
        self._last = GlobalTime(0.0)

    def start(self, body: Body) -> None:
        """It adds to whatever there is."""

    def pose(self, moment: Moment) -> Posed:
        """The turn to be added."""
        if self._since is None:
            self._since = self._last = moment.time
        passed, self._last = moment.time - self._last, moment.time
        x, y, z = (self._angle(i, passed) for i in range(len(_AXES)))
        weight = minimum_jerk(share(moment.time, self._since, self._since + _EASE_IN))
        return Posed({self._joint: from_euler(x, y, z)}, weight)

    def _angle(self, axis: int, passed: float) -> float:
        """About one axis, rad, after so many seconds more."""
        frequency, amplitude, persistence, offset = (
            self.parameters[f"{name}{_AXES[axis]}"] for name in ("basefreq", "baseamplitude", "persistence", "offset")
        )
        self._cycles[axis] = (self._cycles[axis] + passed * frequency) % _PERIOD
        return offset + amplitude * self._noises[axis].octaves(self._cycles[axis], _OCTAVES, persistence)
