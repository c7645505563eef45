"""Where the eyes are, where they look, and how far they turn (Listing's law)."""

import math
from dataclasses import dataclass
from typing import Self

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.humanoid import between_eyes
from reactive_realizer.embodiment.joints import EYES
from reactive_realizer.embodiment.quaternion import Quat, angle, between, conjugate, power, rotate
from reactive_realizer.embodiment.vector import FORWARD, Vec3, length, scale, subtract

EYE_RANGE = 2.0 * math.asin(math.sqrt(0.12))
"""How far an eye turns to a side or down from straight ahead, rad (40.5 degrees).

Of the rotation as a quaternion the squares of its vertical and its horizontal part add up to 0.12 at most: D. Tweed,
"Three-dimensional model of the human eye-head saccadic system" (Journal of Neurophysiology 77, 1997).
"""

EYE_RANGE_UP = math.radians(30.0)
"""How far an eye turns up, rad: much less, and less with age.

W. J. Lee and others, "Differences in eye movement range based on age and gaze direction" (Eye 33, 2019), found 27.9
degrees (standard deviation 7.6) in people from 5 to 91 years; 47.1 down, 44.9 and 44.2 to the sides.
"""

_NEAREST = 0.07
"""m; what is nearer has no direction: eyes that have lost it do not meet on it again.

M. Scheiman and others, "Nearpoint of convergence: test procedure, target selection, and normative data" (Optometry and
Vision Science 80, 2003): normal eyes lose a target at 5 cm at the latest, and have it again at 7.
"""


@dataclass(frozen=True, slots=True)
class Sockets:
    """The head as it carries the eyes, in the figure's frame.

    Attributes:
        rotation: of the head: an eye that looks straight ahead looks along its z.
        places: eye joint -> where it is, m; empty for a figure without eyes.
        middle: the point between the eyes, or the top of the neck of a figure without eyes, m.
    """

    rotation: Quat
    places: dict[str, Vec3]
    middle: Vec3

    @classmethod
    def of(cls, body: Body) -> Self:
        """Those of a body."""
        places = {eye: body.place(eye).position for eye in EYES if eye in body.skeleton}
        return cls(body.place("skullbase").rotation, places, between_eyes(body))


def direction(origin: Vec3, target: Vec3) -> Vec3 | None:
    """The unit vector from one point to another; None where they are too near for one."""
    way = subtract(target, origin)
    far = length(way)
    return scale(way, 1.0 / far) if far > _NEAREST else None


def turned(start: Vec3, goal: Vec3, part: float) -> Vec3:
    """The unit vector a part of the way from one to another, along their great circle."""
    if part >= 1.0:
        return goal
    return rotate(power(between(start, goal), part), start)


def eye_range(turn: Quat) -> float:
    """How far an eye can turn the way that a turn from straight ahead goes, rad: upward an ellipse, else a circle."""
    _, down, side, _ = turn
    if down >= 0.0:
        return EYE_RANGE
    return math.hypot(down, side) / math.hypot(down / EYE_RANGE_UP, side / EYE_RANGE)


def listing(head: Quat, sight: Vec3) -> Quat:
    """An eye's rotation in the head that looks in a direction, or as near as it can.

    Listing's law: the shortest turn from straight ahead, so an eye never rolls about its line of sight.

    Args:
        head: its rotation in the figure's frame.
        sight: a unit vector of the figure's frame.
    """
    turn = between(FORWARD, rotate(conjugate(head), sight))
    far, furthest = angle(turn), eye_range(turn)
    return turn if far <= furthest else power(turn, furthest / far)
