"""How layers leave."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.embodiment.pose import Layer, LayerKind, compose
from reactive_realizer.embodiment.quaternion import IDENTITY, angle, from_euler
from reactive_realizer.engines.animation.release import LOWEST, Release, release_duration, stacked

JOINT = "r_elbow"
NEW = Layer(LayerKind.POSTURE, {JOINT: from_euler(1.0, 0.0, 0.0)})
OLD = Layer(LayerKind.BASE, {JOINT: IDENTITY})


def shift(weight: float) -> Layer:
    return Layer(LayerKind.POSTURE, NEW.rotations, weight)


def shown(skeleton, releases, now: float, playing=()) -> float:
    """How far the joint is turned over a base that has become the new one."""
    base = Layer(LayerKind.BASE, NEW.rotations)
    return angle(compose(skeleton, [base, *stacked(releases, playing, now)]).shown.rotation(JOINT))


@given(st.floats(0.0, 0.999))
def test_what_became_the_base_before_it_was_there_goes_on_from_where_it_is_straight_to_it(skeleton, weight):
    releases = (Release(OLD, 0.0, 1.0, under=weight), Release(shift(weight), 0.0, 1.0, (0.0, 0.0)))
    way = [shown(skeleton, releases, 0.05 * step) for step in range(21)]
    assert way[0] == pytest.approx(weight, abs=1e-6)
    assert way[-1] == pytest.approx(1.0)
    assert min(b - a for a, b in pairwise(way)) > -1e-6


def test_what_was_below_a_shift_comes_back_by_easing(skeleton):
    below = Layer(LayerKind.POSTURE, {JOINT: IDENTITY})
    releases = (Release(shift(1.0), 0.0, 1.0, (4.0, -5.0)),)
    way = [shown(skeleton, releases, 0.05 * step, [((0.0, -9.0), below)]) for step in range(21)]
    assert (way[0], way[-1]) == pytest.approx((1.0, 0.0), abs=1e-9)
    assert 0.0 < max(a - b for a, b in pairwise(way)) < 0.1


def test_what_started_with_it_and_would_have_ended_later_lies_below_what_leaves():
    upper, lower = shift(1.0), Layer(LayerKind.POSTURE, {})
    assert stacked([Release(upper, 0.0, 1.0, (0.0, -1.0))], [((0.0, -9.0), lower)], 0.0) == [lower, upper]


def test_what_was_never_to_be_seen_has_left_at_once():
    assert Release(OLD, 0.0, under=1.0).over(0.0)
    assert Release(shift(0.0), 0.0, 1.0, LOWEST).over(0.0)


def test_a_figure_takes_its_time_to_wherever_it_may_have_to_go():
    sitting = Layer(LayerKind.POSTURE, {}, root=(0.0, -0.5, 0.0))
    near, far = (0.0, -0.45, 0.0), (0.0, 0.0, 0.0)
    assert release_duration(sitting, [near]) == 0.6
    assert release_duration(sitting, [near, far]) == pytest.approx(1.4)
