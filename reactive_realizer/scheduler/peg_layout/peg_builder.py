"""Makes the pegs of a layout."""

from collections.abc import Iterator, Mapping, Sequence

from reactive_realizer.pegboard.bounded_pegs import AfterPeg, BeforePeg, Bound
from reactive_realizer.pegboard.time_peg import OffsetPeg, RatioPeg, TimeCell, TimePeg
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.scheduler.peg_layout.network import TOLERANCE
from reactive_realizer.scheduler.peg_layout.peg_rules import AtPosition, Between, PlannedPeg, Position
from reactive_realizer.scheduler.peg_layout.section import PointRule, Section
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
        outside: those to depend on instead of some pegs from outside.

    Attributes:
        made: all pegs that were made.
        pegs: of the points.
    """

    def __init__(
        self,
        graph: Graph,
        block: str,
        section: Section,
        points: Sequence[Point],
        start: TimeCell,
        pegs: Mapping[Point, TimePeg],
        outside: Mapping[TimeCell, TimePeg],
    ) -> None:
        self._graph = graph
        self._block = block
        self._section = section
        self._network = section.network
        self._points = points
        self._start = start
        self._given = [self._link(node, pegs, outside) for node in section.network.given]
        self._outer = set(self._given).difference(pegs.values())
        self._names: dict[tuple[int, float], str] = {}
        for point in points:
            rule = section.points[point]
            if isinstance(rule, AtPosition) and (key := _key(rule.positions[0])) not in self._names:
                self._names[key] = self._name_of(point)
        self.made: list[TimePeg] = []
        self.pegs: dict[Point, TimePeg] = {}
        self._roots: dict[PlannedPeg, TimeCell] = {}
        self._shared: dict[tuple[int, float], TimePeg] = {}

    def steps(self) -> Iterator[None]:
        """Make the pegs of all points one by one; those of roots are made first, each after those it depends on."""
        for planned in self._section.rules.pegs:
            self._roots[planned] = self._bounded(planned.root) if planned.bounded else self._natural(planned.root)
            yield
        made: dict[int, TimePeg] = {}
        for point in self._points:
            rule = self._section.points[point]
            peg = made.get(id(rule))
            if peg is None:
                peg = made[id(rule)] = self._peg(rule, point)
            self.pegs[point] = peg
            yield

    def _peg(self, rule: PointRule, point: Point) -> TimePeg:
        if isinstance(rule, AtPosition):
            return self._at(rule.positions[0])
        if isinstance(rule, Between):
            return self._between(self._name_of(point), rule)
        return self._keep(OffsetPeg(self._graph, self._name_of(point), self._at(rule.positions[0]), rule.distance))

    def _between(self, name: str, rule: Between) -> TimePeg:
        before, after = rule.positions
        return self._keep(RatioPeg(self._graph, name, self._at(before), self._at(after), rule.ratio))

    def _at(self, position: Position) -> TimePeg:
        """The peg at a position."""
        key = _key(position)
        peg = self._shared.get(key)
        if peg is None:
            link, offset = self._from_root(position)
            # Whatever rounding says, a point at its root shares the root's peg: once it has fired, the others stay.
            if abs(offset) <= TOLERANCE and isinstance(link, TimePeg) and link not in self._outer:
                peg = link
            else:
                peg = self._offset(self._name(position), link, offset)
            self._shared[key] = peg
        return peg

    def _natural(self, root: int) -> TimeCell:
        rule = self._section.rules.rules[root]
        name = self._root_name(root)
        if rule.before or rule.after:
            name = f"{name} as planned"
        natural = rule.natural
        if isinstance(natural, AtPosition):
            return self._offset(name, *self._from_root(natural.positions[0]))
        if isinstance(natural, Between):
            return self._between(name, natural)
        return self._given[root] if root < self._network.fixed else self._offset(name, self._start, natural.offset)

    def _bounded(self, root: int) -> TimeCell:
        rule, peg = self._section.rules.rules[root], self._roots.get(PlannedPeg(root, bounded=False))
        if peg is None:
            return self._natural(root)
        name = self._root_name(root)
        if rule.before:
            planned = f"{name} as planned" if rule.after else name
            bounds, floors = self._bounds(rule.before, bounded=False), self._bounds(rule.floors)
            peg = self._keep(BeforePeg(self._graph, planned, peg, bounds, floors))
        if rule.after:
            bounds, ceilings = self._bounds(rule.after), self._bounds(rule.ceilings)
            peg = self._keep(AfterPeg(self._graph, name, peg, bounds, ceilings))
        return peg

    def _bounds(self, positions: Sequence[Position], *, bounded: bool = True) -> list[Bound]:
        return [self._from_root(position, bounded=bounded) for position in positions]

    def _from_root(self, position: Position, *, bounded: bool = True) -> Bound:
        """The peg of the root of a position, and the offset (s) from it: from the first point of the root."""
        root, offset = position
        return self._roots[PlannedPeg(root, bounded)], offset - self._network.leads[root]

    def _offset(self, name: str, link: TimeCell, offset: float) -> TimePeg:
        """A peg at an offset from another; from the start of the block, if the other depends only on that."""
        if isinstance(link, OffsetPeg) and link.dependencies == (self._start,):
            offset += link.offset
            link = self._start
        return self._keep(OffsetPeg(self._graph, name, link, offset))

    def _link(self, node: Node, pegs: Mapping[Point, TimePeg], outside: Mapping[TimeCell, TimePeg]) -> TimeCell:
        """The peg of a given node."""
        if isinstance(node, Point):
            return pegs[node]
        return self._start if isinstance(node, Origin) else outside.get(node, node)

    def _name_of(self, point: Point) -> str:
        return f"{self._block}:{point.behavior}:{point.sync}"

    def _root_name(self, root: int) -> str:
        return self._name(Position(root, self._network.leads[root]))

    def _name(self, position: Position) -> str:
        return self._names.get(_key(position)) or f"{self._block}:a planned time"

    def _keep(self, peg: TimePeg) -> TimePeg:
        self.made.append(peg)
        return peg


def _key(position: Position) -> tuple[int, float]:
    """Equal for positions that differ by rounding alone."""
    root, offset = position
    return root, round(offset, 9)
