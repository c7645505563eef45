"""The laws of expressivity (EMBR, section 5), for all values."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.bml.expressivity import NEUTRAL, Expressivity

VALUES = st.floats(-1.0, 1.0)
SECONDS = st.floats(0.0, 60.0)
SHARES = st.floats(0.0, 1.0)


@given(SECONDS, SHARES)
def test_without_expressivity_nothing_changes(duration: float, share: float) -> None:
    assert NEUTRAL.movement(duration) == NEUTRAL.pause(duration) == duration
    assert (NEUTRAL.size, NEUTRAL.speed, NEUTRAL.curvature) == (1.0, 1.0, 1.0)
    assert NEUTRAL.back_swing == NEUTRAL.swing_hold == NEUTRAL.rest == 0.0
    assert NEUTRAL.beyond(share) == NEUTRAL.arriving(share) == 0.0


@given(VALUES, SECONDS, st.floats(0.0, 1.0))
def test_a_movement_is_longer_by_the_logarithm_of_its_duration_and_never_too_short(
    value: float, duration: float, shortest: float
) -> None:
    expected = max(shortest, 0.6 * duration, duration + 1.5 * value * math.log(1.0 + duration))
    assert Expressivity(temporal_extent=value).movement(duration, shortest) == pytest.approx(expected)


@given(VALUES, SECONDS)
def test_a_pause_is_up_to_300_ms_shorter_or_longer(value: float, duration: float) -> None:
    assert Expressivity(fluidity=value).pause(duration) == pytest.approx(max(0.0, duration - 0.3 * value))


@given(VALUES)
def test_power_swings_back_by_a_tenth_and_holds_for_300_ms_and_is_a_fifth_quicker(value: float) -> None:
    power = Expressivity(power=value)
    assert power.back_swing == pytest.approx(0.1 * max(0.0, value))
    assert power.swing_hold == pytest.approx(0.3 * max(0.0, value))
    assert power.speed == pytest.approx(1.0 + 0.2 * value)
    assert power.curvature == pytest.approx(1.0 - value)


@given(VALUES, SHARES)
def test_a_hand_is_beyond_or_behind_only_on_the_way_and_never_by_more_than_an_eighth(
    value: float, share: float
) -> None:
    power = Expressivity(power=value)
    assert 0.0 <= power.beyond(share) <= 0.125 * max(0.0, value)
    assert abs(power.arriving(share)) <= 0.125 * abs(value)
    assert [power.beyond(end) for end in (0.0, 1.0)] == [power.arriving(end) for end in (0.0, 1.0)] == [0.0, 0.0]
