"""From a timetable to descriptions of pegs."""

from collections.abc import Sequence
from itertools import zip_longest

from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.timing import Phase, PhaseKind
from reactive_realizer.reactive.cell import Cell
from reactive_realizer.scheduler.convex.hanging import Hanging
from reactive_realizer.scheduler.convex.model import START
from reactive_realizer.scheduler.convex.network import Network
from reactive_realizer.scheduler.convex.recipes import Between, First, Given, Hung, Spot, Step
from reactive_realizer.scheduler.convex.timetable import Timetable
from reactive_realizer.scheduler.problem import AtBlock, AtLeast, AtMost, AtOffset, AtRatio, PegSpec


def pegs_of(table: Timetable) -> dict[str, dict[str, PegSpec]]:
    """The pegs of all behaviors of a timetable, point by point."""
    roots = _Roots(table)
    return {item.behavior.id: _points(table, roots, index) for index, item in table.model.stage.items.items()}


def _points(table: Timetable, roots: "_Roots", behavior: int) -> dict[str, PegSpec]:
    """Between knots at a fraction, behind the last at a distance; rigid phases keep theirs."""
    timing, times = table.model.stage.items[behavior].timing, table.points[behavior]
    knots = {k: roots.peg(node) for k, node in table.model.knots[behavior].items()}
    rigid = any(phase.kind is PhaseKind.RIGID for phase in timing.phases)
    pegs: list[PegSpec] = []
    for before, after in zip_longest(knots, list(knots)[1:]):
        pegs.append(knots[before])
        whole = 0.0 if after is None else times[after] - times[before]
        for k in range(before + 1, len(times) if after is None else after):
            gone = times[k] - times[before]
            if times[k] == times[k - 1] or (after is not None and whole <= 0.0):
                pegs.append(pegs[-1])
            elif rigid and _rigid(timing.phases[before:k]):
                pegs.append(AtOffset(knots[before], gone))
            elif after is None:
                pegs.append(roots.behind(table.model.knots[behavior][before], gone))
            elif rigid and _rigid(timing.phases[k:after]):
                pegs.append(AtOffset(knots[after], times[k] - times[after]))
            else:
                pegs.append(AtRatio(knots[before], knots[after], gone / whole))
    return dict(zip(timing.points, pegs, strict=True))


def _rigid(phases: tuple[Phase, ...]) -> bool:
    return all(phase.kind is PhaseKind.RIGID for phase in phases)


class _Roots:
    """The pegs of roots; what is at the same distance from the same root shares one."""

    def __init__(self, table: Timetable) -> None:
        self._network = Network(table)
        self._links = [fixed.link for fixed in table.model.stage.fixed.values()]
        hanging = Hanging(self._network)
        self._recipes = hanging.recipes
        self._made: dict[Step, PegSpec | TimeCell] = {}
        self._shared: dict[tuple[int, float], PegSpec] = {}
        for step in hanging.steps:
            self._made[step] = self._bounded(step.root) if step.bounded else self._natural(step.root)

    def peg(self, node: int) -> PegSpec:
        """The peg of a node."""
        return self._at(self._network.spot(node))

    def behind(self, node: int, distance: float) -> PegSpec:
        """A peg at a distance (s) from a node, which goes on to follow what the node hangs on when that has passed."""
        spot = self._network.spot(node)
        if spot.root not in self._network.branches or self._network.is_rigid(spot.root):
            return AtOffset(self.peg(node), distance)
        host = self._network.branches[spot.root]
        return self._at(host.moved(spot.distance + distance))

    def _at(self, spot: Spot) -> PegSpec:
        key = (spot.root, round(spot.distance, 9))
        if key not in self._shared:
            link, distance = self._made[Step(spot.root, bounded=True)], self._from_lead(spot)
            self._shared[key] = _moved(link, distance) if distance or isinstance(link, Cell) else link
        return self._shared[key]

    def _natural(self, root: int) -> PegSpec | TimeCell:
        match self._recipes[root].natural:
            case Given():
                return self._links[root]
            case First(offset):
                return _moved(self._links[START], offset)
            case Hung(spot):
                return _moved(self._made[Step(spot.root, bounded=True)], self._from_lead(spot))
            case Between(before, after, ratio):
                return AtRatio(self._at(before), self._at(after), ratio)

    def _bounded(self, root: int) -> PegSpec | TimeCell:
        recipe, peg = self._recipes[root], self._made.get(Step(root, bounded=False)) or self._natural(root)
        if recipe.before:
            floors = self._bounds(recipe.floors, bounded=True)
            peg = AtMost(peg, self._bounds(recipe.before, bounded=False), floors)
        if recipe.after:
            ceilings = self._bounds(recipe.ceilings, bounded=True)
            peg = AtLeast(peg, self._bounds(recipe.after, bounded=True), ceilings)
        return peg

    def _bounds(self, spots: Sequence[Spot], *, bounded: bool) -> tuple[tuple[PegSpec | TimeCell, float], ...]:
        return tuple((self._made[Step(spot.root, bounded)], self._from_lead(spot)) for spot in spots)

    def _from_lead(self, spot: Spot) -> float:
        """How much later (s) a spot is than the first point of its root."""
        return spot.distance - self._network.leads[spot.root]


def _moved(link: PegSpec | TimeCell, distance: float) -> PegSpec:
    """A peg of its own at a distance (s)."""
    if isinstance(link, AtBlock):
        return AtBlock(link.anchor, link.offset + distance)
    return AtOffset(link, distance)
