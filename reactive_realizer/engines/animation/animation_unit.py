"""Plan units that play motions."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Pointing
from reactive_realizer.bml.vocabulary import InterruptSpeech
from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer, LayerKind, over
from reactive_realizer.engine.effects import MovePoints
from reactive_realizer.engine.player import height
from reactive_realizer.engines.animation.candidates import Candidate, Candidates, select
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.fade_out import LOWEST
from reactive_realizer.engines.animation.kinematics import KinematicState
from reactive_realizer.engines.animation.live_extent import TEMPORAL_EXTENT, LiveExtent
from reactive_realizer.engines.animation.motion_timing import keys_of, motion_timing
from reactive_realizer.engines.animation.motion_unit import (
    Moment,
    PhaseDuration,
    layer_of,
)
from reactive_realizer.engines.animation.parameter_jumps import ParameterJumps
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Parameter, ParameterValues
from reactive_realizer.planunit.phase_clock import PhaseClock
from reactive_realizer.planunit.plan_unit import LATE, PlanUnit
from reactive_realizer.planunit.sync_point import DuePoint, SyncPoint
from reactive_realizer.planunit.timing import Timing
from reactive_realizer.reactive.graph import Graph

CHANGE = 0.3
"""Time in which joints go over to a motion with other parameters, s: about as long as a movement takes."""

_TURNING_BACK = 0.06
"""Time that a hand needs to turn back after a stroke, s, beside the shortest duration of a preparation from rest."""

_RECENT = 0.07
"""A layer shown longer ago says nothing about its speed, s."""


_HALFWAY = 0.5
"""Share of the pose of a gesture that an arm keeps which waits for the next one (ours)."""


@dataclass(frozen=True, slots=True)
class MotionContext:
    """The figure and its motion, as motion units see them.

    Attributes:
        body: returns the body as shown last, without additive layers.
        shown: returns the body as shown last.
        rest: returns the body at rest.
        state_at: returns the kinematic state at a time: the body as shown last, extrapolated.
        hands: returns the body with its hands where they are at a time, as the times of points imply, whether frames
            are made or not; None if they are at rest.
        passed: called when a unit passes a sync point.
        released: called when a unit ends, to take over its joints.
        claimed: returns the resources that are better left to others while a unit plays.
        switch: called with joints, and the time until which they go over to another motion (`Humanoid.switch`).
        graph: of the cells of parameters.
    """

    body: Callable[[], Body]
    shown: Callable[[], Body]
    rest: Callable[[], Body]
    state_at: Callable[[GlobalTime], KinematicState]
    hands: Callable[[GlobalTime], Body | None]
    passed: Callable[["AnimationUnit", str, GlobalTime], None]
    released: Callable[["AnimationUnit", GlobalTime], None]
    claimed: Callable[["AnimationUnit"], frozenset[str]]
    switch: Callable[[Iterable[str], GlobalTime], None]
    graph: Graph


class AnimationUnit(PlanUnit):
    """A `MotionUnit` between pegs.

    Attributes:
        motion: that is played.
        keys: sync id -> phase of the motion, 0 to 1.
        shown: the layer that it showed last.
        shown_at: time of that, s.
        height: its stacking position when it was shown last.
        notes: faults of the behavior or of its motion that do not prevent playing.
        kept_up: joints that a retraction brings only halfway to rest.
    """

    kept_up: frozenset[str] = frozenset()

    def __init__(self, block: BlockKey, behavior: Behavior, candidates: Candidates, context: MotionContext) -> None:
        """Plan a motion.

        Args:
            block: of the behavior.
            behavior: to play.
            candidates: the motions that could play it; the best one is planned.
            context: in which it plays.
        """
        planned = candidates.planned
        motion = planned.motion
        keys = keys_of(behavior, motion)
        super().__init__(block, behavior, motion_timing(behavior, motion, keys))
        self._context = context
        self.parameters = {
            name: Parameter(context.graph, str(self.key(name)), motion.parameters[own], planned.range(name))
            for name, own in planned.names.items()
        }
        self._play(planned, keys)
        self.notes = planned.notes
        self.planning_work = motion.planning_work
        self.height = LOWEST
        self._fault_reported = False
        self._candidates = candidates

    @property
    def phase(self) -> float:
        """Progress of the motion, 0 to 1."""
        return self._clock.phase

    def _play(self, candidate: Candidate, keys: Mapping[str, float]) -> None:
        motion = candidate.motion
        self.motion = motion
        self.resources = motion.resources
        self.group = candidate.group or motion.group
        self.yields = candidate.yields
        self.shown = Layer(motion.kind, {}, 0.0)
        self.shown_at = GlobalTime(-inf)
        # When it was shown before that, with its weight then.
        self._before = self.shown_at, 0.0
        self.keys = keys
        self._clock = PhaseClock(keys)
        self._names = candidate.names
        cells = {own: self.parameters[name].cell for name, own in candidate.names.items() if name in self.parameters}
        self._extent = LiveExtent(motion, cells.get(TEMPORAL_EXTENT))
        motion.parameters = ParameterValues(motion.parameters, cells)
        self._jumps = ParameterJumps(tuple(cells.values()), self.shown)

    def _stands_in(self, candidate: Candidate) -> bool:
        """Return whether a candidate has the points and the parameters of the planned one."""
        points = tuple(keys_of(self.behavior, candidate.motion))
        return points == self.timing.points and candidate.names.keys() >= self._names.keys()

    def settle(self, taken: frozenset[str]) -> None:
        """Choose the candidate to play (thesis 8.17).

        If one hand is busy, holds on to a target, or is named by a later behavior of the block, use the other; if there
        is little time, a shorter motion.
        """
        start, end = self.start_and_end
        time = None if start is None or end is None else end - start
        chosen = select(self._usable(), taken, time)
        needed = chosen.motion.resources
        free = needed.isdisjoint(taken)  # else, no candidate is
        if needed and free and (claimed := self._context.claimed(self)) & needed:
            other = select(self._usable(), taken | claimed, time)
            chosen = chosen if other.motion.resources & (taken | claimed) else other
        if chosen.motion is not self.motion:
            self._play(chosen, keys_of(self.behavior, chosen.motion))

    def _usable(self) -> Iterator[Candidate]:
        planned = self._candidates.planned
        return (candidate for candidate in self._candidates if candidate is planned or self._stands_in(candidate))

    def spares(self, resources: frozenset[str]) -> bool:
        """Return whether another motion, such as one of the other hand, could play it without some resources."""
        return any(resources.isdisjoint(candidate.motion.resources) for candidate in self._usable())

    def continue_from(self, body: Body) -> None:
        """Expect to begin where a body is, if that needs less time than from rest."""
        needed, (first, *others) = self.motion.preparation(body), self.timing.phases
        if needed is not None and needed.shortest < first.shortest:
            self.timing = replace(self.timing, phases=(replace(first, shortest=needed.shortest), *others))
            self.shortest[0] = needed.shortest

    def timing_after(self, previous: PlanUnit) -> Timing:
        """Return the timing with a preparation from where the hands are when another motion relaxes."""
        if not isinstance(previous, AnimationUnit):
            return self.timing
        needed = self.motion.preparation(previous.relaxed_body(GlobalTime(0.0), self._context.rest()))
        if needed is None:
            return self.timing
        shortest = needed.shortest + _TURNING_BACK
        return self._prepared(PhaseDuration(max(needed.preferred, shortest), shortest))

    def loosen(self, timing: Timing) -> None:
        """Take a `timing_after`."""
        self.timing = timing
        self.shortest = [phase.shortest for phase in timing.phases]

    def _prepared(self, needed: PhaseDuration) -> Timing:
        first, *others = self.timing.phases
        preparation = replace(first, duration=needed.preferred, shortest=needed.shortest)
        return replace(self.timing, phases=(preparation, *others))

    def preference(self, now: GlobalTime) -> Timing:
        """Return the preferred timing.

        A gesture that starts now is prepared from where the hands are (thesis 12.1.4).
        """
        hands = None if self.begun else self._context.hands(now)
        needed = None if hands is None else self.motion.preparation(hands)
        return self.timing if needed is None else self._prepared(needed)

    def gentle_end(self, time: GlobalTime, speech: InterruptSpeech) -> GlobalTime:
        """Return the time of the next exit point, or the given time if there is none."""
        times = (point.peg.value for point in self._exits())
        return min((GlobalTime(at) for at in times if at is not None and at >= time), default=time)

    @property
    def holds_on(self) -> bool:
        """Whether its hands stay at a target until the unit is ended."""
        return self.timing.persistent and isinstance(self.behavior, Pointing)

    def subsiding(self, time: GlobalTime) -> bool:
        """Return whether a successor may take over: also at an exit point, and from hands that have come to stay."""
        if self.holds_on and self.only_persists:
            return True
        passed = (point.peg.value for point in self._exits() if point.fired)
        leaving = any(at is not None and abs(at - time) <= RESOLUTION for at in passed)
        return leaving or super().subsiding(time)

    def _exits(self) -> list[SyncPoint]:
        return [point for point in self.points if point.id in self.motion.exits]

    def fire(self, due: Sequence[DuePoint], now: GlobalTime) -> None:
        """Fire as every unit does. A unit that starts after its start has passed joins late."""
        begins = not self.begun and bool(due)
        super().fire(due, now)
        if begins and now - due[0].time > LATE:
            self.motion.joined = now

    def on_start(self, time: GlobalTime) -> None:
        """Start the motion from the current body. It is extrapolated to the time, unless the motion is additive."""
        motion = self.motion
        self._extent.listen(lambda: self.wake())
        self._set_shortest(time)
        added = motion.kind is LayerKind.ADDITIVE
        motion.start(self._context.body() if added else self._context.state_at(time).body)
        self._jumps.start()
        if motion.joined is not None or not added:
            self._context.switch(motion.joints, self._arrival(motion.joined or time, motion.entrance))

    def _arrival(self, now: GlobalTime, longest: float) -> GlobalTime:
        """Return the time at which the joints are to follow the motion again: before its next point."""
        points = (at for point in self.ahead() if (at := point.peg.value) is not None and at > now + RESOLUTION)
        return min(GlobalTime(now + longest), next(points, GlobalTime(inf)))

    def _set_shortest(self, time: GlobalTime) -> None:
        """Set the shortest duration of the preparation from where the hands are."""
        if self.shortest[0] > 0.0:
            hands = self._context.hands(time)
            needed = None if hands is None else self.motion.preparation(hands)
            if needed is not None:
                self.shortest[0] = needed.shortest
            else:
                self.shortest[0] = self.motion.shortest.get(self.timing.points[1], 0.0)

    def on_sync(self, sync: str, time: GlobalTime) -> None:
        """Report the sync point: a gaze may get or release the eyes here."""
        self._context.passed(self, sync, time)

    def on_finish(self, time: GlobalTime) -> None:
        """Release the joints."""
        self._context.released(self, time)

    def moves(self, now: GlobalTime, until: Callable[[], Time]) -> Iterator[MovePoints]:
        """Yield the move of its points ahead, if its temporal extent has changed.

        Args:
            now: s.
            until: as for `LiveExtent.times`.
        """
        if self.begun and not self.ends_early and (times := self._extent.times(self.points, self.keys, now, until)):
            yield MovePoints(self, times, now)

    def layer(self, now: GlobalTime) -> Layer:
        """Return the layer of the motion now.

        Raises:
            RealizerError: the motion has no layer, or an invalid one; the unit should be stopped.
        """
        context, motion, before = self._context, self.motion, self.shown
        if self.shown_at < now:
            self._before = self.shown_at, self.shown.weight
        phase = self._clock.advance(self, now)
        layer = layer_of(motion, Moment(phase, now, context.body(), context.shown()))
        self.height = height(self)
        self.shown, self.shown_at = self._raised(self._faded_in(layer, now)), now
        changed = self._jumps.occur(before, layer)
        if motion.jumped or changed:
            context.switch(motion.joints, GlobalTime(now + (CHANGE if changed else motion.entrance)))
        return self.shown

    def _faded_in(self, layer: Layer, now: GlobalTime) -> Layer:
        """Scale the weight of a motion that joined late."""
        joined, fade_in = self.motion.joined, self.motion.fade_in
        if joined is None or fade_in is None:
            return layer
        return replace(layer, weight=layer.weight * minimum_jerk(share(now, joined, joined + fade_in)))

    def _raised(self, layer: Layer) -> Layer:
        """Return a layer that retracts with the joints that are kept up on their way to where they wait."""
        if not self.kept_up or layer.weight == 1.0:
            return layer
        weight = _HALFWAY + (1.0 - _HALFWAY) * layer.weight
        others = {joint: layer.weight / weight for joint in layer.rotations if joint not in self.kept_up}
        return replace(layer, weight=weight, weights=others or None)

    def weight_speed(self, time: GlobalTime) -> float:
        """Return how fast the weight of its layer changes at a time, 1/s; 0 if that is not known."""
        before, weight = self._before
        return 0.0 if time - before > _RECENT else (self.shown.weight - weight) / (self.shown_at - before)

    def new_fault(self) -> Fault | None:
        """Return a fault that occurred while playing, once."""
        fault = None if self._fault_reported else self.motion.fault
        self._fault_reported = self._fault_reported or fault is not None
        return fault

    def timed_layer(self, now: GlobalTime, rest: Body) -> Layer:
        """Return the layer of a playing unit, over a body at rest. It depends on the times of its points alone."""
        ahead = self.ahead()
        begin, end = (self.keys.get(point.id, 1.0) for point in (self.points[-len(ahead) - 1], ahead[0]))
        return layer_of(self.motion, Moment(begin + self.progress(now) * (end - begin), now, rest))

    def retraction_layer(self, now: GlobalTime, rest: Body) -> Layer:
        """Return the layer of a unit past its relax, on its way to a body at rest.

        It depends on the times of its points alone.
        """
        return self._relaxing_layer(self._returned(now), now, rest)

    def _returned(self, now: GlobalTime) -> float:
        """Return the share of its way back that a unit past its relax has covered: no more than its hands can."""
        relax, end = self.time("relax"), self.time("end")
        if relax is None or end is None:
            return 0.0
        needed = max(end, relax + self.motion.retraction)
        return share(min(now, end), relax, needed) if needed > relax else 0.0

    def final_layer(self, now: GlobalTime, rest: Body) -> Layer:
        """Return the layer of a unit that has ended or was cut, at that moment; without weight if it was at rest.

        It depends on the times of its points alone.
        """
        if not self.motion.key_positions.keys() >= {"ready", "relax"}:
            return Layer(self.motion.kind, {}, 0.0)
        fired = [point for point in self.points if point.fired and not point.cut]
        if any(point.id == "relax" for point in fired):
            return self._relaxing_layer(0.0 if self.was_cut("end") else self._returned(now), now, rest)
        last = max((self.motion.key_positions.get(point.id, 0.0) for point in fired), default=0.0)
        ready = self.motion.key_positions["ready"]
        layer = layer_of(self.motion, Moment(max(last, ready), now, rest))
        return layer if last >= ready else replace(layer, weight=minimum_jerk(self.progress(now)))

    def relaxed_body(self, now: GlobalTime, rest: Body) -> Body:
        """Return a body at rest, with its hands where they are at the relax of the unit."""
        return over(rest, self._relaxing_layer(0.0, now, rest))

    def _relaxing_layer(self, gone: float, now: GlobalTime, rest: Body) -> Layer:
        begin = self.motion.key_positions.get("relax", 1.0)
        return layer_of(self.motion, Moment(begin + gone * (1.0 - begin), now, rest))
