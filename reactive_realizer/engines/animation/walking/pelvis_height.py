"""How high the pelvis of a walking figure is."""

import math
from collections.abc import Sequence

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.feet import reach
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.vector import subtract
from reactive_realizer.engines.animation.walking.progression import Axis
from reactive_realizer.engines.animation.walking.walker import FootPose

_PENDULUM, _DEEPEST = 0.12, 0.16
"""How much lower the pelvis is in walking with the feet apart, 1/m (it grows with their squared distance), and the
limit, m."""

_WIDEST, _WIDE_PENDULUM = 0.3, 0.3
"""Distance of the feet from side to side from which it is lower, m, and how much, 1/m."""

_BENT, _CROUCH = 0.012, 0.045
"""How much lower it is than the legs would need, m: knees are never locked in walking, and further bent in running."""

_BOUNCE, _BOUNCING = 0.06, 0.16
"""How much lower it is in running while it passes over a foot, m, and up to which squared distance of the feet, m^2.

The leg that stands is a spring: R. Blickhan, "The spring-mass model for running and hopping" (Journal of Biomechanics
22, 1989)."""

_SOFTNESS = 0.012
"""Softness with which it is lowered for a leg that would not reach its foot, m."""

_FREELY, _LOWEST = 0.06, 0.12
"""Lowering for legs that do not reach their feet: where its limit begins to act, and the limit, m.

A foot that is still not reached is dragged along. Without a limit, a fast figure that turns would sink to its knees."""

_QUICK, _HARDEST, _FASTEST = 40.0, 27.0, 1.0
"""How fast it follows the height that the feet need, 1/s, and the limits: of acceleration, m/s^2, and speed, m/s.

Where two steps meet, the height that they need has an edge; a foot is rather missed by some millimeters."""

_STEP = 0.005
"""Step of time in which it follows, s."""


class PelvisHeight:
    """The height of the pelvis, from frame to frame.

    In walking it is lowest while the feet are apart, as an inverted pendulum, in running while it passes over the foot
    that stands. It goes lower for legs that would not reach their feet. Its acceleration is limited.
    """

    def __init__(self) -> None:
        self._swung = self._goal = 0.0
        self._down = Axis(0.0)

    def swung(self, apart: float, wide: float, running: float, walking: float) -> float:
        """Return how much lower it is for the places of the feet, m.

        Args:
            apart: distance of the feet along the way, m.
            wide: their distance from side to side, m.
            running: how much the figure moves as in running, 0 to 1.
            walking: how much of walking is to be seen, 0 to 1.
        """
        square, beyond = apart * apart, max(0.0, wide - _WIDEST)
        ran = _BOUNCE * math.exp(-square / _BOUNCING) + _CROUCH
        down = _BENT * walking + (1.0 - running) * _PENDULUM * square + running * ran
        self._swung = min(_DEEPEST, down + _WIDE_PENDULUM * walking * beyond * beyond)
        return self._swung

    def lowered(self, passed: float, body: Body, feet: Sequence[FootPose], walking: float) -> float:
        """Return how much further it goes down for the legs to reach the feet that stand, m.

        Args:
            passed: time since the last frame, s; infinite to set out anew.
            body: with the pelvis as far down as `swung`.
            feet: left first.
            walking: how much of walking is to be seen, 0 to 1.
        """
        goal = self._swung + _lowering(body, feet, walking)
        if passed == math.inf:
            self._down = Axis(goal)
        elif passed > 0.0:
            self._follow(goal, passed)
        self._goal = goal
        return self._down.at - self._swung

    def _follow(self, goal: float, passed: float) -> None:
        speed = (goal - self._goal) / passed
        count = math.ceil(passed / _STEP - 1e-9)
        for number in range(1, count + 1):
            off = self._goal + (goal - self._goal) * number / count - self._down.at
            wanted = max(-_FASTEST, min(_FASTEST, speed + _closing(off)))
            change = max(-_HARDEST, min(_HARDEST, 2.0 * _QUICK * (wanted - self._down.speed)))
            after = self._down.speed + change * passed / count
            self._down = Axis(self._down.at + after * passed / count, after)


def _closing(off: float) -> float:
    """Return the speed toward a height that is some way off, m: from far away, as fast as it can brake, m/s."""
    near = _HARDEST / _QUICK**2
    return _QUICK * off if abs(off) < near else math.copysign(math.sqrt(_HARDEST * (2.0 * abs(off) - near)), off)


def _lowering(body: Body, feet: Sequence[FootPose], walking: float) -> float:
    """Return how much lower it must be for the legs to reach the feet that stand, m; at most `_LOWEST`."""
    softness = max(1e-4, _SOFTNESS * walking)
    needed = sum(
        foot.bears * _softly(_lacking(body, side, foot), softness) for side, foot in zip(SIDES, feet, strict=True)
    )
    if needed <= _FREELY:
        return needed
    return _LOWEST - (_LOWEST - _FREELY) * math.exp((_FREELY - needed) / (_LOWEST - _FREELY))


def _lacking(body: Body, side: str, foot: FootPose) -> float:
    """Return how much lower it must be for a leg to reach its foot, m; negative if the leg reaches it."""
    x, y, z = subtract(body.transform(f"{side}_hip").position, foot.ankle.position)
    return y - math.sqrt(max(0.0, reach(body.skeleton, side) ** 2 - x * x - z * z))


def _softly(lacking: float, softness: float) -> float:
    """Return a length, or nearly 0 if it is negative."""
    return lacking if lacking > 30.0 * softness else softness * math.log1p(math.exp(lacking / softness))
