"""Maps Mixamo bones to H-Anim joints.

A Mixamo avatar rests in a T-pose; in the H-Anim default pose the arms hang. A_j is the turn of joint j's bone from the
T-pose to the default pose, in the figure's axes. A bone that turned as its joint did is at R_j A_j.
"""

import math
from collections.abc import Mapping

from reactive_realizer.embodiment.joints import JAW
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, from_axis_angle

_FINGERS = {"Thumb": "thumb", "Index": "index", "Middle": "middle", "Ring": "ring", "Pinky": "pinky"}

_SIDE = {
    "Shoulder": "sternoclavicular",
    "Arm": "shoulder",
    "ForeArm": "elbow",
    "Hand": "wrist",
    **{f"Hand{bone}{i}": f"{joint}{i}" for bone, joint in _FINGERS.items() for i in (1, 2, 3)},
    "UpLeg": "hip",
    "Leg": "knee",
    "Foot": "ankle",
    "ToeBase": "midtarsal",
    "Eye": "eyeball_joint",
}

# Three bones stand for seventeen lumbar and thoracic vertebrae, two for the neck. Each maps to the joint near it that
# AsapRealizer's animations turn most.
_TRUNK = {"Hips": "HumanoidRoot", "Spine": "vl5", "Spine1": "vt10", "Spine2": "vt6", "Neck": "vc4", "Head": "skullbase"}

JOINTS: Mapping[str, str] = {
    **_TRUNK,
    "Jaw": JAW,
    **{f"Left{bone}": f"l_{joint}" for bone, joint in _SIDE.items()},
    **{f"Right{bone}": f"r_{joint}" for bone, joint in _SIDE.items()},
}
"""Mixamo bone -> H-Anim joint."""

_ARM = ("shoulder", "elbow", "wrist", *(f"{joint}{i}" for joint in _FINGERS.values() for i in (1, 2, 3)))
_DOWN = {
    "l": from_axis_angle((0.0, 0.0, 1.0), -0.5 * math.pi),
    "r": from_axis_angle((0.0, 0.0, 1.0), 0.5 * math.pi),
}
_ALIGNMENT = {f"{side}_{joint}": turn for side, turn in _DOWN.items() for joint in _ARM}


def alignment(joint: str) -> Quat:
    """Return A_j: the turn from the T-pose to the default pose, in the figure's axes; identity outside the arms."""
    return _ALIGNMENT.get(joint, IDENTITY)
