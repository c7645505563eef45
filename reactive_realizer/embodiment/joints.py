"""The joints of a figure by their H-Anim names (ISO/IEC 19774), and the parts of the body that they make.

A joint of an arm, a leg or an eye has its side before its name: `l_` or `r_`.
"""

SIDES = ("l", "r")

ROOT = "HumanoidRoot"
"""The pelvis, which carries all others."""

TRUNK = (ROOT, "vl5", "vt10", "vt6")
HEAD = ("vc4", "skullbase")
"""Neck and head."""

EYES = ("l_eyeball_joint", "r_eyeball_joint")

FINGERS = ("thumb", "index", "middle", "ring", "pinky")
"""Each has three joints, 1 the nearest to the palm."""

_ARM = ("sternoclavicular", "shoulder", "elbow", "wrist", *(f"{finger}{i}" for finger in FINGERS for i in (1, 2, 3)))
_LEG = ("hip", "knee", "ankle", "midtarsal")

LEFT_ARM, RIGHT_ARM = (frozenset(f"{side}_{joint}" for joint in _ARM) for side in SIDES)
LEFT_LEG, RIGHT_LEG = (frozenset(f"{side}_{joint}" for joint in _LEG) for side in SIDES)
LEGS = LEFT_LEG | RIGHT_LEG

LOWER_BODY = LEGS | {ROOT}
"""What moves a figure as a whole, or has to follow so that its feet stay."""


def other_side(name: str) -> str:
    """The joint on the other side, or the other side itself; a joint of the middle is its own."""
    side, underscore, joint = name.partition("_")
    return {"l": "r", "r": "l"}.get(side, side) + underscore + joint
