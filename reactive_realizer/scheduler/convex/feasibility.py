"""Whether all inequalities can be met together, and who is in whose way if not."""

from collections.abc import Sequence

from reactive_realizer.scheduler.convex.causes import Clash
from reactive_realizer.scheduler.convex.longest_path import TOLERANCE, Arc, longest_path
from reactive_realizer.scheduler.convex.model import Model
from reactive_realizer.scheduler.convex.span import Row, Span

_Wish = Row | Span
"""A row; or a span that cannot shrink to nothing."""


def clashes(model: Model) -> list[Clash]:
    """Circles of inequalities and shortest durations that cannot be met, no two with one of these in common.

    There is a plan if and only if there is no circle: the longest paths are one.
    """
    arcs: list[Arc[_Wish]] = [Arc(bound.earlier, bound.later, bound.distance, bound.row) for bound in model.bounds]
    elastic = (span for span in model.spans if span.elastic and not span.closed)
    arcs += [Arc(span.tail, span.head, span.least - span.shift, span) for span in elastic]
    found: list[Clash] = []
    while circle := longest_path(model.size, arcs)[1]:
        found.append(_clash(model, circle))
        arcs = [arc for arc in arcs if arc not in circle]
    return found


def _clash(model: Model, circle: Sequence[Arc[_Wish]]) -> Clash:
    """Where a row ends in one node of a root and the next begins in another, the ties between them take part."""
    wishes = [arc.label for arc in circle]
    rows = [wish if isinstance(wish, Row) else _shortest(wish) for wish in wishes]
    causes = {row.cause for row in rows}
    for row, following in zip(rows, [*rows[1:], rows[0]], strict=True):
        causes |= model.roots.way(row.later, following.earlier)
    gap = sum(arc.length for arc in circle)
    spans = [wish for wish in wishes if isinstance(wish, Span)]
    if gap <= sum(span.least for span in spans) + TOLERANCE:
        causes |= {span.length_cause for span in spans}
    return Clash(frozenset(causes), gap)


def _shortest(span: Span) -> Row:
    return Row(span.end, span.start, span.least + span.rigid, span.cause)
