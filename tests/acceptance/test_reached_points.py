"""When a ready or a stroke is reported, the hand is there: in random sessions with tight ties and late predictions."""

import pytest

from .reached_points import examine


@pytest.mark.parametrize("seed", [*range(20), 116, 1127, 1583, 3389, 3498, 31373, 32215, 40776, 51017, 52983])
async def test_a_hand_is_where_its_motion_wants_it_when_its_point_is_reported(seed: int) -> None:
    assert [point for point in await examine(seed) if point.missed] == []
