"""The anticipator `backchannel` finds the places that a low pitch asks for."""

from collections.abc import Iterator
from typing import Any

import pytest

from anticipators.backchannel import Backchannel
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.anticipator_harness import AnticipatorHarness

from .conftest import CONTEXT


def spoken(*parts: tuple[float, float], start: float = 0.0) -> Iterator[tuple[float, float]]:
    """Values of pitch, (s, Hz), 100 per second, with 0 for silence; parts are durations (s) with their pitch."""
    tick = round(start * 100)
    for seconds, pitch in parts:
        for _ in range(round(seconds * 100)):
            yield tick / 100, pitch and pitch + tick % 3
            tick += 1


def places(stage: AnticipatorHarness, listener: Backchannel, values: Iterator[tuple[float, float]]) -> list[float]:
    """The predicted places, in order of prediction."""
    found: list[float] = []
    for time, pitch in values:
        stage.event(time, listener, "pitch", pitch)
        place = stage.time(listener, "backchannel")
        if place is not None and place not in found:
            found.append(place)
    return found


@pytest.fixture
def listener(stage: AnticipatorHarness) -> Backchannel:
    return stage.make("user", Backchannel)


@pytest.mark.parametrize("voice", [90.0, 180.0, 400.0])
def test_a_low_pitch_at_the_end_of_speech_asks_for_a_response_after_seven_tenths_of_a_second(
    stage: AnticipatorHarness, listener: Backchannel, voice: float
) -> None:
    parts = (2.0, voice), (0.3, 0.8 * voice), (1.0, 0.0)
    assert places(stage, listener, spoken(*parts)) == pytest.approx([2.11 + 0.7])


@pytest.mark.parametrize(
    "parts",
    [
        [(2.0, 200.0), (0.1, 150.0), (1.0, 200.0)],
        [(0.6, 200.0), (0.2, 150.0), (1.0, 0.0)],
        [(2.0, 200.0), (0.5, 0.0), (0.2, 150.0), (1.0, 0.0)],
        [(3.0, 200.0)],
        [(2.0, 200.0), (0.08, 150.0), (0.02, 0.0), (0.08, 150.0)],
    ],
    ids=["too short", "too early", "after a pause", "monotonous", "interrupted"],
)
def test_other_speech_asks_for_nothing(
    stage: AnticipatorHarness, listener: Backchannel, parts: list[tuple[float, float]]
) -> None:
    assert places(stage, listener, spoken(*parts)) == []


def test_voiceless_sounds_do_not_interrupt_speech(stage: AnticipatorHarness, listener: Backchannel) -> None:
    parts = (0.5, 200.0), (0.1, 0.0), (0.5, 200.0), (0.2, 150.0)
    assert places(stage, listener, spoken(*parts)) == pytest.approx([1.21 + 0.7])


@pytest.mark.parametrize(("between", "second"), [(1.0, False), (1.4, True)])
def test_two_places_are_at_least_eight_tenths_of_a_second_and_a_wait_apart(
    stage: AnticipatorHarness, listener: Backchannel, between: float, second: bool
) -> None:
    parts = (2.0, 200.0), (0.12, 150.0), (between, 200.0), (0.12, 140.0)
    assert len(places(stage, listener, spoken(*parts))) == 1 + second


def test_a_start_forgets_the_voice_of_the_user_before(stage: AnticipatorHarness, listener: Backchannel) -> None:
    assert places(stage, listener, spoken((1.0, 400.0), (0.12, 300.0)))
    stage.event(1.2, listener, "start")
    assert stage.time(listener, "backchannel") is None
    assert places(stage, listener, spoken((2.0, 200.0), start=1.3)) == []


@pytest.mark.parametrize(
    "wrong", [{"level": 0.0}, {"low": -1.0}, {"speech": 61.0}, {"apart": float("nan")}, {"wait": 11.0}]
)
def test_a_parameter_out_of_range_is_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(RealizerError, match=next(iter(wrong))):
        Backchannel(CONTEXT, **wrong)
