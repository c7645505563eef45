"""The rules of the roots of a network, so that a plan remains valid when times from outside move: nothing is solved."""

from collections import defaultdict, deque
from collections.abc import Collection, Iterable, Sequence
from graphlib import CycleError
from itertools import pairwise

from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE
from reactive_realizer.scheduler.peg_layout import paths
from reactive_realizer.scheduler.peg_layout.knots import START
from reactive_realizer.scheduler.peg_layout.network import TOLERANCE, Network, RootPrecedence
from reactive_realizer.scheduler.peg_layout.peg_rules import (
    AfterStart,
    AtPosition,
    Between,
    Natural,
    PegRule,
    PlannedPeg,
    Position,
    ordered_pegs,
)


class RootRules:
    """The rule of every root.

    Between two given roots a root keeps its fraction of the way; behind or before one it keeps its distance. A cluster
    without a given root begins with one of its roots, as early as its `after` constraints allow (thesis 7.24), also
    after changes. The order of roots that move differently is kept by bounds on one or both of them
    (docs/semantics.md, pegs).

    Attributes:
        rules: by root.
        pegs: in an order in which they can be made.
    """

    def __init__(self, network: Network) -> None:
        self._network = network
        self._orders = network.precedences()
        self._firsts = self._first_roots()
        outside = {*network.roots[: network.fixed], *network.branches}
        given = {*outside, *self._firsts.values()}
        self.rules = {root: PegRule(natural) for root, natural in self._naturals(given).items()}
        self._begin_clusters()
        bounded = self._keep_orders() | self._keep_between(given)
        if bounded - given:
            # The roots that these depend on keep their rules, so that nothing comes to depend on itself.
            given |= self._with_bases(bounded - given)
            self._depend_on(given)
        self._stop_bounds(given, outside)
        self.pegs = self._order_pegs()

    # --- clusters

    def _first_roots(self) -> dict[int, int]:
        """The first root of every cluster without a given root."""
        network, firsts = self._network, dict[int, int]()
        for root in network.roots[network.fixed :]:
            cluster = network.clusters[root]
            if cluster not in network.anchored:
                first = firsts.setdefault(cluster, root)
                if network.first_times[root] < network.first_times[first]:
                    firsts[cluster] = root
        return firsts

    def _begin_clusters(self) -> None:
        """Such a cluster begins as early as its `after` constraints allow, or, if it was planned later, as planned."""
        starts = dict.fromkeys(self._firsts.values(), 0.0)
        for order in self._orders:
            first = self._firsts.get(self._network.clusters[order.later])
            if first is not None and not self._within_cluster(order):
                ahead = self._network.first_times[first] - self._network.times[order.later]
                if order.earlier == START:
                    starts[first] = max(starts[first], order.distance + ahead)
                else:
                    self.rules[first].after.append(Position(order.earlier, order.distance + ahead))
        for first, start in starts.items():
            self.rules[first].natural = self._beginning(first, start)

    def _beginning(self, first: int, start: float) -> AfterStart:
        """At an offset (s), if the present bounds of the first root are what keeps it there, otherwise as planned."""
        planned = self._network.first_times[first]
        earliest = max([start, *map(self._least, self.rules[first].after)])
        return AfterStart(planned if abs(planned - earliest) > TIE_TOLERANCE else start)

    def _least(self, position: Position) -> float:
        """The time of a position, s after the block's start; of an unknown one the least that constraints allow."""
        orders = (order for order in self._orders if order.later == position.root < self._network.fixed)
        least = [self._network.times[order.earlier] + order.distance + position.offset for order in orders]
        return max([self._network.at(position), *least])

    def _within_cluster(self, order: RootPrecedence) -> bool:
        return self._network.clusters[order.later] == self._network.clusters[order.earlier]

    # --- natural places

    def _naturals(self, given: Collection[int]) -> dict[int, Natural]:
        network, several = self._network, self._lead_to_several(given)
        before = paths.latest_before(network, given) if several else {}
        after = paths.earliest_after(network, given) if several else {}
        naturals: dict[int, Natural] = {}
        for root in network.roots:
            if root in network.branches:
                naturals[root] = AtPosition((network.branches[root].moved(network.leads[root]),))
            elif root in given:
                naturals[root] = AfterStart(0.0)
            elif root in before and root in after and before[root].root != after[root].root:
                naturals[root] = self._between(root, before[root], after[root])
        self._place_rest(naturals)
        return naturals

    def _lead_to_several(self, given: Collection[int]) -> bool:
        """Whether edges lead from or to more than one of some roots."""
        return len({root for edge in self._network.edges for root in edge[:2] if root in given}) > 1

    def _between(self, root: int, before: Position, after: Position) -> Natural:
        network, lead = self._network, self._network.leads[root]
        time, start, end = network.times[root], network.at(before), network.at(after)
        if end - start <= TOLERANCE:
            return AtPosition((before.moved(lead + time - start),))
        return Between((before.moved(lead), after.moved(lead)), (time - start) / (end - start))

    def _place_rest(self, naturals: dict[int, Natural]) -> None:
        """At a distance from what edges connect them with, step by step.

        A root depends on the base of the root before it, or, if its edge leaves from a point that stays when the first
        point of that root has passed, on that root.
        """
        network = self._network
        edges: defaultdict[int, list[tuple[int, float]]] = defaultdict(list)
        for edge in network.edges:
            edges[edge.start].append((edge.end, edge.leaves))
            edges[edge.end].append((edge.start, edge.enters))
        waiting = deque(sorted(naturals))
        while waiting:
            root = waiting.popleft()
            for other, leaves in edges[root]:
                if other not in naturals:
                    natural, base = naturals[root], root
                    if isinstance(natural, AtPosition) and leaves <= network.leads[root] + TOLERANCE:
                        base = natural.positions[0].root
                    distance = network.first_times[other] - network.times[base]
                    naturals[other] = AtPosition((Position(base, distance),))
                    waiting.append(other)

    def _with_bases(self, roots: Iterable[int]) -> set[int]:
        """Some roots, and all that their natural places depend on."""
        found, waiting = set[int](), list(roots)
        while waiting:
            root = waiting.pop()
            if root not in found:
                found.add(root)
                waiting += [position.root for position in self.rules[root].natural.positions]
        return found

    def _depend_on(self, given: Collection[int]) -> None:
        """Let the natural places of other roots depend on roots that bounds hold."""
        for root, natural in self._naturals(given).items():
            if root not in given:
                self.rules[root].natural = natural

    # --- bounds

    def _keep_orders(self) -> set[int]:
        """Bounds for before/after constraints whose sides may move against each other; the roots that get some."""
        bounded = set[int]()
        if not self._orders:
            return bounded
        moved, leads = self.following(range(START + 1, self._network.fixed)), self._network.leads
        movable = {root for root in self.rules if root >= self._network.fixed} - self._network.branches.keys()
        for order in self._orders:
            if not moved & {order.later, order.earlier} or self._begins_after(order):
                continue
            # The earlier root goes with a later one that comes from outside, depends on it, or cannot go.
            pushed = order.own and order.earlier in moved and order.later not in self._network.branches
            if order.earlier in movable and not pushed:
                self.rules[order.earlier].before.append(Position(order.later, leads[order.earlier] - order.distance))
                bounded.add(order.earlier)
            if order.own:
                self.rules[order.later].after.append(Position(order.earlier, leads[order.later] + order.distance))
                bounded.add(order.later)
        return bounded

    def _keep_between(self, given: Collection[int]) -> set[int]:
        """Bounds for roots on paths of several given ones that move against each other; the roots that get some."""
        bounded = set[int]()
        if not self._lead_to_several(given):
            return bounded
        floors, ceilings = paths.floors(self._network, given), paths.ceilings(self._network, given)
        for root, rule in self.rules.items():
            bases = {position.root for position in rule.natural.positions}
            if root not in given and (len(floors[root]) > 1 or len(ceilings[root]) > 1):
                rule.after += [position for position in floors[root] if position.root not in bases]
                rule.before += [position for position in ceilings[root] if position.root not in bases]
                bounded.add(root)
        return bounded

    def _stop_bounds(self, given: Collection[int], outside: Collection[int]) -> None:
        """The limits of bounds: a `before` does not pass what leads to the root, an `after` what stays where it is."""
        held = [(root, rule) for root, rule in self.rules.items() if rule.before]
        floors = paths.floors(self._network, given) if held else {}
        for root, rule in held:
            starts_in_block = self._network.first_times[root] >= 0  # thesis 7.13
            rule.floors = [*([Position(START, 0.0)] if starts_in_block else []), *floors[root]]
        held = [(root, rule) for root, rule in self.rules.items() if rule.after]
        ceilings = paths.ceilings(self._network, outside) if held else {}
        for root, rule in held:
            rule.ceilings = [*ceilings[root]]

    def _begins_after(self, order: RootPrecedence) -> bool:
        """Whether a before/after constraint is kept by the beginning of the cluster."""
        is_first = self._firsts.get(self._network.clusters[order.later]) == order.later
        return is_first and not self._within_cluster(order)

    def following(self, given: Iterable[int]) -> set[int]:
        """The roots that move when some given ones do, these included."""
        users: defaultdict[int, list[int]] = defaultdict(list)
        for root, rule in self.rules.items():
            for position in (*rule.natural.positions, *rule.after):
                users[position.root].append(root)
        moved = set(given)
        waiting = [*moved]
        while waiting:
            new = set(users[waiting.pop()]) - moved
            moved |= new
            waiting += new
        return moved

    # --- circles of bounds

    def _order_pegs(self) -> list[PlannedPeg]:
        """A bound by which a peg would depend on itself is dropped; a cluster then begins when it was planned to."""
        while True:
            try:
                return ordered_pegs(self.rules)
            except CycleError as problem:
                self._open(problem.args[1])

    def _open(self, circle: Sequence[PlannedPeg]) -> None:
        """Drop the limits of bounds that close a circle; if there are none, its earliest bound."""
        pairs = [(peg, needed) for needed, peg in pairwise(circle) if peg.bounded]
        bounds = [(peg, needed) for peg, needed in pairs if needed in self.rules[peg.root].bounds]
        rules = [(self.rules[peg.root], needed.root) for peg, needed in bounds]
        stops = [(held, root) for rule, root in rules for held in (rule.floors, rule.ceilings)]
        dropped = [(held, root) for held, root in stops if any(position.root == root for position in held)]
        if dropped:
            self._drop(dropped)
            return
        peg, needed = min(bounds, key=lambda pair: (self._network.first_times[pair[0].root], pair))
        rule = self.rules[peg.root]
        self._drop([(rule.after if needed.bounded else rule.before, needed.root)])
        within = self._network.clusters[peg.root] == self._network.clusters[needed.root]
        if isinstance(rule.natural, AfterStart) and not within:
            rule.natural = self._beginning(peg.root, rule.natural.offset)

    @staticmethod
    def _drop(bounds: Iterable[tuple[list[Position], int]]) -> None:
        """Drop the bounds on some roots from lists of bounds."""
        for held, root in bounds:
            held[:] = [position for position in held if position.root != root]
