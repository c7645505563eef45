"""Motions in a plan."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import inf

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.embodiment.quaternion import Quat, slerp
from reactive_realizer.engines.animation.arms.gesture_motion_unit import GestureMotionUnit
from reactive_realizer.engines.animation.choice import Choice
from reactive_realizer.engines.animation.easing import share
from reactive_realizer.engines.animation.motion_unit import AMOUNT, AMOUNT_RANGE, Moment, MotionUnit, completed
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Parameter
from reactive_realizer.planunit.phase_clock import PhaseClock
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing
from reactive_realizer.reactive.cell import Source
from reactive_realizer.reactive.graph import Graph

_HOLDS = frozenset({("ready", "strokeStart"), ("strokeEnd", "relax")})
"""Before and after a stroke the hands wait."""


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
        shown: what it showed last.
    """

    def __init__(self, block: BlockKey, behavior: Behavior, choices: Sequence[Choice], stage: Stage) -> None:
        """Plans a motion.

        Args:
            block: of which block.
            behavior: what is asked for.
            choices: the motions that could play it, the best first: this one is planned.
            stage: where it plays.
        """
        chosen = choices[0]
        motion = chosen.motion
        super().__init__(block, behavior, motion_timing(behavior, motion), motion.resources)
        self.motion = motion
        self.group = chosen.group or motion.group
        self.yields = chosen.yields
        self.shown = Layer(motion.kind, {})
        self._choices = choices
        self._clock = PhaseClock({sync: _keys(behavior, motion)[sync] for sync in self.timing.points})
        self._stage = stage
        self._names = chosen.names
        for name, own in chosen.names.items():
            cell = Source(stage.graph, str(self.key(name)), motion.parameters[own])
            self.parameters[name] = Parameter(self, cell, AMOUNT_RANGE if name == AMOUNT else motion.ranges[own])

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
        for name, own in self._names.items():
            self.motion.parameters[own] = self.parameters[name].value
        posed = self.motion.pose(Moment(self._clock.advance(self, now), now, self._stage.body()))
        self.shown = Layer(self.motion.kind, posed.rotations, posed.weight, root=posed.root)
        return self.shown

    def way_back(self, now: GlobalTime, rest: Body) -> dict[str, Quat]:
        """The rotations of a unit past its relax, on its way to a body at rest, from the times of its points alone."""
        relax, end = self.time("relax"), self.time("end")
        gone = 0.0 if relax is None or end is None else share(now, relax, end)
        begin = self.motion.key_positions["relax"]
        posed = self.motion.pose(Moment(begin + gone * (1.0 - begin), now, rest))
        return {joint: slerp(rest.rotation(joint), goal, posed.weight) for joint, goal in posed.rotations.items()}


def motion_timing(behavior: Behavior, motion: MotionUnit) -> Timing:
    """The preferred timing of a behavior, from the key positions of its motion.

    Its points are those of the motion, whatever their names, and those that BML wants of such a behavior.
    """
    keys = _keys(behavior, motion)
    shortest, longest = motion.limits or (0.0, inf)
    # What only comes and goes, such as a gaze, waits between.
    holds = {*_HOLDS, *({("ready", "relax")} & set(pairwise(behavior.sync_points)))}
    phases = (
        Phase((keys[b] - keys[a]) * motion.preferred_duration, PhaseKind.HOLD)
        if (a, b) in holds
        else Phase(
            (keys[b] - keys[a]) * motion.preferred_duration,
            PhaseKind.ELASTIC,
            (keys[b] - keys[a]) * shortest,
            (keys[b] - keys[a]) * longest if keys[b] > keys[a] else inf,
        )
        for a, b in pairwise(keys)
    )
    return Timing(tuple(keys), tuple(phases), persistent=getattr(behavior, "persistent", False))


def _keys(behavior: Behavior, motion: MotionUnit) -> dict[str, float]:
    wanted = (*behavior.sync_points, *behavior.instead_of)
    keys = motion.key_positions
    if not keys.keys() >= set(wanted):
        keys = completed(keys)
    # One that strokes several times has no single stroke.
    return {sync: phase for sync, phase in keys.items() if sync != "stroke" or "stroke:1" not in keys}
