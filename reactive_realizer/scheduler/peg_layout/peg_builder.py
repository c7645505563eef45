"""Makes the pegs of a layout."""

from collections.abc import Mapping, Sequence

from reactive_realizer.pegboard.time_peg import AfterPeg, BeforePeg, Bound, OffsetPeg, RatioPeg, TimeCell, TimePeg
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.scheduler.peg_layout.peg_rules import AfterStart, AtPosition, Between, Given, Position, Step
from reactive_realizer.scheduler.peg_layout.section import Behind, PointRule, Section
from reactive_realizer.scheduler.problem import Node, Origin, Point


class PegBuilder:
    """Makes the pegs of one section; a peg that several points share has the name of the first of them.

    Args:
        graph: where the pegs live.
        block: id of the block, for names.
        section: with the rules of roots and points.
        points: of the section, in the order of their names.
        start: the peg of the block's start.
        pegs: those of the points of earlier sections.

    Attributes:
        made: all pegs that were made.
    """

    def __init__(
        self,
        graph: Graph,
        block: str,
        section: Section,
        points: Sequence[Point],
        start: TimeCell,
        pegs: Mapping[Point, TimePeg],
    ) -> None:
        self._graph = graph
        self._block = block
        self._section = section
        self._points = points
        self._start = start
        self._given = [self._link(node, pegs) for node in section.network.given]
        self._own = set(pegs.values())
        self._names: dict[tuple[int, float], str] = {}
        for point in points:
            rule = section.points[point]
            if isinstance(rule, AtPosition):
                self._names.setdefault(_key(rule.position), self._name_of(point))
        self.made: list[TimePeg] = []
        self._roots: dict[Step, TimeCell] = {}
        self._shared: dict[tuple[int, float], TimePeg] = {}

    def build(self) -> dict[Point, TimePeg]:
        """The pegs of all points; those of roots are made first, each after those that it hangs on."""
        for step in self._section.rules.steps:
            self._roots[step] = self._bounded(step.root) if step.bounded else self._natural(step.root)
        pegs: dict[Point, TimePeg] = {}
        made: dict[int, TimePeg] = {}
        for point in self._points:
            rule = self._section.points[point]
            if id(rule) not in made:
                made[id(rule)] = self._peg(rule, point)
            pegs[point] = made[id(rule)]
        return pegs

    def _peg(self, rule: PointRule, point: Point) -> TimePeg:
        match rule:
            case AtPosition(position):
                return self._at(position)
            case Between(before, after, ratio):
                name = self._name_of(point)
                return self._keep(RatioPeg(self._graph, name, self._at(before), self._at(after), ratio))
            case Behind(position, distance):
                return self._keep(OffsetPeg(self._graph, self._name_of(point), self._at(position), distance))

    def _at(self, position: Position) -> TimePeg:
        """The peg at a position."""
        key = _key(position)
        if key not in self._shared:
            link, offset = self._roots[Step(position.root, bounded=True)], self._from_lead(position)
            if not (isinstance(link, TimePeg) and link in self._own and offset == 0):
                link = self._offset(self._name(position), link, offset)
            self._shared[key] = link
        return self._shared[key]

    def _natural(self, root: int) -> TimeCell:
        rule = self._section.rules.rules[root]
        name = self._name(Position(root, self._section.network.leads[root]))
        if rule.before or rule.after:
            name = f"{name} as planned"
        match rule.natural:
            case Given():
                return self._given[root]
            case AfterStart(offset):
                return self._offset(name, self._start, offset)
            case AtPosition(position):
                link = self._roots[Step(position.root, bounded=True)]
                return self._offset(name, link, self._from_lead(position))
            case Between(before, after, ratio):
                return self._keep(RatioPeg(self._graph, name, self._at(before), self._at(after), ratio))

    def _bounded(self, root: int) -> TimeCell:
        rule, peg = self._section.rules.rules[root], self._roots.get(Step(root, bounded=False))
        peg = self._natural(root) if peg is None else peg
        name = self._name(Position(root, self._section.network.leads[root]))
        if rule.before:
            planned = f"{name} as planned" if rule.after else name
            bounds, floors = self._bounds(rule.before, bounded=False), self._bounds(rule.floors, bounded=True)
            peg = self._keep(BeforePeg(self._graph, planned, peg, bounds, floors))
        if rule.after:
            bounds, ceilings = self._bounds(rule.after, bounded=True), self._bounds(rule.ceilings, bounded=True)
            peg = self._keep(AfterPeg(self._graph, name, peg, bounds, ceilings))
        return peg

    def _bounds(self, positions: Sequence[Position], *, bounded: bool) -> list[Bound]:
        return [(self._roots[Step(position.root, bounded)], self._from_lead(position)) for position in positions]

    def _from_lead(self, position: Position) -> float:
        """How much later (s) a position is than the first point of its root."""
        return position.offset - self._section.network.leads[position.root]

    def _offset(self, name: str, link: TimeCell, offset: float) -> TimePeg:
        """A peg at an offset from another; from the start of the block, if that is all the other hangs on."""
        if isinstance(link, OffsetPeg) and link.dependencies == (self._start,):
            offset += link.offset
            link = self._start
        return self._keep(OffsetPeg(self._graph, name, link, offset))

    def _link(self, node: Node, pegs: Mapping[Point, TimePeg]) -> TimeCell:
        """The peg of a given node."""
        if isinstance(node, Point):
            return pegs[node]
        return self._start if isinstance(node, Origin) else node

    def _name_of(self, point: Point) -> str:
        return f"{self._block}:{':'.join(point)}"

    def _name(self, position: Position) -> str:
        return self._names.get(_key(position)) or f"{self._block}:a planned time"

    def _keep(self, peg: TimePeg) -> TimePeg:
        self.made.append(peg)
        self._own.add(peg)
        return peg


def _key(position: Position) -> tuple[int, float]:
    return position.root, round(position.offset, 9)
