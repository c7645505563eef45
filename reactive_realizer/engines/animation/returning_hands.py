"""Computes where hands are on their way back to rest from the times of points, also when no frames are made."""

from collections.abc import Iterable

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind, over
from reactive_realizer.engines.animation.animation_unit import AnimationUnit
from reactive_realizer.engines.animation.fade_out import FadeOut
from reactive_realizer.engines.animation.posture.rest_posture import RestPosture


class ReturningHands:
    """The hands of gestures that retract or have ended; the preparations of the next ones begin there.

    Args:
        rest: the figure at rest.
    """

    def __init__(self, rest: RestPosture) -> None:
        self._rest = rest
        self._ended: list[FadeOut] = []

    def body(self, playing: Iterable[AnimationUnit], now: GlobalTime) -> Body | None:
        """Return the figure with its hands where they are at a time; None if it is at rest."""
        rest = hands = self._rest.body
        playing = list(playing)
        self._ended = [ended for ended in self._ended if not ended.finished(now)]
        for unit in playing:
            if unit.motion.kind is LayerKind.POSTURE:
                hands = over(hands, unit.timed_layer(now, rest))
        for ended in self._ended:
            hands = over(hands, ended.at(now))
        for unit in playing:
            if unit.motion.kind is LayerKind.GESTURE and unit.subsiding(now) and not unit.accompanies:
                hands = over(hands, unit.retraction_layer(now, rest))
        return None if hands is rest else hands

    def note_end(self, unit: AnimationUnit, time: GlobalTime) -> None:
        """Note where a gesture leaves the hands; one that accompanies others must not change the times of the next."""
        if unit.motion.kind is LayerKind.GESTURE and unit.shortest[0] > 0.0 and not unit.accompanies:
            ended = FadeOut(unit.final_layer(time, self._rest.body), time)
            self._ended = [each for each in (*self._ended, ended) if not each.finished(time)]
