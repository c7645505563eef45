"""From times to pegs: what is tied shares one, what lies between others stays between them."""

import itertools
from collections import defaultdict, deque
from collections.abc import Iterator, Mapping

from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.timing import SHORTEST
from reactive_realizer.reactive.cell import Cell
from reactive_realizer.scheduler.embr.case import Case
from reactive_realizer.scheduler.embr.keeping import Kept
from reactive_realizer.scheduler.problem import (
    AtLeast,
    AtMost,
    AtOffset,
    AtRatio,
    Item,
    Node,
    Order,
    Origin,
    PegSpec,
    Point,
)
from reactive_realizer.scheduler.stretch import ratio_between

Link = PegSpec | TimeCell
Bound = tuple[Link, float]


class Pegs:
    """Pegs of all points, hung from what is given on: each class of tied points has one.

    A knot between two that have theirs already hangs between these, any other at its distance from the nearest; both as
    far as before/after constraints on what hangs already let it.

    Attributes:
        orders: the before/after constraints that classes hung from now on keep, also when times from outside move.
    """

    def __init__(self, case: Case, kept: Kept, times: Mapping[Node, float]) -> None:
        self._case = case
        self._times = times
        self.orders = [each for each in kept.constraints if isinstance(each, Order)]
        self._find = kept.classes.find
        self._links: dict[Node, tuple[Link, float]] = {node: (given.link, 0.0) for node, given in case.given.items()}
        self._shared: dict[tuple[Node, float], PegSpec] = {}
        self._waiting: deque[str] = deque()
        self._users: dict[Node, list[str]] = defaultdict(list)
        for id_ in case.items:
            for point in self.knots(id_):
                self._users[self._find(point)[0]].append(id_)
        for node in case.given:
            self._waiting.extend(self._users[node])

    def knots(self, id_: str) -> list[Point]:
        """The knots of a behavior, in order."""
        points = self._case.items[id_].timing.points
        return [Point(id_, points[i]) for i in self._case.knots[id_]]

    def users(self, id_: str) -> set[str]:
        """The behaviors that share a class with one, itself among them."""
        return {user for point in self.knots(id_) for user in self._users[self._find(point)[0]]}

    def hung(self, node: Node) -> bool:
        """Whether there is a peg for a node."""
        return self._find(node)[0] in self._links

    def hang(self, node: Node, link: Link) -> None:
        """Give the class of a node its peg, through this node."""
        root, later = self._find(node)
        self._links[root] = self._bounded(root, later, link), later
        self._waiting.extend(self._users[root])

    def spread(self) -> None:
        """Hang everything that is tied, directly or not, to what hangs already."""
        while self._waiting:
            knots = self.knots(self._waiting.popleft())
            for i, point in enumerate(knots):
                if not self.hung(point):
                    before = [knot for knot in knots[:i] if self.hung(knot)][-1:]
                    after = [knot for knot in knots[i + 1 :] if self.hung(knot)][:1]
                    self.hang(point, self._between(point, *before, *after))

    def link(self, node: Node) -> Link:
        """What stands for a node that is hung: the peg of its class, or one at a distance from that."""
        root, later = self._find(node)
        link, at = self._links[root]
        distance = round(later - at, 9)
        return link if distance == 0 else self._at(root, link, distance)

    def all(self) -> dict[str, dict[str, PegSpec]]:
        """The pegs of all points of all behaviors; between knots all phases stretch alike."""
        return {id_: dict(self._of(item)) for id_, item in self._case.items.items()}

    def _at(self, root: Node, link: Link, distance: float) -> PegSpec:
        return self._shared.setdefault((root, distance), AtOffset(link, distance))

    def _between(self, point: Point, *hung: Point) -> Link:
        first, last = hung[0], hung[-1]
        time, low, high = self._times[point], self._times[first], self._times[last]
        if low < high:
            return AtRatio(self.link(first), self.link(last), (time - low) / (high - low))
        return self.link(first) if time == low else AtOffset(self.link(first), time - low)

    def _bounded(self, root: Node, at: float, link: Link) -> Link:
        """A peg that stands so much (s) after a root, held by the orders on the class of this."""
        most: list[Bound] = []
        least: list[Bound] = []
        for order in self.orders:
            (one, later), (other, earlier) = (self._find(node) for node in order.nodes)
            if other == root and self.hung(order.later):
                most.append((self.link(order.later), at - earlier - order.offset))
            elif one == root and self.hung(order.earlier):
                least.append((self.link(order.earlier), at - later + order.offset))
        if most:
            link = AtMost(link, tuple(most), tuple(self._floors(root, at)))
        return AtLeast(link, tuple(least)) if least else link

    def _floors(self, root: Node, at: float) -> Iterator[Bound]:
        """What a class does not come before, whatever its orders say: knots in front of its own, and the block."""
        for id_ in dict.fromkeys(self._users[root]):
            knots = self.knots(id_)
            for before, point in itertools.pairwise(knots):
                base, later = self._find(point)
                if base == root and self._find(before)[0] != root and self.hung(before):
                    yield self.link(before), at - later + SHORTEST
            base, later = self._find(knots[0])
            if base == root and self._times[knots[0]] >= 0:
                yield self.link(Origin.BLOCK_START), at - later

    def _of(self, item: Item) -> Iterator[tuple[str, PegSpec]]:
        knots, offsets = self._case.knots[item.behavior.id], item.timing.offsets
        for i, sync in enumerate(item.timing.points):
            before = max(knot for knot in knots if knot <= i)
            after = min(knot for knot in knots if knot >= i)
            low, high = (self._spec(Point(item.behavior.id, item.timing.points[knot])) for knot in (before, after))
            yield sync, low if before == i else AtRatio(low, high, ratio_between(offsets, before, i, after))

    def _spec(self, point: Point) -> PegSpec:
        link = self.link(point)
        return self._at(self._find(point)[0], link, 0.0) if isinstance(link, Cell) else link
