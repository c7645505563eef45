"""Shared by the tests of anticipators: a harness, and rhythms like those of people."""

from collections.abc import Callable, Iterator
from math import exp
from random import Random

import pytest

from reactive_realizer.clock.tick_clock import TickClock
from reactive_realizer.pegboard.anticipator import AnticipatorContext
from reactive_realizer.testing.anticipator_harness import AnticipatorHarness

CONTEXT = AnticipatorContext("it", TickClock())
"""For anticipators whose streams do not run."""


@pytest.fixture
def stage() -> Iterator[AnticipatorHarness]:
    with AnticipatorHarness() as stage:
        yield stage


def rhythm_of(interval: Callable[[int], float], beats: int, seed: int, noise: float = 0.015) -> list[float]:
    """Onsets like those of a tapping person: each ``interval(n)`` s after the previous one, with noise (s)."""
    random = Random(seed)
    times = [1.0]
    for beat in range(1, beats):
        times.append(times[-1] + interval(beat))
    return [time + random.gauss(0.0, noise) for time in times]


def acceleration(moments: list[float], seconds: float, seed: int) -> list[tuple[float, float]]:
    """Times and magnitudes (m/s²) of an accelerometer, 50 a second: gravity, noise, and a swing at each key moment."""
    random = Random(seed)
    times = [n / 50 for n in range(round(seconds * 50))]
    swings = [sum(8.0 * exp(-(((time - moment) / 0.08) ** 2)) for moment in moments) for time in times]
    return [(time, abs(9.81 + swing + random.gauss(0.0, 0.4))) for time, swing in zip(times, swings, strict=True)]
