"""The names of EMBR's characters, and what they mean here: body groups, joints, axes, morph targets, shaders."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final, NamedTuple

from reactive_realizer.bml.vocabulary import BodyGroup, FacePart

BODY_GROUPS: Final[Mapping[str, BodyGroup]] = MappingProxyType(
    {
        "larm": BodyGroup.LEFT_ARM,
        "rarm": BodyGroup.RIGHT_ARM,
        "lhand": BodyGroup.LEFT_HAND,
        "rhand": BodyGroup.RIGHT_HAND,
        "head": BodyGroup.HEAD,
        "headNeck": BodyGroup.HEAD_NECK,
        "headThorax": BodyGroup.HEAD_CHEST,
        "headAbdomen": BodyGroup.HEAD_BACK,
        "upperBodyNoArms": BodyGroup.TRUNK,
        "spine": BodyGroup.TRUNK,
        "shoulders": BodyGroup.SHOULDERS,
        "eyes": BodyGroup.EYES,
        "leye": BodyGroup.LEFT_EYE,
        "reye": BodyGroup.RIGHT_EYE,
        "all": BodyGroup.WHOLEBODY,
    }
)

_ARM = {"clavicle": "sternoclavicular", "humerus": "shoulder", "radius": "elbow", "hand": "wrist"}
_FINGERS = ("thumb", "index", "middle", "ring", "pinky")
_PHALANGES = ("Mcp", "Prox", "Dist")


def _joints() -> dict[str, str]:
    joints = {"spine1": "vl5", "spine2": "vt10", "spine3": "vt10", "spine4": "vt6", "neck": "vc4", "head": "skullbase"}
    for side in "lr":
        joints[f"{side}eye"] = f"{side}_eyeball_joint"
        joints |= {f"{side}{name}": f"{side}_{joint}" for name, joint in _ARM.items()}
        for number, finger in enumerate(_FINGERS, 1):
            joints |= {f"{side}{number}{bone}": f"{side}_{finger}{i}" for i, bone in enumerate(_PHALANGES, 1)}
    return joints


JOINTS: Final[Mapping[str, str]] = MappingProxyType(_joints())
"""EMBR's name of a joint -> its H-Anim name."""

SHADERS: Final[Mapping[str, str]] = MappingProxyType(
    {
        "blushing": "skinBlush",
        "blush": "skinBlush",
        "paling": "skinPallor",
        "pale": "skinPallor",
        "pallor": "skinPallor",
    }
)
"""EMBR's name of a shader parameter -> the weight that colors the skin."""


class Expression(NamedTuple):
    """The expression that stands for a morph target of EMBR's characters.

    Attributes:
        type: of its parts.
        parts: action unit or morph target -> its weight in it.
    """

    type: FacePart
    parts: Mapping[str, float]


def _units(**weights: float) -> Expression:
    parts = {name.removeprefix("au").replace("_", ".").upper(): weight for name, weight in weights.items()}
    return Expression(FacePart.FACS, MappingProxyType(parts))


def _look(*names: str) -> Expression:
    return Expression(FacePart.MORPH, MappingProxyType(dict.fromkeys((f"eyeLook{name}" for name in names), 1.0)))


MORPHS: Final[Mapping[str, Expression]] = MappingProxyType(
    {
        "ExpSmileClosed": _units(au6=0.4, au12=0.8),
        "ExpSmileOpen": _units(au6=0.5, au12=0.9, au25=0.6, au26=0.2),
        "ExpAnger": _units(au4=0.9, au5=0.3, au7=0.5, au23=0.6),
        "ExpDisgust": _units(au4=0.3, au9=0.8, au10=0.5, au15=0.3),
        "ExpFear": _units(au1=0.8, au2=0.4, au4=0.4, au5=0.7, au20=0.5, au25=0.4),
        "ExpSad": _units(au1=0.9, au4=0.3, au15=0.7, au17=0.2),
        "ExpSurprise": _units(au1=0.8, au2=0.8, au5=0.6, au26=0.8),
        "ModBlinkLeft": _units(au43_left=1.0),
        "ModBlinkRight": _units(au43_right=1.0),
        "ModEyeSquintLeft": _units(au44_left=1.0),
        "ModEyeSquintRight": _units(au44_right=1.0),
        "ModBrowDownLeft": _units(au4_left=1.0),
        "ModBrowDownRight": _units(au4_right=1.0),
        "ModBrowInLeft": _units(au4_left=0.6),
        "ModBrowInRight": _units(au4_right=0.6),
        "ModBrowUpLeft": _units(au1=0.4, au2_left=1.0),
        "ModBrowUpRight": _units(au1=0.4, au2_right=1.0),
        "ModLookDown": _look("DownLeft", "DownRight"),
        "ModLookUp": _look("UpLeft", "UpRight"),
        "ModLookLeft": _look("OutLeft", "InRight"),
        "ModLookRight": _look("InLeft", "OutRight"),
        "Phonaah": _units(au25=0.6, au26=0.6),
        "Phonbigaah": _units(au25=0.8, au27=0.6),
        "PhonB,M,P": _units(au24=0.7),
        "Phonch,J,sh": _units(au18=0.3, au22=0.5, au25=0.3),
        "PhonD,S,T": _units(au20=0.2, au25=0.5, au26=0.15),
        "Phonee": _units(au20=0.6, au25=0.6),
        "Phoneh": _units(au20=0.3, au25=0.6, au26=0.3),
        "PhonF,V": _units(au10=0.3, au32=0.8),
        "Phoni": _units(au20=0.4, au25=0.5, au26=0.15),
        "PhonK": _units(au25=0.4, au26=0.4),
        "PhonN": _units(au25=0.4, au26=0.2),
        "Phonoh": _units(au18=0.4, au22=0.4, au26=0.6),
        "Phonooh,Q": _units(au18=0.9, au22=0.3, au26=0.2),
        "PhonR": _units(au18=0.4, au22=0.3, au26=0.2),
        "Phonth": _units(au19=0.6, au25=0.4),
        "PhonW": _units(au18=1.0),
    }
)
"""The morph targets of EMBR's characters."""
