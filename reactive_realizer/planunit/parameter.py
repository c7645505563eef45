"""What of a behavior may be changed while it plays (thesis 6.6.6)."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from reactive_realizer.reactive.cell import Source

if TYPE_CHECKING:
    from reactive_realizer.planunit.plan_unit import PlanUnit


@dataclass(slots=True, eq=False)
class Parameter:
    """A value with a range, as a cell: whatever shows it follows.

    Attributes:
        cell: the value; written by the scheduler alone.
        low: smallest value that means something.
        high: largest.
        owner: the unit that changed it last; of two that change it, the later start wins.
    """

    cell: Source[float]
    low: float
    high: float
    owner: "PlanUnit | None" = None
