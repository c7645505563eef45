"""The plan units of the face: expressions and animations that come and go, and expressions that stay."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engines.face.face_animation import FaceAnimation
from reactive_realizer.engines.face.face_timing import EXPRESSION_PHASES, SHIFT_PHASES, SHIFT_TIMING, FaceShape
from reactive_realizer.engines.face.weights import Weights
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Parameter
from reactive_realizer.planunit.phase_clock import PhaseClock
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState
from reactive_realizer.planunit.timing import Timing, timing_at

MOUTH = "mouth"
MOUTH_MORPHS = ("mouth", "jaw", "tongue")
"""Prefixes of the names of the morph targets of the mouth."""

_FADE_IN = 0.1
"""Duration in which an animation fades in, s."""


class FaceUnit(PlanUnit, ABC):
    """A face that comes and goes.

    Args:
        timing: that it prefers.
        phases: of its sync points, increasing.
        weights: of morph targets, 0..1.
        released: is given what is still shown at the end.

    Attributes:
        weights: of morph targets in the last frame, 0..1.
        level: the factor of these weights in the last frame.
    """

    def __init__(
        self,
        block: BlockKey,
        behavior: Behavior,
        timing: Timing,
        phases: Mapping[str, float],
        weights: Weights,
        released: Callable[["FaceUnit", GlobalTime], None],
    ) -> None:
        super().__init__(block, behavior, timing, _resources(weights))
        self.weights = weights
        self.level = 0.0
        self._clock = PhaseClock(phases)
        self._last_phase = max(phases.values())
        self._released = released

    def on_finish(self, time: GlobalTime) -> None:
        """Hands over the weights that are still shown, which then fade."""
        if self.state is UnitState.DONE and not self.points[-1].cut:
            self.follow(self._last_phase)
        self._released(self, time)

    def shown(self, now: GlobalTime) -> "FaceUnit":
        """The unit, with its weights and its level of now."""
        self.follow(self._clock.advance(self, now))
        return self

    @abstractmethod
    def follow(self, phase: float) -> None:
        """Sets weights and level for a phase."""


class ExpressionUnit(FaceUnit):
    """An expression: attack, hold and decay.

    Args:
        shape: the expression at the amount of the behavior.
        overshoot: fraction by which the attack peak exceeds them.
        released: is given what is still shown at the end.
    """

    def __init__(
        self,
        block: BlockKey,
        behavior: Behavior,
        shape: FaceShape,
        overshoot: float,
        released: Callable[[FaceUnit, GlobalTime], None],
    ) -> None:
        super().__init__(block, behavior, shape.timing, EXPRESSION_PHASES, shape.weights, released)
        self._overshoot = overshoot
        self._strength: _Strength | None = None

    def vary(self, name: str, parameter: Parameter, weights: Callable[[float], Weights]) -> None:
        """Let its strength change while it plays.

        Args:
            name: of the parameter.
            parameter: the strength.
            weights: of morph targets at a strength.
        """
        self.parameters[name] = parameter
        self._strength = _Strength(parameter, parameter.value, weights)

    def follow(self, phase: float) -> None:
        """Sets weights and level for a phase; BML 1.0's overshoot raises the level at the attack peak."""
        strength = self._strength
        if strength is not None and strength.shown != strength.parameter.value:
            strength.shown = strength.parameter.value
            self.weights = strength.weights(strength.shown)
        peak = 1.0 + self._overshoot
        if phase < 1.0:
            self.level = peak * eased(phase)
        elif phase < 2.0:
            self.level = peak + (1.0 - peak) * eased(phase - 1.0)
        else:
            self.level = 1.0 - eased(phase - 2.0)


@dataclass(slots=True)
class _Strength:
    """The strength of an expression, its value in the last frame, and the weights at each value."""

    parameter: Parameter
    shown: float
    weights: Callable[[float], Weights]


class FaceAnimationUnit(FaceUnit):
    """A keyframe animation, which fades in so that a first row that is not neutral does not jump.

    Args:
        animation: to play.
        released: is given what is still shown at the end.

    Attributes:
        notes: faults of parts that are left out.
    """

    def __init__(
        self,
        block: BlockKey,
        behavior: Behavior,
        animation: FaceAnimation,
        released: Callable[[FaceUnit, GlobalTime], None],
    ) -> None:
        start = next(iter(animation.points.values()))
        timing = timing_at({sync: time - start for sync, time in animation.points.items()})
        super().__init__(block, behavior, timing, animation.phases, animation.weights(0.0), released)
        self._animation = animation
        self.notes = animation.notes

    def follow(self, phase: float) -> None:
        """Sets weights and level for a phase."""
        self.weights = self._animation.weights(phase)
        self.level = eased(min(1.0, phase * self._animation.duration / _FADE_IN))


class FaceShiftUnit(PlanUnit):
    """An expression that becomes the resting face.

    Args:
        weights: of morph targets at the amount of the behavior, 0..1.
        reached: is given the unit when it ends, completely or not.

    Attributes:
        weights: of morph targets at the amount of the behavior, 0..1.
        share: of the way from the resting face before, 0..1, in the last frame.
    """

    def __init__(
        self, block: BlockKey, behavior: Behavior, weights: Weights, reached: Callable[["FaceShiftUnit"], None]
    ) -> None:
        super().__init__(block, behavior, SHIFT_TIMING, frozenset({"resting face"}))
        self.weights = weights
        self.share = 0.0
        self._clock = PhaseClock(SHIFT_PHASES)
        self._reached = reached

    def on_finish(self, time: GlobalTime) -> None:
        """Has the resting face become what is shown; after an interruption, this is not the whole expression."""
        if self.state is UnitState.DONE and not self.points[-1].cut:
            self.share = 1.0
        self._reached(self)

    def shown(self, now: GlobalTime) -> "FaceShiftUnit":
        """The unit, with its share of now."""
        self.share = eased(self._clock.advance(self, now))
        return self


def eased(share: float) -> float:
    """A share of 0 to 1 that starts and ends slowly."""
    return share * share * (3.0 - 2.0 * share)


def _resources(weights: Weights) -> frozenset[str]:
    return frozenset({MOUTH} if any(morph.startswith(MOUTH_MORPHS) for morph in weights) else ())
