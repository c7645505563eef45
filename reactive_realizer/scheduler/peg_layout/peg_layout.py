"""From the times of a plan to its pegs."""

from collections.abc import Generator, Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

from reactive_realizer.pegboard.time_peg import TimeCell, TimePeg
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.scheduler.peg_layout.peg_builder import PegBuilder
from reactive_realizer.scheduler.peg_layout.section import Section
from reactive_realizer.scheduler.problem import Node, Point, SchedulingProblem
from reactive_realizer.scheduler.solution import Solution


class BuiltPegs(NamedTuple):
    """The pegs of a plan.

    Attributes:
        pegs: of all points, in the order of the problem.
        unnamed: the other ones, which these depend on.
    """

    pegs: Mapping[Point, TimePeg]
    unnamed: Sequence[TimePeg]

    def dispose(self) -> None:
        """Have none of them follow others any more."""
        for peg in dict.fromkeys((*self.pegs.values(), *self.unnamed)):
            peg.dispose()


class PegLayout:
    """Derives what each peg of a plan depends on from its times, in the same way for every strategy.

    Ties hold also when times from outside move; points between others stay between them; a cluster that depends on
    nothing given begins as early as its `after` constraints allow; and before/after constraints between points that may
    move against each other become bounds of pegs (docs/semantics.md, pegs). Behaviors without preferences depend on
    the others, and none of these on them. The pegs have the times of the plan.

    Args:
        problem: what was to be timed.
        solution: its times and losses.

    Attributes:
        kept: the problem without what is lost.
    """

    def __init__(self, problem: SchedulingProblem, solution: Solution) -> None:
        self.kept = solution.kept_of(problem)
        self._points = [point for item in self.kept.items for point in item.points]
        kept = self.kept.canonical
        free = {item.behavior.id for item in kept.items if item.timing.free}
        parts = [kept]
        if free:
            parts = [
                kept.only(lambda item: not item.timing.free, lambda each: not each.names(free)),
                kept.only(lambda item: item.timing.free, lambda each: each.names(free)),
            ]
        self._sections = [Section(part, solution.times) for part in parts if part.items]
        self._times = solution.times
        self._outer = problem.times

    @property
    def times(self) -> dict[Point, float | None]:
        """The times of the points, s after the start of the block; None for those that depend on an unknown time."""
        waiting: set[Node] = {cell for cell, time in self._outer.items() if time is None}
        if waiting:
            for section in self._sections:
                waiting |= section.following(waiting)
        return {point: None if point in waiting else self._times[point] for point in self._points}

    def build(
        self, graph: Graph, block: str, start: TimeCell, outside: Mapping[TimeCell, TimePeg] = MappingProxyType({})
    ) -> BuiltPegs:
        """The pegs of all points.

        Args:
            graph: where they live.
            block: id of the block, for their names.
            start: the peg of the block's start.
            outside: pegs to depend on instead of some pegs from outside.
        """
        *_, built = self.steps(graph, block, start, outside)
        return built or BuiltPegs({}, ())

    def steps(
        self, graph: Graph, block: str, start: TimeCell, outside: Mapping[TimeCell, TimePeg]
    ) -> Generator[BuiltPegs | None]:
        """As `build`, in small steps, of which the last one gives the pegs; closed before, it disposes of them."""
        named: dict[Point, TimePeg] = {}
        made: list[TimePeg] = []
        for section in self._sections:
            points = [point for point in self._points if point in section.points]
            builder = PegBuilder(graph, block, section, points, start, named, outside)
            try:
                yield from builder.steps()
            except GeneratorExit:
                for peg in (*made, *builder.made):
                    peg.dispose()
                raise
            named |= builder.pegs
            made += builder.made
        named = {point: named[point] for point in self._points}
        shown = set(named.values())
        yield BuiltPegs(named, [peg for peg in made if peg not in shown])
