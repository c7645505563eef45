"""Chooses the constraints that can be met together."""

from dataclasses import dataclass
from itertools import groupby

from reactive_realizer.scheduler.embr.differences import Differences, Row, Unmet
from reactive_realizer.scheduler.embr.embr_problem import EmbrProblem
from reactive_realizer.scheduler.faults import ContradictoryTie, OuterTieDropped, TooHurried
from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE, OffsetUnionFind
from reactive_realizer.scheduler.problem import Node, Point, Precedence, Tie
from reactive_realizer.scheduler.solution import Loss, lost_constraint

_LEAST = 2e-5
"""The shortest duration of a behavior, s: it can be played (`SHORTEST`) even after the solver has rounded."""


@dataclass(frozen=True, slots=True)
class Kept:
    """The part of a problem that can be kept.

    Attributes:
        constraints: that can be met together.
        losses: the other constraints.
        groups: of points that `at` constraints and rigid phases hold together.
        rows: the other conditions on all times, including the before/after constraints and authored limits.
        least: the earliest solution.
    """

    constraints: tuple[Tie | Precedence, ...]
    losses: tuple[Loss, ...]
    groups: OffsetUnionFind[Node]
    rows: tuple[Row[Node], ...]
    least: Differences[Node]


def keep(problem: EmbrProblem, *, limits: bool) -> Kept:
    """Admit constraints in their order, except for those that cannot be met together with earlier ones.

    Args:
        problem: with the constraints.
        limits: whether authored limits are admitted too, last.
    """
    return _Admission(problem).keep(limits=limits)


class _Admission:
    """One pass over the constraints."""

    def __init__(self, problem: EmbrProblem) -> None:
        self._problem = problem
        self._groups = OffsetUnionFind[Node](problem.given)
        self._rows: list[Row[Node]] = []
        self._losses: list[Loss] = []
        known = [node for node, time in problem.given.items() if time is not None]
        self._differences = Differences[Node](self._floors(), known)

    def keep(self, *, limits: bool) -> Kept:
        for segment in self._problem.segments:
            if segment.rigid:
                self._groups.union(segment.end, segment.start, segment.preferred)
                self._differences.add(*_equal(segment.end, segment.start, segment.preferred))
            else:
                self._add(segment.row)
        for id_, item in self._problem.items.items():
            if not item.timing.instant:
                self._add(Row(Point(id_, item.timing.points[-1]), Point(id_, item.timing.points[0]), _LEAST))
        constraints = tuple(each for each in self._problem.constraints if self._admit(each))
        for segment in self._problem.segments if limits else ():
            for row in segment.limits:
                self._add(row)
        losses, rows = tuple(self._losses), tuple(self._rows)
        return Kept(constraints, losses, self._groups, rows, self._differences)

    def _add(self, row: Row[Node]) -> Unmet[Node] | None:
        """Add a row; None if it can be met together with the others."""
        unmet = self._differences.add(row)
        if unmet is None:
            self._rows.append(row)
        return unmet

    def _admit(self, constraint: Tie | Precedence) -> bool:
        if isinstance(constraint, Precedence):
            unmet = self._add(Row(constraint.later, constraint.earlier, constraint.offset))
        elif self._outer(constraint):
            self._losses.append(lost_constraint(constraint, OuterTieDropped(tie=constraint.text)))
            return False
        else:
            unmet = self._differences.add(*_equal(constraint.left, constraint.right, constraint.offset))
            if unmet is None:
                self._groups.union(constraint.left, constraint.right, constraint.offset)
        if unmet is not None:
            fault = self._hurried(constraint, unmet) or ContradictoryTie(tie=constraint.text, gap=unmet.gap)
            self._losses.append(lost_constraint(constraint, fault))
        return unmet is None

    def _hurried(self, constraint: Tie | Precedence, unmet: Unmet[Node]) -> TooHurried | None:
        """The fault if a constraint leaves phases too little time; None if it is not met even if these take none."""
        rows = set(unmet.rows)
        segments = [each for each in self._problem.segments if each.shortest > 0 and each.row in rows]
        need = sum(segment.shortest for segment in segments)
        if not segments or unmet.gap > need + TIE_TOLERANCE:
            return None
        own = groupby(segments, key=lambda segment: segment.start.behavior)
        parts = [(behavior, list(each)) for behavior, each in own]
        phases = tuple(f"{behavior} from {each[0].start.sync} to {each[-1].end.sync}" for behavior, each in parts)
        return TooHurried(what=constraint.text, phases=phases, need=need, room=max(0.0, need - unmet.gap))

    def _outer(self, tie: Tie) -> bool:
        """Whether it would equate two given times, of which one may move without the other."""
        roots = {self._groups.find(node)[0] for node in tie.nodes}
        return len(roots) == 2 and roots <= self._problem.given.keys()

    def _floors(self) -> dict[Node, float]:
        """Given times; for knots the start of the block."""
        floors = {node: time or 0.0 for node, time in self._problem.given.items()}
        floors |= {node: 0.0 for segment in self._problem.segments for node in (segment.start, segment.end)}
        return floors


def _equal(left: Node, right: Node, offset: float) -> tuple[Row[Node], Row[Node]]:
    return Row(left, right, offset), Row(right, left, -offset)
