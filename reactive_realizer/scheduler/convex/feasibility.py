"""Whether all inequalities can be met together, and who is in whose way if not."""

from collections.abc import Sequence
from typing import NamedTuple

from reactive_realizer.scheduler.convex.causes import Clash
from reactive_realizer.scheduler.convex.longest_path import TOLERANCE, Arc, longest_path
from reactive_realizer.scheduler.convex.model import Model
from reactive_realizer.scheduler.convex.span import Row, Span


class _Wish(NamedTuple):
    """A row; and the span, if it is there because that cannot shrink to nothing."""

    row: Row
    span: Span | None


def clashes(model: Model) -> list[Clash]:
    """Circles of inequalities and shortest durations that cannot be met, no two with one of these in common.

    There is a plan if and only if there is no circle: the longest paths are one.
    """
    arcs = [Arc(bound.earlier, bound.later, bound.distance, _Wish(bound.row, None)) for bound in model.bounds]
    arcs += [_shortest(span) for span in model.spans if span.elastic and not span.closed]
    found: list[Clash] = []
    while circle := longest_path(model.size, arcs)[1]:
        found.append(_clash(model, circle))
        arcs = [arc for arc in arcs if arc not in circle]
    return found


def _shortest(span: Span) -> Arc[_Wish]:
    row = Row(span.end, span.start, span.least + span.rigid, span.cause)
    return Arc(span.tail, span.head, span.least - span.shift, _Wish(row, span))


def _clash(model: Model, circle: Sequence[Arc[_Wish]]) -> Clash:
    """Where a row ends in one node of a root and the next begins in another, the ties between them take part."""
    wishes = [arc.label for arc in circle]
    causes = {wish.row.cause for wish in wishes}
    for wish, following in zip(wishes, [*wishes[1:], wishes[0]], strict=True):
        causes |= model.roots.way(wish.row.later, following.row.earlier)
    gap = sum(arc.length for arc in circle)
    spans = [wish.span for wish in wishes if wish.span is not None]
    if gap <= sum(span.least for span in spans) + TOLERANCE:
        causes |= {span.length_cause for span in spans}
    return Clash(frozenset(causes), gap)
