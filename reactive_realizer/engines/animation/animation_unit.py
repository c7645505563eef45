"""Motions in a plan."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from math import inf

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Pointing
from reactive_realizer.clock.units import RESOLUTION, GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.engines.animation.choice import Choice, Choices, choose
from reactive_realizer.engines.animation.easing import share
from reactive_realizer.engines.animation.motion_unit import (
    Moment,
    MotionUnit,
    completed,
    layer_of,
)
from reactive_realizer.engines.animation.moving import Moving
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Parameter
from reactive_realizer.planunit.phase_clock import PhaseClock
from reactive_realizer.planunit.plan_unit import PlanUnit, SyncPoint
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing
from reactive_realizer.reactive.cell import Source
from reactive_realizer.reactive.graph import Graph

_HOLDS = frozenset({("ready", "strokeStart"), ("strokeEnd", "relax")})
"""Before and after a stroke the hands wait."""

_STAYS = frozenset({("strokeStart", "stroke"), ("stroke", "strokeEnd")})
"""The stroke of a pointing is a stay."""


@dataclass(frozen=True, slots=True)
class Stage:
    """What motions find where they play.

    Attributes:
        body: the body as shown last, without additive layers.
        shown: the body as shown last.
        moving: the same body as it has moved on by a time, and how it moves then.
        hands: the body with its hands where they are at a time on their way back to rest, whether anybody looks or
            not; None where they are at rest.
        passed: learns when a unit passes a point.
        released: takes the joints of a unit that has ended.
        graph: where parameters are cells.
    """

    body: Callable[[], Body]
    shown: Callable[[], Body]
    moving: Callable[[GlobalTime], Moving]
    hands: Callable[[GlobalTime], Body | None]
    passed: Callable[["AnimationUnit", GlobalTime], None]
    released: Callable[["AnimationUnit", GlobalTime], None]
    graph: Graph


class AnimationUnit(PlanUnit):
    """A `MotionUnit` between pegs.

    Attributes:
        motion: what is played.
        keys: sync id -> phase of the motion, 0 to 1.
        shown: what it showed last.
        started: when it started, s; before that it lies below all others.
        note: what is wrong with what is said to it though it is played, None if nothing is.
    """

    def __init__(self, block: BlockKey, behavior: Behavior, choices: Choices, stage: Stage) -> None:
        """Plans a motion.

        Args:
            block: of which block.
            behavior: what is asked for.
            choices: the motions that could play it, the best of which is planned.
            stage: where it plays.
        """
        planned = choices.planned
        motion = planned.motion
        super().__init__(block, behavior, motion_timing(behavior, motion))
        self._stage = stage
        self._play(planned)
        for name, own in planned.names.items():
            cell = Source(stage.graph, str(self.key(name)), motion.parameters[own])
            self.parameters[name] = Parameter(self, cell, planned.range(name))
        self.note = planned.note
        self.started = GlobalTime(-inf)
        self._complained = False
        self._choices = choices

    @property
    def phase(self) -> float:
        """How far the motion has come, 0 to 1."""
        return self._clock.phase

    def _play(self, choice: Choice) -> None:
        motion = choice.motion
        self.motion = motion
        self.resources = motion.resources
        self.group = choice.group or motion.group
        self.yields = choice.yields
        self.shown = Layer(motion.kind, {})
        self.keys = _keys(self.behavior, motion)
        self._clock = PhaseClock(self.keys)
        self._names = choice.names

    def _stands_in(self, choice: Choice) -> bool:
        """Whether a choice has the points and the parameters of the one that is planned."""
        points = tuple(_keys(self.behavior, choice.motion))
        return points == self.timing.points and choice.names.keys() >= self._names.keys()

    def settle(self, taken: frozenset[str]) -> None:
        """The other hand plays if one is busy, and what is short if there is little time (thesis 8.17)."""
        start, end = self.times_around
        planned = self._choices.planned
        usable = (choice for choice in self._choices if choice is planned or self._stands_in(choice))
        chosen = choose(usable, taken, None if start is None or end is None else end - start)
        if chosen.motion is not self.motion:
            self._play(chosen)

    def preference(self, now: GlobalTime) -> Timing:
        """A gesture that begins now is prepared from where the hands are (thesis 12.1.4)."""
        hands = None if self.begun else self._stage.hands(now)
        duration = None if hands is None else self.motion.preparation(hands)
        if duration is None:
            return self.timing
        preparation, *others = self.timing.phases
        return replace(self.timing, phases=(replace(preparation, duration=duration), *others))

    def gentle_end(self, time: GlobalTime) -> GlobalTime:
        """The next point at which it may well be left; without one it is broken off."""
        times = (point.time for point in self._exits())
        return min((GlobalTime(at) for at in times if at is not None and at >= time), default=time)

    def subsiding(self, time: GlobalTime) -> bool:
        """Just at such a point a successor may take over, too."""
        leaving = any(point.fired is not None and abs(point.fired - time) <= RESOLUTION for point in self._exits())
        return leaving or super().subsiding(time)

    def _exits(self) -> list[SyncPoint]:
        return [point for point in self.points if point.id in self.motion.exits]

    def on_start(self, time: GlobalTime) -> None:
        """The motion begins from where the body is; what is added to it comes from nowhere."""
        self.started = time
        added = self.motion.kind is LayerKind.ADDITIVE
        self.motion.start(self._stage.body() if added else self._stage.moving(time).body)

    def on_sync(self, sync: str, time: GlobalTime) -> None:
        """Eyes that it leads may come or go here."""
        self._stage.passed(self, time)

    def on_finish(self, time: GlobalTime) -> None:
        """Give the joints back."""
        self._stage.released(self, time)

    def layer(self, now: GlobalTime) -> Layer:
        """What the motion shows now.

        Raises:
            RealizerError: the motion has nothing to show, or not what can be shown: the unit should be stopped.
        """
        for name, own in self._names.items():
            self.motion.parameters[own] = self.parameters[name].value
        stage = self._stage
        self.shown = layer_of(self.motion, Moment(self._clock.advance(self, now), now, stage.body(), stage.shown()))
        return self.shown

    def complaint(self) -> Fault | None:
        """What is wrong with it though it plays on; told once."""
        fault = None if self._complained else self.motion.fault
        self._complained = self._complained or fault is not None
        return fault

    def way_back(self, now: GlobalTime, rest: Body) -> Layer:
        """The layer of a unit past its relax, on its way to a body at rest, from the times of its points alone."""
        relax, end = self.time("relax"), self.time("end")
        gone = 0.0 if relax is None or end is None else share(now, relax, end)
        begin = self.motion.key_positions.get("relax", 1.0)
        return layer_of(self.motion, Moment(begin + gone * (1.0 - begin), now, rest))


def motion_timing(behavior: Behavior, motion: MotionUnit) -> Timing:
    """The preferred timing of a behavior, from the key positions of its motion.

    Its points are those of the motion, whatever their names, and those that BML wants of such a behavior.
    """
    keys = _keys(behavior, motion)
    shortest, longest = motion.limits or (0.0, inf)
    # What is added to other motion waits for nothing: where its points coincide they stay together.
    holds = frozenset[tuple[str, str]]() if motion.kind is LayerKind.ADDITIVE else _holds(behavior)
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
    return Timing(tuple(keys), tuple(phases), persistent=behavior.persistent)


def _holds(behavior: Behavior) -> frozenset[tuple[str, str]]:
    """The phases in which a motion waits."""
    if isinstance(behavior, Pointing):
        return _HOLDS | _STAYS
    # What only comes and goes, such as a gaze, waits between.
    return _HOLDS | ({("ready", "relax")} & set(pairwise(behavior.sync_points)))


def _keys(behavior: Behavior, motion: MotionUnit) -> dict[str, float]:
    wanted = (*behavior.sync_points, *behavior.instead_of)
    keys = motion.key_positions
    if not keys.keys() >= set(wanted):
        keys = completed(keys)
    # One that strokes several times has no single stroke.
    return {sync: phase for sync, phase in keys.items() if sync != "stroke" or "stroke:1" not in keys}
