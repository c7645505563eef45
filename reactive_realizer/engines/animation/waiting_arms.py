"""Partial retraction: an arm whose next stroke comes soon waits halfway, instead of going to rest and back.

People rest their hands fully only in longer pauses between gestures: S. Kopp and I. Wachsmuth, "Synthesizing multimodal
utterances for conversational agents" (Computer Animation and Virtual Worlds 15, 2004). The time is ours.
"""

from collections.abc import Callable, Collection, Iterable
from operator import itemgetter
from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.joints import LEFT_ARM, RIGHT_ARM
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.engines.animation.animation_unit import AnimationUnit
from reactive_realizer.engines.animation.motion_unit import Resource
from reactive_realizer.planunit.plan_unit import UnitState

SOON = 2.0
"""Longest time from the relax of a gesture to the stroke of the next one for which the arm waits, s."""

_JOINTS = {Resource.LEFT_ARM: LEFT_ARM, Resource.RIGHT_ARM: RIGHT_ARM}


class _Waiting(NamedTuple):
    """Arms that wait for a gesture.

    Attributes:
        following: the next gesture.
        layer: of the arms.
        until: time until which they wait at most, s.
    """

    following: AnimationUnit
    layer: Layer
    until: GlobalTime


class WaitingArms:
    """The arms of a figure that wait between two gestures."""

    def __init__(self, release: Callable[[Collection[str], GlobalTime], None]) -> None:
        """Let no arm wait.

        Args:
            release: called with joints that wait no longer, though the next gesture does not move them, and the time.
        """
        self._release = release
        self._following: dict[AnimationUnit, AnimationUnit] = {}
        self._waiting: list[_Waiting] = []

    def note_relax(self, unit: AnimationUnit, units: Iterable[AnimationUnit], now: GlobalTime) -> None:
        """Let a gesture that relaxes keep up the arms that another gesture of the plan needs soon."""
        following = _following(unit, units, now)
        if following is not None:
            shared = following.resources & unit.resources
            unit.kept_up = frozenset().union(*(_JOINTS.get(each, frozenset()) for each in shared))
            self._following[unit] = following

    def note_end(self, unit: AnimationUnit, now: GlobalTime) -> frozenset[str]:
        """Return the joints of a gesture that ends which wait from now on."""
        following, layer = self._following.pop(unit, None), unit.shown
        if following is None or following.begun or unit.state is not UnitState.DONE:
            return frozenset()
        kept = {joint: turn for joint, turn in layer.rotations.items() if joint in unit.kept_up}
        until = GlobalTime(now + SOON)
        self._waiting.append(_Waiting(following, Layer(layer.kind, kept, layer.weight), until))
        return frozenset(kept)

    def layers(self, now: GlobalTime) -> tuple[Layer, ...]:
        """Return the layers of arms that wait. They are released if their gesture is dropped or comes much later."""
        if not self._waiting:
            return ()
        waiting, self._waiting = self._waiting, []
        for each in waiting:
            following, layer, until = each
            if following.live and not following.begun and now < until:
                self._waiting.append(each)
            elif left := layer.rotations.keys() - (following.motion.joints if following.begun else ()):
                self._release(left, now)
        return tuple(each.layer for each in self._waiting)


def _following(unit: AnimationUnit, units: Iterable[AnimationUnit], now: GlobalTime) -> AnimationUnit | None:
    """Return the next gesture of the plan that moves an arm of a gesture, if its stroke comes soon."""
    later = GlobalTime(now + SOON)
    strokes = [
        (stroke, other)
        for other in units
        if not other.begun
        and other.motion.kind is LayerKind.GESTURE
        and other.resources & unit.resources
        and "stroke" in other.timing.points
        and (stroke := other.time("stroke")) is not None
        and stroke <= later
    ]
    return min(strokes, key=itemgetter(0))[1] if strokes else None
