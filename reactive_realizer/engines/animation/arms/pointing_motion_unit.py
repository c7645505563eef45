"""Pointing at a target for a while (thesis 4.2.2)."""

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import Quat, slerp
from reactive_realizer.engines.animation.arms.gesture_motion_unit import HOLD, HOLD_RANGE
from reactive_realizer.engines.animation.arms.pace import comfortable, seven_points
from reactive_realizer.engines.animation.arms.pointing_arm import ArmPose, PointingArm
from reactive_realizer.engines.animation.arms.sigmoid import sigmoid
from reactive_realizer.engines.animation.easing import share
from reactive_realizer.engines.animation.motion_unit import Moment, MotionUnit, Posed, arms_of
from reactive_realizer.engines.animation.sight import Sight
from reactive_realizer.errors import Fault
from reactive_realizer.planunit.parameter import Range

HAND = "hand"
"""The parameter that says which hand points, where the behavior does not."""

STEEPNESS, ASYMMETRY = "steepness", "asymmetry"
"""Parameters of the `sigmoid` of way by time; `HOLD` is how long the finger stays on its target, s."""

DEFAULTS: Mapping[str, float] = MappingProxyType({STEEPNESS: 2.0, ASYMMETRY: -0.1, HOLD: 0.8})

RANGES: Mapping[str, Range] = MappingProxyType(
    {STEEPNESS: Range(1.5, 4.0), ASYMMETRY: Range(-0.6, 0.6), HOLD: HOLD_RANGE}
)
"""The values of these parameters that mean something."""


class PointingMotionUnit(MotionUnit):
    """Brings the line of one index finger or of both to the target and back.

    It sets out from where the arms are and keeps the line on the target from ready to relax, wherever target and trunk
    go. Hands speed up and slow down in a bell of adjustable shape (`sigmoid`). The way back takes as long as the way
    there: people's retractions from pointing are as their preparations (thesis 4.2.2). A target that leaves the reach
    of the arm has it stay where it came nearest.
    """

    kind = LayerKind.GESTURE
    fixed = frozenset({HAND, *RANGES})

    def __init__(
        self,
        name: str,
        arms: Sequence[PointingArm],
        target: Sight,
        figure: Callable[[], Body],
        rest: Body,
        parameters: Mapping[str, float] = DEFAULTS,
    ) -> None:
        """Plans a pointing.

        Args:
            name: of the target.
            arms: one or both.
            target: where the target is; a hand that moves is pointed at where it will be in the frame.
            figure: the body as it was shown last, additive motion included: a trunk that breathes moves the finger.
            rest: as the body is expected to be at the start: preferred durations follow from it.
            parameters: a value within its range for each of `RANGES`.
        """
        self.parameters = dict(parameters)
        self.joints = frozenset().union(*(arm.joints for arm in arms))
        self.resources = arms_of(self.joints)
        self._arms, self._target, self._figure = arms, target, figure
        self._begin = {joint: rest.rotation(joint) for joint in self.joints}
        self._name, self._aimed = name, dict[str, Quat]()
        way = self.preparation(rest)
        self.preferred_duration = 2.0 * way + self.parameters[HOLD]
        self.key_positions = seven_points([way, 0.0, 0.0, self.parameters[HOLD], 0.0, way])

    def preparation(self, body: Body) -> float:
        """How long the hands would like to take to point from where a body has them, s."""
        return comfortable(body, body.posed(_turns(self._aim(body))), self.joints)

    def start(self, body: Body) -> None:
        """The hands set out from where they are now."""
        self._begin = {joint: body.rotation(joint) for joint in self.joints}

    def pose(self, moment: Moment) -> Posed:
        """Rotations of arms and fingers; they leave for whatever lies below."""
        keys, phase = self.key_positions, moment.phase
        if phase <= keys["relax"] or not self._aimed:
            aims = self._aim(self._figure(), moment.time)
            self._aimed = _turns(aims)
            if phase >= keys["ready"]:
                self.fault = self.fault or self._missed(aims)
        if phase < keys["ready"]:
            done = self._gone(share(phase, 0.0, keys["ready"]))
            return Posed({joint: slerp(self._begin[joint], goal, done) for joint, goal in self._aimed.items()})
        return Posed(self._aimed, 1.0 - self._gone(share(phase, keys["relax"], 1.0)))

    def _gone(self, progress: float) -> float:
        return sigmoid(progress, self.parameters[STEEPNESS], self.parameters[ASYMMETRY])

    def _aim(self, body: Body, time: GlobalTime | None = None) -> list[ArmPose]:
        target = self._target(time)
        return [arm.aim(body, target) for arm in self._arms]

    def _missed(self, aims: Sequence[ArmPose]) -> Fault | None:
        for arm, aim in zip(self._arms, aims, strict=True):
            if aim.fault is not None:
                return Fault("target-lost", {"hand": arm.hand, "target": self._name, "reason": aim.fault})
        return None


def _turns(aims: Sequence[ArmPose]) -> dict[str, Quat]:
    return {joint: rotation for aim in aims for joint, rotation in aim.rotations.items()}
