"""When a ready or a stroke is reported, the hand is there: in random blocks with tight ties and late predictions."""

import pytest

from .reached_points import examine


@pytest.mark.parametrize("first", range(0, 40, 10))
async def test_a_hand_is_where_its_motion_wants_it_when_its_point_is_reported(first: int) -> None:
    for seed in range(first, first + 10):
        assert await examine(seed) == [], seed
