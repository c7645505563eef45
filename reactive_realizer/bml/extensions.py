"""The behaviors that BMLA and BMLT add to BML 1.0.

Those of continuous interaction act on other blocks and behaviors (thesis 6.6 and app. C); BMLA and BMLT write them
alike. `Emit` is an addition of this realizer. Those of BMLT alone play motion as it was made: animations, captures,
noise, transitions (app. C). Beside their start and end, these may have sync points that only their file defines, such
as the beats of a conducting pattern. `AudioFile` plays a sound.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import ClassVar, Final

from reactive_realizer.bml.attribute_types import BehaviorId, Enumeration, EventName, Float, Id, IdList, Integer, Text
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.behaviors import REACH, Pointing
from reactive_realizer.bml.names import BMLA, BMLT
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.bml.vocabulary import FacePart, InterruptSpeech, Mode, Reach

_START_AND_END: SyncPoints = ("start", "end")
_FACE_POINTS: SyncPoints = ("start", "attackPeak", "relax", "end")
_MOST_FAPU = 100_000.0
"""Largest value of a facial animation parameter."""
_LAST_VISEME, _LAST_EXPRESSION = 14, 6
WHOLE_FACE: Final = 63
"""The most of a blend or an intensity of MPEG-4's parameters that select faces."""


# --- continuous interaction


@dataclass(frozen=True, slots=True, kw_only=True)
class Activate(Behavior):
    """Starts a preplanned block (thesis 6.6.1).

    Attributes:
        target: id of the block.
    """

    NAMESPACE = BMLA
    SYNC_POINTS = _START_AND_END

    target: str = field(metadata=attribute(Id()))


@dataclass(frozen=True, slots=True, kw_only=True)
class Interrupt(Behavior):
    """Interrupts a block, or some of its behaviors (thesis 6.6.3).

    Attributes:
        target: id of the block.
        include: ids of the behaviors to interrupt; none means all.
        exclude: ids of the behaviors to leave alone.
        speech: the point at which an interrupted speech ends.
    """

    NAMESPACE = BMLA
    SYNC_POINTS = _START_AND_END

    target: str = field(metadata=attribute(Id()))
    include: tuple[str, ...] = field(default=(), metadata=attribute(IdList()))
    exclude: tuple[str, ...] = field(default=(), metadata=attribute(IdList()))
    speech: InterruptSpeech = field(default=InterruptSpeech.NOW, metadata=attribute(Enumeration(InterruptSpeech)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Emit(Behavior):
    """Emits an event to planners and to other behaviors (thesis 6.2.2, where its syntax is left open).

    Attributes:
        event: name of the event.
        content: for planners: the content of the element, as XML.
    """

    NAMESPACE = BMLA
    SYNC_POINTS = _START_AND_END
    ANY_CONTENT = True

    event: str = field(metadata=attribute(EventName()))
    content: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Trajectory:
    """The course of a parameter from one value to another.

    Attributes:
        type: name of the curve: linear, instant, or one that a plug-in registers.
        target_value: last value, in the unit of the parameter.
        initial_value: first value; None for the value that the parameter has then.
    """

    type: str = field(metadata=attribute(Text()))
    target_value: float = field(metadata=attribute(Float()))
    initial_value: float | None = field(default=None, metadata=attribute(Float()))


@dataclass(frozen=True, slots=True, kw_only=True)
class ParameterValueChange(Behavior):
    """Changes a parameter of a behavior while it plays (thesis 6.6.6).

    The parameter reaches its target value at the end, which BMLT also calls stroke.

    Attributes:
        target: id of the behavior, after the id of its block if that is another block: ``b1:speech1``.
        parameter: name of the parameter, such as volume.
        trajectory: the course of its values.
    """

    NAMESPACE = BMLA
    CHILDREN: ClassVar = ("trajectory",)
    SYNC_POINTS = ("start", "stroke", "end")

    target: str = field(metadata=attribute(BehaviorId()))
    parameter: str = field(metadata=attribute(Text(), "paramId"))
    trajectory: Trajectory

    @classmethod
    def complete_syncs(
        cls, syncs: Mapping[str, SyncRef], values: Mapping[str, object], namespace: str
    ) -> Mapping[str, SyncRef]:
        """Ties BMLT's stroke to whatever its end is tied to: the two are one point."""
        if namespace != BMLT or "stroke" in syncs or "end" not in syncs:
            return syncs
        return MappingProxyType({**syncs, "stroke": syncs["end"]})

    @property
    def target_block(self) -> str | None:
        """Id of the target's block; None for the block of this behavior."""
        return self.target.rpartition(":")[0] or None

    @property
    def target_behavior(self) -> str:
        """Id of the target in its block."""
        return self.target.rpartition(":")[2]


# --- motion


@dataclass(frozen=True, slots=True, kw_only=True)
class ProcAnimation(Behavior):
    """Plays a procedural animation (C.1.5).

    Attributes:
        animation: its name in a binding, or the name of its file without suffix.
        file_name: name of its file among the assets.
        mode: selects the hands of an animation that a binding has for several.
    """

    NAMESPACE = BMLT
    SYNC_POINTS = _START_AND_END
    OPEN_POINTS = True

    animation: str | None = field(default=None, metadata=attribute(Text(), "name"))
    file_name: str | None = field(default=None, metadata=attribute(Text()))
    mode: Mode | None = field(default=None, metadata=attribute(Enumeration(Mode)))


@dataclass(frozen=True, slots=True, kw_only=True)
class ProcAnimationGesture(ProcAnimation):
    """Plays a procedural animation as a gesture, with a preparation and a retraction."""

    SYNC_POINTS = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")


@dataclass(frozen=True, slots=True, kw_only=True)
class Keyframe(Behavior):
    """Plays a keyframe animation or a captured motion (C.1.2).

    Attributes:
        animation: name of its file, without suffix.
        interpolator: a ``SkeletonInterpolator`` written inside the behavior, as XML; played instead of a file.
    """

    NAMESPACE = BMLT
    CHILDREN: ClassVar = ("SkeletonInterpolator",)
    SYNC_POINTS = _START_AND_END
    OPEN_POINTS = True

    animation: str | None = field(default=None, metadata=attribute(Text(), "name"))
    interpolator: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Noise(Behavior):
    """Moves a joint at random (C.1.7).

    Attributes:
        type: of noise, such as perlin.
        joint: H-Anim name of the joint.
    """

    NAMESPACE = BMLT
    SYNC_POINTS = _START_AND_END

    type: str = field(metadata=attribute(Text()))
    joint: str = field(metadata=attribute(Text()))


@dataclass(frozen=True, slots=True, kw_only=True)
class Transition(Behavior):
    """Moves some joints from their present pose to the pose in which the following motions start (C.1.6).

    Attributes:
        kind: of curve, such as SlerpTransition.
    """

    NAMESPACE = BMLT
    SYNC_POINTS = _START_AND_END

    kind: str = field(metadata=attribute(Text(), "class"))


@dataclass(frozen=True, slots=True, kw_only=True)
class FaceMorph(Behavior):
    """A morph target of the avatar (C.1.8).

    Attributes:
        targetname: name of the morph target.
        intensity: weight of the morph target, 0 to 1.
    """

    NAMESPACE = BMLT
    SYNC_POINTS: ClassVar[SyncPoints] = _FACE_POINTS

    targetname: str = field(metadata=attribute(Text()))
    intensity: float = field(default=1.0, metadata=attribute(Float(0, 1)))


@dataclass(frozen=True, slots=True, kw_only=True)
class FaceFap(Behavior):
    """Facial animation parameters of MPEG-4 (thesis 8.8, which leaves their syntax open).

    The attributes with the names of ISO/IEC 14496-2 (annex C.2) are those of the parameters 1 (viseme) and 2
    (expression), which select faces.

    Attributes:
        fap: numbers or names of one or more parameters, such as ``12 raise_r_cornerlip``.
        value: displacement of the feature point of each of the others, in the unit of the parameter (FAPU).
        viseme_select1: index of a viseme.
        viseme_select2: index of another one.
        viseme_blend: how much of the first one is shown, in 63rds; the rest is the second one.
        expression_select1: index of an expression.
        expression_intensity1: its intensity, in 63rds.
        expression_select2: index of another one, which is added.
        expression_intensity2: its intensity, in 63rds.
    """

    NAMESPACE = BMLT
    SYNC_POINTS: ClassVar[SyncPoints] = _FACE_POINTS

    fap: str = field(metadata=attribute(Text()))
    value: float | None = field(default=None, metadata=attribute(Float(-_MOST_FAPU, _MOST_FAPU)))
    viseme_select1: int | None = field(default=None, metadata=attribute(Integer(0, _LAST_VISEME), "viseme_select1"))
    viseme_select2: int = field(default=0, metadata=attribute(Integer(0, _LAST_VISEME), "viseme_select2"))
    viseme_blend: int = field(default=WHOLE_FACE, metadata=attribute(Integer(0, WHOLE_FACE), "viseme_blend"))
    expression_select1: int | None = field(
        default=None, metadata=attribute(Integer(0, _LAST_EXPRESSION), "expression_select1")
    )
    expression_intensity1: int = field(
        default=WHOLE_FACE, metadata=attribute(Integer(0, WHOLE_FACE), "expression_intensity1")
    )
    expression_select2: int = field(default=0, metadata=attribute(Integer(0, _LAST_EXPRESSION), "expression_select2"))
    expression_intensity2: int = field(
        default=WHOLE_FACE, metadata=attribute(Integer(0, WHOLE_FACE), "expression_intensity2")
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class FacePlutchik(Behavior):
    """An emotion on Plutchik's wheel (thesis 8.8, which leaves its syntax open).

    Attributes:
        angle: on the wheel, degrees.
        activation: 0 for none to 7.
        intensity: factor of the activation, 0 to 1.
    """

    NAMESPACE = BMLT
    SYNC_POINTS: ClassVar[SyncPoints] = _FACE_POINTS

    angle: float = field(metadata=attribute(Float(0, 360)))
    activation: float = field(metadata=attribute(Float(0, 7)))
    intensity: float = field(default=1.0, metadata=attribute(Float(0, 1)))


@dataclass(frozen=True, slots=True, kw_only=True)
class FaceKeyframe(Behavior):
    """Plays a keyframe animation of the face, as AsapRealizer writes it.

    Attributes:
        animation: name of its file, without suffix.
        type: what its parts are.
        interpolator: a ``FaceInterpolator`` written inside the behavior, as XML; played instead of a file.
    """

    NAMESPACE = BMLT
    CHILDREN: ClassVar = ("FaceInterpolator",)
    SYNC_POINTS = _START_AND_END
    OPEN_POINTS = True

    animation: str | None = field(default=None, metadata=attribute(Text(), "name"))
    type: FacePart = field(default=FacePart.MORPH, metadata=attribute(Enumeration(FacePart)))
    interpolator: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Controller(Behavior):
    """Moves joints by forces (C.1.4). Without a constraint on its end it is persistent (C.4).

    Attributes:
        kind: of controller, such as BalanceController.
        controller: name of a compound controller.
    """

    NAMESPACE = BMLT
    SYNC_POINTS = _START_AND_END

    kind: str = field(metadata=attribute(Text(), "class"))
    controller: str | None = field(default=None, metadata=attribute(Text(), "name"))


MOTIONS: Final[frozenset[type[Behavior]]] = frozenset(
    {ProcAnimation, ProcAnimationGesture, Keyframe, Noise, Transition, Controller}
)
"""The behaviors that move joints, each in its own way."""

FACES: Final[frozenset[type[Behavior]]] = frozenset({FaceMorph, FaceFap, FacePlutchik, FaceKeyframe})
"""The behaviors that move the face, each in its own way."""


# --- sound


@dataclass(frozen=True, slots=True, kw_only=True)
class AudioFile(Behavior):
    """Plays a sound file (C.1.3).

    Attributes:
        file_name: name of the file among the assets. AsapRealizer writes ``fileName``.
    """

    NAMESPACE = BMLT
    SYNC_POINTS = _START_AND_END

    file_name: str = field(metadata=attribute(Text(), "filename", synonyms=("fileName",)))


# --- in any behavior


@dataclass(frozen=True, slots=True, kw_only=True)
class BehaviorParameter:
    """A ``<bmlt:parameter>``: a value for the engine that plays the behavior (C.1.1).

    Attributes:
        name: name of the parameter in that engine.
        value: as written.
    """

    name: str = field(metadata=attribute(Text()))
    value: str = field(metadata=attribute(Text()))


_LOOP: Final = "loop"
"""Parameter of a clip that is played over and over."""


def lasts(behavior: Behavior) -> bool:
    """Return whether a behavior is persistent, in any document, if its end is not tied.

    These are controllers, loops, and hands that hold on to a target.
    """
    looping = isinstance(behavior, Keyframe) and behavior.parameters.get(_LOOP, "").lower() in ("true", "1")
    holding = isinstance(behavior, Pointing) and behavior.extensions.get(REACH, "").strip().upper() == Reach.HOLD
    return looping or holding or isinstance(behavior, Controller)
