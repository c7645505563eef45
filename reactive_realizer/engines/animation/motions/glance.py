"""Glances aside as motions: a saccade away from where the eyes look, and one back."""

import math

from reactive_realizer.bml.glance import Glance
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import Quat, from_euler
from reactive_realizer.engines.animation.faults import WrongElement
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_unit import Moment, MotionPose, MotionUnit
from reactive_realizer.errors import RealizerError

_DURATION = 0.3
"""Preferred duration, s: about that of a fixation."""


class GlanceMotionUnit(MotionUnit):
    """Turns the eyes aside while it plays; `EyeController` moves them there and back at the speed of saccades."""

    kind = LayerKind.ADDITIVE
    joints = frozenset()
    preferred_duration = _DURATION

    def __init__(self, left: float, up: float) -> None:
        """Plan a glance.

        Args:
            left: turn to the left, rad.
            up: turn upward, rad.
        """
        self.parameters = {}
        self._turn = from_euler(-up, left, 0.0)

    def start(self, body: Body) -> None:
        """Nothing has to be known of the body."""

    def pose(self, moment: Moment) -> MotionPose:
        """Return no rotations: the eyes move after all joints."""
        return MotionPose({})

    def glance(self, phase: float) -> Quat | None:
        """Return the turn of the eyes until the end."""
        return self._turn if phase < 1.0 else None


class GlanceMaker:
    """Makes glances."""

    def __init__(self, context: MakerContext) -> None:
        pass

    def __call__(self, request: MotionRequest) -> GlanceMotionUnit:
        """Make a motion."""
        behavior = request.behavior
        if not isinstance(behavior, Glance):
            raise RealizerError(WrongElement(unit="glance", element=behavior.name))
        return GlanceMotionUnit(math.radians(behavior.left), math.radians(behavior.up))
