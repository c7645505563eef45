"""From a behavior to a posture."""

from reactive_realizer.bml.posture import Posture, PostureShift
from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.posture.posture_motion_unit import PostureMotionUnit
from reactive_realizer.errors import error


class PostureMaker:
    """Makes postures, and shifts of posture."""

    def __init__(self, actor: Actor) -> None:
        self._rest = actor.rest

    def __call__(self, wanted: Wanted) -> PostureMotionUnit:
        """As every maker."""
        behavior = wanted.behavior
        if not isinstance(behavior, Posture):
            raise error("wrong-element", unit="posture", element=behavior.name)
        shift = isinstance(behavior, PostureShift)
        return PostureMotionUnit(self._rest, behavior.stance, behavior.poses, shift=shift)
