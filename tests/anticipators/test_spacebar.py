"""A key happens when it happens, and then there is a next time."""

import pytest

from anticipators.spacebar import Spacebar
from reactive_realizer.pegboard.time_peg import OffsetPeg


@pytest.mark.parametrize("point", ["press", "release"])
def test_it_is_unknown_until_it_happens_and_unknown_again_for_whoever_comes_later(stage, point) -> None:
    key = Spacebar("spacebar", stage.board)
    first = stage.board.predicted("spacebar", point)
    assert first.value is None
    stage.event(2.0, key, point)
    assert first.value == 2.0
    assert stage.time(key, point) is None
    second = stage.board.predicted("spacebar", point)
    stage.event(3.0, key, point)
    assert (first.value, second.value) == (2.0, 3.0)


def test_a_press_is_no_release(stage) -> None:
    key = Spacebar("spacebar", stage.board)
    release = stage.board.predicted("spacebar", "release")
    stage.event(2.0, key, "press")
    assert release.value is None


def test_what_is_to_come_some_time_after_it_keeps_its_time(stage) -> None:
    key = Spacebar("spacebar", stage.board)
    after = OffsetPeg(stage.board.graph, "after", stage.board.predicted("spacebar", "press"), 0.5)
    stage.event(2.0, key, "press")
    stage.event(2.2, key, "press")
    assert after.value == 2.5
