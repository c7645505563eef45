"""A metronome predicts every beat, whatever its tempo was before."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from anticipators.metronome import Metronome
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.reactive.graph import Graph


def metronome(tempo: float = 60.0) -> Metronome:
    return Metronome("m", PegBoard(Graph()), tempo)


def beat(m: Metronome, number: int) -> float:
    time = m._board.predicted("m", f"tick{number}").value
    assert time is not None
    return time


def forecast(m: Metronome, number: int) -> float:
    time = m.forecast(f"tick{number}")
    assert time is not None
    return time


def event(m: Metronome, name: str, value: float | None, now: float) -> None:
    with m._board.graph.transaction("event"):
        m.event(name, value, GlobalTime(now))


def test_beats_are_counted_from_the_start() -> None:
    m = metronome(120)
    assert [beat(m, n) for n in (0, 1, 2, 100)] == [0.0, 0.5, 1.0, 50.0]
    assert m._board.predicted("m", "tock").value is None


def test_a_new_tempo_holds_from_the_beat_before_and_moves_every_beat_ahead() -> None:
    m = metronome(60)
    before = [beat(m, n) for n in range(6)]
    event(m, "tempo", 30, 2.5)
    assert [beat(m, n) for n in range(6)] == [*before[:3], 4.0, 6.0, 8.0]
    assert m.tempo == pytest.approx(30)


def test_a_past_beat_has_its_time_even_if_it_is_named_later() -> None:
    m = metronome(60)
    event(m, "tempo", 120, 2.5)
    assert [beat(m, n) for n in range(5)] == [0.0, 1.0, 2.0, 2.5, 3.0]


def test_a_fast_tempo_does_not_make_several_beats_due_at_once() -> None:
    m = metronome(60)
    assert beat(m, 3) == 3.0
    event(m, "tempo", 240, 2.9)
    assert [beat(m, n) for n in (2, 3, 4)] == pytest.approx([2.0, 2.9, 3.15])


def test_only_the_last_of_several_tempos_between_two_beats_counts() -> None:
    m = metronome(60)
    event(m, "tempo", 30, 2.2)
    event(m, "tempo", 20, 3.5)
    event(m, "tempo", 40, 3.6)
    assert [beat(m, n) for n in (2, 3, 4)] == pytest.approx([2.0, 3.6, 5.1])


def test_a_start_resets_the_count() -> None:
    m = metronome(60)
    assert beat(m, 1) == 1.0
    event(m, "start", None, 10.0)
    assert [beat(m, 0), beat(m, 1)] == [10.0, 11.0]


@pytest.mark.parametrize("tempo", [9.9, 401.0, float("nan"), -60.0, 0.0])
def test_a_tempo_out_of_range_is_refused_and_changes_nothing(tempo: float) -> None:
    m = metronome(60)
    with pytest.raises(RealizerError, match="between 10 and 400"):
        event(m, "tempo", tempo, 1.5)
    assert beat(m, 2) == 2.0
    with pytest.raises(RealizerError):
        metronome(tempo)


@given(st.lists(st.tuples(st.floats(0.01, 3.0), st.integers(10, 400)), max_size=8), st.booleans())
def test_beats_stay_in_order_and_past_ones_keep_their_times(
    changes: list[tuple[float, int]], named_before: bool
) -> None:
    m = metronome(60)
    numbers = range(40)
    if named_before:
        assert [beat(m, n) for n in numbers] == list(numbers)
    now = 0.0
    passed: dict[int, float] = {}
    for wait, tempo in changes:
        now += wait
        passed |= {n: time for n in numbers if (time := forecast(m, n)) <= now}
        event(m, "tempo", tempo, now)
        times = [forecast(m, n) for n in numbers]
        assert times == sorted(times)
        assert all(times[n] == pytest.approx(time, abs=1e-9) for n, time in passed.items())
        assert all(time >= now for n, time in enumerate(times) if n not in passed)
        assert [beat(m, n) for n in numbers] == pytest.approx(times, abs=1e-9)
