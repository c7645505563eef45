"""Soles of feet, in frames."""

import math

import numpy as np
import numpy.typing as npt

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import rotate
from reactive_realizer.embodiment.vector import UP, distance

from .standing import FEET

FRAME = 0.02
_PARTS = ("ankle", "midtarsal")

Values = npt.NDArray[np.float64]


def heights(bodies: list[Body]) -> Values:
    """How much higher than in standing the lower end of each foot is, (frames, 2), m."""
    standing = Body(bodies[0].skeleton)
    thick = [[standing.transform(f"{side}_{part}").position[1] for part in _PARTS] for side in "lr"]
    lowest: Values = (_places(bodies)[..., 1] - np.array(thick)).min(axis=2)
    return lowest


def speeds(bodies: list[Body]) -> Values:
    """The speed over the ground of the faster end of each foot, (frames - 1, 2), m/s."""
    ways = np.diff(_places(bodies)[..., [0, 2]], axis=0)
    fastest: Values = np.linalg.norm(ways, axis=3).max(axis=2) / FRAME
    return fastest


def slides(bodies: list[Body]) -> Values:
    """The speeds of each foot while it is less than a centimeter above the ground, else 0, (frames - 1, 2), m/s."""
    high = heights(bodies)
    return np.where(np.maximum(high[1:], high[:-1]) < 0.01, speeds(bodies), 0.0)


def planted(bodies: list[Body]) -> float:
    """The largest distance of a foot from its first position, m."""
    first = bodies[0]
    return max(
        distance(body.transform(foot).position, first.transform(foot).position) for body in bodies for foot in FEET
    )


def flat(bodies: list[Body]) -> float:
    """The steepest that a sole was, degrees."""
    ups = (rotate(body.transform(foot).rotation, UP)[1] for body in bodies for foot in FEET)
    return max(math.degrees(math.acos(min(1.0, up))) for up in ups)


def _places(bodies: list[Body]) -> Values:
    places = [[[body.transform(f"{side}_{part}").position for part in _PARTS] for side in "lr"] for body in bodies]
    return np.array(places)
