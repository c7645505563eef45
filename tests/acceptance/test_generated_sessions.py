"""Laws of any session, in random ones (`python -m benchmarks generated` plays more)."""

from random import Random

import pytest

from reactive_realizer.testing.random_session import random_session
from reactive_realizer.testing.session_laws import examine


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("strategy", ["convex", "embr", "smartbody"])
async def test_a_random_session_breaks_no_law(strategy: str, seed: int) -> None:
    assert (await examine(random_session(Random(seed)), strategy)).breaches == []


def test_a_seed_always_gives_the_same_session() -> None:
    assert random_session(Random(5)) == random_session(Random(5)) != random_session(Random(6))
