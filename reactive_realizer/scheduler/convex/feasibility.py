"""Whether all inequalities can be met together, and the conflicts if not."""

from collections.abc import Sequence

from reactive_realizer.scheduler.convex.conflict import Conflict
from reactive_realizer.scheduler.convex.longest_path import TOLERANCE, Arc, longest_path
from reactive_realizer.scheduler.convex.model import Model
from reactive_realizer.scheduler.convex.span import Row, Span

_Wish = Row | Span
"""A row; or a span that cannot shrink to nothing."""


def conflicts(model: Model) -> list[Conflict]:
    """Circles of inequalities and shortest durations that cannot be met, no two with one of these in common.

    There is a plan if and only if there is no circle: the longest paths are one.
    """
    arcs: list[Arc[_Wish]] = [Arc(bound.earlier, bound.later, bound.distance, bound.row) for bound in model.bounds]
    elastic = (span for span in model.spans if span.elastic and not span.closed)
    arcs += [Arc(span.tail, span.head, span.least - span.shift, span) for span in elastic]
    found: list[Conflict] = []
    while circle := longest_path(model.size, arcs)[1]:
        found.append(_conflict(model, circle))
        arcs = [arc for arc in arcs if arc not in circle]
    return found


def _conflict(model: Model, circle: Sequence[Arc[_Wish]]) -> Conflict:
    """Where a row ends in one node of a root and the next begins in another, the ties between them take part."""
    wishes = [arc.label for arc in circle]
    rows = [wish if isinstance(wish, Row) else _shortest(wish) for wish in wishes]
    requirements = {row.requirement for row in rows}
    for row, following in zip(rows, [*rows[1:], rows[0]], strict=True):
        requirements |= model.groups.between(row.later, following.earlier)
    gap = sum(arc.length for arc in circle)
    spans = [wish for wish in wishes if isinstance(wish, Span)]
    if gap <= sum(span.least for span in spans) + TOLERANCE:
        requirements |= {span.length_requirement for span in spans}
    return Conflict(frozenset(requirements), gap)


def _shortest(span: Span) -> Row:
    return Row(span.end, span.start, span.least + span.rigid, span.requirement)
