"""The anticipator `tap` predicts the next beat and offbeat from the taps of a user."""

import pytest

from anticipators.tap import Tap
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.anticipator import AnticipatorEvent
from reactive_realizer.testing.anticipator_harness import AnticipatorHarness

from .conftest import CONTEXT, rhythm_of


@pytest.fixture
def foot(stage: AnticipatorHarness) -> Tap:
    return stage.make("foot", Tap)


def tapped(stage: AnticipatorHarness, foot: Tap, *taps: float) -> tuple[float | None, float | None]:
    """The next beat and offbeat after some taps."""
    for tap in taps:
        stage.event(tap, foot, "tap")
    return stage.time(foot, "beat"), stage.time(foot, "offbeat")


def test_the_second_tap_makes_a_rhythm(stage: AnticipatorHarness, foot: Tap) -> None:
    assert tapped(stage, foot, 1.0) == (None, None)
    assert tapped(stage, foot, 1.8) == pytest.approx((2.6, 2.2))


def test_the_names_mean_the_next_moments_as_time_passes(stage: AnticipatorHarness, foot: Tap) -> None:
    tapped(stage, foot, 1.0, 2.0)
    expected = {2.4: (3.0, 2.5), 2.5: (3.0, 3.5), 2.9: (3.0, 3.5), 3.0: (4.0, 3.5), 3.7: (4.0, 4.5)}
    for now, moments in expected.items():
        stage.tick(now)
        assert (stage.time(foot, "beat"), stage.time(foot, "offbeat")) == pytest.approx(moments)


def test_the_beats_follow_the_taps_half_the_way(stage: AnticipatorHarness, foot: Tap) -> None:
    assert tapped(stage, foot, 1.0, 2.0, 3.1) == pytest.approx((4.07, 3.535), abs=0.01)


def test_the_rhythm_goes_on_for_four_beats_without_taps(stage: AnticipatorHarness, foot: Tap) -> None:
    tapped(stage, foot, 1.0, 2.0)
    coming = []
    for tick in range(200, 900):
        stage.tick(tick / 100)
        coming.append(stage.time(foot, "beat"))
    assert list(dict.fromkeys(coming)) == pytest.approx([3.0, 4.0, 5.0, 6.0, None])


@pytest.mark.parametrize("seed", range(3))
def test_a_person_who_speeds_up_is_followed(stage: AnticipatorHarness, foot: Tap, seed: int) -> None:
    taps = rhythm_of(lambda n: 0.8 * 0.99**n, 40, seed)
    waiting, beats = stage.board.predicted("foot", "beat"), []
    for tick in range(round(taps[-1] * 100)):
        entered = [AnticipatorEvent("tap") for tap in taps if tick - 1 < tap * 100 <= tick]
        stage.tick(tick / 100, *((foot, tap) for tap in entered))
        if (coming := stage.board.predicted("foot", "beat")) is not waiting:
            beats.append(waiting.value or 0.0)
            waiting = coming
    assert len(beats) == pytest.approx(len(taps) - 2, abs=1), "the first two are not predicted"
    assert [min(abs(beat - tap) for tap in taps) < 0.1 for beat in beats[3:]] == [True] * len(beats[3:])


def test_a_start_forgets_the_rhythm(stage: AnticipatorHarness, foot: Tap) -> None:
    tapped(stage, foot, 1.0, 2.0)
    stage.event(2.2, foot, "start")
    assert (stage.time(foot, "beat"), stage.time(foot, "offbeat")) == (None, None)
    assert tapped(stage, foot, 5.0, 5.5) == (6.0, 5.75)


@pytest.mark.parametrize("wrong", [{"phase": 0.0}, {"period": 2.0}, {"ahead": 0.0}])
def test_a_parameter_out_of_range_is_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(RealizerError, match=next(iter(wrong))):
        Tap(CONTEXT, **wrong)
