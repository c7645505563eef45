"""The anticipator `conducting` predicts the next beats from those that it hears."""

import pytest

from anticipators.conducting import Conducting
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.anticipator_harness import AnticipatorHarness

from .conftest import CONTEXT, rhythm_of


def play(stage: AnticipatorHarness, conducting: Conducting, *beats: float) -> None:
    for beat in beats:
        stage.event(beat, conducting, "beat")


def test_beats_are_counted_from_the_first_that_is_heard(stage: AnticipatorHarness) -> None:
    conducting = stage.make("c", Conducting)
    assert stage.time(conducting, "beat1") is None
    play(stage, conducting, 2.0, 2.5)
    assert [stage.time(conducting, f"beat{n}") for n in (0, 1, 2, 3, 5)] == [None, 2.0, 2.5, 3.0, 4.0]
    assert stage.time(conducting, "bar1") is None


def test_every_beat_moves_those_ahead_and_none_that_passed(stage: AnticipatorHarness) -> None:
    conducting = stage.make("c", Conducting)
    play(stage, conducting, 0.0, 1.0)
    assert [stage.time(conducting, f"beat{n}") for n in (2, 3, 4)] == [1.0, 2.0, 3.0]
    play(stage, conducting, 2.1)
    assert [stage.time(conducting, f"beat{n}") for n in (2, 3, 4)] == pytest.approx([1.0, 2.0, 3.07])


@pytest.mark.parametrize("seed", range(3))
def test_a_slowing_tempo_is_followed(stage: AnticipatorHarness, seed: int) -> None:
    conducting = stage.make("c", Conducting)
    for number, beat in enumerate(rhythm_of(lambda n: 0.5 * 1.01**n, 50, seed), start=1):
        if number > 4:
            assert stage.time(conducting, f"beat{number}") == pytest.approx(beat, abs=0.1)
        play(stage, conducting, beat)


def test_a_limited_number_of_beats_is_predicted(stage: AnticipatorHarness) -> None:
    conducting = stage.make("c", Conducting, ahead=4)
    play(stage, conducting, 0.0, 1.0)
    assert [stage.time(conducting, f"beat{n}") for n in (6, 7)] == [5.0, None]
    play(stage, conducting, 2.0)
    assert [stage.time(conducting, f"beat{n}") for n in (6, 7)] == [5.0, 6.0]


def test_a_start_forgets_the_music(stage: AnticipatorHarness) -> None:
    conducting = stage.make("c", Conducting)
    play(stage, conducting, 0.0, 1.0)
    assert stage.time(conducting, "beat3") == 2.0
    stage.event(5.0, conducting, "start")
    assert [stage.time(conducting, f"beat{n}") for n in (1, 2, 3)] == [None, None, None]
    play(stage, conducting, 9.0, 9.5)
    assert [stage.time(conducting, f"beat{n}") for n in (1, 2, 3)] == [9.0, 9.5, 10.0]


def test_beats_closer_than_a_fifth_of_a_second_are_ignored(stage: AnticipatorHarness) -> None:
    conducting = stage.make("c", Conducting)
    play(stage, conducting, *(n / 1000 for n in range(2001)))
    assert [stage.time(conducting, f"beat{n}") for n in (1, 6, 11, 12)] == pytest.approx([0.0, 1.0, 2.0, 2.2], abs=0.01)


@pytest.mark.parametrize("wrong", [{"phase": 0.0}, {"phase": float("nan")}, {"period": 2.0}, {"ahead": 1e9}])
def test_a_parameter_out_of_range_is_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(RealizerError, match=next(iter(wrong))):
        Conducting(CONTEXT, **wrong)
