"""The strategy that stretches as little as it can, keeps before/after, and does not care for the order of elements."""

from collections.abc import Mapping, Sequence

from reactive_realizer.scheduler.convex.case import Case, Fixed
from reactive_realizer.scheduler.convex.causes import Cause
from reactive_realizer.scheduler.convex.giving_up import GivingUp
from reactive_realizer.scheduler.convex.model import Model
from reactive_realizer.scheduler.convex.pegs import pegs_of
from reactive_realizer.scheduler.convex.timetable import Timetable, find_times
from reactive_realizer.scheduler.problem import (
    Anchor,
    AtBlock,
    Node,
    Origin,
    PegSpec,
    Point,
    Problem,
    Solution,
)


class ConvexStrategy:
    """The plan of least cost that keeps all constraints, and starts what is free as early as these allow.

    Durations minimize a convex cost (`Costs`); then every cluster starts at the earliest time (thesis 7.24). Behaviors
    without any preference are timed after all others and move none of them. What cannot be kept is given up in the
    order of docs/semantics.md.
    """

    name = "convex"

    def solve(self, problem: Problem) -> Solution:
        """See `SchedulingStrategy`."""
        return _Run(problem).solve()


class _Run:
    """The work on one problem."""

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._case = Case.of(problem)
        self._giving_up = GivingUp(self._case)
        self._fixed: dict[Node, Fixed] = {Origin.BLOCK_START: Fixed(0.0, AtBlock(Anchor(), 0.0))}
        self._fixed |= {cell: Fixed(time, cell) for cell, time in problem.times.items()}
        self._pegs: dict[str, Mapping[str, PegSpec]] = {}
        self._done: frozenset[Cause] = frozenset()

    def solve(self) -> Solution:
        """Behaviors with preferences, then those without: for these the others are given."""
        free = {index for index, item in enumerate(self._case.items) if item.timing.free}
        table = self._solve([index for index in range(len(self._case.items)) if index not in free])
        if free:
            self._fix(table)
            self._solve(sorted(free))
        self._giving_up.report_orphans()
        kept = (item.behavior.id for item in self._problem.items if item.behavior.id in self._pegs)
        return Solution({id_: self._pegs[id_] for id_ in kept}, tuple(self._giving_up.losses))

    def _solve(self, behaviors: Sequence[int]) -> Timetable:
        while True:
            stage = self._case.stage(behaviors, self._fixed, self._giving_up.things | self._done)
            found = find_times(Model(stage, self._giving_up.things))
            if isinstance(found, Timetable):
                self._done |= stage.constraints
                self._pegs |= pegs_of(found)
                return found
            self._giving_up.resolve(stage, found)

    def _fix(self, table: Timetable) -> None:
        """Have the times that were found be given from now on."""
        for index, item in table.model.stage.items.items():
            id_ = item.behavior.id
            known = not any(table.waits(node) for node in table.model.knots[index].values())
            times = zip(item.timing.points, table.points[index], strict=True)
            pegs = self._pegs[id_]
            self._fixed |= {Point(id_, sync): Fixed(time if known else None, pegs[sync]) for sync, time in times}
