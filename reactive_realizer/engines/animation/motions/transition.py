"""Transitions: motions from the current pose of some joints to the start of the motions after them (thesis 4.2.4)."""

from collections.abc import Callable, Mapping
from dataclasses import replace

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import EYES
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.vector import scale
from reactive_realizer.engines.animation.animation_unit import AnimationUnit, MotionContext
from reactive_realizer.engines.animation.candidates import Candidates
from reactive_realizer.engines.animation.faults import NoJoints, NoTransition
from reactive_realizer.engines.animation.kinematics import KinematicState
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_unit import (
    JOINTS,
    Moment,
    MotionPose,
    MotionUnit,
    Predictability,
    resources_used,
)
from reactive_realizer.engines.animation.motions.rotation_curves import CURVES, Curve, CurveEnd, CurveKind
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import spelled
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing

CLASS = "class"
"""Parameter for the kind of curve."""


class TransitionMotionUnit(MotionUnit):
    """Leads joints from their state at its start to the state in which the next motions start.

    Until the goal is known (`connect`), the joints stay as they are.
    """

    kind = LayerKind.GESTURE
    fixed = frozenset({CLASS, JOINTS})
    preferred_duration = 0.6
    predictability = Predictability.ONCE_STARTED
    entrance = 0.0  # it takes the velocities into account itself

    def __init__(self, joints: frozenset[str], curve: CurveKind) -> None:
        """Prepare a transition of some joints along curves of one kind."""
        self.parameters = {}
        self.joints = joints
        self.resources = resources_used(joints)
        self._kind = curve
        self._body: Body | None = None
        self._curves: Mapping[str, Curve] = {}

    def start(self, body: Body) -> None:
        """Start from a body."""
        self._body = body

    def connect(self, begin: KinematicState, goal: KinematicState, duration: float) -> None:
        """Set the curves of all joints, with their velocities and accelerations at both ends.

        Args:
            begin: state of the body at phase 0.
            goal: state of the body at phase 1.
            duration: between the two, s.
        """
        self._curves = {
            joint: self._kind(_end(begin, joint, duration), _end(goal, joint, duration)) for joint in self.joints
        }

    def pose(self, moment: Moment) -> MotionPose:
        """Return each joint on its curve."""
        body = self._body or moment.body
        here = {joint: body.rotation(joint) for joint in self.joints}
        return MotionPose({**here, **{joint: curve(moment.phase) for joint, curve in self._curves.items()}})


def _end(moving: KinematicState, joint: str, duration: float) -> CurveEnd:
    """Return the end of a joint's curve with a duration, s."""
    velocity, acceleration = moving.velocity(joint), moving.acceleration(joint)
    return CurveEnd(moving.body.rotation(joint), scale(velocity, duration), scale(acceleration, duration * duration))


Predict = Callable[[GlobalTime, AnimationUnit], KinematicState]
"""Returns the predicted state of the body at a time, with one unit left out."""


class TransitionUnit(AnimationUnit):
    """A transition between pegs."""

    def __init__(
        self, block: BlockKey, behavior: Behavior, candidates: Candidates, context: MotionContext, predict: Predict
    ) -> None:
        """Plan a transition; its goal is predicted when it starts."""
        super().__init__(block, behavior, candidates, context)
        if {"start", "end"} <= behavior.syncs.keys() and self.timing.points == ("start", "end"):
            self.timing = Timing(("start", "end"), (Phase(0.0, PhaseKind.FREE),))
        self._predict = predict
        self._connected = False

    def on_start(self, time: GlobalTime) -> None:
        """Start from the current state of the body."""
        super().on_start(time)
        self._connect(time)

    def on_finish(self, time: GlobalTime) -> None:
        """Finish. The motion to which it led starts now, so the rest of the transition lies below it."""
        if not self.was_cut("end"):
            self.shown = replace(self.shown, kind=LayerKind.POSTURE)
        super().on_finish(time)

    def layer(self, now: GlobalTime) -> Layer:
        """Return the layer; while the end is unknown, the joints stay as they are."""
        if not self._connected:
            self._connect(now)
        return super().layer(now)

    def _connect(self, now: GlobalTime) -> None:
        end = self.time("end")
        if isinstance(self.motion, TransitionMotionUnit) and end is not None and end > now:
            self.motion.connect(self._context.state_at(now), self._predict(end, self), end - now)
            self._connected = True


class TransitionMaker:
    """Makes transitions of the `joints`, or else of the whole figure.

    The parameter `class` names the kind of curve.
    """

    def __init__(self, context: MakerContext) -> None:
        self._joints = frozenset(context.humanoid.avatar.skeleton.joints).difference(EYES)

    def __call__(self, request: MotionRequest) -> TransitionMotionUnit:
        """Make a motion."""
        kind = spelled(request.parameters.get(CLASS, "").rpartition(".")[2], CURVES)
        if kind not in CURVES:
            raise RealizerError(NoTransition(kind=kind, known=tuple(CURVES)))
        joints = self._joints & request.joints if request.joints else self._joints
        if not joints:
            raise RealizerError(NoJoints(joints=tuple(sorted(request.joints)), element=request.behavior.name))
        return TransitionMotionUnit(joints, CURVES[kind])
