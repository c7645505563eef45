"""Hands that let go of what they carry or hold on to, an extension of BML."""

from dataclasses import dataclass, field
from typing import ClassVar

from reactive_realizer.bml.attribute_types import Enumeration
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.names import OWN
from reactive_realizer.bml.vocabulary import Mode


@dataclass(frozen=True, slots=True, kw_only=True)
class Release(Behavior):
    """Lets go of what hands carry, at its start: it stays where it is. Ends the pointings in which they hold a target.

    Attributes:
        mode: the hands.
    """

    NAMESPACE = OWN
    SYNC_POINTS: ClassVar[SyncPoints] = ("start", "end")

    mode: Mode = field(metadata=attribute(Enumeration(Mode)))
