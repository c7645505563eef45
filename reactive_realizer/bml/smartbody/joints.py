"""Names of joints in SmartBody's skeletons."""

from typing import Final

_JOINTS: Final = {
    "base": "HumanoidRoot",
    "spine1": "vl5",
    "spine2": "vt10",
    "spine3": "vt6",
    "spine4": "vc4",
    "spine5": "skullbase",
    "eyeball_left": "l_eyeball_joint",
    "eyeball_right": "r_eyeball_joint",
}
"""Those that differ from those of H-Anim."""


def joint_named(name: str) -> str:
    """The name of a joint in H-Anim."""
    return _JOINTS.get(name, name)


def target_named(target: str) -> str:
    """A target whose joint, if it names one, has the name of H-Anim."""
    owner, separator, joint = target.partition(":")
    return f"{owner}:{joint_named(joint)}" if separator else target
