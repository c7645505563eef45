"""A plan as times at one moment, for the checks of `verify`."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Self

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.timing import Timing
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.late_ties import outer_ties
from reactive_realizer.scheduler.peg_layout.peg_layout import PegLayout
from reactive_realizer.scheduler.problem import Node, Origin, Point, Precedence, SchedulingProblem, Tie
from reactive_realizer.scheduler.solution import Solution


@dataclass(frozen=True, slots=True)
class PlanView:
    """The points of a block and their times (s), all on one axis.

    Attributes:
        timings: the preferred timing of each behavior, by id.
        times: of the points, None while unknown; points that were cut or will be are missing.
        past: the points whose times are final: fired, or pinned.
        kept: the constraints of the plan.
        outer: times of the pegs outside of the block that these name.
        start: of the block, None while unknown.
        earliest: at which a behavior that has not begun could begin; None if that is not known.
        end: of the block; None if it is unknown.
        end_floor: before which the block does not end.
        settled: the constraints that need not hold any more.
        lurking: ids of behaviors on the board that have not begun. They are checked when they begin; until then, times
            from outside may bring them out of order, or before their block.
        shortest: duration that the body needs for each phase, s, by the id of the behavior.
        cut: the points that were cut; what comes after them keeps its time.
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
    shortest: Mapping[str, Sequence[float]] = field(default_factory=dict)
    cut: frozenset[Point] = frozenset()

    @classmethod
    def of_solution(cls, problem: SchedulingProblem, solution: Solution) -> Self:
        """The solution of a strategy, in times after the start of the block."""
        layout = PegLayout(problem, solution)
        timings = {item.behavior.id: item.timing for item in layout.kept.items}
        shortest = {id_: [phase.shortest for phase in timing.phases] for id_, timing in timings.items()}
        kept, outer = layout.kept.constraints, problem.times
        return cls(timings, layout.times, frozenset(), kept, outer, start=0.0, earliest=0.0, shortest=shortest)

    @classmethod
    def of_block(cls, block: BMLBlock, now: GlobalTime, *, played: bool) -> Self:
        """A block on the board, in global times, at the end of the tick at ``now``.

        Args:
            block: of which the plan is.
            now: the time of the tick.
            played: whether the block played before this tick; until then, ties to times from outside may be late.
        """
        points = {Point(unit.behavior.id, p.id): p for unit in block.units for p in unit.coming()}
        start = block.start.value
        # The start of the block waits for these, and may come later; a body was too slow for the others.
        waited = (each for each in block.kept if not any(isinstance(node, Point) for node in each.nodes))
        late = [] if played else list(outer_ties(each for each in block.kept if isinstance(each, Tie)))
        # What comes after a time to which a tie is late comes, until the block starts, after the time of that tie.
        hurried = {Point(unit.behavior.id, sync) for unit in block.units for sync in unit.hurries}
        missed = (each for each in block.kept if not hurried.isdisjoint(each.nodes))
        return cls(
            # The end of a persistent behavior is not checked before it is ended.
            {
                unit.behavior.id: unit.timing.closed
                if unit.timing.persistent and not unit.points[-1].fired
                else unit.timing
                for unit in block.units
            },
            {key: point.peg.value for key, point in points.items()},
            frozenset(key for key, point in points.items() if point.peg.pinned),
            block.kept,
            {n: n.value for each in block.kept for n in each.nodes if not isinstance(n, Point | Origin)},
            start,
            None if start is None or late else max(start, now),
            block.end.value,
            block.end.floor,
            frozenset(block.settled.union(waited, missed, (each.tie for each in late))),
            frozenset(unit.behavior.id for unit in block.units if not unit.begun),
            {unit.behavior.id: unit.shortest for unit in block.units},
            frozenset(key for key, point in points.items() if point.cut),
        )

    @property
    def expected(self) -> list[Tie | Precedence]:
        """The constraints that have to hold."""
        return [each for each in self.kept if each not in self.settled]

    def time(self, node: Node) -> float | None:
        """The time of a node; None while it is unknown, or if it was cut."""
        if isinstance(node, Point):
            return self.times.get(node)
        return self.start if isinstance(node, Origin) else self.outer[node]

    def movable(self, node: Node) -> bool:
        """Whether the plan can still satisfy a constraint on a node; times from outside are given."""
        return not isinstance(node, Point) or (node in self.times and node not in self.past)
