"""From a binding to a gesture."""

from functools import lru_cache

from reactive_realizer.binding.gesture_binding import numbers
from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.arms.gesture_motion_unit import HOLD, HOLD_RANGE, GestureMotionUnit
from reactive_realizer.engines.animation.motion_unit import AMOUNT, AMOUNT_RANGE
from reactive_realizer.engines.animation.procedural.animation_files import AnimationFiles
from reactive_realizer.engines.animation.procedural.proc_animation import ProcAnimation
from reactive_realizer.engines.animation.values import values_of

_RANGES = {AMOUNT: AMOUNT_RANGE, HOLD: HOLD_RANGE}

_MOST = 128
"""Gestures that are kept to be made again; a planner may ask for any number of sizes of one."""


class GestureMaker:
    """Makes gestures of animation files.

    Of the time that planning a gesture takes, most is its hands' way to the stroke: found once for all alike, while the
    figure rests in the same posture.
    """

    def __init__(self, actor: Actor) -> None:
        self._actor = actor
        self._files = AnimationFiles(actor)
        self._rest = actor.rest.body
        self._gesture = lru_cache(_MOST)(self._made)

    def __call__(self, wanted: Wanted) -> GestureMotionUnit:
        """As every maker."""
        animation = self._files(wanted)
        parameters = numbers(wanted.parameters) | values_of(wanted.parameters, _RANGES)
        if self._rest is not self._actor.rest.body:
            self._rest = self._actor.rest.body
            self._gesture.cache_clear()
        return self._gesture(animation, tuple(parameters.items())).another()

    def look_again(self) -> None:
        """As `LookingMaker`."""
        self._files.look_again()

    def _made(self, animation: ProcAnimation, parameters: tuple[tuple[str, float], ...]) -> GestureMotionUnit:
        return GestureMotionUnit(animation, dict(parameters), self._rest)
