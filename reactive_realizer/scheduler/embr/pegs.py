"""From times to pegs: what is tied shares one, what lies between others stays between them."""

from collections import defaultdict, deque
from collections.abc import Callable, Iterator, Mapping, Sequence

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
    """Pegs of all points, hung from what is given on.

    Each class of tied points has one, and of a class on something given each branch. It is the peg of its first point:
    so the others stay at their distances from that when it has passed.

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
        self._branch = kept.branches.find
        self._pegs: dict[Node, tuple[PegSpec, float]] = {}
        self._shared: dict[tuple[Node, float], PegSpec] = {}
        self._waiting: deque[str] = deque()
        self._users: dict[Node, list[str]] = defaultdict(list)
        self._knots = {
            id_: [Point(id_, item.timing.points[i]) for i in case.knots[id_]] for id_, item in case.items.items()
        }
        for id_ in case.items:
            for point in self.knots(id_):
                self._users[self._find(point)[0]].append(id_)
        for node in case.given:
            self._branch_off(node)
            self._waiting.extend(self._users[node])

    def knots(self, id_: str) -> list[Point]:
        """The knots of a behavior, in order."""
        return self._knots[id_]

    def users(self, id_: str) -> set[str]:
        """The behaviors that share a class with one, itself among them."""
        return {user for point in self.knots(id_) for user in self._users[self._find(point)[0]]}

    def hung(self, node: Node) -> bool:
        """Whether there is a peg for a node."""
        root = self._find(node)[0]
        return root in self._pegs or root in self._case.given

    def hang(self, point: Point, peg: PegSpec, on: Sequence[Point] = ()) -> None:
        """Give the class of a point its peg, through this point.

        Args:
            point: that hangs on nothing yet.
            peg: where it is by nature.
            on: the knots that this hangs on.
        """
        root, later = self._find(point)
        first = min(later for _, _, later in self._own_knots(root))
        self._pegs[root] = self._bounded(root, first, _moved(peg, first - later), on), first
        self._waiting.extend(self._users[root])

    def spread(self) -> None:
        """Hang everything that is tied, directly or not, to what hangs already."""
        while self._waiting:
            knots = self.knots(self._waiting.popleft())
            for i, point in enumerate(knots):
                if not self.hung(point):
                    around = [*self._before(knots, i), *self._after(knots, i)]
                    self.hang(point, self._between(point, *around), around)

    def link(self, node: Node) -> Link:
        """What stands for a node that is hung."""
        return self._case.given[node].link if node in self._case.given else self._peg(node)

    def all(self) -> dict[str, dict[str, PegSpec]]:
        """The pegs of all points of all behaviors; between knots all phases stretch alike."""
        return {id_: dict(self._of(item)) for id_, item in self._case.items.items()}

    def _branch_off(self, node: Node) -> None:
        """Hang the first point of each branch of a class on what is given."""
        link, leads = self._case.given[node].link, dict[Node, float]()
        for knots, i, later in self._own_knots(node):
            branch = self._branch(knots[i])[0]
            leads[branch] = min(later, leads.get(branch, later))
        for branch, lead in leads.items():
            self._pegs[branch] = _moved(link, lead), lead

    def _peg(self, node: Node) -> PegSpec:
        """The peg of the class or branch of a node, or one at a distance from that."""
        root, later = self._find(node)
        root = self._branch(node)[0] if root in self._case.given else root
        peg, at = self._pegs[root]
        distance = round(later - at, 9)
        return self._shared.setdefault((root, distance), _moved(peg, distance))

    def _between(self, point: Point, *hung: Point) -> PegSpec:
        first, last = hung[0], hung[-1]
        time, low, high = self._times[point], self._times[first], self._times[last]
        if low < high:
            return AtRatio(self._peg(first), self._peg(last), (time - low) / (high - low))
        return _moved(self._peg(first), time - low)

    def _bounded(self, root: Node, at: float, peg: PegSpec, on: Sequence[Point]) -> PegSpec:
        """A peg that stands so much (s) after a root, held by the orders on the class of this.

        What its behaviors have hung before and behind it holds it too, but for that which it hangs on itself.
        """
        floors, ceilings = self._stops(root, at, self._before), self._stops(root, at, self._after)
        least = [bound for knot, bound in floors if knot not in on]
        most = [bound for knot, bound in ceilings if knot not in on]
        for order in self.orders:
            (one, later), (other, earlier) = (self._find(node) for node in order.nodes)
            if other == root and self.hung(order.later):
                most.append((self.link(order.later), at - earlier - order.offset))
            elif one == root and self.hung(order.earlier):
                least.append((self.link(order.earlier), at - later + order.offset))
        if most:
            stops = *(bound for _, bound in floors), *self._block_floors(root, at)
            peg = AtMost(peg, tuple(most), stops)
        return AtLeast(peg, tuple(least), tuple(bound for _, bound in ceilings)) if least else peg

    def _stops(
        self, root: Node, at: float, nearest: Callable[[Sequence[Point], int], list[Point]]
    ) -> list[tuple[Point, Bound]]:
        """What a class does not pass, whatever its orders say: knots in front of its own, or behind them."""
        stops = []
        for knots, i, later in self._own_knots(root):
            for knot in nearest(knots, i):
                gap = self._times[knots[i]] - self._times[knot]
                stops.append((knot, (self.link(knot), at - later + min(max(gap, -SHORTEST), SHORTEST))))
        return stops

    def _block_floors(self, root: Node, at: float) -> Iterator[Bound]:
        """The start of the block, for what begins in a class and is not before it already (thesis 7.13)."""
        for knots, i, later in self._own_knots(root):
            if i == 0 and self._times[knots[0]] >= 0:
                yield self.link(Origin.BLOCK_START), at - later

    def _own_knots(self, root: Node) -> Iterator[tuple[list[Point], int, float]]:
        """The knots of behaviors that are in a class: among which, at which place, and how much (s) after its root."""
        for knots in (self.knots(id_) for id_ in dict.fromkeys(self._users[root])):
            for i, point in enumerate(knots):
                base, later = self._find(point)
                if base == root:
                    yield knots, i, later

    def _before(self, knots: Sequence[Point], i: int) -> list[Point]:
        """The last knot before one that is hung, if there is any."""
        return [knot for knot in knots[:i] if self.hung(knot)][-1:]

    def _after(self, knots: Sequence[Point], i: int) -> list[Point]:
        """The first knot after one that is hung, if there is any."""
        return [knot for knot in knots[i + 1 :] if self.hung(knot)][:1]

    def _of(self, item: Item) -> Iterator[tuple[str, PegSpec]]:
        knots, offsets = self._case.knots[item.behavior.id], item.timing.offsets
        for i, sync in enumerate(item.timing.points):
            before = max(knot for knot in knots if knot <= i)
            after = min(knot for knot in knots if knot >= i)
            low, high = (self._peg(Point(item.behavior.id, item.timing.points[knot])) for knot in (before, after))
            yield sync, low if before == i else AtRatio(low, high, ratio_between(offsets, before, i, after))


def _moved(link: Link, distance: float) -> PegSpec:
    """A peg at a distance (s); a peg of the plan itself where there is none."""
    return AtOffset(link, distance) if distance or isinstance(link, Cell) else link
