"""A plan as times at one moment: what can be checked of a solution and of a block that plays."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.timing import Timing
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.peg_layout.peg_layout import PegLayout
from reactive_realizer.scheduler.problem import Node, Origin, Point, Precedence, SchedulingProblem, Solution, Tie


@dataclass(frozen=True, slots=True)
class PlanView:
    """The points of a block and their times (s), all on one axis.

    Attributes:
        timings: what each behavior prefers, by id.
        times: of the points that are still to come or have come, None while unknown; cut ones are not among them.
        past: the points that keep their times whatever happens: fired, or pinned.
        kept: the constraints of the plan.
        outer: times of the pegs that these name outside of the block.
        start: of the block, None while unknown.
        earliest: at which what has not begun could begin.
        end: of the block; None where that is not known.
        end_floor: before which the block does not end whatever its behaviors do.
        settled: the constraints that nothing is expected of any more.
        lurking: ids of behaviors on the board that have not begun; they are judged when they do, and until then times
            from outside may bring them out of order, or before their block.
    """

    timings: Mapping[str, Timing]
    times: Mapping[Point, float | None]
    past: frozenset[Point]
    kept: tuple[Tie | Precedence, ...]
    outer: Mapping[TimeCell, float | None]
    start: float | None
    earliest: float | None
    end: float | None = None
    end_floor: float = 0.0
    settled: frozenset[Tie | Precedence] = frozenset()
    lurking: frozenset[str] = frozenset()

    @classmethod
    def of_solution(cls, problem: SchedulingProblem, solution: Solution) -> Self:
        """What a strategy answered, in times after the start of the block."""
        kept = solution.kept_of(problem)
        return cls(
            timings={item.behavior.id: item.timing for item in kept.items},
            times=PegLayout(problem, solution).times,
            past=frozenset(),
            kept=(*kept.ties, *kept.orders),
            outer=problem.times,
            start=0.0,
            earliest=0.0,
        )

    @classmethod
    def of_block(cls, block: BMLBlock, now: GlobalTime) -> Self:
        """A block on the board, in global times, at the end of the tick at ``now``."""
        points = {Point(unit.behavior.id, p.id): p for unit in block.units for p in unit.points}
        start = block.start.value
        return cls(
            # The end of what persists is nobody's business before it comes.
            timings={
                unit.behavior.id: unit.timing if unit.points[-1].fired else unit.timing.closed for unit in block.units
            },
            times={key: p.peg.value for key, p in points.items()},
            past=frozenset(key for key, p in points.items() if p.peg.pinned),
            kept=block.kept,
            settled=_settled(block),
            lurking=frozenset(unit.behavior.id for unit in block.units if not unit.begun),
            outer={n: n.value for each in block.kept for n in each.nodes if not isinstance(n, Point | Origin)},
            start=start,
            earliest=None if start is None else max(start, now),
            end=block.end.value,
            end_floor=block.end.floor,
        )

    @property
    def expected(self) -> list[Tie | Precedence]:
        """The constraints that are to hold."""
        return [each for each in self.kept if each not in self.settled]

    def time(self, node: Node) -> float | None:
        """When something is; None while it is unknown, or if it is not there (any more)."""
        if isinstance(node, Point):
            return self.times.get(node)
        return self.start if isinstance(node, Origin) else self.outer[node]

    def movable(self, node: Node) -> bool:
        """Whether what is asked of it can still be met; the outside is as it is."""
        return not isinstance(node, Point) or (node in self.times and node not in self.past)


def _settled(block: BMLBlock) -> frozenset[Tie | Precedence]:
    """Also what its start waited for, once it has started."""
    waited = (each for each in block.kept if not any(isinstance(node, Point) for node in each.nodes))
    return frozenset(block.settled.union(waited) if block.state.plays else block.settled)
