"""From a binding to noise."""

from zlib import crc32

from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.noise_motion_unit import JOINT, RANGES, NoiseMotionUnit
from reactive_realizer.engines.animation.values import values_of
from reactive_realizer.errors import error

_USUAL = "skullbase"


class NoiseMaker:
    """Makes noise of one joint, which the parameter `joint` names."""

    def __init__(self, actor: Actor) -> None:
        self._actor = actor

    def __call__(self, wanted: Wanted) -> NoiseMotionUnit:
        """As every maker; each behavior has noise of its own, and the same in each session of the same seed."""
        joint = wanted.parameters.get(JOINT, _USUAL)
        if joint not in self._actor.humanoid.avatar.skeleton:
            raise error("no-joints", joints=joint, element=wanted.behavior.name)
        seed = crc32(f"{self._actor.seed} {wanted.behavior.id} {joint}".encode())
        return NoiseMotionUnit(joint, values_of(wanted.parameters, RANGES), seed)
