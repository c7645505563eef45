"""How the points of a plan hang on each other."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from reactive_realizer.pegboard.time_peg import TimeCell, TimePeg
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.scheduler.peg_layout.peg_builder import PegBuilder
from reactive_realizer.scheduler.peg_layout.section import Section
from reactive_realizer.scheduler.problem import Node, Point, SchedulingProblem, Solution, canonical


class BuiltPegs(NamedTuple):
    """The pegs of a plan.

    Attributes:
        pegs: of all points, in the order of the problem.
        unnamed: those that were made beside them, and that they hang on.
    """

    pegs: Mapping[Point, TimePeg]
    unnamed: Sequence[TimePeg]


class PegLayout:
    """From the times of a plan to pegs, the same for every strategy.

    What is tied stays tied, also when times from outside move; what lies between others stays between them; a cluster
    that hangs on nothing begins as early as what it comes after lets it; and before/after constraints between points
    that may come to move against each other stay alive (docs/semantics.md, pegs). Behaviors without preferences hang on
    the others, and none of these on them. The pegs lie where the plan has its points.

    Args:
        problem: what was to be timed.
        solution: the times, and what is not kept.

    Attributes:
        kept: what is left of the problem without what is lost.
    """

    def __init__(self, problem: SchedulingProblem, solution: Solution) -> None:
        self.kept = solution.kept_of(problem)
        self._points = [Point(item.behavior.id, sync) for item in self.kept.items for sync in item.timing.points]
        kept = canonical(self.kept)
        free = {item.behavior.id for item in kept.items if item.timing.free}
        followed = kept.only(lambda item: not item.timing.free, lambda each: not each.names(free))
        following = kept.only(lambda item: item.timing.free, lambda each: each.names(free))
        self._sections = [Section(part, solution.times) for part in (followed, following) if part.items]
        self._times = solution.times
        self._outer = problem.times

    @property
    def times(self) -> dict[Point, float | None]:
        """The times of the points, s after the start of the block; None for those that wait for an unknown time."""
        waiting: set[Node] = {cell for cell, time in self._outer.items() if time is None}
        if waiting:
            for section in self._sections:
                waiting |= section.following(waiting)
        return {point: None if point in waiting else self._times[point] for point in self._points}

    def build(self, graph: Graph, block: str, start: TimeCell) -> BuiltPegs:
        """The pegs of all points.

        Args:
            graph: where they live.
            block: id of the block, for their names.
            start: the peg of the block's start.
        """
        named: dict[Point, TimePeg] = {}
        made: list[TimePeg] = []
        for section in self._sections:
            points = [point for point in self._points if point in section.points]
            builder = PegBuilder(graph, block, section, points, start, named)
            named |= builder.build()
            made += builder.made
        named = {point: named[point] for point in self._points}
        shown = set(named.values())
        return BuiltPegs(named, [peg for peg in made if peg not in shown])
