"""Which joints of a capture are which of H-Anim: those of limbs by their names, those of the trunk by their place."""

import re
from collections.abc import Collection, Iterator, Mapping, Sequence

from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.mixamo import JOINTS
from reactive_realizer.engines.animation.keyframe.capture import CapturedJoint

_SIDES = {"l": "l", "left": "l", "r": "r", "right": "r"}
_WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|\d+")

_NAMED_AFTER_BONES = {
    # MotionBuilder has the names of Mixamo, and so have the captures of CMU in the form that B. Hahne gave them.
    **{bone[4:].lower(): joint[2:] for bone, joint in JOINTS.items() if bone.startswith("Left")},
    **dict.fromkeys(("collar", "clavicle"), "sternoclavicular"),
    **dict.fromkeys(("upperarm", "shldr"), "shoulder"),
    "lowerarm": "elbow",
    **dict.fromkeys(("upperleg", "thigh"), "hip"),
    **dict.fromkeys(("lowerleg", "shin", "calf"), "knee"),
    **dict.fromkeys(("toe", "toes", "toe0"), "midtarsal"),
}
"""Mixamo, Rokoko, Poser, 3ds Max, Unreal, and many of no name."""

_NAMED_AFTER_JOINTS = {
    "collar": "sternoclavicular",
    **{name: name for name in ("shoulder", "elbow", "wrist", "hip", "knee", "ankle")},
    **dict.fromkeys(("toe", "foot"), "midtarsal"),
}
"""Biovision, Xsens, SMPL."""

_SPINE = {1: ("vl5",), 2: ("vl5", "vt6"), 3: ("vl5", "vt10", "vt6")}


def joints_of(joints: Sequence[CapturedJoint], known: Collection[str]) -> Mapping[str, int]:
    """What of a captured figure is known.

    Names of limbs say a side and a part, in one of several ways: "LeftUpLeg", "mixamorig:LeftUpLeg", "lThigh",
    "Bip01 L Thigh", "thigh_l", "LeftHip". The pelvis is what head and legs have in common, the spine leads from there
    to the arms, the neck from the arms to the head. A figure with joints of H-Anim is taken at its word.

    Args:
        joints: of the capture.
        known: joints of the figure that is to move.

    Returns:
        H-Anim name -> index in the capture.
    """
    own = {joint.name: index for index, joint in enumerate(joints) if joint.name in known}
    limbs = max((_limbs(joints, parts) for parts in (_NAMED_AFTER_BONES, _NAMED_AFTER_JOINTS)), key=len)
    found = {name: index for name, index in (limbs | _trunk(joints, limbs)).items() if name in known}
    return max(own, found, key=len)


def _limbs(joints: Sequence[CapturedJoint], parts: Mapping[str, str]) -> dict[str, int]:
    found: dict[str, int] = {}
    for index, joint in enumerate(joints):
        words = _words(joint.name)
        at = next((at for at, word in enumerate(words) if word in _SIDES), len(words))
        part = parts.get("".join(words[at + 1 :] or words[:at]))
        if part is not None and at < len(words):
            found.setdefault(f"{_SIDES[words[at]]}_{part}", index)
    return found


def _trunk(joints: Sequence[CapturedJoint], limbs: Mapping[str, int]) -> dict[str, int]:
    head = next((index for index, joint in enumerate(joints) if _words(joint.name)[-1:] == ["head"]), None)
    if head is None or "l_hip" not in limbs or "r_hip" not in limbs:
        return {}
    legs = {*_upwards(joints, limbs["l_hip"])}.intersection(_upwards(joints, limbs["r_hip"]))
    up = [index for index in _upwards(joints, head) if index not in legs][:0:-1]
    arm = {*_upwards(joints, limbs.get("l_shoulder", head))}
    spine, neck = [index for index in up if index in arm], [index for index in up if index not in arm]
    pelvis = next(index for index in _upwards(joints, head) if index in legs)
    return {ROOT: pelvis, "skullbase": head, **({"vc4": neck[0]} if neck else {}), **_vertebrae(spine)}


def _vertebrae(spine: Sequence[int]) -> dict[str, int]:
    """Of many the lowest, one in the middle and the highest."""
    chosen = [spine[0], spine[len(spine) // 2], spine[-1]] if len(spine) > 3 else spine
    return dict(zip(_SPINE.get(len(chosen), ()), chosen, strict=True))


def _words(name: str) -> list[str]:
    """Of a name; what stands before a colon is no part of it."""
    return [word.lower() for word in _WORD.findall(name.rpartition(":")[2])]


def _upwards(joints: Sequence[CapturedJoint], index: int) -> Iterator[int]:
    """A joint and those above it."""
    while index >= 0:
        yield index
        index = joints[index].parent
