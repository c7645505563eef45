"""The joints of body groups."""

from typing import Final

from reactive_realizer.bml.vocabulary import BodyGroup
from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.embodiment.joints import EYES, HEAD, LEFT_ARM, RIGHT_ARM, TRUNK

_NOT_FINGERS: Final = ("sternoclavicular", "shoulder", "elbow", "wrist")


def group_joints(group: BodyGroup, skeleton: Skeleton) -> tuple[str, ...]:
    """Return the joints of a group that a figure has."""
    arms = {
        BodyGroup.LEFT_ARM: [f"l_{name}" for name in _NOT_FINGERS],
        BodyGroup.RIGHT_ARM: [f"r_{name}" for name in _NOT_FINGERS],
        BodyGroup.LEFT_HAND: LEFT_ARM - {f"l_{name}" for name in _NOT_FINGERS},
        BodyGroup.RIGHT_HAND: RIGHT_ARM - {f"r_{name}" for name in _NOT_FINGERS},
        BodyGroup.HEAD: HEAD[1:],
        BodyGroup.HEAD_NECK: HEAD,
        BodyGroup.HEAD_CHEST: (*TRUNK[2:], *HEAD),
        BodyGroup.HEAD_BACK: (*TRUNK[1:], *HEAD),
        BodyGroup.TRUNK: TRUNK[1:],
        BodyGroup.SHOULDERS: ("l_sternoclavicular", "r_sternoclavicular"),
        BodyGroup.EYES: EYES,
        BodyGroup.LEFT_EYE: EYES[:1],
        BodyGroup.RIGHT_EYE: EYES[1:],
        BodyGroup.WHOLEBODY: skeleton.joints,
    }
    return tuple(joint for joint in skeleton.joints if joint in arms[group])
