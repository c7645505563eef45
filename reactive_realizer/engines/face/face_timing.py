"""The preferred timing of faces."""

from typing import Final, NamedTuple

from reactive_realizer.engines.face.weights import Weights
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing

EXPRESSION_PHASES: Final = {"start": 0.0, "attackPeak": 1.0, "relax": 2.0, "end": 3.0}
SHIFT_PHASES: Final = {"start": 0.0, "end": 1.0}
SHIFT_TIMING: Final = Timing(tuple(SHIFT_PHASES), (Phase(0.5),))


def expression_timing(attack: float, hold: float, decay: float) -> Timing:
    """The timing of an expression, from the durations of its phases, s."""
    return Timing(tuple(EXPRESSION_PHASES), (Phase(attack), Phase(hold, PhaseKind.HOLD), Phase(decay)))


TIMING: Final = expression_timing(0.5, 1.0, 0.5)
"""The attack and the decay take a quarter each of the preferred two seconds."""


class FaceShape(NamedTuple):
    """An expression.

    Attributes:
        weights: of morph targets, 0..1.
        timing: that it prefers.
    """

    weights: Weights
    timing: Timing = TIMING
