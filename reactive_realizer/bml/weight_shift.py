"""Shifts of the weight to a foot, an extension of BML."""

from dataclasses import dataclass, field
from typing import ClassVar

from reactive_realizer.bml.attribute_types import Float
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.names import OWN


@dataclass(frozen=True, slots=True, kw_only=True)
class WeightShift(Behavior):
    """Shifts the weight of a standing character, which stays there until idle animation shifts it again.

    Attributes:
        side: the supporting foot, from -1, the right one, to 1, the left one; 0 for both.
    """

    NAMESPACE = OWN
    SYNC_POINTS: ClassVar[SyncPoints] = ("start", "end")

    side: float = field(metadata=attribute(Float(-1, 1)))
