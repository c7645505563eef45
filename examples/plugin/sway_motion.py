"""A kind of motion: the trunk sways from side to side."""

from collections.abc import Mapping
from math import pi, radians, sin

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import from_axis_angle
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_parameters import parameter_values
from reactive_realizer.engines.animation.motion_unit import Moment, MotionPose, MotionUnit
from reactive_realizer.planunit.parameter import Range

_FORWARD = (0.0, 0.0, 1.0)
_RANGES = {"degrees": Range(0.0, 20.0)}
_POINTS = {"start": 0.0, "left": 0.25, "right": 0.75, "end": 1.0}


class Sway(MotionUnit):
    """Sways to the left and to the right once, and is added to what the trunk does otherwise."""

    kind = LayerKind.ADDITIVE
    joints = frozenset({"vl5"})
    ranges = _RANGES
    key_positions = _POINTS
    preferred_duration = 2.0

    def __init__(self, parameters: Mapping[str, float]) -> None:
        self.parameters = {"degrees": 6.0, **parameters}

    def start(self, body: Body) -> None:
        """Start; the pose of the body has no effect."""

    def pose(self, moment: Moment) -> MotionPose:
        """Return the turn that is added; positive about the forward axis is to the right."""
        angle = -radians(self.parameters["degrees"]) * sin(2.0 * pi * moment.phase)
        return MotionPose({"vl5": from_axis_angle(_FORWARD, angle)})


class SwayMaker:
    """Makes sways for one figure."""

    def __init__(self, context: MakerContext) -> None:
        self._context = context

    def __call__(self, request: MotionRequest) -> Sway:
        """Make the motion of a behavior."""
        return Sway(parameter_values(request.parameters, _RANGES))
