"""Names of joints in SmartBody's skeletons: the older ones, and those of its later characters, which begin with Jt."""

from typing import Final

_SIDES: Final = {"Lf": "l", "Rt": "r"}
_FINGERS: Final = {"Thumb": "thumb", "Index": "index", "Middle": "middle", "Ring": "ring", "Little": "pinky"}
_LIMBS: Final = {
    "Clavicle": "sternoclavicular",
    "Shoulder": "shoulder",
    "Elbow": "elbow",
    "Wrist": "wrist",
    "Hip": "hip",
    "Knee": "knee",
    "Ankle": "ankle",
    "Ball": "midtarsal",
    "Eye": "eyeball_joint",
    **{f"{old}{letter}": f"{new}{number}" for old, new in _FINGERS.items() for number, letter in enumerate("ABC", 1)},
}
_SPINE: Final = {"base": "HumanoidRoot", "spine1": "vl5", "spine2": "vt10", "spine3": "vt6", "spine4": "vc4"}
_JOINTS: Final = {
    **_SPINE,
    "spine5": "skullbase",
    "eyeball_left": "l_eyeball_joint",
    "eyeball_right": "r_eyeball_joint",
    "l_forefoot": "l_midtarsal",
    "r_forefoot": "r_midtarsal",
    **dict(zip(("JtRoot", "JtSpineA", "JtSpineB", "JtSpineC", "JtNeckA"), _SPINE.values(), strict=True)),
    "JtNeckB": "skullbase",
    "JtSkullA": "skullbase",
    "JtJaw": "temporomandibular",
    **{f"Jt{old}{end}": f"{side}_{new}" for old, new in _LIMBS.items() for end, side in _SIDES.items()},
}
"""Those that differ from those of H-Anim."""


def joint_named(name: str) -> str:
    """The name of a joint in H-Anim."""
    return _JOINTS.get(name, name)


def target_named(target: str) -> str:
    """A target whose joint, if it names one, has the name of H-Anim."""
    owner, separator, joint = target.partition(":")
    return f"{owner}:{joint_named(joint)}" if separator else target
