"""Behaviors of a plan that are laid out together."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import zip_longest
from math import inf
from typing import NamedTuple

from reactive_realizer.planunit.timing import Phase, PhaseKind
from reactive_realizer.scheduler.peg_layout.network import TOLERANCE, Network
from reactive_realizer.scheduler.peg_layout.peg_rules import AtPosition, Between, Position
from reactive_realizer.scheduler.peg_layout.root_rules import RootRules
from reactive_realizer.scheduler.problem import Item, Node, Point, SchedulingProblem


class Behind(NamedTuple):
    """At a distance (s) from a knot of its own behavior."""

    knot: Position
    distance: float

    @property
    def positions(self) -> tuple[Position, ...]:
        """What it hangs on."""
        return (self.knot,)


PointRule = AtPosition | Between | Behind


class Section:
    """Behaviors that are laid out together; what their constraints name beside them has pegs already.

    Attributes:
        network: of their points.
        rules: of its roots.
        points: the rule of each point; points of one behavior that share a rule share a peg.
    """

    def __init__(self, problem: SchedulingProblem, times: Mapping[Point, float]) -> None:
        self.network = Network(problem, times)
        self.rules = RootRules(self.network)
        self.points: dict[Point, PointRule] = {}
        for item in problem.items:
            points = [Point(item.behavior.id, sync) for sync in item.timing.points]
            rules = self._rules_of(item, [times[point] for point in points])
            self.points.update(zip(points, rules, strict=True))

    def following(self, given: Collection[Node]) -> set[Node]:
        """The points that move when some given nodes do."""
        numbers = self.network.nodes
        roots = self.rules.following({numbers[node] for node in given if node in numbers})
        return {point for point, rule in self.points.items() if any(p.root in roots for p in rule.positions)}

    def _rules_of(self, item: Item, times: Sequence[float]) -> Iterator[PointRule]:
        """Between knots at a fraction of the way, behind the last at a distance; rigid phases keep theirs."""
        knots = self.network.knots[item.behavior.id]
        for before, after in zip_longest(knots, list(knots)[1:]):
            rule: PointRule = AtPosition(self.network.position(knots[before]))
            yield rule
            whole = inf if after is None else times[after] - times[before]
            for k in range(before + 1, len(times) if after is None else after):
                if times[k] != times[k - 1] and abs(whole) > TOLERANCE:
                    rule = self._rule(item, times, before, k, after)
                yield rule

    def _rule(self, item: Item, times: Sequence[float], before: int, k: int, after: int | None) -> PointRule:
        """Of a point behind a knot, and in front of another one if there is another."""
        knots, phases = self.network.knots[item.behavior.id], item.timing.phases
        gone = times[k] - times[before]
        if _rigid(phases[before:k]):
            return Behind(self.network.position(knots[before]), gone)
        if after is None:
            return self._behind(knots[before], gone)
        if _rigid(phases[k:after]):
            return Behind(self.network.position(knots[after]), times[k] - times[after])
        start, end = (self.network.position(knots[knot]) for knot in (before, after))
        return Between(start, end, gone / (times[after] - times[before]))

    def _behind(self, knot: int, distance: float) -> PointRule:
        """At a distance from a knot; it goes on to follow what the knot hangs on when that has passed."""
        position = self.network.position(knot)
        if position.root not in self.network.branches or self.network.is_rigid(position.root):
            return Behind(position, distance)
        return AtPosition(self.network.branches[position.root].moved(position.offset + distance))


def _rigid(phases: Sequence[Phase]) -> bool:
    return all(phase.kind is PhaseKind.RIGID for phase in phases)
