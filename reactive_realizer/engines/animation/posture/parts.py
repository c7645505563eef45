"""The joints of a body's parts, as BML's poses name them."""

from collections.abc import Mapping
from types import MappingProxyType

from reactive_realizer.bml.words import PosePart

_FINGERS = tuple(f"{finger}{i}" for finger in ("thumb", "index", "middle", "ring", "pinky") for i in (1, 2, 3))
_ARM = ("sternoclavicular", "shoulder", "elbow", "wrist", *_FINGERS)
_LEG = ("hip", "knee", "ankle", "midtarsal")
_HEAD = frozenset({"vc4", "skullbase"})
_TRUNK = frozenset({"HumanoidRoot", "vl5", "vt10", "vt6"})


def _of(sides: str, joints: tuple[str, ...]) -> frozenset[str]:
    return frozenset(f"{side}_{joint}" for side in sides for joint in joints)


JOINTS: Mapping[PosePart, frozenset[str]] = MappingProxyType(
    {
        PosePart.WHOLEBODY: _TRUNK | _HEAD | _of("lr", _ARM) | _of("lr", _LEG),
        PosePart.LEGS: _of("lr", _LEG),
        PosePart.LEFT_LEG: _of("l", _LEG),
        PosePart.RIGHT_LEG: _of("r", _LEG),
        PosePart.HEAD: _HEAD,
        PosePart.ARMS: _of("lr", _ARM),
        PosePart.LEFT_ARM: _of("l", _ARM),
        PosePart.RIGHT_ARM: _of("r", _ARM),
    }
)
"""Part -> its joints. In this order poses are taken: where hands go may depend on what trunk and legs do."""
