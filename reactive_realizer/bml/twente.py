"""The behaviors that BMLT adds to play motion as it was made: animations, captures, noise, transitions (thesis app. C).

Beside the two sync points of each, whatever plays it may know more: a conducting pattern has its beats.
"""

from dataclasses import dataclass, field
from typing import ClassVar

from reactive_realizer.bml.attribute_types import Text, Word
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.names import BMLT
from reactive_realizer.bml.words import Mode

_POINTS: SyncPoints = ("start", "end")


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter:
    """A value for what plays a behavior, by the name that this one has for it (C.1.1); it may stand in any behavior."""

    name: str = field(metadata=attribute(Text()))
    value: str = field(metadata=attribute(Text()))


@dataclass(frozen=True, slots=True, kw_only=True)
class ProcAnimation(Behavior):
    """Plays a procedural animation as it is (C.1.5).

    Attributes:
        animation: its name, which a binding may know, else that of its file without suffix.
        file_name: name of its file among the assets.
        mode: of an animation that a binding has for several hands: which.
    """

    NAMESPACE = BMLT
    SYNC_POINTS = _POINTS
    OPEN_POINTS = True

    animation: str | None = field(default=None, metadata=attribute(Text(), "name"))
    file_name: str | None = field(default=None, metadata=attribute(Text()))
    mode: Mode | None = field(default=None, metadata=attribute(Word(Mode)))


@dataclass(frozen=True, slots=True, kw_only=True)
class ProcAnimationGesture(ProcAnimation):
    """Plays a procedural animation as a gesture: with a preparation and a retraction of its own."""

    SYNC_POINTS = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")


@dataclass(frozen=True, slots=True, kw_only=True)
class Keyframe(Behavior):
    """Plays a keyframe animation or a captured motion (C.1.2).

    Attributes:
        animation: name of its file, without suffix.
        interpolator: one that stands inside, a ``SkeletonInterpolator`` as XML, which is played in place of a file.
    """

    NAMESPACE = BMLT
    CHILDREN: ClassVar = ("SkeletonInterpolator",)
    SYNC_POINTS = _POINTS
    OPEN_POINTS = True

    animation: str | None = field(default=None, metadata=attribute(Text(), "name"))
    interpolator: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Noise(Behavior):
    """Stirs a joint at random (C.1.7).

    Attributes:
        type: of noise, such as perlin.
        joint: its H-Anim name.
    """

    NAMESPACE = BMLT
    SYNC_POINTS = _POINTS

    type: str = field(metadata=attribute(Text()))
    joint: str = field(metadata=attribute(Text()))


@dataclass(frozen=True, slots=True, kw_only=True)
class Transition(Behavior):
    """Leads some joints from where they are to where the motions after it find them (C.1.6).

    Attributes:
        kind: of curve, such as SlerpTransition.
    """

    NAMESPACE = BMLT
    SYNC_POINTS = _POINTS

    kind: str = field(metadata=attribute(Text(), "class"))


BEHAVIORS: frozenset[type[Behavior]] = frozenset({ProcAnimation, ProcAnimationGesture, Keyframe, Noise, Transition})
"""All of them."""
