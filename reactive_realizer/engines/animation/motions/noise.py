"""Noise: a joint that moves at random (thesis C.1.7)."""

from collections.abc import Mapping
from math import pi
from random import Random
from zlib import crc32

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import from_euler
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.expression.functions import PerlinNoise
from reactive_realizer.engines.animation.faults import NoJoints
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_parameters import parameter_values
from reactive_realizer.engines.animation.motion_unit import Moment, MotionPose, MotionUnit
from reactive_realizer.errors import RealizerError
from reactive_realizer.planunit.parameter import Range

JOINT = "joint"
"""Parameter for the joint that moves."""

_AXES = "xyz"
_OCTAVES = 4
_PERIOD = 256.0
_EASE_IN = 0.5
"""Duration of the fade-in, s; the engine fades it out (`FadeOut`)."""

_DEFAULTS: Mapping[str, float] = {
    **{f"basefreq{axis}": 1.0 for axis in _AXES},
    **{f"baseamplitude{axis}": 0.0 for axis in _AXES},
    **{f"persistence{axis}": 0.5 for axis in _AXES},
    **{f"offset{axis}": 0.0 for axis in _AXES},
}
"""Frequency, Hz; amplitude, rad; weight of each octave relative to the one before; offset, rad."""

RANGES: Mapping[str, Range] = {
    **{f"basefreq{axis}": Range(0.0, 1000.0) for axis in _AXES},
    **{f"baseamplitude{axis}": Range(-pi, pi) for axis in _AXES},
    **{f"persistence{axis}": Range(0.0, 1.0) for axis in _AXES},
    **{f"offset{axis}": Range(-pi, pi) for axis in _AXES},
}
"""Valid values of these parameters."""


class NoiseMotionUnit(MotionUnit):
    """Adds Perlin noise to one joint, independently about each of its axes.

    About an axis it turns by `offset` plus at most `baseamplitude`, rad. Its time is counted in cycles of `basefreq`,
    so a change of frequency does not cause a jump.
    """

    kind = LayerKind.ADDITIVE
    planning_work = 50
    fixed = frozenset({JOINT})
    preferred_duration = 1.0

    def __init__(self, joint: str, parameters: Mapping[str, float], seed: int) -> None:
        """Prepare a motion.

        Args:
            joint: H-Anim name.
            parameters: values of some parameters; unknown names have no effect.
            seed: of its random generator.
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
        """Start; the current body has no effect."""

    def pose(self, moment: Moment) -> MotionPose:
        """Return the additional turn."""
        if self._since is None:
            self._since = self._last = moment.time
        passed, self._last = moment.time - self._last, moment.time
        x, y, z = (self._angle(i, passed) for i in range(len(_AXES)))
        weight = minimum_jerk(share(moment.time, self._since, self._since + _EASE_IN))
        return MotionPose({self._joint: from_euler(x, y, z)}, weight)

    def _angle(self, axis: int, passed: float) -> float:
        """Return the angle about one axis after further seconds, rad."""
        frequency, amplitude, persistence, offset = (
            self.parameters[f"{name}{_AXES[axis]}"] for name in ("basefreq", "baseamplitude", "persistence", "offset")
        )
        self._cycles[axis] = (self._cycles[axis] + passed * frequency) % _PERIOD
        return offset + amplitude * self._noises[axis].octaves(self._cycles[axis], _OCTAVES, persistence)


_USUAL = "skullbase"


class NoiseMaker:
    """Makes noise for the joint that the parameter `joint` names."""

    def __init__(self, context: MakerContext) -> None:
        self._context = context

    def __call__(self, request: MotionRequest) -> NoiseMotionUnit:
        """Make a motion. Each behavior has its own noise, which is the same in all sessions with the same seed."""
        joint = request.parameters.get(JOINT, _USUAL)
        if joint not in self._context.humanoid.avatar.skeleton:
            raise RealizerError(NoJoints(joints=(joint,), element=request.behavior.name))
        seed = crc32(f"{self._context.seed} {request.behavior.id} {joint}".encode())
        return NoiseMotionUnit(joint, parameter_values(request.parameters, RANGES), seed)
