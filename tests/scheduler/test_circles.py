"""Stretching of spans that are tied at both ends: all spans of a circle are under equal force."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.planunit.timing import PhaseKind
from reactive_realizer.scheduler.convex.circles import solve_circles
from reactive_realizer.scheduler.convex.conflicts import GIVEN
from reactive_realizer.scheduler.convex.costs import SLACK, STIFFNESS
from reactive_realizer.scheduler.convex.longest_path import Arc
from reactive_realizer.scheduler.convex.model import BoundArc, Inequality
from reactive_realizer.scheduler.convex.spans import Span

preferred = st.floats(0.05, 5.0)


def spans_around(phases: list[tuple[PhaseKind, float, bool]], total: float) -> list[Span]:
    """Phases (kind, preferred, forward?) from the block's start through all variables and back to `total` (s)."""
    nodes = [*range(len(phases)), 0]
    spans = []
    for (kind, duration, forward), (here, there) in zip(phases, pairwise(nodes), strict=True):
        tail, head = (here, there) if forward else (there, here)
        spans.append(Span(0, (0,), kind, duration, 0, 0, tail=tail, head=head, goal=duration))
    last, (_, _, forward) = spans[-1], phases[-1]
    last.shift = total if forward else -total
    return spans


def pull(span: Span, length: float) -> float:
    """The derivative of a span's cost by its length."""
    if span.elastic:
        return 1.0 - span.goal / length
    return STIFFNESS * (1.0 - (span.goal + SLACK) / (length + SLACK))


def lengths_of(spans: list[Span], times: dict[int, float] | None) -> list[float]:
    assert times is not None
    return [times[span.head] - times[span.tail] + span.shift for span in spans]


@given(st.lists(preferred, min_size=2, max_size=6), st.floats(0.1, 30.0))
def test_elastic_phases_between_two_times_are_stretched_alike(durations: list[float], total: float) -> None:
    spans = spans_around([(PhaseKind.ELASTIC, duration, True) for duration in durations], total)
    times = solve_circles(spans, [])
    ratios = [length / span.goal for span, length in zip(spans, lengths_of(spans, times), strict=True)]
    assert ratios == pytest.approx([total / sum(durations)] * len(spans))


kinds = st.sampled_from([PhaseKind.ELASTIC, PhaseKind.HOLD])


@given(st.lists(st.tuples(kinds, preferred, st.booleans()), min_size=2, max_size=6), st.floats(-10.0, 20.0))
def test_spans_that_are_not_at_a_limit_have_equal_forces(
    phases: list[tuple[PhaseKind, float, bool]], total: float
) -> None:
    spans = spans_around(phases, total)
    times = solve_circles(spans, [])
    if times is None:
        assert_out_of_reach(phases, total)
        return
    signs = [1 if forward else -1 for _, _, forward in phases]
    lengths = lengths_of(spans, times)
    assert min(lengths) >= -1e-9
    assert sum(s * n for s, n in zip(signs, lengths, strict=True)) == pytest.approx(total, abs=1e-9)
    forces = [s * pull(span, n) for span, s, n in zip(spans, signs, lengths, strict=True) if n > 1e-6]
    assert forces == pytest.approx(forces[:1] * len(forces), rel=1e-3, abs=1e-6)


def assert_out_of_reach(phases: list[tuple[PhaseKind, float, bool]], total: float) -> None:
    """The only circles without a solution: all phases have one direction, and the total has the other."""
    ways = {forward for _, _, forward in phases}
    assert len(ways) == 1
    assert (total if True in ways else -total) <= 1e-3


def test_holds_absorb_extra_time_first() -> None:
    spans = spans_around([(PhaseKind.ELASTIC, 1.0, True), (PhaseKind.HOLD, 1.0, True)], 9.0)
    elastic, hold = lengths_of(spans, solve_circles(spans, []))
    assert 1.0 < elastic < 1.06
    assert hold == pytest.approx(9.0 - elastic)


def test_a_span_stays_within_its_limit_and_the_others_stretch_more() -> None:
    spans = spans_around([(PhaseKind.ELASTIC, 1.0, True), (PhaseKind.ELASTIC, 1.0, True)], 4.0)
    spans[0].maximum = 1.2
    assert lengths_of(spans, solve_circles(spans, [])) == pytest.approx([1.2, 2.8])


def test_a_hold_may_shrink_to_zero() -> None:
    spans = spans_around([(PhaseKind.ELASTIC, 1.0, True), (PhaseKind.HOLD, 0.1, True)], 0.3)
    assert lengths_of(spans, solve_circles(spans, [])) == pytest.approx([0.3, 0.0])


def bound(later: int, earlier: int, distance: float = 0.0) -> BoundArc:
    return Arc(earlier, later, distance, Inequality(later, earlier, distance, GIVEN))


def test_a_behavior_is_shortened_to_start_within_its_block() -> None:
    stroke = Span(0, (0,), PhaseKind.ELASTIC, 0.8, 0, 0, tail=1, head=0, shift=0.3, goal=0.8)  # it is at 0.3 s
    times = solve_circles([stroke], [bound(1, 0)])
    assert times == pytest.approx({0: 0.0, 1: 0.0})


def test_an_inactive_bound_has_no_effect() -> None:
    stroke = Span(0, (0,), PhaseKind.ELASTIC, 0.8, 0, 0, tail=1, head=0, shift=2.0, goal=0.8)
    times = solve_circles([stroke], [bound(1, 0)])
    assert times == pytest.approx({0: 0.0, 1: 1.2})


def test_spans_that_are_not_simple_circles_are_not_solved() -> None:
    sides = [Span(0, (k,), PhaseKind.ELASTIC, 1.0 + k, 0, 0, tail=1, head=2, goal=1.0 + k) for k in range(3)]
    assert solve_circles(sides, []) is None
