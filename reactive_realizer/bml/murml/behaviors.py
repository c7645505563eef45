"""The behaviors of MURML in BML, as AsapRealizer has them."""

from dataclasses import dataclass, field
from typing import ClassVar

from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.murml.description import Keyframing, MurmlDescription
from reactive_realizer.bml.names import MURML

DESCRIPTION = "murml-description"
"""Name of the element that both contain."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MurmlGesture(Behavior):
    """A gesture, described by constraints of its hands or by key frames. Values with an id are further sync points.

    Attributes:
        description: what it means.
        content: its `murml-description`, as XML.
    """

    NAMESPACE = MURML
    CHILDREN: ClassVar = (DESCRIPTION,)
    SYNC_POINTS: ClassVar[SyncPoints] = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")
    OPEN_POINTS = True

    description: MurmlDescription
    content: str = field(compare=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class MurmlFace(Behavior):
    """Key frames of the face.

    Attributes:
        keyframing: its key frames.
        content: its `murml-description`, as XML.
    """

    NAMESPACE = MURML
    CHILDREN: ClassVar = (DESCRIPTION,)
    SYNC_POINTS: ClassVar[SyncPoints] = ("start", "attackPeak", "relax", "end")

    keyframing: Keyframing
    content: str = field(compare=False)
