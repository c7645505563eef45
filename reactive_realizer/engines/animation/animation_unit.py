"""Motions in a plan."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from math import inf

from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.behaviors import Pointing
from reactive_realizer.clock.units import RESOLUTION, GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.engine.player import height
from reactive_realizer.engines.animation.choice import Choice, Choices, choose
from reactive_realizer.engines.animation.drift import Drift, Shown
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.motion_unit import (
    Moment,
    MotionUnit,
    completed,
    layer_of,
)
from reactive_realizer.engines.animation.moving import Moving
from reactive_realizer.engines.animation.release import LOWEST
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Parameter
from reactive_realizer.planunit.phase_clock import PhaseClock
from reactive_realizer.planunit.plan_unit import PlanUnit, SyncPoint
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing
from reactive_realizer.reactive.cell import Source
from reactive_realizer.reactive.graph import Graph

Both = tuple[str, str]
"""The sync points at the ends of a phase."""

_NEVER: frozenset[Both] = frozenset()

_MOST_TIMINGS = 1000
"""Timings that are kept: most motions are planned again and again."""

_HOLDS = frozenset({("ready", "strokeStart"), ("strokeEnd", "relax")})
"""Before and after a stroke the hands wait."""

_STAYS = frozenset({("strokeStart", "stroke"), ("stroke", "strokeEnd")})
"""The stroke of a pointing is a stay."""

_LATE = 0.05
"""s; what comes later than this after its start has joined late."""


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
        height: where it lay among others when it was shown last.
        notes: what is wrong with what is said to it, or with its motion, though it is played.
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
        keys = keys_of(behavior, motion)
        super().__init__(block, behavior, motion_timing(behavior, motion, keys))
        self._stage = stage
        self._play(planned, keys)
        for name, own in planned.names.items():
            cell = Source(stage.graph, str(self.key(name)), motion.parameters[own])
            self.parameters[name] = Parameter(self, cell, planned.range(name))
        self.notes = planned.notes
        self.height = LOWEST
        self._complained = False
        self._choices = choices

    @property
    def phase(self) -> float:
        """How far the motion has come, 0 to 1."""
        return self._clock.phase

    def _play(self, choice: Choice, keys: Mapping[str, float]) -> None:
        motion = choice.motion
        self.motion = motion
        self.resources = motion.resources
        self.group = choice.group or motion.group
        self.yields = choice.yields
        self.shown = Layer(motion.kind, {}, 0.0)
        self._seen: tuple[Shown, ...] = ()
        self.keys = keys
        self._clock = PhaseClock(keys)
        self._names = choice.names

    def _stands_in(self, choice: Choice) -> bool:
        """Whether a choice has the points and the parameters of the one that is planned."""
        points = tuple(keys_of(self.behavior, choice.motion))
        return points == self.timing.points and choice.names.keys() >= self._names.keys()

    def settle(self, taken: frozenset[str]) -> None:
        """The other hand plays if one is busy, and what is short if there is little time (thesis 8.17)."""
        start, end = self.times_around
        planned = self._choices.planned
        usable = (choice for choice in self._choices if choice is planned or self._stands_in(choice))
        chosen = choose(usable, taken, None if start is None or end is None else end - start)
        if chosen.motion is not self.motion:
            self._play(chosen, keys_of(self.behavior, chosen.motion))

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

    def fire(self, now: GlobalTime, *, end: bool = True) -> list[SyncPoint]:
        """As every unit; what begins after its start has passed joins late."""
        begins = not self.begun
        fired = super().fire(now, end=end)
        start = self.points[0].fired
        if begins and start is not None and now - start > _LATE:
            self.motion.joined = now
        return fired

    def on_start(self, time: GlobalTime) -> None:
        """The motion begins from where the body is; what is added to it comes from nowhere."""
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
        layer = layer_of(self.motion, Moment(self._clock.advance(self, now), now, stage.body(), stage.shown()))
        self.height = height(self)
        self.shown = self._come_in(layer, now)
        self._seen = (*(seen for seen in self._seen[-1:] if seen.time < now), Shown(now, self.shown))
        return self.shown

    def _come_in(self, layer: Layer, now: GlobalTime) -> Layer:
        """The layer of one that joined late comes by its weight."""
        joined, entrance = self.motion.joined, self.motion.entrance
        if joined is None or entrance is None:
            return layer
        return replace(layer, weight=layer.weight * minimum_jerk(share(now, joined, joined + entrance)))

    def drift(self, time: GlobalTime) -> Drift | None:
        """How what it showed last goes on by itself from a time on; None if that is not known."""
        return Drift.after(self._seen, time)

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


def motion_timing(behavior: Behavior, motion: MotionUnit, keys: Mapping[str, float]) -> Timing:
    """The preferred timing of a behavior, from the key positions of its motion.

    Args:
        behavior: what is asked for.
        motion: what plays it.
        keys: the phase of each point: of those of the motion, whatever their names, and of those that BML wants of such
            a behavior.
    """
    # What is added to other motion waits for nothing: where its points coincide they stay together.
    waits = motion.kind is not LayerKind.ADDITIVE
    holds = _holds(isinstance(behavior, Pointing), behavior.sync_points) if waits else _NEVER
    limits = motion.limits or (0.0, inf)
    return _timing(tuple(keys.items()), motion.preferred_duration, limits, holds, behavior.persistent)


@lru_cache(_MOST_TIMINGS)
def _timing(
    keys: tuple[tuple[str, float], ...],
    duration: float,
    limits: tuple[float, float],
    holds: frozenset[Both],
    persistent: bool,
) -> Timing:
    shortest, longest = limits
    phases = []
    for (point, begin), (other, end) in pairwise(keys):
        part = end - begin
        if (point, other) in holds:
            phases.append(Phase(part * duration, PhaseKind.HOLD))
        else:
            most = part * longest if part > 0.0 else inf
            phases.append(Phase(part * duration, PhaseKind.ELASTIC, part * shortest, most))
    return Timing(tuple(point for point, _ in keys), tuple(phases), persistent=persistent)


@lru_cache(_MOST_TIMINGS)
def _holds(pointing: bool, points: SyncPoints) -> frozenset[Both]:
    """The phases in which a motion waits."""
    if pointing:
        return _HOLDS | _STAYS
    # What only comes and goes, such as a gaze, waits between.
    return _HOLDS | ({("ready", "relax")} & set(pairwise(points)))


def keys_of(behavior: Behavior, motion: MotionUnit) -> dict[str, float]:
    """The phase of each point of a behavior that a motion plays, in order."""
    wanted = (*behavior.sync_points, *behavior.instead_of)
    keys = motion.key_positions
    if not keys.keys() >= set(wanted):
        keys = completed(keys)
    # One that strokes several times has no single stroke.
    return {sync: phase for sync, phase in keys.items() if sync != "stroke" or "stroke:1" not in keys}
