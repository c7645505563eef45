"""The pitch of a sound is estimated."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.liveliness.pitch import HIGHEST, LOWEST, STEP, pitches

from .conftest import RATE, voice


@given(pitch=st.floats(LOWEST + 5.0, HIGHEST - 20.0), rate=st.sampled_from([16_000, 22_050, 24_000, 48_000]))
def test_a_voice_has_its_pitch_within_a_fifth_of_a_semitone(pitch: float, rate: int) -> None:
    found = pitches(voice(pitch, rate=rate), rate)
    assert 12.0 * abs(np.log2(np.nanmedian(found) / pitch)) < 0.2


def test_it_is_given_in_steps() -> None:
    assert len(pitches(voice(200.0, 1.0), RATE)) == pytest.approx(1.0 / STEP, abs=1)


def test_noise_and_silence_have_none() -> None:
    noise = np.random.default_rng(1).normal(0.0, 3000.0, RATE).astype("<i2").tobytes()
    assert np.isnan(pitches(noise, RATE)).mean() > 0.9
    assert np.isnan(pitches(bytes(RATE), RATE)).all()


@pytest.mark.parametrize("sound", [b"", bytes(20)])
def test_a_sound_that_is_too_short_has_none(sound: bytes) -> None:
    assert not len(pitches(sound, RATE))
