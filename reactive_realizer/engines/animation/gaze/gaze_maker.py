"""From a behavior to a gaze."""

from reactive_realizer.binding.flag import flag
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Gaze, GazeShift, HeadDirectionShift
from reactive_realizer.bml.names import BMLT
from reactive_realizer.bml.words import Influence
from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.gaze.aim import Aim
from reactive_realizer.engines.animation.gaze.gaze_motion_unit import GAZE_SHIFT, HEAD_SHIFT, LOOK, GazeMotionUnit
from reactive_realizer.engines.animation.gaze.influence import EYES, WEIGHTS, usual_weights
from reactive_realizer.engines.animation.sight import sight_of
from reactive_realizer.engines.animation.values import values_of
from reactive_realizer.errors import error

DYNAMIC = (BMLT, "dynamic")
"""The attribute by which a gaze follows a target that moves."""


class GazeMaker:
    """Makes gazes and shifts of gaze at targets of the world.

    Args:
        actor: who looks.
        follow: whether all of them follow their target; else those that say so.
        influence: what takes part where the behavior does not say.
    """

    def __init__(self, actor: Actor, *, follow: bool = False, influence: Influence = Influence.HEAD) -> None:
        self._actor = actor
        self._follow = follow
        self._influence = influence

    def __call__(self, wanted: Wanted) -> GazeMotionUnit:
        """As every maker."""
        gaze = wanted.behavior
        if not isinstance(gaze, Gaze):
            raise error("wrong-element", unit="gaze", element=gaze.name)
        follow = self._follow or _follows(gaze)
        aim = Aim(sight_of(self._actor, gaze.target, follow=follow), gaze.offset_angle, gaze.offset_direction)
        weights = usual_weights(gaze.influence or self._influence) | values_of(wanted.parameters, WEIGHTS)
        return GazeMotionUnit(aim, weights, self._actor.rest, GAZE_SHIFT if isinstance(gaze, GazeShift) else LOOK)


class HeadDirectionMaker:
    """Makes shifts of the head's direction: as those of gaze, without the eyes."""

    def __init__(self, actor: Actor) -> None:
        self._actor = actor

    def __call__(self, wanted: Wanted) -> GazeMotionUnit:
        """As every maker."""
        shift = wanted.behavior
        if not isinstance(shift, HeadDirectionShift):
            raise error("wrong-element", unit="head-direction", element=shift.name)
        aim = Aim(sight_of(self._actor, shift.target, follow=_follows(shift)))
        weights = usual_weights(Influence.HEAD) | values_of(wanted.parameters, WEIGHTS)
        del weights[EYES]
        return GazeMotionUnit(aim, weights, self._actor.rest, HEAD_SHIFT)


def _follows(behavior: Behavior) -> bool:
    return flag(DYNAMIC[1], behavior.extensions.get(DYNAMIC, "false"))
