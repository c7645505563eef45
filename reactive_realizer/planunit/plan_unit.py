"""A behavior in a plan: its sync points on pegs, and its progress."""

import logging
from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from enum import Enum

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.vocabulary import InterruptSpeech
from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time, is_due
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.open_pegs import OpenPeg
from reactive_realizer.pegboard.peg_key import BlockKey, PegKey
from reactive_realizer.pegboard.time_peg import TimePeg
from reactive_realizer.planunit.body_parts import BodyPart, parts_of
from reactive_realizer.planunit.parameter import Parameter
from reactive_realizer.planunit.phase_progress import PhaseProgress
from reactive_realizer.planunit.point_order import keep_order, needs_after, overtaken
from reactive_realizer.planunit.sync_point import DuePoint, Hurry, SyncPoint
from reactive_realizer.planunit.timing import OPEN, SHORTEST, Overtaken, Timing, TooShort

logger = logging.getLogger(__name__)

LATE = 0.05
"""A unit that starts later than this after its start has joined late, s."""


class UnitState(Enum):
    """The state of a unit, in the terms of Kopp and Wachsmuth that the thesis uses (7.3.4)."""

    PENDING = "pending"
    """Planned; its block has not started."""
    LURKING = "lurking"
    """Its block plays, but its own start is not reached."""
    IN_EXEC = "in_exec"
    DONE = "done"
    DROPPED = "dropped"


def sleep() -> None:
    """The `PlanUnit.wake` of a unit that no player has."""


class PlanUnit:
    """A behavior as an engine plays it; engines make subclasses of it.

    A unit fires its sync points in order, each once, with the time of its peg, even if a tick is late.

    Attributes:
        block: name of its block.
        behavior: its description.
        timing: the timing that it prefers; the strategy decides.
        resources: the parts of the body that it owns while it plays; units that share one exclude each other.
        group: its replacement group (thesis 8.7.5), None without one.
        accompanies: whether it gives way to every unit that does not accompany and moves the same parts of the body.
        yields: whether units of its group that start later replace it until they end. A unit that is replaced keeps its
            points and their feedback.
        points: its sync points in order; empty until the plan is committed.
        unreported: ids of the points that feedback leaves out: nobody asked for them.
        open: pegs of the points that are unknown until it is ended, if it is persistent.
        parameters: those that may be changed while it plays, by name.
        wake: called when its pegs or its state have changed outside of its engine; its player sets it.
        shortest: duration that the body needs for each phase, s.
        hurries: the points that come later than they were asked for, by sync id.
        planning_work: what it takes to make it, beside its sync points, as the limit `planning_per_tick` counts.
        ends_early: whether it will be cut at its end, which was brought forward for that.
    """

    planning_work: int = 8

    def __init__(
        self, block: BlockKey, behavior: Behavior, timing: Timing, resources: frozenset[str] = frozenset()
    ) -> None:
        self.block = block
        self.behavior = behavior
        self.timing = timing
        self.resources = resources
        self.group: str | None = None
        self.accompanies = False
        self.yields = False
        self.points: list[SyncPoint] = []
        self.unreported: frozenset[str] = frozenset()
        self.open: dict[str, TimePeg] = {}
        self.parameters: dict[str, Parameter] = {}
        self.wake: Callable[[], None] = sleep
        self.shortest = [phase.shortest for phase in timing.phases]
        self.hurries: dict[str, Hurry] = {}
        self.ends_early = False
        self.state = UnitState.PENDING
        self._progress: PhaseProgress | None = None
        self._parts: frozenset[BodyPart] | None = None

    # --- for subclasses

    def on_start(self, time: GlobalTime) -> None:
        """Called when the unit begins to play."""

    def on_sync(self, sync: str, time: GlobalTime) -> None:
        """Called when a sync point is reached, also for ``start`` and ``end``."""

    def on_finish(self, time: GlobalTime) -> None:
        """Called when the unit has ended or is interrupted; the engine moves the body back to rest."""

    def finish_planning(self) -> Iterator[int]:
        """Do what would hold up a tick if its engine did it at once, in steps; its timing may change meanwhile.

        Yields:
            The work of each step, as the limit `planning_per_tick` counts.

        Raises:
            RealizerError: the behavior cannot be played after all.
        """
        return iter(())

    def preference(self, now: GlobalTime) -> Timing:
        """The timing that it prefers if it begins now; a chunk is planned again when it starts (thesis 12.1.4)."""
        return self.timing

    def settle(self, taken: frozenset[str]) -> None:
        """Choose among alternatives just before the unit begins.

        Args:
            taken: the resources that other units own and keep.
        """

    def loose_timing(self, named: Container[str]) -> Timing | None:
        """The timing of a rigid behavior that can be stretched after all, where constraints ask for it.

        Args:
            named: the points that constraints name.
        """
        return None

    def loosen(self, timing: Timing) -> None:
        """Take a `loose_timing`, or one of `timing_after`, from now on."""

    def timing_after(self, previous: "PlanUnit") -> Timing:
        """The timing that it prefers if it starts where another unit of its block leaves the body at its relax."""
        return self.timing

    def lacks_from(self) -> Time:
        """While it plays, the time from which on the results of its slow work are missing; None if none are."""
        return None

    def wait(self, until: GlobalTime) -> None:
        """Change its timing: what is missing does not come before a time."""

    def gentle_end(self, time: GlobalTime, speech: InterruptSpeech) -> GlobalTime:
        """The first time, not before ``time``, at which it can end without being cut, for example within a word.

        Args:
            time: of the interruption, s.
            speech: what a speech does not end within: a word or a clause.
        """
        return time

    def details(self, sync: str, time: GlobalTime) -> Mapping[str, str]:
        """Attributes of the feedback of a sync point that is reached at a time, beside the time."""
        return {}

    def due_at_cut(self, now: GlobalTime, *, end: bool = True) -> "list[DuePoint]":
        """The `due_points` that are reported although it is cut ``now``."""
        return self.due_points(now, end=end)

    # --- for the player and the scheduler

    def key(self, sync: str) -> PegKey:
        """The name of one of its sync points."""
        return PegKey(*self.block, self.behavior.id, sync)

    @property
    def parts(self) -> frozenset[BodyPart]:
        """The parts of the body that its behavior moves."""
        if self._parts is None:
            self._parts = parts_of(self.behavior)
        return self._parts

    @property
    def begun(self) -> bool:
        """Whether it has started."""
        return bool(self.points) and self.points[0].fired

    @property
    def live(self) -> bool:
        """Whether it is neither done nor dropped."""
        return self.state not in (UnitState.DONE, UnitState.DROPPED)

    def time(self, sync: str) -> Time:
        """The time of the peg of one of its points.

        Raises:
            KeyError: it has no such point.
        """
        return self.point(sync).peg.value

    def point(self, sync: str) -> SyncPoint:
        """One of its points.

        Raises:
            KeyError: it has no such point.
        """
        for point in self.points:
            if point.id == sync:
                return point
        raise KeyError(sync)

    def coming(self) -> list[SyncPoint]:
        """Its points, except for those that will be cut because it ends early."""
        end = self.points[-1].peg.value if self.ends_early and self.points else None
        if end is None:
            return self.points
        kept = {*OPEN, *(due.point.id for due in self.due_at_cut(end, end=False))}
        return [point for point in self.points if point.fired or point.id in kept]

    def was_cut(self, sync: str) -> bool:
        """Whether a point that it was planned with was cut: it was reported early, or never will be."""
        point = next((point for point in self.points if point.id == sync), None)
        return point is None or point.cut

    @property
    def last_known(self) -> SyncPoint:
        """Its end or, while it persists, the last point whose time can be known."""
        if not self.timing.persistent:
            return self.points[-1]
        return next(point for point in reversed(self.points) if not self._open(point))

    @property
    def only_persists(self) -> bool:
        """Whether only its unknown end is left, because it persists."""
        return self.begun and self.timing.persistent and all(self._open(point) for point in self.ahead())

    def _open(self, point: SyncPoint) -> bool:
        return self.timing.persistent and point.id in OPEN and not point.fired

    def ahead(self) -> list[SyncPoint]:
        """The points that have not fired."""
        return [point for point in self.points if not point.fired]

    def subsiding(self, time: GlobalTime) -> bool:
        """Whether, at a time, it only returns to rest, and no BML constraint names its end."""
        relaxed = any(point.id == "relax" and point.fired and is_due(point.peg.value, time) for point in self.points)
        return relaxed and not self.points[-1].tied

    def spares(self, resources: frozenset[str]) -> bool:
        """Whether it can do without some resources, though it is planned with them."""
        return resources.isdisjoint(self.resources)

    def excludes(self, other: "PlanUnit") -> bool:
        """Whether this unit and another one cannot play at the same time."""
        if self.accompanies is not other.accompanies:
            return bool(self.parts & other.parts)
        rivals = self.group is not None and self.group == other.group
        if rivals and (self.yields or other.yields):
            # The upper unit hides the other; if both begin and end together, neither is above.
            return self.start_and_end == other.start_and_end
        return rivals or bool(self.resources & other.resources)

    @property
    def start_and_end(self) -> tuple[Time, Time]:
        """The times of its first and its last point."""
        return self.points[0].peg.value, self.points[-1].peg.value

    def due(self, now: GlobalTime) -> bool:
        """Whether it can begin: its block plays, and its start has come."""
        return self.state is UnitState.LURKING and is_due(self.points[0].peg.value, now)

    def next_due(self) -> Time:
        """The earliest known time at which it begins or reaches a point; None if there is none.

        It does not come earlier when one of the pegs that it awaits comes later.
        """
        if self.state is UnitState.LURKING:
            return self.points[0].peg.value
        if self.state is not UnitState.IN_EXEC:
            return None
        earliest: Time = None
        for point in self.points:
            if not point.fired and (time := point.peg.value) is not None and (earliest is None or time < earliest):
                earliest = time
        return earliest

    def awaited(self) -> list[TimePeg]:
        """The pegs that it waits for: that of its start once its block plays, and then those of the points ahead."""
        if self.state is UnitState.PENDING:
            return []
        if not self.begun:
            return [point.peg for point in self.points[:1]]
        return [point.peg for point in self.points if not point.fired]

    def refusal(self) -> Fault | None:
        """The fault that keeps it from beginning with the present times of its points (thesis 7.14, 7.15), if any.

        This is checked only when it is about to begin, because external times may be out of order temporarily.
        """
        times = [point.peg.value for point in self.points]
        known = [time for time in times if time is not None]
        if known != sorted(known) and (lost := overtaken(self.points)) is not None:
            (sync, time), (later, late) = lost
            return Overtaken(sync=sync, time=time, later=later, late=late)
        start, end = times[0], times[-1]
        if start is None or end is None or end - start >= SHORTEST:
            return None
        return None if self.timing.closed.instant else TooShort()

    def release(self) -> None:
        """Called when its block has started."""
        if self.state is UnitState.PENDING:
            self.state = UnitState.LURKING
            self.wake()

    def begin(self) -> None:
        """Begin to play; the start itself fires with the next `fire`."""
        self.state = UnitState.IN_EXEC

    def earliest(self, now: GlobalTime) -> Iterator[tuple[SyncPoint, GlobalTime]]:
        """The points ahead that its body cannot reach at once, each with the earliest time at which it can.

        A unit that is not about to begin has none. In a late tick, a point that its body has reached since the
        tick before has the time at which it can have been reached.
        """
        start, ahead = self.points[0].peg.value, self.ahead()
        if not any(self.shortest) or len(self.points) <= len(self.shortest) or not ahead or not is_due(start, now):
            return
        time, first, needs = now, len(self.points) - len(ahead), needs_after(self.points, self.shortest)
        if first > 0 and self.progress(now) >= 1.0 and (began := self.points[first - 1].peg.value) is not None:
            yield ahead[0], min(now, GlobalTime(began + needs[first - 1]))
        for index, point in enumerate(ahead, first):
            if index > 0:
                left = 1.0 - self.progress(now) if index == first else 1.0
                time = GlobalTime(time + left * needs[index - 1])
            # Another behavior may hold a point that both share.
            time = max(time, point.peg.earliest or time)
            if time > now + RESOLUTION:
                yield point, time

    def progress(self, now: GlobalTime) -> float:
        """The share of its present phase that is done, 0 to 1."""
        ahead = self.ahead()
        if self._progress is None or not ahead:
            return 0.0
        self._progress.move(ahead[0].peg.value, now)
        return self._progress.share(now)

    def keep_order(self, part: Callable[[SyncPoint], None] = lambda point: None) -> bool:
        """Within a transaction, keep each point that has not fired in time for later ones; whether any was not.

        Args:
            part: called with each point before its peg is changed.
        """
        return keep_order(self.points, needs_after(self.points, self.shortest), part)

    def due_points(self, now: GlobalTime, *, end: bool = True) -> list[DuePoint]:
        """The points that are due, and unknown points before them, which have the time of the next known point."""
        due: list[DuePoint] = []
        successor: Time = None
        for point in reversed(self.points if end else self.points[:-1]):
            if point.fired:
                continue
            time = point.peg.value
            if time is None:
                time = successor
            if time is not None and (successor is not None or is_due(time, now)):
                due.append(DuePoint(point, time))
                successor = time
        due.reverse()
        return due

    def fire(self, due: Sequence[DuePoint], now: GlobalTime) -> None:
        """Fire points that are due ``now``."""
        for point, time in due:
            self._fire(point, time)
        if not due:
            return
        self._progress = None
        if any(self.shortest) and (ahead := self.ahead()):
            late = now - due[-1].time > LATE
            since, need = now if late else due[-1].time, needs_after(self.points, self.shortest)[-len(ahead) - 1]
            self._progress = PhaseProgress(since, ahead[0].peg.value, need)

    def interrupt(self, time: GlobalTime) -> list[SyncPoint]:
        """Within a transaction, end at a time: ``relax`` and ``end`` move there alone; other points are removed."""
        self._drop_cut_points()
        for point in self.ahead():
            self.detach(point, time)
        return self._cut(time)

    def finish(self, time: GlobalTime, shared: Container[TimePeg]) -> list[SyncPoint]:
        """As `interrupt`, but dependents of ``relax`` and ``end`` move along, unless the peg is a shared one."""
        self._drop_cut_points()
        for point in self.ahead():
            if point.peg in shared:
                self.detach(point, time)
            else:
                point.peg.pin(time)
        return self._cut(time)

    def detach(self, point: SyncPoint, time: GlobalTime) -> None:
        """Within a transaction, move a point alone: the points that share its peg, or depend on it, keep their times.

        If the point is open, because its unit persists, its dependents follow: they have no times yet.
        """
        if isinstance(point.peg, OpenPeg):
            point.peg.pin(time)
        else:
            point.peg = point.peg.detached(str(self.key(point.id)), time)
            self.wake()

    def drop(self, time: GlobalTime) -> None:
        """Leave the plan without feedback; if `on_finish` raises, that is logged."""
        playing = self.state is UnitState.IN_EXEC
        self.state = UnitState.DROPPED
        self._end_parameters()
        if playing:
            try:
                self.points[-1].details = self.details(self.points[-1].id, time)
                self.on_finish(time)
            except Exception:
                logger.exception("%s/%s:%s failed to go back to rest", *self.block, self.behavior.id)

    def _drop_cut_points(self) -> None:
        self.points = [point for point in self.points if point.fired or point.id in OPEN]

    def _cut(self, time: GlobalTime) -> list[SyncPoint]:
        kept = self.ahead()
        for point in kept:
            point.details = self.details(point.id, time)
            point.fired = point.cut = True
        self._finish(time)
        return kept

    def _fire(self, point: SyncPoint, time: GlobalTime) -> None:
        point.fired = True
        point.details = self.details(point.id, time)
        if point is self.points[0]:
            self.on_start(time)
        self.on_sync(point.id, time)
        if point is self.points[-1]:
            self._finish(time)

    def _finish(self, time: GlobalTime) -> None:
        self.state = UnitState.DONE
        self._end_parameters()
        self.on_finish(time)

    def _end_parameters(self) -> None:
        for parameter in self.parameters.values():
            parameter.cell.dispose()
