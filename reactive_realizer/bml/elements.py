"""The table of the behaviors, from which parser, support tables and ``/capabilities`` are made."""

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
from reactive_realizer.bml.continuous import Activate, Interrupt, ParameterValueChange
from reactive_realizer.bml.face import Face, FaceFacs, FaceLexeme, FaceShift
from reactive_realizer.bml.names import BML, BML_EXT, BMLA, CONTINUOUS
from reactive_realizer.bml.posture import Posture, PostureShift
from reactive_realizer.bml.twente import Keyframe, Noise, ProcAnimation, ProcAnimationGesture, Transition


@dataclass(frozen=True, slots=True)
class Element:
    """An element of BML 1.0, of continuous interaction or of BMLT that is a behavior.

    Attributes:
        name: local name.
        namespace: the core's, that of the core extensions, BMLA's, or BMLT's.
        behavior: the class of what is read from it.
        attributes: those other than sync points.
    """

    name: str
    namespace: str
    behavior: type[Behavior]
    attributes: tuple[Attribute, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """Those of its attributes that are no sync points."""
        return tuple(each.name for each in self.attributes)

    @property
    def continuous(self) -> bool:
        """Whether it is none of BML 1.0's."""
        return self.namespace in CONTINUOUS

    @property
    def namespaces(self) -> tuple[str, ...]:
        """Where it may stand: what is the core's also in none, what is BMLA's also in that of BMLT."""
        if not self.continuous:
            return ("", BML, BML_EXT)
        return CONTINUOUS if self.namespace == BMLA else (self.namespace,)

    @property
    def children(self) -> tuple[str, ...]:
        """The elements that it may hold beside descriptions."""
        return self.behavior.CHILDREN

    @property
    def sync_points(self) -> SyncPoints:
        """Its default sync points, each of them an attribute too, in the order in which they are reached."""
        return self.behavior.SYNC_POINTS


def _element(behavior: type[Behavior]) -> Element:
    return Element(_name(behavior), behavior.NAMESPACE, behavior, attributes_of(behavior))


def _name(behavior: type[Behavior]) -> str:
    """BML 1.0 writes it in camelCase, the others in small letters."""
    name = behavior.__name__
    return name.lower() if behavior.NAMESPACE in CONTINUOUS else name[0].lower() + name[1:]


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
    Activate,
    Interrupt,
    ParameterValueChange,
    ProcAnimation,
    ProcAnimationGesture,
    Keyframe,
    Noise,
    Transition,
)

ELEMENTS: Mapping[str, Element] = MappingProxyType({each.name: each for each in map(_element, _BEHAVIORS)})
"""The behaviors by the name of their element; no two of them share one."""
