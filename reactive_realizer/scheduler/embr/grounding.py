"""Clusters that hang on nothing are grounded at the start of the block, or after what they wait for (thesis 7.2.3)."""

from collections.abc import Mapping
from dataclasses import dataclass

from reactive_realizer.scheduler.embr.case import Case
from reactive_realizer.scheduler.embr.keeping import Kept
from reactive_realizer.scheduler.embr.pegs import Pegs
from reactive_realizer.scheduler.problem import Anchor, AtBlock, AtLeast, Node, Order, PegSpec, Point


@dataclass(frozen=True, slots=True)
class _Cluster:
    """Behaviors that hang on each other and on nothing else.

    Attributes:
        first: its earliest knot.
        waits: its before/after constraints on what lies outside of it.
    """

    first: Point
    waits: tuple[Order, ...]


def ground(case: Case, kept: Kept, times: Mapping[Node, float], pegs: Pegs) -> None:
    """Hang every cluster: it is where its ``after``s let it be, also when what they name moves (thesis 7.24).

    Clusters that wait for each other in a circle keep the distances of the plan.
    """
    pegs.spread()
    waiting = _clusters(case, kept, times, pegs)
    while waiting:
        cluster = next((each for each in waiting if all(pegs.hung(w.earlier) for w in each.waits)), waiting[0])
        waiting.remove(cluster)
        pegs.hang(cluster.first, _start(cluster, times, pegs))
        pegs.spread()


def _clusters(case: Case, kept: Kept, times: Mapping[Node, float], pegs: Pegs) -> list[_Cluster]:
    clusters: list[_Cluster] = []
    seen: set[str] = set()
    orders = [each for each in kept.constraints if isinstance(each, Order)]
    for id_ in case.items:
        if id_ not in seen and not pegs.hung(pegs.knots(id_)[0]):
            members = _connected(id_, pegs)
            seen |= members
            first = min((times[knot], knot) for member in members for knot in pegs.knots(member))[1]
            clusters.append(_Cluster(first, tuple(order for order in orders if _waits(order, members))))
    return clusters


def _connected(id_: str, pegs: Pegs) -> set[str]:
    members, waiting = {id_}, [id_]
    while waiting:
        found = pegs.users(waiting.pop()) - members
        members |= found
        waiting.extend(found)
    return members


def _waits(order: Order, members: set[str]) -> bool:
    later, earlier = (isinstance(node, Point) and node.behavior in members for node in order.nodes)
    return later and not earlier


def _start(cluster: _Cluster, times: Mapping[Node, float], pegs: Pegs) -> PegSpec:
    start = times[cluster.first]
    live = [order for order in cluster.waits if pegs.hung(order.earlier)]
    pegs.orders = [order for order in pegs.orders if order not in live]
    natural = AtBlock(Anchor(0.0 if len(live) == len(cluster.waits) else start), 0.0)
    bounds = [(pegs.link(order.earlier), order.offset - (times[order.later] - start)) for order in live]
    return AtLeast(natural, tuple(bounds)) if bounds else natural
