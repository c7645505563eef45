"""The table of behavior elements, which the parser, the support tables and ``/capabilities`` read."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from reactive_realizer.bml.attributes import Attribute, attributes_of
from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.behaviors import (
    Face,
    FaceFacs,
    FaceLexeme,
    FaceShift,
    Gaze,
    GazeShift,
    Gesture,
    Head,
    HeadDirectionShift,
    Locomotion,
    Pointing,
    Posture,
    PostureShift,
    Wait,
)
from reactive_realizer.bml.extensions import (
    Activate,
    AudioFile,
    Controller,
    Emit,
    FaceFap,
    FaceKeyframe,
    FaceMorph,
    FacePlutchik,
    Interrupt,
    Keyframe,
    Noise,
    ParameterValueChange,
    ProcAnimation,
    ProcAnimationGesture,
    Transition,
)
from reactive_realizer.bml.glance import Glance
from reactive_realizer.bml.idle_change import IdleChange
from reactive_realizer.bml.key_poses import KeyPoses
from reactive_realizer.bml.murml.behaviors import MurmlFace, MurmlGesture
from reactive_realizer.bml.names import BML, BML_EXT, BMLA, CONTINUOUS, MURML
from reactive_realizer.bml.release import Release
from reactive_realizer.bml.speech import Speech
from reactive_realizer.bml.weight_shift import WeightShift


@dataclass(frozen=True, slots=True)
class Element:
    """The element of a behavior in BML 1.0, BMLA, BMLT, MURML or our own extensions.

    Attributes:
        name: local name.
        namespace: of BML 1.0, its core extensions, BMLA, BMLT, MURML or our own.
        behavior: class of the behavior.
        attributes: its attributes other than sync points.
    """

    name: str
    namespace: str
    behavior: type[Behavior]
    attributes: tuple[Attribute, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The names of its attributes other than sync points, synonyms included."""
        return tuple(name for each in self.attributes for name in each.spellings)

    @property
    def core(self) -> bool:
        """True for an element of BML 1.0 or of its core extensions."""
        return self.namespace in (BML, BML_EXT)

    @property
    def continuous(self) -> bool:
        """True for an element of BMLA or BMLT, the extensions for continuous interaction."""
        return self.namespace in CONTINUOUS

    @property
    def namespaces(self) -> tuple[str, ...]:
        """The namespaces in which it may be written: none for BML 1.0 too, that of BMLT for BMLA too."""
        if self.core:
            return ("", BML, BML_EXT)
        return CONTINUOUS if self.namespace == BMLA else (self.namespace,)

    @property
    def children(self) -> tuple[str, ...]:
        """Names of the elements that it may contain besides descriptions."""
        return self.behavior.CHILDREN

    @property
    def sync_points(self) -> SyncPoints:
        """Its default sync points, each of which is also an attribute, in the order of time."""
        return self.behavior.SYNC_POINTS


def _element(behavior: type[Behavior]) -> Element:
    return Element(_name(behavior), behavior.NAMESPACE, behavior, attributes_of(behavior))


def _name(behavior: type[Behavior]) -> str:
    """The name of an element: camelCase in BML 1.0, lowercase in the others."""
    name = behavior.__name__
    return name.lower() if behavior.NAMESPACE in (*CONTINUOUS, MURML) else name[0].lower() + name[1:]


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
    Emit,
    ProcAnimation,
    ProcAnimationGesture,
    Keyframe,
    Noise,
    Transition,
    Controller,
    FaceMorph,
    AudioFile,
    FaceFap,
    FacePlutchik,
    FaceKeyframe,
    KeyPoses,
    Glance,
    Release,
    IdleChange,
    WeightShift,
    MurmlGesture,
    MurmlFace,
)

ELEMENTS: Mapping[str, Element] = MappingProxyType({each.name: each for each in map(_element, _BEHAVIORS)})
"""The elements by name, which is unique."""
