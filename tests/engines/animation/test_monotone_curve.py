"""Curves through points: they pass them, do not overshoot, are smooth, and are found by their values."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.engines.animation.monotone_curve import MonotoneCurve

STEPS = st.lists(st.tuples(st.floats(0.01, 5.0), st.floats(0.0, 1.0)), min_size=2, max_size=8)
"""Durations before points, s, and their values."""


def points_of(steps: list[tuple[float, float]]) -> list[tuple[float, float]]:
    times = [sum(step for step, _ in steps[:end]) for end in range(1, len(steps) + 1)]
    return [(time, value) for time, (_, value) in zip(times, steps, strict=True)]


@given(STEPS)
def test_it_passes_its_points_and_stays_at_the_last_ones(steps: list[tuple[float, float]]) -> None:
    points = points_of(steps)
    curve = MonotoneCurve(points)
    assert [curve(time) for time, _ in points] == pytest.approx([value for _, value in points])
    assert curve(points[0][0] - 1.0) == points[0][1]
    assert curve(points[-1][0] + 1.0) == points[-1][1]


@given(STEPS, st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_it_goes_in_one_direction_between_two_points(
    steps: list[tuple[float, float]], first: float, second: float
) -> None:
    points = points_of(steps)
    curve = MonotoneCurve(points)
    for (begin, low), (end, high) in pairwise(points):
        shares = sorted((first, second))
        here, there = (curve(begin + share * (end - begin)) for share in shares)
        assert min(low, high) - 1e-9 <= here <= max(low, high) + 1e-9
        assert (there - here) * (high - low) >= -1e-9


@given(STEPS)
def test_its_slope_is_continuous(steps: list[tuple[float, float]]) -> None:
    points = points_of(steps)
    curve = MonotoneCurve(points)
    step = 1e-6
    for time, _ in points[1:-1]:
        before, after = (curve(time) - curve(time - step)) / step, (curve(time + step) - curve(time)) / step
        assert before == pytest.approx(after, abs=0.1)


@given(STEPS, st.floats(0.0, 1.0))
def test_the_first_time_of_a_value_has_this_value(steps: list[tuple[float, float]], share: float) -> None:
    points = points_of(steps)
    curve = MonotoneCurve(points)
    value = curve(points[0][0] + share * (points[-1][0] - points[0][0]))
    assert curve(curve.first_time(value)) == pytest.approx(value, abs=1e-6)


def test_two_points_are_joined_by_a_straight_line() -> None:
    curve = MonotoneCurve([(0.0, 1.0), (2.0, 0.0)])
    assert [curve(time) for time in (0.0, 0.5, 1.0, 2.0)] == pytest.approx([1.0, 0.75, 0.5, 0.0])


def test_a_value_that_it_never_has_is_refused() -> None:
    with pytest.raises(ValueError, match="never has the value"):
        MonotoneCurve([(0.0, 0.0), (1.0, 0.4)]).first_time(0.5)
