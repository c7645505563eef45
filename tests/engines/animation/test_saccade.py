"""Jumps of the eyes (thesis 4.2.2; Carpenter 1988)."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.engines.animation.gaze.saccade import PEAK_VELOCITY, saccade_duration, saccade_progress

amplitudes = st.floats(1e-6, math.pi)
equation = settings(derandomize=True, max_examples=80, deadline=None)


def velocity(amplitude: float, time: float) -> float:
    step = 1e-6
    before, after = (saccade_progress(amplitude, time + way) for way in (-step, step))
    return amplitude * (after - before) / (2 * step)


@pytest.mark.parametrize(("degrees", "milliseconds"), [(0, 21), (5, 32), (10, 43), (20, 65), (40, 109)])
def test_the_duration_is_linear_in_the_amplitude(degrees, milliseconds):
    assert 1000 * saccade_duration(math.radians(degrees)) == pytest.approx(milliseconds)


@equation
@given(amplitudes, st.floats(0, 1))
def test_the_velocity_rises_as_it_falls(amplitude, share):
    duration = saccade_duration(amplitude)
    passed = share * duration
    whole = saccade_progress(amplitude, passed) + saccade_progress(amplitude, duration - passed)
    assert whole == pytest.approx(1.0, abs=1e-9)


@equation
@given(amplitudes, st.floats(0.02, 0.98))
def test_it_never_goes_back_and_never_faster_than_the_plateau(amplitude, share):
    assert -1e-6 <= velocity(amplitude, share * saccade_duration(amplitude)) <= PEAK_VELOCITY * (1 + 1e-4)


@pytest.mark.parametrize(("degrees", "peak"), [(2, 158), (5, 312), (10, 465), (15, 498.5), (40, 498.5), (90, 498.5)])
def test_the_peak_velocity_grows_with_the_amplitude_up_to_the_plateau(degrees, peak):
    amplitude = math.radians(degrees)
    fastest = max(velocity(amplitude, i / 100 * saccade_duration(amplitude)) for i in range(1, 100))
    assert math.degrees(fastest) == pytest.approx(peak, rel=0.01)


def test_it_begins_and_ends_at_rest():
    for degrees in (1, 10, 40):
        amplitude = math.radians(degrees)
        assert saccade_progress(amplitude, 0.0) == 0.0
        assert saccade_progress(amplitude, saccade_duration(amplitude)) == 1.0
        assert velocity(amplitude, 1e-6) < 0.01
        assert saccade_progress(amplitude, 99.0) == 1.0
