"""From a binding to a gesture."""

from reactive_realizer.binding.gesture_binding import numbers
from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.arms.gesture_motion_unit import GestureMotionUnit
from reactive_realizer.engines.animation.procedural.animation_files import wanted_animation
from reactive_realizer.engines.animation.procedural.proc_animation import ProcAnimation


class GestureMaker:
    """Makes gestures of animation files.

    Of the time that planning a gesture takes, most is its hands' way to the stroke: found once for all alike, while the
    figure rests in the same posture.
    """

    def __init__(self, actor: Actor) -> None:
        self._actor = actor
        self._made: dict[tuple[ProcAnimation, tuple[tuple[str, float], ...]], GestureMotionUnit] = {}
        self._rest = actor.rest.body

    def __call__(self, wanted: Wanted) -> GestureMotionUnit:
        """As every maker."""
        animation, parameters = wanted_animation(self._actor, wanted), numbers(wanted.parameters)
        if self._rest is not self._actor.rest.body:
            self._rest = self._actor.rest.body
            self._made.clear()
        alike = animation, tuple(parameters.items())
        if alike not in self._made:
            self._made[alike] = GestureMotionUnit(animation, parameters, self._rest.pose, self._rest)
        return self._made[alike].another()
