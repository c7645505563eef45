"""A behavior in a plan: its sync points on pegs, and how far it has come."""

import itertools
import logging
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time, is_due
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.peg_key import BlockKey, PegKey
from reactive_realizer.pegboard.time_peg import TimePeg
from reactive_realizer.planunit.parameter import Parameter
from reactive_realizer.planunit.timing import OPEN, SHORTEST, Timing

logger = logging.getLogger(__name__)


class UnitState(Enum):
    """Where a unit stands, in the words of Kopp and Wachsmuth that the thesis uses (7.3.4)."""

    PENDING = "pending"
    """Planned; its block has not started."""
    LURKING = "lurking"
    """Its block plays, its own start is ahead."""
    IN_EXEC = "in_exec"
    DONE = "done"
    DROPPED = "dropped"


@dataclass(slots=True)
class SyncPoint:
    """A sync point of one unit.

    Attributes:
        id: the sync id.
        peg: when; shared with the sync points it is tied to.
        tied: whether BML says when; else it is where its behavior would like it.
        fired: the time it was reported with, None before.
        cut: whether it was reported because its behavior was cut short.
    """

    id: str
    peg: TimePeg
    tied: bool = False
    fired: Time = None
    cut: bool = False

    @property
    def time(self) -> Time:
        """When it was, or is predicted to be."""
        return self.peg.value if self.fired is None else self.fired


class PlanUnit:
    """What an engine plays for one behavior; engines make subclasses of it.

    A unit fires its sync points in order, each once, with the time of its peg, however late a tick is; a point whose
    successor is due is due itself, so that order holds whatever a live retiming did.

    Attributes:
        block: of which block.
        behavior: what was asked for.
        timing: what it prefers; the strategy decides.
        resources: what of the body it owns while it plays; units that share one exclude each other.
        group: its replacement group (thesis 8.7.5), None without one.
        yields: whether others of its group may take its place while it plays, and give it back when they end: of these
            the one that started last plays. Who is overwritten keeps its points and their feedback.
        points: its sync points in order; empty until the plan is committed.
        open: pegs of the points that are unknown until it is ended, if it is persistent.
        parameters: what of it may be changed while it plays, by name.
    """

    def __init__(
        self, block: BlockKey, behavior: Behavior, timing: Timing, resources: frozenset[str] = frozenset()
    ) -> None:
        self.block = block
        self.behavior = behavior
        self.timing = timing
        self.resources = resources
        self.group: str | None = None
        self.yields = False
        self.points: list[SyncPoint] = []
        self.open: dict[str, TimePeg] = {}
        self.parameters: dict[str, Parameter] = {}
        self.state = UnitState.PENDING

    # --- for subclasses

    def on_start(self, time: GlobalTime) -> None:
        """The unit begins to play."""

    def on_sync(self, sync: str, time: GlobalTime) -> None:
        """A sync point was reached; ``start`` and ``end`` too."""

    def on_finish(self, time: GlobalTime) -> None:
        """The unit ended or was interrupted: the way back to rest is the engine's motion."""

    def preference(self, now: GlobalTime) -> Timing:
        """How it would like to be timed if it began now; a chunk is planned anew when it starts (thesis 12.1.4)."""
        return self.timing

    def settle(self, taken: frozenset[str]) -> None:
        """Choose what to play, if there is a choice, now that it is to begin.

        Args:
            taken: the resources that others own and keep.
        """

    def gentle_end(self, time: GlobalTime) -> GlobalTime:
        """When it can end without breaking off in the middle of something, if it is asked to at a time."""
        return time

    def end_details(self, time: GlobalTime) -> Mapping[str, str]:
        """What the feedback of an interrupted ``end`` tells beside the time."""
        return {}

    # --- for the player and the scheduler

    def key(self, sync: str) -> PegKey:
        """The name of one of its sync points."""
        return PegKey(*self.block, self.behavior.id, sync)

    @property
    def begun(self) -> bool:
        """Whether its start was reached."""
        return bool(self.points) and self.points[0].fired is not None

    @property
    def live(self) -> bool:
        """Whether something of it is ahead."""
        return self.state not in (UnitState.DONE, UnitState.DROPPED)

    def time(self, sync: str) -> Time:
        """When one of its points was, or is predicted to be, as `times` tells it of all.

        Raises:
            KeyError: it has no such point.
        """
        place = next((place for place, point in enumerate(self.points) if point.id == sync), None)
        if place is None:
            raise KeyError(sync)
        time = self.points[place].time
        if time is None or not self.begun or self.points[place].fired is not None:
            return time
        known = (point.time for point in self.points[place:])
        return min(each for each in known if each is not None)

    def times(self) -> dict[str, Time]:
        """When each of its points was, or is predicted to be; once it plays, none comes after its successor."""
        if not self.begun:
            return {point.id: point.time for point in self.points}
        times: dict[str, Time] = {}
        following: Time = None
        for point in reversed(self.points):
            time = point.time
            if point.fired is None and time is not None and following is not None:
                time = min(time, following)
            times[point.id] = time
            following = following if time is None else time
        return dict(reversed(times.items()))

    def point(self, sync: str) -> SyncPoint:
        """One of its points.

        Raises:
            KeyError: it has no such point.
        """
        for point in self.points:
            if point.id == sync:
                return point
        raise KeyError(sync)

    def was_cut(self, sync: str) -> bool:
        """Whether one of the points that it once had was never reached, or not as planned: it was cut short before."""
        point = next((point for point in self.points if point.id == sync), None)
        return point is None or point.cut

    @property
    def last_known(self) -> SyncPoint:
        """Its end, or, while it persists, the last point that can be known."""
        return next(point for point in reversed(self.points) if not self._open(point))

    @property
    def lasting(self) -> bool:
        """Whether it persists, and nothing else is ahead of it."""
        return self.begun and self.timing.persistent and all(self._open(point) for point in self.ahead())

    def _open(self, point: SyncPoint) -> bool:
        return self.timing.persistent and point.id in OPEN and point.fired is None

    def ahead(self) -> list[SyncPoint]:
        """The points not yet fired."""
        return [point for point in self.points if point.fired is None]

    def subsiding(self, time: GlobalTime) -> bool:
        """Whether at a time nothing is left of it but a way back to rest that BML says nothing of."""
        relaxed = any(point.id == "relax" and is_due(point.fired, time) for point in self.points)
        return relaxed and not self.points[-1].tied

    def excludes(self, other: "PlanUnit") -> bool:
        """Whether this and another one cannot play together."""
        rivals = self.group is not None and self.group == other.group
        if rivals and (self.yields or other.yields):
            # Whichever lies above hides the other; of two that begin and end together neither can.
            return self.times_around == other.times_around
        return rivals or bool(self.resources & other.resources)

    @property
    def times_around(self) -> tuple[Time, Time]:
        """When it starts and ends."""
        return self.points[0].time, self.points[-1].time

    def due(self, now: GlobalTime) -> bool:
        """Whether it is its turn to begin."""
        return self.state is UnitState.LURKING and is_due(self.points[0].peg.value, now)

    def overtaken(self) -> tuple[tuple[str, GlobalTime], tuple[str, GlobalTime]] | None:
        """Two of its points whose known times lost their order (thesis 7.15), if there are such; tied ones first."""
        known = [(point, time) for point in self.points if (time := point.time) is not None]
        for points in ([each for each in known if each[0].tied], known):
            for (earlier, time), (later, late) in itertools.pairwise(points):
                if time > late + RESOLUTION:
                    return (earlier.id, time), (later.id, late)
        return None

    def refusal(self) -> Fault | None:
        """Why it cannot begin with the times that its points have now (thesis 7.14, 7.15), if it cannot.

        Times from outside may lose their order for a while; that is judged when it is to begin.
        """
        start, end = self.points[0].peg.value, self.points[-1].peg.value
        if (lost := self.overtaken()) is not None:
            (sync, time), (later, late) = lost
            return Fault("overtaken", {"sync": sync, "time": time, "later": later, "late": late})
        if start is None or end is None or self.timing.instant or end - start >= SHORTEST:
            return None
        return Fault("too-short")

    def over_before(self, time: GlobalTime) -> bool:
        """Whether even its end has passed when its block starts."""
        end = self.points[-1].peg.value
        return end is not None and end < time - RESOLUTION

    def release(self) -> None:
        """Its block has started."""
        if self.state is UnitState.PENDING:
            self.state = UnitState.LURKING

    def begin(self) -> None:
        """Take the stage; the start itself fires with the next `fire`."""
        self.state = UnitState.IN_EXEC

    def fire(self, now: GlobalTime, *, end: bool = True) -> list[SyncPoint]:
        """Fire the points that are due, and those before them; the end only if it may."""
        ahead = [point for point in self.ahead() if end or point is not self.points[-1]]
        count = max((i + 1 for i, point in enumerate(ahead) if is_due(point.peg.value, now)), default=0)
        for i, point in enumerate(ahead[:count]):
            # A point overtaken by its successor fires with it.
            times = [time for later in ahead[i:count] if (time := later.peg.value) is not None]
            self._fire(point, min(times))
        return ahead[:count]

    def interrupt(self, time: GlobalTime) -> list[SyncPoint]:
        """End now: of the points ahead only ``relax`` and ``end`` are kept, both at ``time``."""
        self.points = [p for p in self.points if p.fired is not None or p.id in ("relax", "end")]
        kept = self.ahead()
        for point in kept:
            point.fired, point.cut = time, True
        self._finish(time)
        return kept

    def drop(self, time: GlobalTime) -> None:
        """Leave the plan without a word; what it moves goes back to rest, and it leaves even if that fails."""
        playing = self.state is UnitState.IN_EXEC
        self.state = UnitState.DROPPED
        if playing:
            try:
                self.on_finish(time)
            except Exception:
                logger.exception("%s/%s:%s failed to go back to rest", *self.block, self.behavior.id)

    def _fire(self, point: SyncPoint, time: GlobalTime) -> None:
        point.fired = time
        if point is self.points[0]:
            self.on_start(time)
        self.on_sync(point.id, time)
        if point is self.points[-1]:
            self._finish(time)

    def _finish(self, time: GlobalTime) -> None:
        self.state = UnitState.DONE
        self.on_finish(time)
