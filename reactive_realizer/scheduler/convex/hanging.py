"""What hangs on what, so that a plan stays one when times from outside move: nothing is solved again."""

from collections import defaultdict, deque
from collections.abc import Collection, Iterable, Sequence
from graphlib import CycleError
from itertools import pairwise

from reactive_realizer.scheduler.convex.longest_path import TOLERANCE
from reactive_realizer.scheduler.convex.model import START
from reactive_realizer.scheduler.convex.network import Network, Precedence, Way
from reactive_realizer.scheduler.convex.recipes import (
    Between,
    First,
    Given,
    Hung,
    Natural,
    Recipe,
    Spot,
    Step,
    steps,
)


class Hanging:
    """The recipe of every root.

    Between two given ones a root keeps its fraction of the way, behind or before one its distance. A cluster that
    hangs on nothing given begins with one of its roots, as early as what it comes after allows (thesis 7.24), also
    after changes. An order between roots that move differently is kept by bounds on one or both of them
    (docs/semantics.md, pegs).

    Attributes:
        recipes: by root.
        steps: in which their pegs can be made.
    """

    def __init__(self, network: Network) -> None:
        self._network = network
        self._orders = network.precedences()
        self._firsts = self._first_roots()
        outside = {*network.roots[: network.fixed], *network.branches}
        given = {*outside, *self._firsts.values()}
        self.recipes = {root: Recipe(natural) for root, natural in self._naturals(given).items()}
        for order in self._orders:
            self._begin_after(order)
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

    def _begin_after(self, order: Precedence) -> None:
        """What a point of such a cluster comes after, its first root comes after, by as much earlier as it is."""
        cluster = self._network.cluster(order.later)
        first = self._firsts.get(cluster)
        if first is None or order.later < self._network.fixed or cluster == self._network.cluster(order.earlier):
            return
        recipe = self.recipes[first]
        ahead = self._network.first_time(first) - self._network.time(order.later)
        if order.earlier == START and isinstance(recipe.natural, First):
            recipe.natural = First(max(recipe.natural.offset, order.distance + ahead))
        else:
            recipe.after.append(Spot(order.earlier, order.distance + ahead))

    # --- where roots are by nature

    def _naturals(self, given: Collection[int]) -> dict[int, Natural]:
        network, between = self._network, self._network.between(given)
        before = network.latest_before(given) if between else {}
        after = network.earliest_after(given) if between else {}
        naturals: dict[int, Natural] = {}
        for root in network.roots:
            if root in network.branches:
                naturals[root] = Hung(network.branches[root].moved(network.leads[root]))
            elif root in given:
                naturals[root] = Given() if root < network.fixed else First(0.0)
            elif root in before and root in after and before[root].root != after[root].root:
                naturals[root] = self._between(root, before[root], after[root])
        self._hang_rest(naturals)
        return naturals

    def _between(self, root: int, before: Spot, after: Spot) -> Natural:
        time, start, end = self._network.time(root), self._network.at(before), self._network.at(after)
        lead = self._network.leads[root]
        if end - start <= TOLERANCE:
            return Hung(before.moved(lead + time - start))
        return Between(before.moved(lead), after.moved(lead), (time - start) / (end - start))

    def _hang_rest(self, naturals: dict[int, Natural]) -> None:
        """At a distance from what they are connected with, step by step."""
        ways: defaultdict[int, list[Way]] = defaultdict(list)
        for way in self._network.ways:
            ways[way.start].append(way)
            ways[way.end].append(way.back)
        waiting = deque(sorted(naturals))
        while waiting:
            root = waiting.popleft()
            for way in ways[root]:
                if way.end not in naturals:
                    naturals[way.end] = self._hung(way, naturals[root])
                    waiting.append(way.end)

    def _hung(self, way: Way, natural: Natural) -> Hung:
        """On what the root before it hangs on, or, where it follows a point that stays when that has begun, on that."""
        follows = way.leaves > self._network.leads[way.start] + TOLERANCE
        base = natural.spot.root if isinstance(natural, Hung) and not follows else way.start
        return Hung(Spot(base, self._network.first_time(way.end) - self._network.time(base)))

    def _with_bases(self, roots: Iterable[int]) -> set[int]:
        """Some roots, and all that these hang on by nature."""
        found, waiting = set[int](), list(roots)
        while waiting:
            root = waiting.pop()
            if root not in found:
                found.add(root)
                waiting += [spot.root for spot in self.recipes[root].natural.spots]
        return found

    def _hang_on(self, given: Collection[int]) -> None:
        """What is held by a bound, others hang on in their turn."""
        for root, natural in self._naturals(given).items():
            if root not in given:
                self.recipes[root].natural = natural

    # --- orders alive

    def _keep_orders(self) -> set[int]:
        """Bounds for the orders whose two sides may come to move against each other; the roots that got some."""
        moved = self._moved_from_outside()
        movable = {root for root in self.recipes if root >= self._network.fixed} - self._network.branches.keys()
        bounded = set()
        for order in self._orders:
            if not moved & {order.later, order.earlier} or self._begins_after(order):
                continue
            leads = self._network.leads
            # The earlier one goes with a later one that comes from outside, hangs there, or cannot go.
            pushed = order.own and order.earlier in moved and order.later not in self._network.branches
            if order.earlier in movable and not pushed:
                self.recipes[order.earlier].before.append(Spot(order.later, leads[order.earlier] - order.distance))
                bounded.add(order.earlier)
            if order.own:
                self.recipes[order.later].after.append(Spot(order.earlier, leads[order.later] + order.distance))
                bounded.add(order.later)
        return bounded

    def _keep_between(self, given: Collection[int]) -> set[int]:
        """Bounds for the order of what leads from and to several that move against each other; who got some."""
        if not self._network.between(given):
            return set()
        floors, ceilings = self._network.floors(given), self._network.ceilings(given)
        bounded = set()
        for root, recipe in self.recipes.items():
            hung = {spot.root for spot in recipe.natural.spots}
            if root not in given and (len(floors[root]) > 1 or len(ceilings[root]) > 1):
                recipe.after += [spot for spot in floors[root] if spot.root not in hung]
                recipe.before += [spot for spot in ceilings[root] if spot.root not in hung]
                bounded.add(root)
        return bounded

    def _stop_bounds(self, given: Collection[int], outside: Collection[int]) -> None:
        """What no bound brings a root past: a `before` what leads up to it, an `after` what stays where it is."""
        recipes = self.recipes.items()
        floors = self._network.floors(given) if any(recipe.before for _, recipe in recipes) else {}
        ceilings = self._network.ceilings(outside) if any(recipe.after for _, recipe in recipes) else {}
        for root, recipe in recipes:
            if recipe.before:
                recipe.floors = [*self._block_floor(root), *floors[root]]
            if recipe.after:
                recipe.ceilings = [*ceilings[root]]

    def _block_floor(self, root: int) -> list[Spot]:
        """The start of the block, for what is not before it already (thesis 7.13)."""
        return [Spot(START, 0.0)] if self._network.first_time(root) >= 0 else []

    def _begins_after(self, order: Precedence) -> bool:
        """Whether an order is kept by the beginning of the cluster."""
        cluster = self._network.cluster(order.later)
        return self._firsts.get(cluster) == order.later and cluster != self._network.cluster(order.earlier)

    def _moved_from_outside(self) -> set[int]:
        """The roots that move when times from outside do."""
        users: defaultdict[int, list[int]] = defaultdict(list)
        for root, recipe in self.recipes.items():
            for spot in (*recipe.natural.spots, *recipe.after):
                users[spot.root].append(root)
        moved = set(range(START + 1, self._network.fixed))
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
                return steps(self.recipes)
            except CycleError as problem:
                self._open(problem.args[1])

    def _open(self, circle: Sequence[Step]) -> None:
        pairs = [(step, needed) for needed, step in pairwise(circle) if step.bounded]
        bounds = [(step, needed) for step, needed in pairs if needed in self.recipes[step.root].bounds]
        if self._drop_stops(bounds):
            return
        step, needed = min(bounds, key=lambda pair: (self._network.first_time(pair[0].root), pair))
        recipe = self.recipes[step.root]
        held = recipe.after if needed.bounded else recipe.before
        held[:] = [spot for spot in held if spot.root != needed.root]
        within = self._network.cluster(step.root) == self._network.cluster(needed.root)
        if isinstance(recipe.natural, First) and not within:
            recipe.natural = First(self._network.first_time(step.root))

    def _drop_stops(self, bounds: Sequence[tuple[Step, Step]]) -> bool:
        """What hangs on a point does not stop it."""
        found = False
        for step, needed in bounds:
            recipe = self.recipes[step.root]
            for stops in (recipe.floors, recipe.ceilings):
                left = [spot for spot in stops if spot.root != needed.root]
                found = found or left != stops
                stops[:] = left
        return found
