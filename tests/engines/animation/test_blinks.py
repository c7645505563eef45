"""Blinks of a figure: their rate, their intervals and their course."""

from itertools import groupby, pairwise
from pathlib import Path
from random import Random
from statistics import mean, median, stdev

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.engines.animation.blinks import Blinks
from reactive_realizer.engines.animation.idle import Idle
from reactive_realizer.testing.pilot import open_pilot


def lids(blinks: Blinks, time: float) -> float:
    """How far the lids are closed at the rate of the blinks themselves."""
    return blinks.closed(time, time, 1.0)


def begins(blinks: Blinks, seconds: float, rate: int = 100) -> list[float]:
    """The times at which the lids begin to close, s, in frames at a rate, 1/s."""
    frames = [lids(blinks, i / rate) for i in range(round(seconds * rate))]
    return [i / rate for i, (a, b) in enumerate(pairwise(frames)) if a == 0.0 < b]


@pytest.mark.parametrize("rate", [5.0, 17.0, 26.0])
def test_intervals_have_the_mean_of_the_rate_most_are_short_and_a_few_long(rate: float) -> None:
    times = begins(Blinks(Random(7), rate), 1200.0)
    gaps = [after - before for before, after in pairwise(times)]
    assert len(times) / 20.0 == pytest.approx(rate, rel=0.15)
    assert median(gaps) < 0.9 * mean(gaps)
    assert max(gaps) > 2.5 * mean(gaps)
    assert min(gaps) >= 0.49
    assert stdev(gaps) / mean(gaps) == pytest.approx(0.7, abs=0.15)


def test_intervals_vary_as_much_in_any_five_minutes() -> None:
    """Their coefficient of variation is about 0.7 in each: no gap is so long that it dominates them."""
    sessions = (begins(Blinks(Random(seed), 17.0), 300.0, 20) for seed in range(40))
    gaps = ([after - before for before, after in pairwise(times)] for times in sessions)
    assert all(0.5 < stdev(each) / mean(each) < 0.9 for each in gaps)


def test_some_blinks_close_the_lids_only_in_part() -> None:
    blinks = Blinks(Random(7), 17.0)
    frames = [lids(blinks, i / 100) for i in range(120000)]
    depths = [max(closed) for moving, closed in groupby(frames, lambda weight: weight > 0.0) if moving]
    partial = [depth for depth in depths if depth < 0.95]
    assert 0.1 < len(partial) / len(depths) < 0.3
    assert 0.4 < min(partial) < max(partial) < 0.85


def test_lids_close_within_100_ms_and_open_within_150_ms() -> None:
    """They close faster by 40 to 47 %: C. Sforza and others (Ophthalmic and Physiological Optics 28, 2008)."""
    blinks = Blinks(Random(7), 17.0)
    (start, *_) = begins(blinks, 20.0)
    closed = [lids(blinks, start + i / 1000) for i in range(300)]
    shut = closed.index(max(closed))
    assert max(closed) > 0.999
    assert 75 <= shut <= 100
    assert sum(weight > 0.0 for weight in closed[shut:]) == pytest.approx(150, abs=11)


def test_a_requested_blink_starts_at_once_and_a_second_one_within_it_is_none_of_its_own() -> None:
    blinks = Blinks(Random(7), 17.0)
    asked = begins(blinks, 20.0)[0] + 0.4
    blinks.request_blink(asked)
    blinks.request_blink(asked + 0.1)
    closed = [lids(blinks, asked + i / 1000) for i in range(250)]
    assert closed[0] == 0.0 < closed[10]
    assert max(closed) > 0.99
    assert closed[236] == 0.0


def test_a_figure_with_a_rate_of_0_does_not_blink_even_if_it_turns_its_gaze_far() -> None:
    idle = Idle(Random(7), 0.0)
    idle.blink(5.0)
    assert {idle.blinks(i / 50)["eyeBlinkLeft"] for i in range(3000)} == {0.0}


async def test_with_a_blink_rate_of_0_a_character_blinks_only_when_it_is_asked_to(tmp_path: Path) -> None:
    human = tmp_path / "human.toml"
    human.write_text("[character.alice]\nblink_rate = 0\n")
    async with open_pilot(SceneOptions(human, "text")) as pilot:
        pilot.watch()
        pilot.block("b", '<faceLexeme id="f" lexeme="BLINK" start="15"/>')
        await pilot.advance(20)
        lid = pilot.realizer.characters["alice"].humanoid.avatar.morphs.index("eyeBlinkLeft")
        closed = [frame.time for frame in pilot.frames["alice"] if frame.weights[lid] > 0.0]
        assert 15.0 < min(closed) < max(closed) < 15.3
