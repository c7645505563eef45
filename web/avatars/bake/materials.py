"""The materials, by name, and the textures that they show."""

from typing import Any

from bake.body import Body
from bake.eyes import paint_eye
from bake.glb import CLAMP, Glb, Json
from bake.head_map import HeadMap
from bake.head_texture import paint_head
from bake.textures import body_color, fabric_normal, hair, lashes, teeth


def make_materials(glb: Glb, body: Body, head: HeadMap) -> dict[str, Json]:
    """Paint all textures, store them, and describe the materials; the order is that of the file."""
    painted = paint_head(body, head)
    skin = glb.texture(painted.color)
    skin_roughness, skin_normal = glb.texture(painted.roughness), glb.texture(painted.normal)
    body_skin = glb.texture(body_color(body))
    eye, eye_normal = (glb.texture(picture) for picture in paint_eye(body.character.iris))
    strands, strands_normal = (glb.texture(picture, CLAMP) for picture in hair())
    fabric = glb.texture(fabric_normal())
    lash, tooth = glb.texture(lashes(), CLAMP), glb.texture(teeth())
    clear_coat = {"KHR_materials_clearcoat": {"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.03}}
    materials = [
        _material("Skin", 1.0, skin, skin_roughness, normalTexture=skin_normal | {"scale": 0.6}),
        _material("Mouth", 0.75),
        _material("Teeth", 0.25, tooth, doubleSided=True),
        _material("Tongue", 0.8),
        _material("Lashes", 0.9, lash, alphaMode="BLEND", doubleSided=True),
        _material("BodySkin", 0.58, body_skin),
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
            alphaCutoff=0.45,
            doubleSided=True,
        ),
    ]
    return {material["name"]: material for material in materials}


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
