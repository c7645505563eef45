"""Which constraints can be met together."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from reactive_realizer.errors import Fault
from reactive_realizer.scheduler.embr.case import Case
from reactive_realizer.scheduler.embr.differences import Differences, Row
from reactive_realizer.scheduler.equalities import Equalities
from reactive_realizer.scheduler.losses import lost_constraint
from reactive_realizer.scheduler.problem import Loss, Node, Order, Origin, Point, Tie

_LEAST = 2e-5
"""What a behavior has at least, s: enough to be played (`SHORTEST`), whatever the solver's rounding takes."""


@dataclass(frozen=True, slots=True)
class Kept:
    """What is left of a case.

    Attributes:
        constraints: those that can be met together.
        losses: the others.
        classes: of points that `at` constraints and rigid phases hold together.
        branches: of points that these hold together even without what is given: what hangs on a time from outside stays
            in one piece when its first point has passed.
        rows: what all times have to meet beside these; of ``constraints`` the before/after ones.
        late: ids of the behaviors that hang on a given time before the start of the block: they may begin before it.
        least: a solution, the earliest one.
    """

    constraints: tuple[Tie | Order, ...]
    losses: tuple[Loss, ...]
    classes: Equalities[Node]
    branches: Equalities[Node]
    rows: tuple[Row[Node], ...]
    late: frozenset[str]
    least: Differences[Node]


def keep(case: Case) -> Kept:
    """Admit constraints in their order, each unless it cannot be met together with those before it."""
    late = frozenset(_late(case, case.constraints))
    while True:
        kept = _Keeping(case, late).keep()
        still = late.intersection(_late(case, kept.constraints))
        if still == late:
            return kept
        late = still


class _Keeping:
    """One pass over the constraints."""

    def __init__(self, case: Case, late: frozenset[str]) -> None:
        self._case = case
        self._late = late
        self._classes = Equalities[Node](frozenset(case.given))
        self._branches = Equalities[Node](frozenset())
        self._rows: list[Row[Node]] = []
        self._losses: list[Loss] = []
        known = [node for node, given in case.given.items() if given.time is not None]
        self._differences = Differences[Node](self._floors(), known)

    def keep(self) -> Kept:
        for span in self._case.spans:
            if span.rigid:
                self._tie(span.end, span.start, span.preferred)
                self._differences.add(*_equal(span.end, span.start, span.preferred))
            else:
                self._require(Row(span.end, span.start, 0.0))
        for id_, item in self._case.items.items():
            if not item.timing.instant:
                first, last = (Point(id_, item.timing.points[i]) for i in (0, -1))
                self._require(Row(last, first, _LEAST))
        constraints = tuple(each for each in self._case.constraints if self._admit(each))
        classes = self._classes, self._branches
        return Kept(constraints, tuple(self._losses), *classes, tuple(self._rows), self._late, self._differences)

    def _tie(self, left: Node, right: Node, offset: float) -> None:
        self._classes.tie(left, right, offset)
        if self._case.given.keys().isdisjoint((left, right)):
            self._branches.tie(left, right, offset)

    def _require(self, row: Row[Node]) -> None:
        self._rows.append(row)
        self._differences.add(row)

    def _admit(self, constraint: Tie | Order) -> bool:
        if isinstance(constraint, Order):
            row = Row(constraint.later, constraint.earlier, constraint.offset)
            gap = self._differences.add(row)
            if gap is None:
                self._rows.append(row)
        elif self._outer(constraint):
            self._losses.append(lost_constraint(constraint, Fault("outer-tie", {"tie": constraint.text})))
            return False
        else:
            gap = self._differences.add(*_equal(constraint.left, constraint.right, constraint.offset))
            if gap is None:
                self._tie(constraint.left, constraint.right, constraint.offset)
        if gap is not None:
            fault = Fault("contradictory-tie", {"tie": constraint.text, "gap": gap})
            self._losses.append(lost_constraint(constraint, fault))
        return gap is None

    def _outer(self, tie: Tie) -> bool:
        """Whether it would make two given times one: one of them may move, and the other not."""
        roots = {self._classes.find(node)[0] for node in tie.nodes}
        return len(roots) == 2 and roots <= self._case.given.keys()

    def _floors(self) -> dict[Node, float]:
        """Given times; of knots the start of the block, or for late ones a time before anything could be."""
        floors = {node: given.time or 0.0 for node, given in self._case.given.items()}
        wanted = sum(item.timing.offsets[-1] for item in self._case.items.values())
        ever = min(floors.values()) - wanted - sum(abs(each.offset) for each in self._case.constraints)
        for id_, knots in self._case.knots.items():
            points = self._case.items[id_].timing.points
            floors |= {Point(id_, points[i]): ever if id_ in self._late else 0.0 for i in knots}
        return floors


def _late(case: Case, constraints: Iterable[Tie | Order]) -> set[str]:
    """The behaviors that `at` constraints hang, directly or not, on the outside before the start of the block."""
    ties = [each for each in constraints if isinstance(each, Tie)]
    late: set[str] = set()
    while found := {id_ for tie in ties for id_ in _hanging(case, tie, late)}.intersection(case.items) - late:
        late |= found
    return late


def _hanging(case: Case, tie: Tie, late: set[str]) -> Iterator[str]:
    """The behaviors of a tie that hang on the past, or on one that is late."""
    for node, partner, offset in ((tie.left, tie.right, tie.offset), (tie.right, tie.left, -tie.offset)):
        time = None if partner is Origin.BLOCK_START else case.known(partner)
        reach = 0.0 if isinstance(partner, Point) else min(0.0, offset)
        past = time is not None and time + reach < 0
        if isinstance(node, Point) and (past or (isinstance(partner, Point) and partner.behavior in late)):
            yield node.behavior


def _equal(left: Node, right: Node, offset: float) -> tuple[Row[Node], Row[Node]]:
    return Row(left, right, offset), Row(right, left, -offset)
