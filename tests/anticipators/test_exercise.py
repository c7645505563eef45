"""The anticipator `exercise` predicts the next key moments from accelerations."""

import itertools
from typing import Any

import pytest

from anticipators.exercise import Exercise
from anticipators.peaks import Peaks
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.time_peg import AnticipatorPeg
from reactive_realizer.testing.anticipator_harness import AnticipatorHarness

from .conftest import CONTEXT, acceleration, rhythm_of


def squats(repetitions: int, seed: int, drift: float = 0.0) -> list[float]:
    """Key moments, alternately down and up: 1.2 s to get up and 0.8 s to go down, plus a drift."""
    return rhythm_of(lambda n: (1.2 if n % 2 else 0.8) + drift * n, 2 * repetitions, seed, 0.02)


def move(stage: AnticipatorHarness, exercise: Exercise, samples: list[tuple[float, float]]) -> None:
    for time, magnitude in samples:
        stage.event(time, exercise, "sample", magnitude)


def after(moments: list[float], seed: int) -> list[tuple[float, float]]:
    """The samples until the last of some moments can be recognized."""
    return acceleration(moments, moments[-1] + 0.3, seed)


@pytest.mark.parametrize("seed", range(5))
def test_peaks_are_found_where_they_are_whatever_the_noise(seed: int) -> None:
    moments = squats(10, seed)
    peaks = Peaks(3.0)
    found = [
        peak
        for time, value in acceleration(moments, 25.0, seed)
        if (peak := peaks.take(value, GlobalTime(time))) is not None
    ]
    assert found == pytest.approx(moments, abs=0.06)


@pytest.mark.parametrize("begin", [0.95, 1.0, 1.05, 1.2, 1.8])
def test_it_does_not_matter_in_which_part_of_a_movement_the_samples_begin(begin: float) -> None:
    moments = [1.0 + 1.2 * n for n in range(5)]
    peaks = Peaks(3.0)
    samples = [sample for sample in acceleration(moments, 7.0, 1) if sample[0] >= begin]
    found = [peak for time, value in samples if (peak := peaks.take(value, GlobalTime(time))) is not None]
    assert found[-4:] == pytest.approx(moments[1:], abs=0.06)


def peaks_of(*values: float) -> list[float]:
    """Where peaks are found in samples 0.1 s apart."""
    peaks = Peaks(3.0)
    found = [peaks.take(value, GlobalTime(number / 10)) for number, value in enumerate(values)]
    return [peak for peak in found if peak is not None]


def test_a_peak_with_noise_on_its_way_down_is_one_peak() -> None:
    assert peaks_of(10, 10, 14, 15, 12.5, 14, 12.5, 14, 10, 10) == [0.3]


def test_a_slow_swing_has_its_peak_where_it_is_highest() -> None:
    assert peaks_of(*range(10, 20), 20, *range(19, 9, -1)) == [1.0]


def test_a_resting_user_makes_no_peak() -> None:
    peaks = Peaks(3.0)
    assert not any(peaks.take(value, GlobalTime(time)) for time, value in acceleration([], 30.0, 1))


@pytest.mark.parametrize("seed", range(3))
def test_peaks_are_counted_and_the_next_ones_predicted(stage: AnticipatorHarness, seed: int) -> None:
    moments = rhythm_of(lambda n: 1.0, 10, seed, 0.02)
    exercise = stage.make("trainer", Exercise)
    move(stage, exercise, after(moments[:6], seed))
    assert [stage.time(exercise, str(n)) for n in range(7, 11)] == pytest.approx(moments[6:], abs=0.15)
    assert stage.time(exercise, "11") is None
    assert stage.time(exercise, "0") is None
    assert stage.time(exercise, "down") is None


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("drift", [-0.01, 0.01])
def test_named_peaks_have_intervals_of_their_own_and_follow_a_drifting_tempo(seed: int, drift: float) -> None:
    moments = squats(10, seed, drift)
    for known in range(6, 18):
        with AnticipatorHarness() as stage:
            exercise = stage.make("trainer", Exercise, ("down", "up"))
            move(stage, exercise, after(moments[:known], seed))
            first, second = ("down", "up") if known % 2 == 0 else ("up", "down")
            assert stage.time(exercise, first) == pytest.approx(moments[known], abs=0.15)
            assert stage.time(exercise, second) == pytest.approx(moments[known + 1], abs=0.2)


def test_a_name_means_the_next_peak_and_dependents_keep_theirs(stage: AnticipatorHarness) -> None:
    moments = squats(8, 1)
    exercise = stage.make("trainer", Exercise, ("down", "up"))
    held: list[AnticipatorPeg] = []
    for time, magnitude in acceleration(moments, moments[-1], 1):
        stage.event(time, exercise, "sample", magnitude)
        point = stage.board.predicted("trainer", "down")
        assert point.value is None or point.value > time
        if not held or held[-1] is not point:
            held.append(point)
    times = [point.value for point in held if point.value is not None]
    assert times[:6] == pytest.approx(moments[4::2], abs=0.15)
    assert times == sorted(times)


def test_predictions_stop_when_the_user_rests_and_resume_later(stage: AnticipatorHarness) -> None:
    moments = rhythm_of(lambda n: 1.0 if n != 6 else 20.0, 9, 2, 0.02)
    exercise = stage.make("trainer", Exercise, ("jump",), ahead=3)
    samples = after(moments, 2)
    resting = [(time, value) for time, value in samples if time < moments[5] + 4]
    move(stage, exercise, resting)
    assert stage.time(exercise, "jump") is None
    move(stage, exercise, samples[len(resting) :])
    assert stage.time(exercise, "jump") == pytest.approx(moments[-1] + 1.0, abs=0.15)


def test_a_start_begins_a_new_exercise(stage: AnticipatorHarness) -> None:
    moments = squats(4, 3)
    exercise = stage.make("trainer", Exercise, ("down", "up"))
    move(stage, exercise, after(moments[:5], 3))
    assert stage.time(exercise, "down") is not None
    stage.event(stage.now, exercise, "start")
    assert [stage.time(exercise, sync) for sync in ("down", "up", "1", "7")] == [None] * 4


@pytest.mark.parametrize(
    "wrong",
    [{"rise": 0.0}, {"phase": 0.0}, {"period": float("nan")}, {"ahead": 0.0}],
)
def test_a_parameter_out_of_range_is_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(RealizerError, match=next(iter(wrong))):
        Exercise(CONTEXT, **wrong)


@pytest.mark.parametrize("names", [("3",), ("down", "down"), ("",), ("a b",), ("a:b",), ("a-1",), ("a" * 201,)])
def test_invalid_and_repeated_names_are_refused(names: tuple[str, ...]) -> None:
    with pytest.raises(RealizerError, match="peak"):
        Exercise(CONTEXT, names)


def test_a_high_sampling_rate_gives_the_same_peaks(stage: AnticipatorHarness) -> None:
    moments = rhythm_of(lambda n: 1.0, 6, 1, 0.0)
    exercise = stage.make("trainer", Exercise)
    for time, magnitude in after(moments, 1):
        move(stage, exercise, list(itertools.repeat((time, magnitude), 20)))
    assert stage.time(exercise, "7") == pytest.approx(7.0, abs=0.1)
