"""The parts of the body that behaviors move: a behavior that accompanies others gives way to those on the same part."""

from enum import Enum, auto

from reactive_realizer.bml.behavior import Behavior
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
)
from reactive_realizer.bml.extensions import FACES, MOTIONS
from reactive_realizer.bml.glance import Glance
from reactive_realizer.bml.key_poses import KeyPoses
from reactive_realizer.bml.murml.behaviors import MurmlFace, MurmlGesture
from reactive_realizer.bml.speech import RecordedSpeech, Speech
from reactive_realizer.bml.vocabulary import BodyGroup, PosePart
from reactive_realizer.bml.weight_shift import WeightShift


class BodyPart(Enum):
    """A part of the body, as an observer names it."""

    VOICE = auto()
    HEAD = auto()
    EYES = auto()
    FACE = auto()
    ARMS = auto()
    TRUNK = auto()


_PARTS: dict[type[Behavior], frozenset[BodyPart]] = {
    **dict.fromkeys((Speech, RecordedSpeech), frozenset({BodyPart.VOICE})),
    **dict.fromkeys((Gesture, MurmlGesture), frozenset({BodyPart.ARMS})),
    Pointing: frozenset({BodyPart.ARMS}),
    Head: frozenset({BodyPart.HEAD}),
    HeadDirectionShift: frozenset({BodyPart.HEAD}),
    # The eyes stay on their target while the head nods, so a gaze leaves it free.
    **dict.fromkeys((Gaze, GazeShift, Glance), frozenset({BodyPart.EYES})),
    **dict.fromkeys((Face, FaceFacs, FaceLexeme, FaceShift, MurmlFace, *FACES), frozenset({BodyPart.FACE})),
    **dict.fromkeys((Locomotion, WeightShift), frozenset({BodyPart.TRUNK})),
    **dict.fromkeys(MOTIONS, frozenset({BodyPart.HEAD, BodyPart.EYES, BodyPart.ARMS, BodyPart.TRUNK})),
}

_HEAD_GROUPS = (BodyGroup.HEAD, BodyGroup.HEAD_NECK)
_LEANING_GROUPS = (BodyGroup.HEAD_CHEST, BodyGroup.HEAD_BACK)
_ARM_GROUPS = (
    BodyGroup.LEFT_ARM,
    BodyGroup.RIGHT_ARM,
    BodyGroup.LEFT_HAND,
    BodyGroup.RIGHT_HAND,
    BodyGroup.SHOULDERS,
)

_GROUPS: dict[BodyGroup, frozenset[BodyPart]] = {
    **dict.fromkeys(_ARM_GROUPS, frozenset({BodyPart.ARMS})),
    **dict.fromkeys(_HEAD_GROUPS, frozenset({BodyPart.HEAD})),
    **dict.fromkeys(_LEANING_GROUPS, frozenset({BodyPart.HEAD, BodyPart.TRUNK})),
    BodyGroup.TRUNK: frozenset({BodyPart.TRUNK}),
    **dict.fromkeys((BodyGroup.EYES, BodyGroup.LEFT_EYE, BodyGroup.RIGHT_EYE), frozenset({BodyPart.EYES})),
    BodyGroup.WHOLEBODY: frozenset({BodyPart.HEAD, BodyPart.EYES, BodyPart.ARMS, BodyPart.TRUNK}),
}

_ARM_POSES = frozenset({PosePart.ARMS, PosePart.LEFT_ARM, PosePart.RIGHT_ARM, PosePart.WHOLEBODY})


def parts_of(behavior: Behavior) -> frozenset[BodyPart]:
    """The parts that a behavior moves; none for one of another kind, which controls others or is foreign."""
    if isinstance(behavior, Posture | PostureShift):
        parts = {pose.part for pose in behavior.poses}
        arms = {BodyPart.ARMS} if parts & _ARM_POSES else set()
        head = {BodyPart.HEAD} if PosePart.HEAD in parts else set()
        return frozenset({BodyPart.TRUNK, *arms, *head})
    if isinstance(behavior, KeyPoses):
        return _GROUPS[behavior.group]
    return _PARTS.get(type(behavior), frozenset())
