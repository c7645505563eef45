"""From a binding to a procedural animation as it is."""

from reactive_realizer.binding.gesture_binding import numbers
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.procedural.animation_files import wanted_animation
from reactive_realizer.engines.animation.procedural.proc_motion_unit import ProcMotionUnit, kind_of


class ProcMotionMaker:
    """Makes motions of animation files."""

    def __init__(self, actor: Actor) -> None:
        self._actor = actor

    def __call__(self, wanted: Wanted) -> ProcMotionUnit:
        """As every maker."""
        animation = wanted_animation(self._actor, wanted)
        kind = LayerKind.ADDITIVE if wanted.added else kind_of(animation)
        return ProcMotionUnit(animation, numbers(wanted.parameters), kind)
