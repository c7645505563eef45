"""Motions in a plan."""

from collections.abc import Callable
from itertools import pairwise

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.engines.animation.motion_unit import MotionUnit
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.phase_clock import PhaseClock
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing

_HOLDS = frozenset({("ready", "strokeStart"), ("strokeEnd", "relax")})


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
        body: Callable[[], Body],
        released: Callable[["AnimationUnit", GlobalTime], None],
    ) -> None:
        super().__init__(block, behavior, motion_timing(behavior, motion), resources)
        self.motion = motion
        self.kind = kind
        self.shown: Layer = Layer(kind, {})
        self._clock = PhaseClock({sync: motion.key_positions[sync] for sync in self.timing.points})
        self._body = body
        self._released = released

    @property
    def phase(self) -> float:
        """How far the motion has come, 0 to 1."""
        return self._clock.phase

    def on_start(self, time: GlobalTime) -> None:
        """The motion begins from where the body is."""
        self.motion.start(self._body())

    def on_finish(self, time: GlobalTime) -> None:
        """Give the joints back."""
        self._released(self, time)

    def layer(self, now: GlobalTime) -> Layer:
        """What the motion shows now."""
        self.shown = Layer(self.kind, self.motion.pose(self._clock.advance(self, now), self._body()))
        return self.shown


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
