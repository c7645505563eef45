"""What tests of expressivity measure in frames."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.engines.animation.arm_shift import CarriedArm
from reactive_realizer.testing.pilot import RealizerPilot

POINTS = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")
FRAME = 0.02


def parameters(values: Mapping[str, object]) -> str:
    """The children of a behavior that set parameters."""
    return "".join(f'<bmlt:parameter name="{name}" value="{value}"/>' for name, value in values.items())


def gesture(lexeme: str = "BEAT", mode: str = "RIGHT_HAND", syncs: str = 'start="0.2"', **values: object) -> str:
    return f'<gesture id="g" lexeme="{lexeme}" mode="{mode}" {syncs}>{parameters(values)}</gesture>'


def pointing(target: str = "bluebox", syncs: str = 'start="0.2"', **values: object) -> str:
    return f'<pointing id="g" target="{target}" mode="RIGHT_HAND" {syncs}>{parameters(values)}</pointing>'


@dataclass(frozen=True)
class Performance:
    """A gesture as it was shown.

    Attributes:
        points: their times, s.
        frames: times of the frames, s, (F,).
        hand: place of the right wrist in the trunk, m, (F, 3).
    """

    points: Mapping[str, float]
    frames: NDArray[np.float64]
    hand: NDArray[np.float64]

    @property
    def durations(self) -> NDArray[np.float64]:
        """Of the six phases between the points, s."""
        return np.diff(np.array([self.points[point] for point in POINTS]))

    def at(self, time: float) -> NDArray[np.float64]:
        """Where the hand is at a time, m."""
        return np.array([np.interp(time, self.frames, column) for column in self.hand.T])

    def between(self, first: str, last: str) -> NDArray[np.float64]:
        """Where the hand is from one point to another one, m, (F, 3)."""
        inside = (self.frames >= self.points[first] - 1e-6) & (self.frames <= self.points[last] + 1e-6)
        return np.vstack([self.at(self.points[first]), self.hand[inside], self.at(self.points[last])])

    @property
    def stroke(self) -> NDArray[np.float64]:
        """The way from strokeStart to the stroke, m."""
        return self.at(self.points["stroke"]) - self.at(self.points["strokeStart"])


async def performed(pilot: RealizerPilot, behaviors: str, seconds: float = 4.0, behavior: str = "g") -> Performance:
    """Plays a block with a gesture, and measures it."""
    begun = len(pilot.frames.get("alice", ()))
    block = f"b{begun}"
    pilot.block(block, behaviors)
    await pilot.advance(seconds)
    bodies = pilot.bodies()[begun:]
    arm = CarriedArm.of(bodies[0].skeleton, "r")
    frames = np.array([frame.time for frame in pilot.frames["alice"][begun:]])
    points = {point: pilot.feedback.time(f"{block}:{behavior}:{point}") for point in POINTS}
    return Performance(points, frames, np.array([arm.place({}, body) for body in bodies]))


def accelerations(places: Any) -> NDArray[np.float64]:
    """Of a path in frames, m/s^2."""
    return np.asarray(np.linalg.norm(np.diff(places, n=2, axis=0), axis=1) / FRAME**2)
