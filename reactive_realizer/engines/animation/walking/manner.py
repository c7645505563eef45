"""Manners of locomotion, and how long they take."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

from reactive_realizer.engines.animation.easing import share

TURNING = 2.0
"""Speed at which the feet turn a figure, rad/s: less than 60 degrees with each step."""

_ASIDE = 0.9
"""A turn up to this angle is part of the first or the last steps, rad."""

_STARTING = 0.4
"""Time that a figure loses while it gets up to speed, s."""

_TWO_STEPS = 0.8
"""Least duration of any change of place: each foot steps once, s."""

_WALKING_SUPPORT = 0.2
"""How long both feet are on the ground in walking, relative to the time from step to step."""

_TOO_FAST_TO_WALK = (2.1, 2.8)
"""Speeds from which a figure that stops to run still flies a little, and from which as in running, m/s."""

_USUAL_CADENCE, _USUAL_SPEED, _CADENCE_POWER = 1.9, 1.2, 0.58
"""Steps per second at a speed, m/s, and how they grow with speed: D. W. Grieve and R. J. Gear, "The relationships
between length of stride, step frequency, time of swing and speed of walking" (Ergonomics 9, 1966)."""


@dataclass(frozen=True, slots=True)
class Manner:
    """A way to move over the ground.

    Attributes:
        name: in BML.
        speed: usual, m/s.
        top: highest speed, m/s.
        braking: duration of the way from the usual speed to rest, s.
        ahead: whether the figure faces the way that it goes.
        flies: whether both feet leave the ground at full speed.
        slowest_step: longest time from step to step, s.
    """

    name: str
    speed: float
    top: float
    braking: float = 1.2
    ahead: bool = True
    flies: bool = False
    slowest_step: float = 0.6

    def duration(self, way: float, speed: float, turns: tuple[float, float] = (0.0, 0.0), gone: float = 0.0) -> float:
        """Return the preferred duration of a way, s.

        Args:
            way: its length, m.
            speed: when the figure has got up to speed, m/s.
            turns: at its beginning and at its end, rad.
            gone: speed with which the figure already goes that way, m/s; negative if it goes back.
        """
        starting = _STARTING * (1.0 - gone / speed)
        usual = way / speed + starting + 0.5 * self.braking if way > 0.0 else _STARTING
        return max(_TWO_STEPS, usual + sum(map(turning_time, turns)))

    def shortest(self, way: float, turns: tuple[float, float] = (0.0, 0.0)) -> float:
        """Return the shortest duration of a way, s: at top speed, or from rest to rest on a short one."""
        fastest = min(1.9 * way / self.top, way / self.top + _STARTING + 0.5 * self.braking)
        return max(_TWO_STEPS, fastest + sum(map(turning_time, turns)))

    def double_support(self, speed: float) -> float:
        """Return how long both feet are on the ground, relative to the time from step to step; negative in flight."""
        if not self.flies:
            return _WALKING_SUPPORT - 0.5 * share(speed, *_TOO_FAST_TO_WALK)
        return _WALKING_SUPPORT - 0.5 * share(speed, 1.2, 2.2) - 0.24 * share(speed, 2.8, 4.5)

    def period(self, speed: float) -> float:
        """Return the time from step to step at a speed, s."""
        cadence: float = _USUAL_CADENCE * (max(speed, 0.1) / _USUAL_SPEED) ** _CADENCE_POWER
        return min(self.slowest_step, 1.0 / min(cadence, 2.8))


def turning_time(angle: float) -> float:
    """Return the time that a turn adds to a way, s; a small one is part of its steps."""
    return max(0.0, abs(angle) - _ASIDE) / TURNING


_LEFT_TO_JOINTS = math.radians(30.0)
"""Angle to a target that the feet leave to the joints, rad."""


def turn_of_feet(bearing: float) -> float:
    """Return how far the feet turn a figure toward a target that its joints do not reach, both rad to the left."""
    return math.copysign(max(0.0, abs(bearing) - _LEFT_TO_JOINTS), bearing)


class SteppingTime(NamedTuple):
    """The duration of a turn on the spot, s; 0 for none.

    Attributes:
        preferred: not less than the shortest.
        shortest: that the feet need.
    """

    preferred: float
    shortest: float


def stepping_time(angle: float) -> SteppingTime:
    """Return how long a turn on the spot takes, rad."""
    if not angle:
        return SteppingTime(0.0, 0.0)
    turns = (0.0, angle)
    return SteppingTime(WALK.duration(0.0, WALK.speed, turns), WALK.shortest(0.0, turns))


WALK = Manner("WALK", 1.2, 2.1)
RUN = Manner("RUN", 2.8, 4.5, 1.4, flies=True)
STRAFE = Manner("STRAFE", 0.4, 0.7, ahead=False, slowest_step=0.42)
"""To the side or backward: the figure does not turn into the way."""

MANNERS: Mapping[str, Manner] = MappingProxyType({each.name: each for each in (WALK, RUN, STRAFE)})
"""By name. Speeds: R. W. Bohannon, "Comfortable and maximum walking speed of adults" (Age and Ageing 26, 1997); people
change from walking to running at 2 m/s. The others are our choice."""

SLOWEST, FASTEST = 0.2, max(each.top for each in MANNERS.values())
"""Bounds of a speed that can be asked for, m/s."""


def is_at(way: float, turn: float) -> bool:
    """Return whether a figure is already where it should be, within what no one sees: m, rad."""
    return way < 0.02 and abs(turn) < math.radians(3.0)
