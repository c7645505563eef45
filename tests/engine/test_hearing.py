"""The drift of a sound from noisy reports."""

from random import Random

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioHeard
from reactive_realizer.engine.hearing import FRAME, MOST, Hearing
from reactive_realizer.errors import RealizerError


def report(position: float, late: float) -> AudioHeard:
    return AudioHeard("alice-speech-1", position, GlobalTime(2.0 + position + late))


@pytest.fixture
def hearing() -> Hearing:
    """Of a sound that started at 2 s."""
    return Hearing(GlobalTime(2.0))


@pytest.mark.parametrize("seed", range(5))
def test_noise_as_of_a_browser_moves_nothing(hearing: Hearing, seed: int) -> None:
    noise = Random(seed)
    assert all(hearing.take(report(0.25 * k, noise.gauss(0.0, 0.006))) == 0 for k in range(1000))


@pytest.mark.parametrize("late", [0.05, -0.05, 0.9])
@pytest.mark.parametrize("seed", range(5))
def test_a_drift_is_made_up_for_after_two_reports_up_to_a_frame(hearing: Hearing, late: float, seed: int) -> None:
    noise = Random(seed)
    changes = [hearing.take(report(0.25 * k, late + noise.gauss(0.0, 0.006))) for k in range(200)]
    assert changes[0] == 0 != changes[1]
    assert sum(change != 0 for change in changes) <= 2
    assert hearing.origin - 2.0 == pytest.approx(late, abs=FRAME)


@pytest.mark.parametrize("outlier", [0.5, -0.5])
def test_a_single_wrong_report_moves_nothing(hearing: Hearing, outlier: float) -> None:
    for k in range(100):
        assert hearing.take(report(0.25 * k, outlier if k % 3 == 0 else 0.004)) == 0


@pytest.mark.parametrize("late", [1.01, -1.01, float("nan")])
def test_what_cannot_be_true_is_refused(hearing: Hearing, late: float) -> None:
    with pytest.raises(RealizerError):
        hearing.check(report(1.0, late))


def test_the_whole_drift_is_limited(hearing: Hearing) -> None:
    for late in (0.6, 0.99, 1.4, 1.9):
        for _ in range(3):
            heard = report(5.0, late)
            try:
                hearing.check(heard)
            except RealizerError:
                continue
            hearing.take(heard)
    assert 0.9 < hearing.drift <= MOST
