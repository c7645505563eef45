"""What tests of anticipators share: somebody who tells them what happens, and rhythms as people produce them."""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import exp
from random import Random

import pytest

from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.reactive.graph import Graph


@dataclass
class Stage:
    """An anticipator on a board of its own, and the hand on its clock."""

    board: PegBoard = field(default_factory=lambda: PegBoard(Graph()))
    now: float = 0.0

    def at(self, now: float, act: Callable[..., None], *arguments: object) -> None:
        """Have something told at a time, as the realizer tells it."""
        self.now = now
        with self.board.graph.transaction("test"):
            act(*arguments, now)

    def event(self, now: float, anticipator: Anticipator, name: str, value: float | None = None) -> None:
        """Have an event happen."""
        anticipator.check(name, value)
        self.at(now, anticipator.advance)
        self.at(now, anticipator.event, name, value)

    def time(self, anticipator: Anticipator, sync: str) -> float | None:
        """When a point is, for whoever names it now."""
        return self.board.predicted(anticipator.id, sync).value


@pytest.fixture
def stage() -> Stage:
    return Stage()


def rhythm_of(interval: Callable[[int], float], beats: int, seed: int, noise: float = 0.015) -> list[float]:
    """Onsets as a person taps them: each ``interval(n)`` s after the one before, and beside that by some noise (s)."""
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
