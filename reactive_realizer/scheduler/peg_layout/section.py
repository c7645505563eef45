"""Behaviors of a plan that are laid out together."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import zip_longest
from typing import NamedTuple

from reactive_realizer.planunit.timing import PhaseKind
from reactive_realizer.scheduler.peg_layout.network import TOLERANCE, Network
from reactive_realizer.scheduler.peg_layout.peg_rules import AtPosition, Between, Position
from reactive_realizer.scheduler.peg_layout.root_rules import RootRules
from reactive_realizer.scheduler.problem import Item, Node, Point, SchedulingProblem


class Behind(NamedTuple):
    """At a distance (s) from a knot of its own behavior, by a peg of its own."""

    positions: tuple[Position]
    distance: float


PointRule = AtPosition | Between | Behind


class Section:
    """Behaviors that are laid out together; the other points that their constraints name have pegs already.

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
            rules = self._rules_of(item, [times[point] for point in item.points])
            self.points.update(zip(item.points, rules, strict=True))

    def following(self, given: Collection[Node]) -> set[Node]:
        """The points that move when some given nodes do."""
        numbers = self.network.knots.nodes
        roots = self.rules.following({numbers[node] for node in given if node in numbers})
        return {point for point, rule in self.points.items() if any(p.root in roots for p in rule.positions)}

    def _rules_of(self, item: Item, times: Sequence[float]) -> Iterator[PointRule]:
        """Between knots at a fraction of the way, behind the last at a distance; rigid phases keep theirs."""
        knots = self.network.knots.indices[item.behavior.id]
        rigid = [phase.kind is PhaseKind.RIGID for phase in item.timing.phases]
        for before, after in zip_longest(knots, list(knots)[1:]):
            start = self.network.positions[knots[before]]
            end = None if after is None else self.network.positions[knots[after]]
            last = len(rigid) if after is None else after
            rule: PointRule = AtPosition((start,))
            yield rule
            for k in range(before + 1, last + (after is None)):
                gone, left = times[k] - times[before], times[last] - times[k]
                if times[k] != times[k - 1] and (end is None or abs(times[last] - times[before]) > TOLERANCE):
                    if all(rigid[before:k]):
                        rule = Behind((start,), gone)
                    elif end is None:
                        rule = self._behind(start, gone)
                    elif all(rigid[k:last]):
                        rule = Behind((end,), -left)
                    else:
                        rule = Between((start, end), gone / (times[last] - times[before]))
                yield rule

    def _behind(self, start: Position, distance: float) -> PointRule:
        """At a distance from a knot; on a branch of one point, it continues to follow the host of that."""
        host = self.network.branches.get(start.root)
        if host is None or self.network.is_rigid(start.root):
            return Behind((start,), distance)
        return AtPosition((host.moved(start.offset + distance),))
