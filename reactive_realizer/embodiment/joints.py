"""H-Anim names of joints (ISO/IEC 19774), and the body parts that they form.

Names of arm, leg and eye joints start with their side: `l_` or `r_`.
"""

SIDES = ("l", "r")

ROOT = "HumanoidRoot"
"""The pelvis, the root of the skeleton."""

TRUNK = (ROOT, "vl5", "vt10", "vt6")
HEAD = ("vc4", "skullbase")
"""Neck and head."""

CARRYING = (*TRUNK, *(f"{side}_sternoclavicular" for side in SIDES))
"""The joints that carry the arms."""

JAW = "temporomandibular"

EYES = ("l_eyeball_joint", "r_eyeball_joint")

FINGERS = ("thumb", "index", "middle", "ring", "pinky")
"""Each has three joints; 1 is nearest to the palm."""

_ARM = ("sternoclavicular", "shoulder", "elbow", "wrist", *(f"{finger}{i}" for finger in FINGERS for i in (1, 2, 3)))
_LEG = ("hip", "knee", "ankle", "midtarsal")

LEFT_ARM, RIGHT_ARM = (frozenset(f"{side}_{joint}" for joint in _ARM) for side in SIDES)
LEFT_LEG, RIGHT_LEG = (frozenset(f"{side}_{joint}" for joint in _LEG) for side in SIDES)
LEGS = LEFT_LEG | RIGHT_LEG

LOWER_BODY = LEGS | {ROOT}
"""The joints that move the whole figure or must follow to keep the feet in place."""


def other_side(name: str) -> str:
    """Mirror the name of a joint, or of a side; joints of the middle stay the same."""
    side, underscore, joint = name.partition("_")
    return {"l": "r", "r": "l"}.get(side, side) + underscore + joint
