"""The joints of a body's parts, as BML's poses name them."""

from collections.abc import Mapping
from types import MappingProxyType

from reactive_realizer.bml.words import PosePart
from reactive_realizer.embodiment.joints import HEAD, LEFT_ARM, LEFT_LEG, LEGS, RIGHT_ARM, RIGHT_LEG, TRUNK

_ARMS = LEFT_ARM | RIGHT_ARM

JOINTS: Mapping[PosePart, frozenset[str]] = MappingProxyType(
    {
        PosePart.WHOLEBODY: frozenset((*TRUNK, *HEAD)) | _ARMS | LEGS,
        PosePart.LEGS: LEGS,
        PosePart.LEFT_LEG: LEFT_LEG,
        PosePart.RIGHT_LEG: RIGHT_LEG,
        PosePart.HEAD: frozenset(HEAD),
        PosePart.ARMS: _ARMS,
        PosePart.LEFT_ARM: LEFT_ARM,
        PosePart.RIGHT_ARM: RIGHT_ARM,
    }
)
"""Part -> its joints. In this order poses are taken: where hands go may depend on what trunk and legs do."""
