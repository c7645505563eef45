"""Geometry of the eyes: position, gaze direction, range (Listing's law), and the lids."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Self

from reactive_realizer.bml.vocabulary import OffsetDirection
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.humanoid import between_eyes
from reactive_realizer.embodiment.joints import EYES
from reactive_realizer.embodiment.quaternion import Quat, angle, between, conjugate, power, rotate
from reactive_realizer.embodiment.vector import (
    FORWARD,
    UP,
    Vec3,
    add,
    cross,
    distance,
    length,
    rejected,
    scale,
    subtract,
    unit,
)

EYE_RANGE = 2.0 * math.asin(math.sqrt(0.12))
"""Range of an eye to each side and down from straight ahead, rad (40.5 degrees).

The squares of the vertical and horizontal components of its quaternion add up to at most 0.12: D. Tweed,
"Three-dimensional model of the human eye-head saccadic system" (Journal of Neurophysiology 77, 1997).
"""

EYE_RANGE_UP = math.radians(30.0)
"""Range of an eye upward, rad; it is smaller, and decreases with age.

W. J. Lee and others, "Differences in eye movement range based on age and gaze direction" (Eye 33, 2019), found 27.9
degrees (standard deviation 7.6) in people from 5 to 91 years; 47.1 down, 44.9 and 44.2 to the sides.
"""

_NEAREST = 0.07
"""Targets nearer than this have no direction, m: eyes that have lost one do not converge on it again.

M. Scheiman and others, "Nearpoint of convergence: test procedure, target selection, and normative data" (Optometry and
Vision Science 80, 2003): normal eyes lose a target at 5 cm at the latest, and recover it at 7.
"""


@dataclass(frozen=True, slots=True)
class EyeSockets:
    """The head as it carries the eyes, in the figure's frame.

    Attributes:
        rotation: of the head; an eye that looks straight ahead looks along its z axis.
        places: eye joint -> position, m; empty for a figure without eyes.
        middle: the midpoint between the eyes, or the top of the neck of a figure without eyes, m.
    """

    rotation: Quat
    places: dict[str, Vec3]
    middle: Vec3

    @classmethod
    def of(cls, body: Body) -> Self:
        """Return the eye sockets of a body."""
        places = {eye: body.transform(eye).position for eye in EYES if eye in body.skeleton}
        return cls(body.transform("skullbase").rotation, places, between_eyes(body))


def direction_between(origin: Vec3, target: Vec3) -> Vec3 | None:
    """Return the unit vector from one point to another; None if they are too near for a direction."""
    way = subtract(target, origin)
    far = length(way)
    return scale(way, 1.0 / far) if far > _NEAREST else None


def turned(start: Vec3, goal: Vec3, part: float) -> Vec3:
    """Return the unit vector at a share of the great circle from one to another."""
    if part >= 1.0:
        return goal
    return rotate(power(between(start, goal), part), start)


def eye_range(turn: Quat) -> float:
    """Return how far an eye can turn in the direction of a turn, rad: upward an ellipse, otherwise a circle."""
    _, down, side, _ = turn
    if down >= 0.0:
        return EYE_RANGE
    return math.hypot(down, side) / math.hypot(down / EYE_RANGE_UP, side / EYE_RANGE)


def listing(head: Quat, direction: Vec3) -> Quat:
    """Return the rotation of an eye in the head that looks in a direction, or as near as possible.

    Listing's law: it is the shortest turn from straight ahead, so an eye never rolls about its line of sight.

    Args:
        head: its rotation in the figure's frame.
        direction: a unit vector in the figure's frame.
    """
    turn = between(FORWARD, rotate(conjugate(head), direction))
    far, path_length = angle(turn), eye_range(turn)
    return turn if far <= path_length else power(turn, path_length / far)


_HALF = math.sqrt(0.5)
_OFFSETS: Mapping[OffsetDirection, tuple[float, float]] = MappingProxyType(
    {
        OffsetDirection.RIGHT: (-1.0, 0.0),
        OffsetDirection.LEFT: (1.0, 0.0),
        OffsetDirection.UP: (0.0, 1.0),
        OffsetDirection.DOWN: (0.0, -1.0),
        OffsetDirection.UPRIGHT: (-_HALF, _HALF),
        OffsetDirection.UPLEFT: (_HALF, _HALF),
        OffsetDirection.DOWNLEFT: (_HALF, -_HALF),
        OffsetDirection.DOWNRIGHT: (-_HALF, -_HALF),
    }
)
"""Direction of an offset: to the left and up, as the figure sees it."""


class GazeTarget:
    """A point at a fixed angle from a target; it moves with the target.

    Args:
        target: returns the position of the target in the figure's frame, m.
        degrees: angle between target and point, seen from between the eyes (BML's offsetAngle).
        side: direction of the offset.
    """

    def __init__(
        self, target: Callable[[], Vec3], degrees: float = 0.0, side: OffsetDirection = OffsetDirection.RIGHT
    ) -> None:
        self._target = target
        self._offset = math.radians(degrees)
        self._side = _OFFSETS[side]

    def point(self, eyes: Vec3) -> Vec3:
        """Return the point to look at, as far away as the target.

        Args:
            eyes: midpoint between the eyes, in the figure's frame, m.

        Returns:
            In the figure's frame, m.
        """
        target = self._target()
        way = direction_between(eyes, target) if self._offset else None
        if way is None:
            return target
        left, up = self._side
        upward = _across(way)
        aside = add(scale(cross(upward, way), left), scale(upward, up))
        turned = add(scale(way, math.cos(self._offset)), scale(aside, math.sin(self._offset)))
        return add(eyes, scale(turned, distance(eyes, target)))


def _across(way: Vec3) -> Vec3:
    """Return the unit vector perpendicular to a direction that points up.

    For straight up and down, backward and forward.
    """
    try:
        return unit(rejected(UP, way))
    except ZeroDivisionError:
        return scale(FORWARD, -way[1])


_HIGHEST = math.sin(EYE_RANGE_UP)
"""Height of the direction of an eye that looks up as far as possible; its lid is fully raised there."""

_SIDES = dict(zip(EYES, ("Left", "Right"), strict=True))


def lid_weights(turns: Mapping[str, Quat]) -> dict[str, float]:
    """Return morph weights of the lids for given eye rotations. Without them an eye that looks up would be all white.

    The upper lid follows the eye over its whole range: W. Becker and A. F. Fuchs, "Lid-eye coordination during vertical
    gaze changes in man and monkey" (Journal of Neurophysiology 60, 1988).

    Args:
        turns: eye joint -> rotation in the head.
    """
    weights: dict[str, float] = {}
    for eye, turn in turns.items():
        side = _SIDES[eye]
        height = rotate(turn, FORWARD)[1]
        if height > 0.0:
            # The morph for looking up alone does not raise the lid far enough.
            raised = min(1.0, height / _HIGHEST)
            weights |= {f"eyeLookUp{side}": raised, f"eyeWide{side}": raised}
        elif height < 0.0:
            weights[f"eyeLookDown{side}"] = -height / EYE_RANGE
    return weights
