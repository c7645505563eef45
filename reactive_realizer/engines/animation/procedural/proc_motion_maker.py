"""From a binding to a procedural animation as it is."""

from functools import lru_cache

from reactive_realizer.binding.gesture_binding import numbers
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.procedural.animation_files import AnimationFiles
from reactive_realizer.engines.animation.procedural.proc_animation import ProcAnimation
from reactive_realizer.engines.animation.procedural.proc_motion_unit import ProcMotionUnit, kind_of

_MOST = 128
"""Motions that are kept to be made again."""


class ProcMotionMaker:
    """Makes motions of animation files; those that are alike are planned once."""

    def __init__(self, actor: Actor) -> None:
        self._files = AnimationFiles(actor)
        self._motion = lru_cache(_MOST)(_made)

    def __call__(self, wanted: Wanted) -> ProcMotionUnit:
        """As every maker."""
        return self._motion(self._files(wanted), tuple(numbers(wanted.parameters).items()), wanted.added).another()

    def look_again(self) -> None:
        """As `LookingMaker`."""
        self._files.look_again()


def _made(animation: ProcAnimation, parameters: tuple[tuple[str, float], ...], added: bool) -> ProcMotionUnit:
    return ProcMotionUnit(animation, dict(parameters), LayerKind.ADDITIVE if added else kind_of(animation))
