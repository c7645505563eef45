"""Maps the bone names of common rigs to H-Anim joints."""

import re
from collections.abc import Iterator, Mapping

from reactive_realizer.embodiment.joints import JAW
from reactive_realizer.embodiment.mixamo import JOINTS

_SIDES = {"l": "left", "r": "right"}
_FINGERS = ("index", "middle", "ring", "pinky")

_LIMBS = {
    "shoulder": "sternoclavicular",
    "upperArm": "shoulder",
    "lowerArm": "elbow",
    "hand": "wrist",
    "upperLeg": "hip",
    "lowerLeg": "knee",
    "foot": "ankle",
    "toes": "midtarsal",
    "eye": "eyeball_joint",
}
_VRM_TRUNK = {
    "hips": "HumanoidRoot",
    "spine": "vl5",
    "chest": "vt10",
    "upperChest": "vt6",
    "neck": "vc4",
    "head": "skullbase",
    "jaw": JAW,
}


def _vrm(thumb: tuple[str, str, str]) -> Iterator[tuple[str, str]]:
    yield from _VRM_TRUNK.items()
    for side, word in _SIDES.items():
        yield from ((word + bone[0].upper() + bone[1:], f"{side}_{joint}") for bone, joint in _LIMBS.items())
        yield from ((f"{word}Thumb{part}", f"{side}_thumb{i}") for i, part in enumerate(thumb, 1))
        for finger in _FINGERS:
            name = "Little" if finger == "pinky" else finger.capitalize()
            parts = enumerate(("Proximal", "Intermediate", "Distal"), 1)
            yield from ((f"{word}{name}{part}", f"{side}_{finger}{i}") for i, part in parts)


VRM_0_JOINTS: Mapping[str, str] = dict(_vrm(("Proximal", "Intermediate", "Distal")))
"""Human bone of VRM 0, and of Unity -> H-Anim joint."""

VRM_1_JOINTS: Mapping[str, str] = dict(_vrm(("Metacarpal", "Proximal", "Distal")))
"""Human bone of VRM 1 -> H-Anim joint."""

# Unreal Engine, and MPFB's rig "game_engine".
_UNREAL_TRUNK = {
    "pelvis": "HumanoidRoot",
    "spine_01": "vl5",
    "spine_02": "vt10",
    "spine_03": "vt6",
    "neck_01": "vc4",
    "head": "skullbase",
}
_UNREAL_LIMBS = {
    "clavicle": "sternoclavicular",
    "upperarm": "shoulder",
    "lowerarm": "elbow",
    "hand": "wrist",
    "thigh": "hip",
    "calf": "knee",
    "foot": "ankle",
    "ball": "midtarsal",
    **{f"{finger}_0{i}": f"{finger}{i}" for finger in ("thumb", *_FINGERS) for i in (1, 2, 3)},
}


# Blender's Rigify, deforming bones.
_RIGIFY_TRUNK = {
    "DEF-spine": "HumanoidRoot",
    "DEF-spine.001": "vl5",
    "DEF-spine.002": "vt10",
    "DEF-spine.003": "vt6",
    "DEF-spine.004": "vc4",
    "DEF-spine.006": "skullbase",
    "DEF-jaw": JAW,
}
_RIGIFY_LIMBS = {
    "shoulder": "sternoclavicular",
    "upper_arm": "shoulder",
    "forearm": "elbow",
    "hand": "wrist",
    "thigh": "hip",
    "shin": "knee",
    "foot": "ankle",
    "toe": "midtarsal",
    **{f"thumb.0{i}": f"thumb{i}" for i in (1, 2, 3)},
    **{f"f_{finger}.0{i}": f"{finger}{i}" for finger in _FINGERS for i in (1, 2, 3)},
}


def _plain(name: str) -> str:
    return re.sub(r"[^a-z0-9]", "", name.rpartition(":")[2].lower())


def _tables() -> Iterator[tuple[str, str]]:
    yield from VRM_0_JOINTS.items()
    yield from _UNREAL_TRUNK.items()
    yield from _RIGIFY_TRUNK.items()
    for side in _SIDES:
        yield from ((f"{bone}_{side}", f"{side}_{joint}") for bone, joint in _UNREAL_LIMBS.items())
        yield from ((f"DEF-{bone}.{side}", f"{side}_{joint}") for bone, joint in _RIGIFY_LIMBS.items())
    yield from ((joint, joint) for joint in JOINTS.values())
    yield from JOINTS.items()


_JOINT_OF = {_plain(name): joint for name, joint in _tables()}


def joint_named(bone: str) -> str | None:
    """Return the H-Anim joint of a bone by its name in Mixamo, Unity, Unreal, Rigify or H-Anim rigs; None if unknown.

    A prefix that ends with a colon, case and punctuation do not matter.
    """
    return _JOINT_OF.get(_plain(bone))
