"""Idle movements that never stop: the head wanders, elbows and fingers are loose, and eyes are never still."""

from collections.abc import Mapping
from math import cos, radians, sin
from random import Random
from typing import NamedTuple

from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.easing import minimum_jerk
from reactive_realizer.engines.animation.idle_movements import Episodes

_QUICKER = 0.3
"""Share of the faster wave in a movement."""

_SLOWER = 1.0 - _QUICKER

_SLOW, _FAST = (0.35, 0.6), (1.0, 1.6)
"""Lowest and highest angular frequency of the two waves of a movement, rad/s: it has no visible period."""


class _Wave(NamedTuple):
    """A slow movement of an angle."""

    slow: float
    fast: float
    begin: float

    @classmethod
    def drawn(cls, random: Random) -> "_Wave":
        """Return a wave of its own."""
        return cls(random.uniform(*_SLOW), random.uniform(*_FAST), random.uniform(0.0, 100.0))

    def at(self, time: float) -> float:
        """Return the movement at a time, -1 to 1."""
        passed = time + self.begin
        return _SLOWER * sin(self.slow * passed) + _QUICKER * sin(self.fast * passed)


_HEAD: Vec3 = (0.012, 0.019, 0.007)
"""How far the head nods, turns and tilts, rad. It moves by 1 to 3 degrees in a minute (ours)."""

_FINGERS = {"index": 0.012, "middle": 0.03, "ring": 0.036, "pinky": 0.036}
"""How far fingers bend and stretch, rad: pointing needs the index finger."""

_ELBOW = 0.012
"""How far elbows bend and stretch, rad."""

_CURLING = {"l": -1.0, "r": 1.0}
"""Sign of the turn about z by which fingers bend."""


class Looseness:
    """The movement of head, elbows and fingers that nobody intends, in people who stand or sit still."""

    def __init__(self, random: Random) -> None:
        """Draw from a generator that must not be shared."""
        self._head = _Wave.drawn(random), _Wave.drawn(random), _Wave.drawn(random)
        self._fingers = [
            (f"{side}_{finger}1", _CURLING[side] * size, _Wave.drawn(random))
            for side in SIDES
            for finger, size in _FINGERS.items()
        ]
        self._elbows = {side: _Wave.drawn(random) for side in SIDES}

    def head(self, time: float) -> Vec3:
        """Return the turns of the head at a time, s: nod, turn and tilt, rad."""
        (nod, turn, tilt), (nods, turns, tilts) = _HEAD, self._head
        return nod * nods.at(time), turn * turns.at(time), tilt * tilts.at(time)

    def elbows(self, time: float, degrees: Mapping[str, float]) -> dict[str, Quat]:
        """Return the turns of elbows at a time, s, for some sides ("l" or "r"), each scaled by its degree."""
        waves = ((side, degree * self._elbows[side].at(time)) for side, degree in degrees.items())
        halves = ((f"{side}_elbow", 0.5 * _ELBOW * turn) for side, turn in waves)
        return {joint: (cos(half), sin(half), 0.0, 0.0) for joint, half in halves}

    def fingers(self, time: float, degree: float) -> dict[str, Quat]:
        """Return the turns of fingers at a time, s, scaled by a degree."""
        turns: dict[str, Quat] = {}
        for joint, curl, (slow, fast, begin) in self._fingers:
            # `_Wave.at` and `from_axis_angle`, written out: eight fingers take a noticeable part of a frame.
            passed = time + begin
            half = 0.5 * degree * curl * (_SLOWER * sin(slow * passed) + _QUICKER * sin(fast * passed))
            turns[joint] = (cos(half), 0.0, 0.0, sin(half))
        return turns


_INTERVAL = (0.35, 1.2)
"""Shortest and longest time between microsaccades, s."""

_AROUND = radians(0.09)
"""Standard deviation of where they lead, in each direction, rad."""

_FURTHEST = radians(0.2)
"""Limit of that, rad."""

_DRIFT = radians(0.1)
"""Fastest drift between them, rad/s."""

_TAKES = 0.025
"""Duration of a microsaccade, s."""


class Fixation:
    """Microsaccades and drift: eyes on a target are never still.

    S. Martinez-Conde, S. L. Macknik and D. H. Hubel, "The role of fixational eye movements in visual perception"
    (Nature Reviews Neuroscience 5, 2004): one or two microsaccades a second, and slow drift between them. Both are
    smaller here, so that the eyes stay within half a degree of their target.
    """

    def __init__(self, random: Random) -> None:
        """Draw from a generator that must not be shared."""
        self._random = random
        self._episodes = Episodes((0.0, 0.0, 0.0, 0.0), self._draw)

    def _draw(self) -> tuple[float, tuple[float, float, float, float]]:
        place = (max(-_FURTHEST, min(_FURTHEST, self._random.gauss(0.0, _AROUND))) for _ in range(2))
        drift = (self._random.uniform(-_DRIFT, _DRIFT) for _ in range(2))
        return self._random.uniform(*_INTERVAL), (*place, *drift)  # type: ignore[return-value]

    def at(self, time: float) -> tuple[float, float]:
        """Return how far both eyes look to the left of and above their target at a time, s, rad."""
        now, before = self._episodes.at(time)
        (x, y, dx, dy), (from_x, from_y, from_dx, from_dy) = now.what, before.what
        passed, all_before = time - now.since, now.since - before.since
        done = minimum_jerk(passed / _TAKES)
        old_x, old_y = from_x + from_dx * all_before, from_y + from_dy * all_before
        return old_x + (x + dx * passed - old_x) * done, old_y + (y + dy * passed - old_y) * done
