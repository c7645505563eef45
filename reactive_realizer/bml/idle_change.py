"""Changes of what a character does of itself all the time, in our own namespace: breathing, blinking, glances."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType
from typing import ClassVar, Final

from reactive_realizer.bml.attribute_types import Enumeration, Float
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.names import OWN

MOST = 120.0
"""Largest value of a parameter of idle animation."""


class IdleParameter(StrEnum):
    """A parameter of idle animation."""

    BREATHING_RATE = "BREATHING_RATE"
    """Breaths per minute."""
    BREATHING_DEPTH = "BREATHING_DEPTH"
    """Depth of breaths, relative to that at rest."""
    BLINK_RATE = "BLINK_RATE"
    """Blinks per minute; 0 for none."""
    BLINK_DEPTH = "BLINK_DEPTH"
    """Depth of blinks, relative to usual ones."""
    GLANCE_RATE = "GLANCE_RATE"
    """Glances aside per minute, of eyes without a target; 0 for none."""
    WEIGHT_SHIFT_RATE = "WEIGHT_SHIFT_RATE"
    """Shifts of the weight per minute, of a standing figure; 0 for none."""
    WEIGHT_SHIFT_DEPTH = "WEIGHT_SHIFT_DEPTH"
    """Width of shifts of the weight, relative to usual ones."""


MOSTS: Final[Mapping[IdleParameter, float]] = MappingProxyType(
    {
        **dict.fromkeys(IdleParameter, MOST),
        IdleParameter.BREATHING_DEPTH: 5.0,
        IdleParameter.BLINK_DEPTH: 1.0,
        IdleParameter.WEIGHT_SHIFT_RATE: 30.0,
        IdleParameter.WEIGHT_SHIFT_DEPTH: 2.0,
    }
)
"""Largest value of each parameter: what a body does."""


@dataclass(frozen=True, slots=True, kw_only=True)
class IdleChange(Behavior):
    """Changes a parameter of idle animation evenly, from its value at the start to another one at the end, which stays.

    After the autonomous behaviors of EMBR (A. Heloir and M. Kipp, 2010).

    Attributes:
        parameter: that changes.
        value: at the end, in the unit of the parameter.
    """

    NAMESPACE = OWN
    SYNC_POINTS: ClassVar[SyncPoints] = ("start", "end")

    parameter: IdleParameter = field(metadata=attribute(Enumeration(IdleParameter)))
    value: float = field(metadata=attribute(Float(0, MOST)))
