"""Idle movements that recur at random intervals: breaths and glances; and how a body leans on one foot."""

import math
from bisect import bisect_right
from collections import deque
from collections.abc import Callable, Mapping
from operator import attrgetter
from random import Random
from typing import Generic, NamedTuple, TypeVar

from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.quaternion import Quat, from_euler
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.easing import minimum_jerk, share, smoothstep

T = TypeVar("T")


class Episode(NamedTuple, Generic[T]):
    """A state since a time, s."""

    since: float
    what: T


class Episodes(Generic[T]):
    """Random episodes in succession, from time 0 on. Each is drawn when it is first needed, in order.

    So they do not depend on the order of queries, back to the last `KEPT` episodes.

    Args:
        first: state of the first episode.
        draw: returns the duration of the last episode, s, and the next state, from a generator that must not be shared.
    """

    KEPT = 128

    def __init__(self, first: T, draw: Callable[[], tuple[float, T]]) -> None:
        self._draw = draw
        self._drawn = deque([Episode(0.0, first)], self.KEPT)

    def at(self, time: float) -> tuple[Episode[T], Episode[T]]:
        """Return the episode at a time, and the one before it. The first one is its own predecessor."""
        while (last := self._drawn[-1].since) <= time:
            duration, what = self._draw()
            self._drawn.append(Episode(last + duration, what))
        if len(self._drawn) > 2 and self._drawn[-2].since <= time:  # as in nearly all frames
            return self._drawn[-2], self._drawn[-3]
        now = max(0, bisect_right(self._drawn, time, key=attrgetter("since")) - 1)
        return self._drawn[now], self._drawn[max(0, now - 1)]


_LASTS = (3.4, 4.8)
"""Shortest and longest breath, s: 12.5 to 17.6 per minute."""

USUAL_BREATHING = 60.0 / (0.5 * (_LASTS[0] + _LASTS[1]))
"""Breaths per minute, on average."""

_DEPTH = (0.7, 1.2)
"""Shallowest and deepest breath."""

_IN = 0.42
"""Share of a breath that is inhalation."""


class Breath:
    """Breaths of a person at rest; no two are alike.

    Depth varies more than time: M. J. Tobin and others, "Variability of resting respiratory drive and timing in healthy
    subjects" (Journal of Applied Physiology 65, 1988). Rate, share of inhalation and variation are our choice, within
    human ranges.
    """

    def __init__(self, random: Random) -> None:
        """Draw from a generator that must not be shared."""
        self._random = random
        self._last = self._breath()
        self._episodes = Episodes(self._last, self._draw)
        self._begun = random.uniform(0.0, _LASTS[0])

    def air(self, time: float) -> float:
        """Return how full the lungs are at a time, s: 0 after exhalation, about 1 after inhalation."""
        passed = time + self._begun
        (since, (duration, depth)), _ = self._episodes.at(passed)
        done = (passed - since) / duration
        return depth * smoothstep(share(done, 0.0, _IN) if done < _IN else share(1.0 - done, 0.0, 1.0 - _IN))

    def _draw(self) -> tuple[float, tuple[float, float]]:
        duration, _ = self._last
        self._last = self._breath()
        return duration, self._last

    def _breath(self) -> tuple[float, float]:
        return self._random.uniform(*_LASTS), self._random.uniform(*_DEPTH)


_SHIFT_ASIDE = 0.030
"""Largest displacement of the pelvis toward the supporting foot in a usual weight shift, m."""

_SHIFT_DOWN = 0.006
"""Lowering of the pelvis there, beyond what the legs need to reach their feet, m."""

_SUNK = 0.1
"""A pelvis that is lower than this below standing height does not shift weight any more, m."""


def standing_degree(sunk: float) -> float:
    """Return the degree to which a figure may shift its weight, 0 to 1: a sitting figure does not.

    Args:
        sunk: how much lower the pelvis is than in standing, m.
    """
    return max(0.0, 1.0 - max(0.0, sunk) / _SUNK)


Leaning = tuple[Mapping[str, Quat], Vec3]
"""Turns of pelvis, trunk and neck, and the displacement of the pelvis, m."""


def leaning(side: float) -> Leaning:
    """Return the turns of pelvis, trunk and neck, and the displacement of the pelvis, m.

    The hip of the supporting leg is higher, trunk and neck compensate the tilt, and the head stays level.

    Args:
        side: the supporting foot, -1 (right) to 1 (left) in a usual weight shift.
    """
    turns = {
        ROOT: from_euler(0.0, -0.04 * side, 0.050 * side),
        "vl5": from_euler(0.0, 0.03 * side, -0.075 * side),
        "vc4": from_euler(0.0, 0.01 * side, 0.025 * side),
    }
    return turns, (_SHIFT_ASIDE * side, -_SHIFT_DOWN * side * side, 0.0)


Direction = tuple[float, float]
"""Yaw to the figure's left and pitch up, from straight ahead, rad."""

# S. P. Lee, J. B. Badler and N. I. Badler, "Eyes Alive" (SIGGRAPH 2002), values for a listener. An amplitude is
# -6.9 ln(P / 15.7) degrees, with P uniform from 0 to 15.7; durations are given in frames of 1/30 s.
_SPREAD = math.radians(6.9)
_DIRECTIONS = {0: 15.54, 45: 6.46, 90: 17.69, 135: 7.44, 180: 16.80, 225: 7.89, 270: 20.38, 315: 7.79}
_AHEAD = (237.5 / 30.0, 47.1 / 30.0)
_ASIDE = (13.0 / 30.0, 7.1 / 30.0)

USUAL_GLANCES = 60.0 / (_AHEAD[0] + _ASIDE[0])
"""Glances per minute of a listener."""

_LONGEST = 30.0
"""Longest time between glances, s, so that they soon follow a change of their rate."""

_FURTHEST = math.radians(5.0)
"""Limit of a glance, rad. Further to the side the head would follow, which is left to gaze behaviors."""

_SHORTEST = 0.15
"""Shortest fixation, s."""

_SACCADE = (0.025, 0.0024 / math.radians(1.0))
"""Duration of a saccade: constant part, s, and part per radian, s (same paper)."""


class Glances:
    """Brief glances aside, about every eight seconds.

    Attributes:
        rate: number of glances, relative to the usual one, from the next one on; 0 for none.
    """

    def __init__(self, random: Random) -> None:
        """Draw from a generator that must not be shared."""
        self.rate = 1.0
        self._random = random
        self._aside = True
        self._episodes: Episodes[Direction] = Episodes((0.0, 0.0), self._draw)

    def _draw(self) -> tuple[float, Direction]:
        self._aside = not self._aside
        if self._aside:
            return max(_SHORTEST, self._random.gauss(*_ASIDE)), (0.0, 0.0)
        if self.rate <= 0.0:
            return _LONGEST, (0.0, 0.0)
        nearest = math.exp(-_FURTHEST / _SPREAD)
        amplitude = -_SPREAD * math.log(self._random.uniform(nearest, 1.0))
        (degrees,) = self._random.choices(tuple(_DIRECTIONS), tuple(_DIRECTIONS.values()))
        angle = math.radians(degrees)
        ahead = self._random.gauss(*_AHEAD) * ((_AHEAD[0] + _ASIDE[0]) / self.rate - _ASIDE[0]) / _AHEAD[0]
        return max(_SHORTEST, min(_LONGEST, ahead)), (amplitude * math.cos(angle), amplitude * math.sin(angle))

    def at(self, time: float) -> Direction:
        """Return the direction of the eyes."""
        now, before = self._episodes.at(time)
        (x, y), (to_x, to_y) = before.what, now.what
        fixed, more = _SACCADE
        done = minimum_jerk((time - now.since) / (fixed + more * math.hypot(to_x - x, to_y - y)))
        return x + (to_x - x) * done, y + (to_y - y) * done
