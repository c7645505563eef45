"""Courses of idle animation: values that change evenly, and their integrals."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.engines.animation.idle_course import IdleCourse

VALUES = st.floats(0.0, 10.0)


@given(VALUES, VALUES, st.floats(0.01, 5.0), st.floats(0.0, 20.0))
def test_the_integral_reaches_an_amount_when_it_says(first: float, goal: float, takes: float, later: float) -> None:
    course = IdleCourse(first)
    course.begin(1.0, goal, 1.0 + takes)
    amount = course.integral(1.0 + later)
    reached = course.reaches(amount)
    assert reached <= 1.0 + later + 1e-6
    assert course.integral(reached) == pytest.approx(amount, abs=1e-6)


def test_an_integral_that_stays_never_reaches_more() -> None:
    course = IdleCourse(1.0)
    course.begin(0.0, 0.0, 2.0)
    assert course.reaches(0.75) == pytest.approx(1.0)
    assert course.reaches(1.5) == float("inf")
