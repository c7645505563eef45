"""An expression in a plan."""

from collections.abc import Callable, Mapping

from reactive_realizer.bml.face import FaceLexeme
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.phase_clock import PhaseClock
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing

_KEYS = {"start": 0.0, "attackPeak": 1.0, "relax": 2.0, "end": 3.0}
TIMING = Timing(tuple(_KEYS), (Phase(0.5), Phase(1.0, PhaseKind.HOLD), Phase(0.5)))
"""The attack and the decay are a quarter each of a preferred two seconds."""

MOUTH = "mouth"


class FaceUnit(PlanUnit):
    """A face that comes, is held, and goes.

    Attributes:
        weights: of morph targets in full, 0..1.
    """

    def __init__(
        self,
        block: BlockKey,
        behavior: FaceLexeme,
        weights: Mapping[str, float],
        released: Callable[["FaceUnit", GlobalTime], None],
    ) -> None:
        mouth = any(morph.startswith(("mouth", "jaw")) for morph in weights)
        super().__init__(block, behavior, TIMING, frozenset({MOUTH} if mouth else ()))
        self.weights = weights
        self.level = 0.0
        self._amount, self._overshoot = behavior.amount, behavior.overshoot
        self._clock = PhaseClock(_KEYS)
        self._released = released

    def on_finish(self, time: GlobalTime) -> None:
        """What is left of the face fades."""
        self._released(self, time)

    def shown(self, now: GlobalTime) -> dict[str, float]:
        """Weights of morph targets now."""
        self.level = self._level(self._clock.advance(self, now))
        return {morph: weight * self.level for morph, weight in self.weights.items()}

    def _level(self, phase: float) -> float:
        """How much of the face there is; at the attack peak it may be more than what is held (BML 1.0: overshoot)."""
        peak = self._amount * (1.0 + self._overshoot)
        if phase < 1.0:
            return peak * _eased(phase)
        if phase < 2.0:
            return peak + (self._amount - peak) * _eased(phase - 1.0)
        return self._amount * (1.0 - _eased(phase - 2.0))


def _eased(share: float) -> float:
    return share * share * (3.0 - 2.0 * share)
