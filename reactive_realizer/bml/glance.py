"""Single glances aside, an extension of BML."""

from dataclasses import dataclass, field
from typing import ClassVar, Final

from reactive_realizer.bml.attribute_types import Float
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.names import OWN

FURTHEST: Final = 40.0
"""Largest turn of the eyes in each direction, degrees."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Glance(Behavior):
    """Turns the eyes aside from where they look, and back at the end; the head stays.

    After the single saccades of SmartBody.

    Attributes:
        left: turn to the left as the character sees it, degrees; below 0 to the right.
        up: turn upward, degrees; below 0 downward.
    """

    NAMESPACE = OWN
    SYNC_POINTS: ClassVar[SyncPoints] = ("start", "end")

    left: float = field(metadata=attribute(Float(-FURTHEST, FURTHEST)))
    up: float = field(metadata=attribute(Float(-FURTHEST, FURTHEST)))
