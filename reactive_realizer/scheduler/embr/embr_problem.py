"""The problem of EMBR's strategy: behaviors cut into segments at the points to which constraints refer."""

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import inf
from typing import NamedTuple

from reactive_realizer.planunit.timing import Phase, PhaseKind
from reactive_realizer.scheduler.embr.differences import Row
from reactive_realizer.scheduler.problem import Item, Node, Point, Precedence, Tie


class PhaseGroup(NamedTuple):
    """The part of a behavior between two knots, which is stretched as a whole: its phases keep their proportions.

    Attributes:
        start: the earlier knot.
        end: the later one.
        preferred: duration, s.
        rigid: whether it cannot be stretched; EMBR does not distinguish the other kinds of phases.
        shortest: duration that the body needs, s.
        phases: of the behavior, between the knots.
    """

    start: Point
    end: Point
    preferred: float
    rigid: bool
    shortest: float
    phases: Sequence[Phase]

    @property
    def row(self) -> Row[Node]:
        """Its shortest duration as a condition on its knots."""
        return Row(self.end, self.start, self.shortest)

    @property
    def limits(self) -> Iterator[Row[Node]]:
        """The durations with which all its phases keep their authored limits, as conditions on its knots."""
        limited = [phase for phase in self.phases if phase.authored and phase.duration > 0.0]
        if limited and not self.rigid:
            least = max(phase.minimum / phase.duration for phase in limited)
            most = min(phase.maximum / phase.duration for phase in limited)
            yield Row(self.end, self.start, least * self.preferred)
            if most < inf:
                yield Row(self.start, self.end, -most * self.preferred)


class EmbrProblem:
    """Behaviors that are timed together, in an order that does not depend on how the block was written.

    Attributes:
        items: by id.
        constraints: in the order in which they are admitted: required ones first, and ties before precedences.
        given: times (s after the start of the block, None while unknown) of the nodes outside of these behaviors.
        knots: the indices of the first and last point of each behavior, of points that constraints name, and of the
            limits of rigid parts.
        segments: of all behaviors.
    """

    def __init__(
        self, items: Sequence[Item], constraints: Sequence[Tie | Precedence], given: Mapping[Node, float | None]
    ) -> None:
        self.items = {item.behavior.id: item for item in sorted(items, key=lambda item: item.behavior.id)}
        self.constraints = sorted(constraints, key=_rank)
        self.given = given
        named = {node for each in constraints for node in each.nodes}
        self.knots = {id_: _knots(item, named) for id_, item in self.items.items()}
        self.segments = [segment for id_, item in self.items.items() for segment in _segments(item, self.knots[id_])]

    def known(self, node: Node) -> float | None:
        """The time (s) of a node that is given and known."""
        return self.given.get(node)

    def movable(self, node: Node) -> Node | str | None:
        """The behavior of a point, or a node with an unknown given time; None for a known node, which does not move."""
        if self.known(node) is not None:
            return None
        return node.behavior if isinstance(node, Point) and node not in self.given else node


def _rank(constraint: Tie | Precedence) -> tuple[bool, bool, str, str, float]:
    owner = constraint.owner or "" if isinstance(constraint, Tie) else constraint.name
    return not constraint.required, isinstance(constraint, Precedence), owner, constraint.text, constraint.offset


def _knots(item: Item, named: Iterable[Node]) -> list[int]:
    own = {i for i, sync in enumerate(item.timing.points) if Point(item.behavior.id, sync) in named}
    rigid = [phase.kind is PhaseKind.RIGID for phase in item.timing.phases]
    own.update(i for i in range(1, len(rigid)) if rigid[i] is not rigid[i - 1])
    return sorted(own | {0, len(rigid)})


def _segments(item: Item, knots: Sequence[int]) -> list[PhaseGroup]:
    points = [Point(item.behavior.id, sync) for sync in item.timing.points]
    offsets, phases = item.timing.offsets, item.timing.phases
    segments = []
    for first, last in itertools.pairwise(knots):
        rigid = phases[first].kind is PhaseKind.RIGID
        shortest = 0.0 if rigid else sum(phase.shortest for phase in phases[first:last])
        preferred = offsets[last] - offsets[first]
        segments.append(PhaseGroup(points[first], points[last], preferred, rigid, shortest, phases[first:last]))
    return segments
