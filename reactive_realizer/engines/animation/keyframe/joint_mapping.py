"""Which joints of a captured figure are H-Anim joints."""

import re
from collections.abc import Collection, Iterator, Mapping, Sequence

from reactive_realizer.embodiment.joints import FINGERS, ROOT
from reactive_realizer.embodiment.mixamo import JOINTS
from reactive_realizer.engines.animation.keyframe.capture import CapturedJoint

_SIDES = {"l": "l", "left": "l", "r": "r", "right": "r"}
_WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|\d+")

_NAMED_AFTER_BONES = {
    # MotionBuilder uses Mixamo's names, and so do the CMU captures as converted by B. Hahne.
    **{bone[4:].lower(): joint[2:] for bone, joint in JOINTS.items() if bone.startswith("Left")},
    **dict.fromkeys(("collar", "clavicle"), "sternoclavicular"),
    **dict.fromkeys(("upperarm", "shldr", "humerus"), "shoulder"),
    **dict.fromkeys(("lowerarm", "radius"), "elbow"),
    **dict.fromkeys(("upperleg", "thigh", "femur"), "hip"),
    **dict.fromkeys(("lowerleg", "shin", "calf", "tibia"), "knee"),
    **dict.fromkeys(("toe", "toes", "toe0"), "midtarsal"),
    **{
        f"{number}{bone}": f"{finger}{joint}"
        for number, finger in enumerate(FINGERS, 1)
        for joint, bone in enumerate(("mcp", "prox", "dist"), 1)
    },
}
"""Names in Mixamo, Rokoko, Poser, 3ds Max, Unreal, Acclaim, and many other files; of fingers also in EMBR's poses."""

_NAMED_AFTER_JOINTS = {
    "collar": "sternoclavicular",
    **{name: name for name in ("shoulder", "elbow", "wrist", "hip", "knee", "ankle")},
    **dict.fromkeys(("toe", "foot"), "midtarsal"),
}
"""Names in Biovision, Xsens, SMPL."""

_SPINE = {1: ("vl5",), 2: ("vl5", "vt6"), 3: ("vl5", "vt10", "vt6")}


def map_joints(joints: Sequence[CapturedJoint], known: Collection[str]) -> Mapping[str, int]:
    """Map H-Anim joints to joints of a captured figure: limbs by name, the trunk by its position in the tree.

    Names of limbs contain a side and a part, in one of several forms: "LeftUpLeg", "mixamorig:LeftUpLeg", "lThigh",
    "Bip01 L Thigh", "thigh_l", "LeftHip". The pelvis is the common ancestor of head and legs, the spine leads from
    there to the arms, and the neck from the arms to the head. A figure with H-Anim names is used as it is.

    Args:
        joints: of the capture.
        known: joints of the figure that will move.

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
    """Return up to three joints of the spine: the lowest, one in the middle, and the highest."""
    chosen = [spine[0], spine[len(spine) // 2], spine[-1]] if len(spine) > 3 else spine
    return dict(zip(_SPINE.get(len(chosen), ()), chosen, strict=True))


def _words(name: str) -> list[str]:
    """Split a name into words, without the prefix before a colon; the side of lhumerus is a word of its own."""
    words = [word.lower() for word in _WORD.findall(name.rpartition(":")[2])]
    if len(words) == 1 and words[0][0] in "lr" and words[0][1:] in _NAMED_AFTER_BONES:
        return [words[0][0], words[0][1:]]
    return words


def _upwards(joints: Sequence[CapturedJoint], index: int) -> Iterator[int]:
    """Yield a joint and its ancestors."""
    while index >= 0:
        yield index
        index = joints[index].parent
