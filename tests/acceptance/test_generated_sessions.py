"""Laws of any session, in random ones (`python -m benchmarks generated` plays more)."""

from random import Random

import pytest

from reactive_realizer.testing.random_session import random_session
from reactive_realizer.testing.session_laws import examine


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("strategy", ["convex", "embr", "smartbody"])
async def test_a_random_session_breaks_no_law(strategy: str, seed: int) -> None:
    assert (await examine(random_session(Random(seed)), strategy)).breaches == []


async def test_a_stroke_that_follows_its_start_is_not_hurried_by_what_its_start_gives_way() -> None:
    """In this session, the start of a stroke comes late, and the stroke is tied to a gaze that begins with it."""
    assert (await examine(random_session(Random(314454)), "smartbody")).breaches == []


@pytest.mark.parametrize("strategy", ["convex", "embr"])
async def test_points_that_move_with_a_later_one_in_the_past_come_in_the_present_tick(strategy: str) -> None:
    """In this session, a gaze and a pointing that start relative to each other begin late, one because of the other."""
    assert (await examine(random_session(Random(300203)), strategy)).breaches == []


async def test_a_stroke_does_not_push_its_end_beyond_a_point_that_cannot_wait() -> None:
    """In this session, a gesture relaxes at a time that is left of a dropped one, too soon after its stroke."""
    assert (await examine(random_session(Random(301374)), "convex")).breaches == []


def test_a_seed_always_gives_the_same_session() -> None:
    assert random_session(Random(5)) == random_session(Random(5)) != random_session(Random(6))
