"""Warns of hands that are not where they should be at a sync point of their gesture."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

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


class _Passed(NamedTuple):
    """A sync point that a unit has passed.

    Attributes:
        time: of the point, s.
        unit: that passed it.
        sync: the point.
        gaps: how far the wrists were from where they should be in the frame before, m, by side.
    """

    time: GlobalTime
    unit: AnimationUnit
    sync: str
    gaps: Mapping[str, float]


class LateHands:
    """Watches the wrists of gestures in the frame after each ready and stroke, or before it if they end with it.

    The shortest durations of a gesture assume that nothing else moves its hands. The trunk may move them, in a gaze for
    instance, so that a hurried hand has further to go. An animation may also be authored faster than hands can move.

    Args:
        humanoid: whose hands are watched.
    """

    def __init__(self, humanoid: Humanoid) -> None:
        self._humanoid = humanoid
        self._passed: list[_Passed] = []

    def note(self, unit: AnimationUnit, sync: str, time: GlobalTime) -> None:
        """Note that a unit has passed a sync point; its frame is not shown yet, and may never be.

        At a point that is its start, a motion has had no time to move the hands.
        """
        if sync in _POINTS and unit.motion.kind is LayerKind.GESTURE and unit.keys[sync] > 0.0:
            recent = (each for each in self._passed if each.time > time - _SHOWN_WITHIN)
            self._passed = [*recent, _Passed(time, unit, sync, self._gaps(unit))]

    def warnings(self) -> Iterator[Warn]:
        """Yield a warning for each hand that is late in the frame shown last, once for every point.

        Motions with a fault are left out: their hands may be elsewhere because of it. If a motion has ended, the frame
        shows others, so the one before its point counts.
        """
        if not self._passed:
            return
        shown = [each for each in self._passed if each.time <= self._humanoid.time]
        self._passed = [each for each in self._passed if each.time > self._humanoid.time]
        for each in shown:
            if each.unit.motion.fault is None:
                yield from self._late(each, self._gaps(each.unit) if each.unit.live else each.gaps)

    def _late(self, passed: _Passed, gaps: Mapping[str, float]) -> Iterator[Warn]:
        unit = passed.unit
        near = NEAR_POINTING if isinstance(unit.behavior, Pointing) else NEAR
        for side, gap in gaps.items():
            if gap > near:
                point = f"{unit.behavior.id}:{passed.sync}"
                yield Warn(unit, HandLate(point=point, hand=_HANDS[side], distance=100.0 * gap))

    def _gaps(self, unit: AnimationUnit) -> Mapping[str, float]:
        """Measure how far its wrists are from where they should be in the frame shown last, m, by side."""
        own = (side for side in SIDES if f"{side}_shoulder" in unit.motion.joints)
        return {side: self._humanoid.gap(f"{side}_wrist") for side in own}
