"""The earliest times of points in a graph of inequalities."""

from collections.abc import Iterator, Sequence
from typing import Generic, NamedTuple, TypeVar

TOLERANCE = 1e-9
"""Inequalities that miss by less (s) are met."""

L = TypeVar("L", covariant=True)


class Arc(NamedTuple, Generic[L]):
    """``time[head] >= time[tail] + length``; the label says what requires it."""

    tail: int
    head: int
    length: float
    label: L


def longest_path(size: int, arcs: Sequence[Arc[L]]) -> tuple[list[float], list[Arc[L]]]:
    """The least times >= 0 that meet all arcs; or else, second, arcs in a circle that cannot be met together.

    By the algorithm of Bellman and Ford. If no arc leads back, one pass finds the times and a second one confirms them.
    Circles are looked for after 4, 8, 16 ... passes, so that one is found soon.
    """
    times, into = [0.0] * size, dict[int, Arc[L]]()
    arcs, passes = _in_turn(size, arcs), 0
    while True:
        passes, moved = passes + 1, False
        for arc in arcs:
            time = times[arc.tail] + arc.length
            if time > times[arc.head] + TOLERANCE:
                times[arc.head], into[arc.head], moved = time, arc, True
        if not moved:
            return times, []
        if passes >= 4 and passes & (passes - 1) == 0 and (circle := _circle(size, into)):
            return times, circle


def _in_turn(size: int, arcs: Sequence[Arc[L]]) -> list[Arc[L]]:
    """The arcs into a node before those out of it, except arcs of negative length."""
    heads: list[list[int]] = [[] for _ in range(size)]
    for arc in arcs:
        if arc.length >= 0:
            heads[arc.tail].append(arc.head)
    order, seen = list[int](), [False] * size
    for start in range(size):
        if not seen[start]:
            order += _reached(start, heads, seen)
    places = {node: -place for place, node in enumerate(order)}
    return sorted(arcs, key=lambda arc: places[arc.tail])


def _reached(start: int, heads: Sequence[Sequence[int]], seen: list[bool]) -> Iterator[int]:
    """A node and those not seen yet that can be reached from it, each after all that it leads to."""
    seen[start], path = True, [(start, iter(heads[start]))]
    while path:
        following = path[-1][1]
        head = next((head for head in following if not seen[head]), None)
        if head is None:
            yield path.pop()[0]
        else:
            seen[head] = True
            path.append((head, iter(heads[head])))


def _circle(size: int, into: dict[int, Arc[L]]) -> list[Arc[L]]:
    seen = [0] * size
    for number, start in enumerate(into, 1):
        node = start
        while node in into and not seen[node]:
            seen[node] = number
            node = into[node].tail
        if node in into and seen[node] == number:
            return _around(node, into)
    return []


def _around(start: int, into: dict[int, Arc[L]]) -> list[Arc[L]]:
    arcs = [into[start]]
    while arcs[-1].tail != start:
        arcs.append(into[arcs[-1].tail])
    return arcs[::-1]
