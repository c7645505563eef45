"""A solved block: the times of its points, and the pegs that are made for them."""

from collections.abc import Iterator, Mapping

from reactive_realizer.pegboard.peg_key import PegKey
from reactive_realizer.pegboard.time_peg import TimeCell, TimePeg
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.scheduler.block_problem import BlockProblem
from reactive_realizer.scheduler.duration_limits import limits_not_kept
from reactive_realizer.scheduler.late_ties import tie_bounds
from reactive_realizer.scheduler.peg_layout.peg_layout import BuiltPegs, PegLayout
from reactive_realizer.scheduler.problem import Origin, Point
from reactive_realizer.scheduler.solution import Solution


class Plan:
    """A solved block; nothing of it is on the board yet.

    Attributes:
        posed: the problem.
        solution: of the strategy.
        layout: how the points depend on each other.
        units: the behaviors that have times.
        losses: those of the problem and of the strategy.
        beyond_limits: the behaviors that do not keep the limits of their authors.
        kept: the constraints that are kept.
        bounds: those that the times from outside set on the ties to them.
        times: of the planned points, s after the start of the block; None for those that depend on an unknown time.
        built: its pegs; None until they are made.
        points: the sync points of its behaviors, on these pegs.
        named: these pegs by name.
    """

    def __init__(self, posed: BlockProblem, solution: Solution) -> None:
        self.posed = posed
        self.solution = solution
        self.layout = PegLayout(posed.problem, solution)
        planned = {item.behavior.id for item in self.layout.kept.items}
        self.units = [unit for unit in posed.units if unit.behavior.id in planned]
        self.losses = (*posed.losses, *solution.losses)
        self.beyond_limits = tuple(limits_not_kept(posed.problem, solution))
        self.kept = (*self.layout.kept.constraints, *posed.holds)
        self.bounds = tie_bounds(self.layout.kept.items, self.layout.kept.ties)
        waiting = {Point(unit.behavior.id, sync) for unit in self.units for sync in unit.open}
        self.times = {point: time for point, time in self.layout.times.items() if point not in waiting}
        self.built: BuiltPegs | None = None
        self.points: dict[PlanUnit, list[SyncPoint]] = {unit: [] for unit in self.units}
        self.named: dict[PegKey, TimePeg] = {}
        self._reasons: dict[Point, list[str]] = {}
        for each in self.kept:
            for node in each.nodes:
                if isinstance(node, Point):
                    self._reasons.setdefault(node, []).append(each.text)

    @property
    def size(self) -> int:
        """The number of its points."""
        return len(self.times)

    def discard(self) -> None:
        """Dispose of its pegs, if they are made."""
        if self.built is not None:
            self.built.dispose()

    def name_pegs(self) -> Iterator[None]:
        """Make the sync points of its behaviors, and the names and the texts of their pegs, in small steps."""
        units = {unit.behavior.id: unit for unit in self.units}
        for point, peg in self._pegs.items():
            unit = units[point.behavior]
            if point.sync not in unit.open:
                reasons = self._reasons.get(point)
                if reasons is not None:
                    peg.why = "; ".join(reasons)
                self.points[unit].append(SyncPoint(point.sync, peg, tied=reasons is not None))
                self.named[unit.key(point.sync)] = peg
            yield
        for unit, points in self.points.items():
            for sync, peg in unit.open.items():
                points.append(SyncPoint(sync, peg))
                self.named[unit.key(sync)] = peg
            yield

    def give_points(self, start: TimeCell) -> None:
        """Within a transaction, give the behaviors their points.

        Args:
            start: the peg of the start of the block.
        """
        for unit, points in self.points.items():
            unit.points = points
            if (timing := self.posed.loose.get(unit.behavior.id)) is not None:
                unit.loosen(timing)
            unit.wake()
        for unit, node in self.posed.awaited.items():
            if unit in self.points:
                awaited = self._pegs.get(node) if isinstance(node, Point) else node
                unit.follow(start if isinstance(awaited, Origin) else awaited)

    @property
    def _pegs(self) -> Mapping[Point, TimePeg]:
        return {} if self.built is None else self.built.pegs
