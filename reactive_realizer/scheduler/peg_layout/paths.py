"""Paths along the edges of a network: the given roots before and behind each root, and how near it can be to them."""

from collections import defaultdict
from collections.abc import Collection, Mapping, Sequence

from reactive_realizer.scheduler.peg_layout.network import TOLERANCE, Edge, Network
from reactive_realizer.scheduler.peg_layout.peg_rules import Position

Stops = Mapping[int, Sequence[Position]]
"""By root, the positions that its first point cannot pass in one direction."""


def latest_before(network: Network, given: Collection[int]) -> dict[int, Position]:
    """For each root with a path from a given one, the position where it would be if the path took no time.

    Of several positions the latest; a path does not continue through given roots.
    """
    return _nearest(network, given, network.edges, 1.0)


def earliest_after(network: Network, given: Collection[int]) -> dict[int, Position]:
    """The same, backwards."""
    return _nearest(network, given, _reversed(network.edges), -1.0)


def floors(network: Network, given: Collection[int]) -> Stops:
    """The positions that first points cannot come before, for all given roots with a path to them."""
    return _stops(network, given, network.least_edges, 1.0)


def ceilings(network: Network, given: Collection[int]) -> Stops:
    """The positions that first points cannot come after, for all given roots with a path from them."""
    return _stops(network, given, _reversed(network.least_edges), -1.0)


def _reversed(edges: Sequence[Edge]) -> list[Edge]:
    return [edge.back for edge in reversed(edges)]


def _nearest(network: Network, given: Collection[int], edges: Sequence[Edge], sign: float) -> dict[int, Position]:
    found = {root: Position(root, 0.0) for root in given}
    for _ in network.roots:
        moved = False
        for edge in edges:
            if edge.start in found and edge.end not in given:
                position = found[edge.start].moved(edge.distance)
                old = found.get(edge.end)
                if old is None or sign * (network.at(position) - network.at(old)) > TOLERANCE:
                    found[edge.end], moved = position, True
        if not moved:
            break
    return {root: position for root, position in found.items() if root not in given}


def _stops(network: Network, given: Collection[int], edges: Sequence[Edge], sign: float) -> Stops:
    found: defaultdict[int, dict[int, float]] = defaultdict(dict)
    for _ in network.roots:  # a circle of shortest durations has no end
        moved = False
        for edge in edges:
            stops = {edge.start: 0.0} if edge.start in given else found[edge.start]
            for root, distance in stops.items():
                old = found[edge.end].get(root)
                if root != edge.end and (old is None or sign * (distance + edge.distance - old) > TOLERANCE):
                    found[edge.end][root], moved = distance + edge.distance, True
        if not moved:
            break
    return {
        root: [Position(stop, distance + network.leads[root]) for stop, distance in found[root].items()]
        for root in network.roots
    }
