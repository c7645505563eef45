"""Timings and plans for tests of the strategy `convex`."""

from itertools import pairwise

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.time_peg import AnticipatorPeg
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing, timing_at
from reactive_realizer.scheduler.convex.convex_strategy import ConvexStrategy
from reactive_realizer.scheduler.problem import Origin, Point, Precedence, Tie
from reactive_realizer.scheduler.strategy import solve
from reactive_realizer.testing.problems import item, pegs_of, problem

START = Origin.BLOCK_START
NOD = timing_at({"start": 0.0, "stroke": 0.4, "end": 1.0})
BEAT = timing_at({"start": 0.0, "ready": 0.3, "stroke": 0.5, "relax": 0.8, "end": 1.2})
SPEECH = timing_at({"start": 0.0, "sync1": 0.5, "end": 2.0}, PhaseKind.RIGID)
HELD = Timing(("start", "ready", "relax", "end"), (Phase(0.5), Phase(1.0, PhaseKind.HOLD), Phase(0.5)))
CHANGE = timing_at({"start": 0.0, "end": 1.0}, PhaseKind.FREE)


class Plan:
    """The solution of a problem: the times of its pegs, which follow outer times."""

    def __init__(self, items: dict[str, Timing], *constraints: Tie | Precedence) -> None:
        self.asked = problem([item(id_, timing) for id_, timing in items.items()], *constraints)
        self.solution = solve(ConvexStrategy(), self.asked)
        self.pegs = pegs_of(self.asked, self.solution)

    def __getitem__(self, point: str) -> float:
        time = self.pegs[Point(*point.split(":"))].value
        assert time is not None
        return time

    def times(self, behavior: str) -> list[float | None]:
        return [peg.value for point, peg in self.pegs.items() if point.behavior == behavior]

    def lengths(self, behavior: str) -> list[float]:
        points = [f"{behavior}:{point.sync}" for point in self.pegs if point.behavior == behavior]
        return [self[after] - self[before] for before, after in pairwise(points)]

    @property
    def losses(self) -> list[tuple[str | None, str, bool]]:
        return [(loss.behavior, loss.fault.code, loss.dropped) for loss in self.solution.losses]

    @property
    def lost(self) -> list[str]:
        return [loss.constraint.text for loss in self.solution.losses if loss.constraint]


def move(cell: AnticipatorPeg, time: float) -> None:
    with cell.graph.transaction("test"):
        cell.set(GlobalTime(time))
