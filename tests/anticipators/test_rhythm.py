"""A rhythm is followed in spite of noise, drift, lost beats and doubled beats."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from anticipators.rhythm import Rhythm
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import RealizerError

from .conftest import rhythm_of


def rhythm(phase: float = 0.5, period: float = 0.2, ahead: int = 16, cycle: int = 1) -> Rhythm:
    return Rhythm(phase, period, ahead, 0.2, 3.0, cycle)


def hear(heard: Rhythm, *onsets: float) -> Rhythm:
    for onset in onsets:
        heard.hear(GlobalTime(onset), GlobalTime(onset))
    return heard


def next_times(heard: Rhythm, count: int) -> list[float | None]:
    return [heard.time(heard.passed + number) for number in range(1, count + 1)]


def errors(heard: Rhythm, onsets: list[float], settled: int = 4) -> list[float]:
    """The distance of each onset from its last prediction, s, once the rhythm has settled."""
    found = []
    for number, onset in enumerate(onsets, start=1):
        expected = heard.time(number)
        if number > settled:
            assert expected is not None
            found.append(abs(expected - onset))
        heard.hear(GlobalTime(onset), GlobalTime(onset))
    return found


def test_two_beats_make_a_tempo_and_one_does_not() -> None:
    heard = hear(rhythm(), 1.0)
    assert (heard.time(1), heard.time(2)) == (1.0, None)
    hear(heard, 1.5)
    assert [heard.time(n) for n in (1, 2, 3, 4)] == [1.0, 1.5, 2.0, 2.5]


def test_equal_beats_are_predicted_exactly() -> None:
    heard = hear(rhythm(), *(1 + 0.6 * n for n in range(20)))
    assert next_times(heard, 3) == pytest.approx([13.0, 13.6, 14.2])


def test_an_error_is_corrected_in_phase_and_in_period() -> None:
    late = hear(rhythm(phase=0.5, period=0.2), 0.0, 1.0, 2.1)
    assert next_times(late, 3) == pytest.approx([2.05 + 1.02, 2.05 + 2.04, 2.05 + 3.06])
    assert late.time(3) == 2.0
    early = hear(rhythm(phase=0.5, period=0.2), 0.0, 1.0, 1.9)
    assert next_times(early, 3) == pytest.approx([1.95, 1.95 + 0.98, 1.95 + 1.96])


@pytest.mark.parametrize("seed", range(5))
def test_noise_of_taps_is_not_amplified(seed: int) -> None:
    found = errors(rhythm(), rhythm_of(lambda beat: 0.6, 60, seed))
    assert sum(found) / len(found) < 0.025
    assert max(found) < 0.08


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("change", [-0.003, 0.003])
def test_a_tempo_that_drifts_is_followed(seed: int, change: float) -> None:
    found = errors(rhythm(), rhythm_of(lambda beat: 0.6 + change * beat, 60, seed))
    assert sum(found) / len(found) < 0.035
    assert max(found) < 0.1


@pytest.mark.parametrize("seed", range(5))
def test_a_missed_beat_is_counted(seed: int) -> None:
    onsets = rhythm_of(lambda beat: 0.6, 40, seed)
    missed = {9, 10, 20, 31}
    heard = rhythm()
    for beat, onset in enumerate(onsets, start=1):
        if beat > 4:
            assert heard.time(beat) == pytest.approx(onset, abs=0.1)
        if beat not in missed:
            hear(heard, onset)


@pytest.mark.parametrize("echo", [0.02, 0.12, 0.17, 0.25, 0.35])
def test_a_beat_that_is_doubled_counts_once(echo: float) -> None:
    heard = rhythm()
    for beat in range(30):
        hear(heard, 0.6 * beat)
        if beat % 7 == 3:
            hear(heard, 0.6 * beat + echo)
    hear(heard, 18.0)
    assert next_times(heard, 2) == pytest.approx([18.6, 19.2])
    assert heard.time(31) == 18.0


def test_a_slow_beat_may_be_doubled_later() -> None:
    heard = hear(rhythm(), 0.0, 2.0, 4.0, 4.3, 6.0, 6.5)
    assert next_times(heard, 2) == [8.0, 10.0]


def test_notes_between_beats_are_ignored() -> None:
    heard = hear(rhythm(), 0.0, 1.0, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5)
    assert next_times(heard, 2) == pytest.approx([5.0, 6.0])


def test_two_onsets_in_a_row_between_beats_are_a_new_tempo() -> None:
    heard = hear(rhythm(), 0.0, 1.0, 2.0, 3.0, 3.65, 4.35)
    assert next_times(heard, 3) == pytest.approx([5.05, 5.75, 6.45])
    assert [heard.time(n) for n in (4, 5, 6)] == [3.0, 4.0, 4.35]
    hear(heard, 4.75)
    assert next_times(heard, 1) == pytest.approx([5.05])


def test_a_new_tempo_may_be_faster_than_the_old_one() -> None:
    heard = hear(rhythm(), 0.0, 1.0, 2.0, 3.0, 3.35, 3.65)
    assert next_times(heard, 2) == pytest.approx([3.95, 4.25])


def test_two_onsets_far_apart_are_no_new_tempo() -> None:
    heard = hear(rhythm(), 0.0, 1.0, 2.0, 3.5, 8.5)
    assert next_times(heard, 2) == [9.0, 10.0]


def test_an_interval_that_is_too_long_is_ignored() -> None:
    heard = hear(rhythm(), 0.0, 9.0)
    assert (heard.time(2), heard.time(3)) == (9.0, None)
    hear(heard, 9.5)
    assert heard.time(4) == 10.0


def test_after_a_rest_the_next_beat_continues_the_count_in_the_last_tempo() -> None:
    heard = hear(rhythm(ahead=3), 0.0, 0.5, 1.0)
    assert next_times(heard, 4) == pytest.approx([1.5, 2.0, 2.5, None])
    hear(heard, 20.1)
    assert heard.time(7) == 20.1
    assert next_times(heard, 4) == pytest.approx([20.6, 21.1, 21.6, None])


def test_beats_that_repeat_in_a_cycle_have_intervals_of_their_own() -> None:
    heard = hear(rhythm(cycle=2), 0.0, 1.5)
    assert heard.time(3) is None
    hear(heard, 2.5, 4.0, 5.0, 6.5)
    assert next_times(heard, 4) == pytest.approx([7.5, 9.0, 10.0, 11.5])


def test_an_onset_reported_late_counts_at_its_own_time() -> None:
    heard = hear(rhythm(), 0.0, 1.0)
    heard.hear(GlobalTime(2.1), GlobalTime(2.4))
    assert heard.time(4) == pytest.approx(2.05 + 1.02)


@pytest.mark.parametrize("late", [0.0, 0.05])
def test_a_predicted_beat_after_which_none_is_known_counts_once(late: float) -> None:
    # Of two intervals that repeat, only that of 1 s is known, and the next beat would be at 6.
    heard = hear(rhythm(cycle=2), 0.0, 1.0, 5.0, 6.0 + late)
    assert heard.passed == 4
    assert heard.coming is None


def test_onsets_out_of_order_are_ignored() -> None:
    heard = hear(rhythm(), 0.0, 1.0, 2.0)
    assert not heard.hear(GlobalTime(1.5), GlobalTime(2.1))
    assert next_times(heard, 1) == [3.0]


@pytest.mark.parametrize(
    ("wrong", "name"),
    [({"phase": 0.0}, "phase"), ({"phase": 1.1}, "phase"), ({"period": -0.1}, "period"), ({"ahead": 0}, "ahead")],
)
def test_the_name_of_a_parameter_out_of_range_is_reported(wrong: dict[str, Any], name: str) -> None:
    with pytest.raises(RealizerError, match=name):
        rhythm(**wrong)


@given(
    st.lists(st.floats(0.0, 4.0), max_size=40),
    st.floats(0.01, 1.0),
    st.floats(0.0, 1.0),
    st.integers(1, 20),
    st.integers(1, 3),
)
def test_beats_stay_in_order_and_past_ones_keep_their_times_for_any_onsets(
    waits: list[float], phase: float, period: float, ahead: int, cycle: int
) -> None:
    heard = rhythm(phase, period, ahead, cycle)
    now = 0.0
    passed: list[GlobalTime] = []
    for wait in waits:
        now += wait
        heard.hear(GlobalTime(now), GlobalTime(now))
        times = [heard.time(number) for number in range(1, heard.passed + ahead + 2)]
        known = [time for time in times if time is not None]
        assert known == sorted(known)
        assert times[: len(known)] == known
        assert known[: len(passed)] == pytest.approx(passed, abs=1e-9)
        assert len(known) <= heard.passed + ahead + 1
        passed = known[: heard.passed]
        assert not passed or passed[-1] <= now + 1e-9
