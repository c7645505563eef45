"""Key presses cannot be predicted, and each press makes the next one a new point."""

import pytest

from anticipators.spacebar import Spacebar
from reactive_realizer.pegboard.time_peg import OffsetPeg
from reactive_realizer.testing.anticipator_harness import AnticipatorHarness


@pytest.mark.parametrize("point", ["press", "release"])
def test_a_key_event_is_unknown_until_it_occurs_and_unknown_again_for_later_behaviors(
    stage: AnticipatorHarness, point: str
) -> None:
    key = stage.make("spacebar", Spacebar)
    first = stage.board.predicted("spacebar", point)
    before = first.value
    assert before is None
    stage.event(2.0, key, point)
    assert first.value == 2.0
    assert stage.time(key, point) is None
    second = stage.board.predicted("spacebar", point)
    stage.event(3.0, key, point)
    assert (first.value, second.value) == (2.0, 3.0)


def test_a_press_does_not_affect_the_release(stage: AnticipatorHarness) -> None:
    key = stage.make("spacebar", Spacebar)
    release = stage.board.predicted("spacebar", "release")
    stage.event(2.0, key, "press")
    assert release.value is None


def test_a_dependent_with_an_offset_keeps_its_time(stage: AnticipatorHarness) -> None:
    key = stage.make("spacebar", Spacebar)
    after = OffsetPeg(stage.board.graph, "after", stage.board.predicted("spacebar", "press"), 0.5)
    stage.event(2.0, key, "press")
    stage.event(2.2, key, "press")
    assert after.value == 2.5
