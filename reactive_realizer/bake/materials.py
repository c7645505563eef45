"""The materials, by name, and the textures that they show."""

from typing import Any

from reactive_realizer.bake.characters import Character
from reactive_realizer.bake.eyes import paint_eye
from reactive_realizer.bake.glb import CLAMP, Glb, Json
from reactive_realizer.bake.skin_paint import SkinTextures
from reactive_realizer.bake.textures import fabric_normal, hair, lashes

EXTENSIONS = ("KHR_materials_anisotropy", "KHR_materials_clearcoat", "KHR_materials_specular")
"""Those of glTF that the materials use."""


def make_materials(glb: Glb, who: Character, head_skin: SkinTextures, body_skin: SkinTextures) -> dict[str, Json]:
    """Paint the other textures, store all, and describe the materials; the order is that of the file."""
    eye, eye_normal = (glb.texture(picture) for picture in paint_eye(who.iris))
    strands, strands_normal = (glb.texture(picture, CLAMP) for picture in hair())
    fabric = glb.texture(fabric_normal())
    lash = glb.texture(lashes(), CLAMP)
    clear_coat = {"KHR_materials_clearcoat": {"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.10}}
    materials = [
        _skin(glb, "Skin", head_skin),
        _material("Mouth", 0.75, **_specular(0.0)),
        _material("Teeth", 0.4, doubleSided=True, **_specular(0.2)),
        _material("Tongue", 0.45, **_specular(0.4)),
        _material("Lashes", 0.9, lash, alphaMode="BLEND", doubleSided=True),
        _skin(glb, "BodySkin", body_skin),
        _material("Eyes", 0.32, eye, normalTexture=eye_normal | {"scale": 0.8}, extensions=clear_coat),
        _material("Top", 0.88, normalTexture=fabric | {"scale": 0.8}, doubleSided=True),
        _material("Pants", 0.85, normalTexture=fabric | {"scale": 0.9}, doubleSided=True),
        _material("Shoes", 0.6, doubleSided=True),
        _material(
            "Hair",
            0.50,
            strands,
            normalTexture=strands_normal | {"scale": 0.7},
            alphaMode="MASK",
            alphaCutoff=0.40,
            doubleSided=True,
            extensions={
                "KHR_materials_anisotropy": {"anisotropyStrength": 0.6},
                "KHR_materials_specular": {"specularFactor": 0.6, "specularColorFactor": [1.0, 0.86, 0.72]},
            },
        ),
    ]
    return {material["name"]: material for material in materials}


def _skin(glb: Glb, name: str, painted: SkinTextures) -> Json:
    color, surface, normal = (glb.texture(each) for each in (painted.color, painted.surface, painted.normal))
    return _material(name, 1.0, color, surface, normalTexture=normal | {"scale": 0.6}, occlusionTexture=surface)


def _material(
    name: str, roughness: float, color: Json | None = None, roughness_map: Json | None = None, **more: Any
) -> Json:
    """A dielectric; the factor of its color is white until a mesh with vertex colors says more."""
    surface: Json = {"baseColorFactor": [1, 1, 1, 1.0], "metallicFactor": 0, "roughnessFactor": roughness}
    if color is not None:
        surface["baseColorTexture"] = color
    if roughness_map is not None:
        surface["metallicRoughnessTexture"] = roughness_map
    return {"name": name, "pbrMetallicRoughness": surface, **more}


def _specular(factor: float) -> Json:
    """Weaker reflections: of the room around, little is seen in a mouth."""
    return {"extensions": {"KHR_materials_specular": {"specularFactor": factor}}}
