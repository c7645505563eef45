"""A transition in a plan."""

from collections.abc import Callable
from dataclasses import replace

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.engines.animation.animation_unit import AnimationUnit, Stage
from reactive_realizer.engines.animation.choice import Choices
from reactive_realizer.engines.animation.moving import Moving
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing

Predict = Callable[[GlobalTime, AnimationUnit], Moving]
"""How the body will move at a time, as far as it can be known, if one unit does nothing."""


class TransitionUnit(AnimationUnit):
    """A transition between pegs."""

    def __init__(self, block: BlockKey, behavior: Behavior, choices: Choices, stage: Stage, predict: Predict) -> None:
        """Plans a transition; where it leads to, a prediction says when it begins."""
        super().__init__(block, behavior, choices, stage)
        if {"start", "end"} <= behavior.syncs.keys() and self.timing.points == ("start", "end"):
            self.timing = Timing(("start", "end"), (Phase(0.0, PhaseKind.FREE),))
        self._predict = predict
        self._led = False

    def on_start(self, time: GlobalTime) -> None:
        """From here, as the body moves now."""
        super().on_start(time)
        self._lead(time)

    def on_finish(self, time: GlobalTime) -> None:
        """What it has led to begins now: what is left of the transition itself lies below that."""
        if not self.was_cut("end"):
            self.shown = replace(self.shown, kind=LayerKind.POSTURE)
        super().on_finish(time)

    def layer(self, now: GlobalTime) -> Layer:
        """As every motion; while nobody knows when it ends, the joints stay where they are."""
        if not self._led:
            self._lead(now)
        return super().layer(now)

    def _lead(self, now: GlobalTime) -> None:
        end = self.time("end")
        if self.motion.led and end is not None and end > now:
            self.motion.lead(self._stage.moving(now), self._predict(end, self), end - now)
            self._led = True
