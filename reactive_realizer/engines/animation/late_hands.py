"""Warns of hands that are not where they should be at a sync point of their gesture."""

from collections.abc import Iterator

from reactive_realizer.bml.behaviors import Pointing
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.engine.effects import Warn
from reactive_realizer.engines.animation.animation_unit import AnimationUnit
from reactive_realizer.engines.animation.faults import HandLate

NEAR = 0.02
"""Distance between the intended and the shown wrist above which a hand is late, m."""

NEAR_POINTING = 0.01
"""The same for a hand that points, m: from the shoulder, about a degree, half of what its finger may be off."""

_SHOWN_WITHIN = 1.0
"""Time after which a point that no frame has shown is no longer watched, s: frames are not always made."""

_POINTS = ("ready", "stroke")
_HANDS = dict(zip(SIDES, ("left", "right"), strict=True))


class LateHands:
    """Watches the wrists of gestures in the frame after each ready and stroke.

    The shortest durations of a gesture assume that nothing else moves its hands. The trunk may move them, in a gaze for
    instance, so that a hurried hand has further to go. An animation may also be authored faster than hands can move.

    Args:
        humanoid: whose hands are watched.
    """

    def __init__(self, humanoid: Humanoid) -> None:
        self._humanoid = humanoid
        self._passed: list[tuple[GlobalTime, AnimationUnit, str]] = []

    def note(self, unit: AnimationUnit, sync: str, time: GlobalTime) -> None:
        """Note that a unit has passed a sync point; its frame is not shown yet, and may never be.

        At a point that is its start, a motion has had no time to move the hands.
        """
        if sync in _POINTS and unit.motion.kind is LayerKind.GESTURE and unit.keys[sync] > 0.0:
            recent = (each for each in self._passed if each[0] > time - _SHOWN_WITHIN)
            self._passed = [*recent, (time, unit, sync)]

    def warnings(self) -> Iterator[Warn]:
        """Yield a warning for each hand that is late in the frame shown last, once for every point.

        Motions with a fault are left out: their hands may be elsewhere because of it. So are those that have ended: the
        frame shows others.
        """
        if not self._passed:
            return
        shown = [each for each in self._passed if each[0] <= self._humanoid.time]
        self._passed = [each for each in self._passed if each[0] > self._humanoid.time]
        for _, unit, sync in shown:
            if unit.motion.fault is None and unit.live:
                yield from self._late(unit, sync)

    def _late(self, unit: AnimationUnit, sync: str) -> Iterator[Warn]:
        for side, hand in _HANDS.items():
            gap = self._humanoid.gap(f"{side}_wrist") if f"{side}_shoulder" in unit.motion.joints else 0.0
            if gap > (NEAR_POINTING if isinstance(unit.behavior, Pointing) else NEAR):
                yield Warn(unit, HandLate(point=f"{unit.behavior.id}:{sync}", hand=hand, distance=100.0 * gap))
