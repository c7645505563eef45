"""What hangs on what, so that a plan stays one when times from outside move: nothing is solved again."""

from collections import defaultdict, deque
from collections.abc import Collection, Iterable, Sequence
from graphlib import CycleError
from itertools import pairwise

from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE
from reactive_realizer.scheduler.peg_layout.network import START, TOLERANCE, Edge, Network, RootPrecedence
from reactive_realizer.scheduler.peg_layout.peg_rules import (
    AfterStart,
    AtPosition,
    Between,
    Given,
    Natural,
    PegRule,
    Position,
    Step,
    steps,
)


class RootRules:
    """The rule of every root.

    Between two given ones a root keeps its fraction of the way, behind or before one its distance. A cluster that
    hangs on nothing given begins with one of its roots, as early as what it comes after allows (thesis 7.24), also
    after changes. An order between roots that move differently is kept by bounds on one or both of them
    (docs/semantics.md, pegs).

    Attributes:
        rules: by root.
        steps: in which their pegs can be made.
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
            # What these hang on themselves stays as it is, so that nothing comes to hang on itself by nature.
            given |= self._with_bases(bounded - given)
            self._hang_on(given)
        self._stop_bounds(given, outside)
        self.steps = self._order_steps()

    # --- clusters

    def _first_roots(self) -> dict[int, int]:
        """The first root of every cluster that hangs on nothing given."""
        firsts: dict[int, int] = {}
        for root in self._network.roots[self._network.fixed :]:
            cluster = self._network.cluster(root)
            if not self._network.hangs(cluster):
                first = firsts.setdefault(cluster, root)
                if self._network.first_time(root) < self._network.first_time(first):
                    firsts[cluster] = root
        return firsts

    def _begin_clusters(self) -> None:
        """Such a cluster begins as early as what it comes after lets it, or, where it was planned later, as planned."""
        starts = dict.fromkeys(self._firsts.values(), 0.0)
        for order in self._orders:
            first = self._firsts.get(self._network.cluster(order.later))
            if first is not None and not self._within_cluster(order):
                ahead = self._network.first_time(first) - self._network.time(order.later)
                if order.earlier == START:
                    starts[first] = max(starts[first], order.distance + ahead)
                else:
                    self.rules[first].after.append(Position(order.earlier, order.distance + ahead))
        for first, start in starts.items():
            planned = self._network.first_time(first)
            earliest = max([start, *map(self._network.at, self.rules[first].after)])
            self.rules[first].natural = AfterStart(planned if abs(planned - earliest) > TIE_TOLERANCE else start)

    def _within_cluster(self, order: RootPrecedence) -> bool:
        return self._network.cluster(order.later) == self._network.cluster(order.earlier)

    # --- where roots are by nature

    def _naturals(self, given: Collection[int]) -> dict[int, Natural]:
        network, between = self._network, self._network.between(given)
        before = network.latest_before(given) if between else {}
        after = network.earliest_after(given) if between else {}
        naturals: dict[int, Natural] = {}
        for root in network.roots:
            if root in network.branches:
                naturals[root] = AtPosition(network.branches[root].moved(network.leads[root]))
            elif root in given:
                naturals[root] = Given() if root < network.fixed else AfterStart(0.0)
            elif root in before and root in after and before[root].root != after[root].root:
                naturals[root] = self._between(root, before[root], after[root])
        self._hang_rest(naturals)
        return naturals

    def _between(self, root: int, before: Position, after: Position) -> Natural:
        time, start, end = self._network.time(root), self._network.at(before), self._network.at(after)
        lead = self._network.leads[root]
        if end - start <= TOLERANCE:
            return AtPosition(before.moved(lead + time - start))
        return Between(before.moved(lead), after.moved(lead), (time - start) / (end - start))

    def _hang_rest(self, naturals: dict[int, Natural]) -> None:
        """At a distance from what they are connected with, step by step."""
        edges: defaultdict[int, list[Edge]] = defaultdict(list)
        for edge in self._network.edges:
            edges[edge.start].append(edge)
            edges[edge.end].append(edge.back)
        waiting = deque(sorted(naturals))
        while waiting:
            root = waiting.popleft()
            for edge in edges[root]:
                if edge.end not in naturals:
                    naturals[edge.end] = self._hung(edge, naturals[root])
                    waiting.append(edge.end)

    def _hung(self, edge: Edge, natural: Natural) -> AtPosition:
        """On what the root before it hangs on, or, where it follows a point that stays when that has begun, on that."""
        follows = edge.leaves > self._network.leads[edge.start] + TOLERANCE
        base = natural.position.root if isinstance(natural, AtPosition) and not follows else edge.start
        return AtPosition(Position(base, self._network.first_time(edge.end) - self._network.time(base)))

    def _with_bases(self, roots: Iterable[int]) -> set[int]:
        """Some roots, and all that these hang on by nature."""
        found, waiting = set[int](), list(roots)
        while waiting:
            root = waiting.pop()
            if root not in found:
                found.add(root)
                waiting += [position.root for position in self.rules[root].natural.positions]
        return found

    def _hang_on(self, given: Collection[int]) -> None:
        """What is held by a bound, others hang on in their turn."""
        for root, natural in self._naturals(given).items():
            if root not in given:
                self.rules[root].natural = natural

    # --- orders alive

    def _keep_orders(self) -> set[int]:
        """Bounds for the orders whose two sides may come to move against each other; the roots that got some."""
        moved = self.following(range(START + 1, self._network.fixed))
        movable = {root for root in self.rules if root >= self._network.fixed} - self._network.branches.keys()
        bounded = set()
        for order in self._orders:
            if not moved & {order.later, order.earlier} or self._begins_after(order):
                continue
            leads = self._network.leads
            # The earlier one goes with a later one that comes from outside, hangs there, or cannot go.
            pushed = order.own and order.earlier in moved and order.later not in self._network.branches
            if order.earlier in movable and not pushed:
                self.rules[order.earlier].before.append(Position(order.later, leads[order.earlier] - order.distance))
                bounded.add(order.earlier)
            if order.own:
                self.rules[order.later].after.append(Position(order.earlier, leads[order.later] + order.distance))
                bounded.add(order.later)
        return bounded

    def _keep_between(self, given: Collection[int]) -> set[int]:
        """Bounds for the order of what leads from and to several that move against each other; who got some."""
        if not self._network.between(given):
            return set()
        floors, ceilings = self._network.floors(given), self._network.ceilings(given)
        bounded = set()
        for root, rule in self.rules.items():
            hung = {position.root for position in rule.natural.positions}
            if root not in given and (len(floors[root]) > 1 or len(ceilings[root]) > 1):
                rule.after += [position for position in floors[root] if position.root not in hung]
                rule.before += [position for position in ceilings[root] if position.root not in hung]
                bounded.add(root)
        return bounded

    def _stop_bounds(self, given: Collection[int], outside: Collection[int]) -> None:
        """What no bound brings a root past: a `before` what leads up to it, an `after` what stays where it is."""
        rules = self.rules.items()
        floors = self._network.floors(given) if any(rule.before for _, rule in rules) else {}
        ceilings = self._network.ceilings(outside) if any(rule.after for _, rule in rules) else {}
        for root, rule in rules:
            if rule.before:
                rule.floors = [*self._block_floor(root), *floors[root]]
            if rule.after:
                rule.ceilings = [*ceilings[root]]

    def _block_floor(self, root: int) -> list[Position]:
        """The start of the block, for what is not before it already (thesis 7.13)."""
        return [Position(START, 0.0)] if self._network.first_time(root) >= 0 else []

    def _begins_after(self, order: RootPrecedence) -> bool:
        """Whether an order is kept by the beginning of the cluster."""
        is_first = self._firsts.get(self._network.cluster(order.later)) == order.later
        return is_first and not self._within_cluster(order)

    def following(self, given: Iterable[int]) -> set[int]:
        """The roots that move when some given ones do, these included."""
        users: defaultdict[int, list[int]] = defaultdict(list)
        for root, rule in self.rules.items():
            for position in (*rule.natural.positions, *rule.after):
                users[position.root].append(root)
        moved = set(given)
        waiting = sorted(moved)
        while waiting:
            new = set(users[waiting.pop()]) - moved
            moved |= new
            waiting += sorted(new)
        return moved

    def _order_steps(self) -> list[Step]:
        """A bound that would make a peg hang on itself is left out; a cluster then begins when it was planned to."""
        while True:
            try:
                return steps(self.rules)
            except CycleError as problem:
                self._open(problem.args[1])

    def _open(self, circle: Sequence[Step]) -> None:
        pairs = [(step, needed) for needed, step in pairwise(circle) if step.bounded]
        bounds = [(step, needed) for step, needed in pairs if needed in self.rules[step.root].bounds]
        if self._drop_stops(bounds):
            return
        step, needed = min(bounds, key=lambda pair: (self._network.first_time(pair[0].root), pair))
        rule = self.rules[step.root]
        held = rule.after if needed.bounded else rule.before
        held[:] = [position for position in held if position.root != needed.root]
        within = self._network.cluster(step.root) == self._network.cluster(needed.root)
        if isinstance(rule.natural, AfterStart) and not within:
            rule.natural = AfterStart(self._network.first_time(step.root))

    def _drop_stops(self, bounds: Sequence[tuple[Step, Step]]) -> bool:
        """What hangs on a point does not stop it."""
        found = False
        for step, needed in bounds:
            rule = self.rules[step.root]
            for stops in (rule.floors, rule.ceilings):
                left = [position for position in stops if position.root != needed.root]
                found = found or left != stops
                stops[:] = left
        return found
