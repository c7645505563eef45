"""The plan units of the face: an expression that comes and goes, and one that stays."""

from collections.abc import Callable

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engines.face.expressions import Weights
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.phase_clock import PhaseClock
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing

MOUTH = "mouth"
MOUTH_MORPHS = ("mouth", "jaw", "tongue")
"""Prefixes of the names of the morph targets of the mouth."""

_PHASES = {"start": 0.0, "attackPeak": 1.0, "relax": 2.0, "end": 3.0}
TIMING = Timing(tuple(_PHASES), (Phase(0.5), Phase(1.0, PhaseKind.HOLD), Phase(0.5)))
"""The attack and the decay take a quarter each of the preferred two seconds."""

_SHIFT_PHASES = {"start": 0.0, "end": 1.0}
SHIFT_TIMING = Timing(tuple(_SHIFT_PHASES), (Phase(0.5),))


class FaceUnit(PlanUnit):
    """An expression: attack, hold and decay.

    Args:
        weights: of morph targets at the amount of the behavior, 0..1.
        overshoot: fraction by which the attack peak exceeds them.
        released: is given what is still shown at the end.

    Attributes:
        weights: of morph targets at the amount of the behavior, 0..1.
        level: the factor of these weights in the last frame.
    """

    def __init__(
        self,
        block: BlockKey,
        behavior: Behavior,
        weights: Weights,
        overshoot: float,
        released: Callable[["FaceUnit", GlobalTime], None],
    ) -> None:
        super().__init__(block, behavior, TIMING, _resources(weights))
        self.weights = weights
        self.level = 0.0
        self._overshoot = overshoot
        self._clock = PhaseClock(_PHASES)
        self._released = released

    def on_finish(self, time: GlobalTime) -> None:
        """Hands over the weights that are still shown, which then fade."""
        self._released(self, time)

    def shown(self, now: GlobalTime) -> "FaceUnit":
        """The unit, with its level of now."""
        self.level = self._level(self._clock.advance(self, now))
        return self

    def _level(self, phase: float) -> float:
        """The factor of the weights at a phase; BML 1.0's overshoot raises it at the attack peak."""
        peak = 1.0 + self._overshoot
        if phase < 1.0:
            return peak * eased(phase)
        if phase < 2.0:
            return peak + (1.0 - peak) * eased(phase - 1.0)
        return 1.0 - eased(phase - 2.0)


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
        self._clock = PhaseClock(_SHIFT_PHASES)
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
