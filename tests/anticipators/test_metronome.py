"""A metronome predicts every beat, whatever its tempo was before."""

from collections.abc import Iterator

import pytest
from hypothesis import given
from hypothesis import strategies as st

from anticipators.metronome import Metronome
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.anticipator_harness import AnticipatorHarness

from .conftest import CONTEXT


class Stage(AnticipatorHarness):
    """A harness with a metronome."""

    def __init__(self, tempo: float = 60.0) -> None:
        super().__init__()
        self.metronome = self.make("m", Metronome, tempo)

    def beat(self, number: int) -> float:
        time = self.time(self.metronome, f"tick{number}")
        assert time is not None
        return time

    def forecast(self, number: int) -> float:
        return self.metronome.forecast(f"tick{number}")

    def send(self, name: str, value: float | None, now: float) -> None:
        self.event(now, self.metronome, name, value)


@pytest.fixture
def m() -> Iterator[Stage]:
    with Stage() as stage:
        yield stage


def test_beats_are_counted_from_the_start() -> None:
    with Stage(120) as m:
        assert [m.beat(n) for n in (0, 1, 2, 100)] == [0.0, 0.5, 1.0, 50.0]
        assert m.time(m.metronome, "tock") is None


def test_a_new_tempo_holds_from_the_beat_before_and_moves_every_beat_ahead(m: Stage) -> None:
    before = [m.beat(n) for n in range(6)]
    m.send("tempo", 30, 2.5)
    assert [m.beat(n) for n in range(6)] == [*before[:3], 4.0, 6.0, 8.0]
    assert m.metronome.tempo == pytest.approx(30)


def test_a_past_beat_has_its_time_even_if_it_is_named_later(m: Stage) -> None:
    m.send("tempo", 120, 2.5)
    assert [m.beat(n) for n in range(5)] == [0.0, 1.0, 2.0, 2.5, 3.0]


def test_a_fast_tempo_does_not_make_several_beats_due_at_once(m: Stage) -> None:
    assert m.beat(3) == 3.0
    m.send("tempo", 240, 2.9)
    assert [m.beat(n) for n in (2, 3, 4)] == pytest.approx([2.0, 2.9, 3.15])


def test_only_the_last_of_several_tempos_between_two_beats_counts(m: Stage) -> None:
    m.send("tempo", 30, 2.2)
    m.send("tempo", 20, 3.5)
    m.send("tempo", 40, 3.6)
    assert [m.beat(n) for n in (2, 3, 4)] == pytest.approx([2.0, 3.6, 5.1])


def test_a_start_resets_the_count(m: Stage) -> None:
    assert m.beat(1) == 1.0
    m.send("start", None, 10.0)
    assert [m.beat(0), m.beat(1)] == [10.0, 11.0]


@pytest.mark.parametrize("tempo", [9.9, 401.0, float("nan"), -60.0, 0.0])
def test_a_tempo_out_of_range_is_refused_and_changes_nothing(m: Stage, tempo: float) -> None:
    with pytest.raises(RealizerError, match="between 10 and 400"):
        m.send("tempo", tempo, 1.5)
    assert m.beat(2) == 2.0
    with pytest.raises(RealizerError):
        Metronome(CONTEXT, tempo)


@given(st.lists(st.tuples(st.floats(0.01, 3.0), st.integers(10, 400)), max_size=8), st.booleans())
def test_beats_stay_in_order_and_past_ones_keep_their_times(
    changes: list[tuple[float, int]], named_before: bool
) -> None:
    with Stage() as m:
        numbers = range(40)
        if named_before:
            assert [m.beat(n) for n in numbers] == list(numbers)
        now = 0.0
        passed: dict[int, float] = {}
        for wait, tempo in changes:
            now += wait
            passed |= {n: time for n in numbers if (time := m.forecast(n)) <= now}
            m.send("tempo", tempo, now)
            times = [m.forecast(n) for n in numbers]
            assert times == sorted(times)
            assert all(times[n] == pytest.approx(time, abs=1e-9) for n, time in passed.items())
            assert all(time >= now for n, time in enumerate(times) if n not in passed)
            assert [m.beat(n) for n in numbers] == pytest.approx(times, abs=1e-9)
