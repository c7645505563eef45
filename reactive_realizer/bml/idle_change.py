"""Changes of what a character does of itself all the time, in our own namespace: breathing, blinking, glances."""

from dataclasses import dataclass, field
from enum import StrEnum
from typing import ClassVar

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
    GLANCE_RATE = "GLANCE_RATE"
    """Glances aside per minute, of eyes without a target; 0 for none."""


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
