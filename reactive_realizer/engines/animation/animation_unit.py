"""Motions in a plan."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.engines.animation.arms.gesture_motion_unit import GestureMotionUnit
from reactive_realizer.engines.animation.easing import share
from reactive_realizer.engines.animation.motion_unit import MotionUnit
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Parameter, Range
from reactive_realizer.planunit.phase_clock import PhaseClock
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing
from reactive_realizer.reactive.cell import Source
from reactive_realizer.reactive.graph import Graph

_HOLDS = frozenset({("ready", "strokeStart"), ("strokeEnd", "relax"), ("ready", "relax")})
"""Before and after a stroke the hands wait; between coming and going a gaze looks."""

AMOUNT_RANGE = Range(0.0, 1.0)


@dataclass(frozen=True, slots=True)
class Stage:
    """What motions find where they play.

    Attributes:
        body: the body as shown last, without additive layers.
        hands: the body with its hands where they are on their way back to rest, whether anybody looks or not; None
            where they are at rest.
        released: takes the joints of a unit that has ended.
        graph: where parameters are cells.
    """

    body: Callable[[], Body]
    hands: Callable[[], Body | None]
    released: Callable[["AnimationUnit", GlobalTime], None]
    graph: Graph


class AnimationUnit(PlanUnit):
    """A `MotionUnit` between pegs.

    Attributes:
        motion: what is played.
        kind: where it lies among the layers of a frame.
        shown: the rotations that it showed last.
    """

    def __init__(
        self,
        block: BlockKey,
        behavior: Behavior,
        motion: MotionUnit,
        kind: LayerKind,
        resources: frozenset[str],
        stage: Stage,
    ) -> None:
        super().__init__(block, behavior, motion_timing(behavior, motion), resources)
        self.motion = motion
        self.kind = kind
        self.shown: Layer = Layer(kind, {})
        self._clock = PhaseClock({sync: motion.key_positions[sync] for sync in self.timing.points})
        self._stage = stage
        if motion.amount is not None:
            amount = Source(stage.graph, str(self.key("amount")), motion.parameters[motion.amount])
            self.parameters["amount"] = Parameter(self, amount, AMOUNT_RANGE)

    @property
    def phase(self) -> float:
        """How far the motion has come, 0 to 1."""
        return self._clock.phase

    def preference(self) -> Timing:
        """A gesture that begins now is prepared from where the hands are (thesis 12.1.4)."""
        hands = self._stage.hands()
        if self.begun or hands is None or not isinstance(self.motion, GestureMotionUnit):
            return self.timing
        preparation, *others = self.timing.phases
        return replace(self.timing, phases=(replace(preparation, duration=self.motion.preparation(hands)), *others))

    def on_start(self, time: GlobalTime) -> None:
        """The motion begins from where the body is."""
        self.motion.start(self._stage.body())

    def on_finish(self, time: GlobalTime) -> None:
        """Give the joints back."""
        self._stage.released(self, time)

    def layer(self, now: GlobalTime) -> Layer:
        """What the motion shows now."""
        if self.motion.amount is not None:
            self.motion.parameters[self.motion.amount] = self.parameters["amount"].value
        self.shown = Layer(self.kind, self.motion.pose(self._clock.advance(self, now), self._stage.body()))
        return self.shown

    def way_back(self, now: GlobalTime, rest: Body) -> dict[str, Quat]:
        """The rotations of a unit past its relax, from the times of its points alone."""
        relax, end = self.time("relax"), self.time("end")
        gone = 0.0 if relax is None or end is None else share(now, relax, end)
        begin = self.motion.key_positions["relax"]
        return self.motion.pose(begin + gone * (1.0 - begin), rest)


def motion_timing(behavior: Behavior, motion: MotionUnit) -> Timing:
    """The preferred timing of a behavior, from the key positions of its motion."""
    points = behavior.sync_points
    keys = motion.key_positions
    phases = (
        Phase(
            (keys[after] - keys[before]) * motion.preferred_duration,
            PhaseKind.HOLD if (before, after) in _HOLDS else PhaseKind.ELASTIC,
        )
        for before, after in pairwise(points)
    )
    return Timing(points, tuple(phases))
