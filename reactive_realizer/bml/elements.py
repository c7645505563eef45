"""The table of the core behaviors, from which parser, support tables and ``/capabilities`` are made."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from reactive_realizer.bml.attributes import Attribute, attributes_of
from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.behaviors import (
    Gaze,
    GazeShift,
    Gesture,
    Head,
    HeadDirectionShift,
    Locomotion,
    Pointing,
    Speech,
    Wait,
)
from reactive_realizer.bml.face import Face, FaceFacs, FaceLexeme, FaceShift
from reactive_realizer.bml.posture import Posture, PostureShift


@dataclass(frozen=True, slots=True)
class Element:
    """An element of BML 1.0 that is a behavior.

    Attributes:
        name: local name.
        namespace: the core's or that of the core extensions.
        behavior: the class of what is read from it.
        attributes: those other than sync points.
    """

    name: str
    namespace: str
    behavior: type[Behavior]
    attributes: tuple[Attribute, ...]

    @property
    def children(self) -> tuple[str, ...]:
        """The elements that it may hold beside descriptions."""
        return self.behavior.CHILDREN

    @property
    def sync_points(self) -> SyncPoints:
        """Its default sync points, each of them an attribute too, in the order in which they are reached."""
        return self.behavior.SYNC_POINTS


def _element(behavior: type[Behavior]) -> Element:
    name = behavior.__name__
    return Element(name[0].lower() + name[1:], behavior.NAMESPACE, behavior, attributes_of(behavior))


_BEHAVIORS = (
    Speech,
    Gesture,
    Pointing,
    Head,
    HeadDirectionShift,
    Gaze,
    GazeShift,
    Face,
    FaceLexeme,
    FaceFacs,
    FaceShift,
    Posture,
    PostureShift,
    Locomotion,
    Wait,
)

ELEMENTS: Mapping[str, Element] = MappingProxyType({each.name: each for each in map(_element, _BEHAVIORS)})
"""The core behaviors by the name of their element; core and core extensions share no name."""
