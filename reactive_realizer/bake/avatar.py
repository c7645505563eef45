"""Builds one avatar from the data and writes its file."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from reactive_realizer.bake.body import Body
from reactive_realizer.bake.body_texture import paint_body
from reactive_realizer.bake.characters import Character
from reactive_realizer.bake.eyes import build_eyes, eye_moves
from reactive_realizer.bake.face import face_parts
from reactive_realizer.bake.glb import Glb, Json
from reactive_realizer.bake.hair import build_hair
from reactive_realizer.bake.head_map import HeadMap
from reactive_realizer.bake.head_texture import paint_head
from reactive_realizer.bake.makehuman import MakeHuman
from reactive_realizer.bake.materials import EXTENSIONS, make_materials
from reactive_realizer.bake.mesh import Mesh, vertex_normals
from reactive_realizer.bake.numeric import Array, Mask
from reactive_realizer.bake.occlusion import exposure
from reactive_realizer.bake.pants import build_pants
from reactive_realizer.bake.primitive import Part, PrimitiveWriter
from reactive_realizer.bake.rig import Rig
from reactive_realizer.bake.shoes import build_shoes
from reactive_realizer.bake.top import build_top
from reactive_realizer.bake.vrm import COPYRIGHT, vrm_block

_GENERATOR = "bake_avatar.py"
"""Generator name of the committed files; another name would change only their bytes."""

_UNDER_CLOTHES = 0.010
"""Distance by which covered skin is moved inward, so that it never shows through a moving garment, m."""


def bake(data: MakeHuman, character: Character, name: str, path: Path) -> None:
    """Write the GLB of a character with a name."""
    body = Body(data, character)
    head = HeadMap(body)
    garments, covered = _dress(body)
    hair, glb = build_hair(body, head), Glb()
    skin = body.positions - body.normals * (_UNDER_CLOTHES * covered)[:, None]
    uncovered = _body_part(body, head, skin, covered)
    around = [Mesh(skin, body.weights, body.triangles, body.uvs), hair, *(part.mesh for part in garments)]
    light = exposure(body.positions, body.normals, around)
    painted = paint_body(body, uncovered.mesh.triangles, uncovered.mesh.uvs, light)
    materials = make_materials(glb, body.character, paint_head(body, head, light), painted)
    writer = PrimitiveWriter(glb, body, materials)
    meshes = [_face(writer, body, [*face_parts(body, head, skin, covered)])]
    meshes.append(_mesh("Body", writer.write(uncovered)))
    eyes = replace(_part("Eyes", build_eyes(body)), moves=eye_moves(body))
    meshes.append(_shaped("Eyes", [writer.write_face(eyes, shaded=False)], list(eyes.moves or ())))
    meshes += [_mesh(part.name, writer.write(part)) for part in (*garments, _part("Hair", hair))]
    nodes, bound = _nodes(body.rig, meshes), glb.accessor(_inverse_bind_matrices(body.rig))
    index = {node["name"]: i for i, node in enumerate(nodes)}
    document = {
        "asset": {"version": "2.0", "generator": _GENERATOR, "copyright": COPYRIGHT},
        "extensionsUsed": [*EXTENSIONS, "VRMC_vrm"],
        "extensions": {"VRMC_vrm": vrm_block(body, name, index)},
        "scene": 0,
        "scenes": [{"nodes": [index["Avatar"]]}],
        "nodes": nodes,
        "meshes": meshes,
        "skins": [{"joints": list(range(len(body.rig.names))), "inverseBindMatrices": bound, "skeleton": 0}],
        "materials": list(materials.values()),
    }
    glb.save(path, document)


def _dress(body: Body) -> tuple[list[Part], Mask]:
    """The garments, and which vertices of the body they hide."""
    top, hem = build_top(body)
    pants = build_pants(body, hem)
    covered = top.covers(body.positions) | pants.covers(body.positions)
    return [_part("Top", top.mesh), _part("Pants", pants.mesh), _part("Shoes", build_shoes(body))], covered


def _part(name: str, mesh: Mesh) -> Part:
    """A mesh with the material of the same name."""
    normals = vertex_normals(mesh.positions, mesh.triangles) if mesh.normals is None else mesh.normals
    return Part(name, mesh, normals, name)


def _body_part(body: Body, head: HeadMap, skin: Array, covered: Mask) -> Part:
    """Arms, hands and other visible parts. Faces under the clothes are left out, so that no nude mesh is shipped."""
    seen = ~covered[body.triangles].all(1) & ~head.is_head
    uvs = body.uvs[seen].copy()
    uvs[..., 1] = 1 - uvs[..., 1]
    return Part("Body", Mesh(skin, body.weights, body.triangles[seen], uvs), body.normals, "BodySkin")


def _face(writer: PrimitiveWriter, body: Body, parts: list[Part]) -> Json:
    primitives = [writer.write_face(part, shaded=part.name == "Head") for part in parts]
    return _shaped("Face", primitives, list(body.shapes))


def _mesh(name: str, primitive: Json) -> Json:
    return {"name": name, "primitives": [primitive]}


def _shaped(name: str, primitives: list[Json], targets: list[str]) -> Json:
    """A mesh with blend shapes."""
    extras = {"targetNames": targets}
    return {"name": name, "primitives": primitives, "weights": [0] * len(targets), "extras": extras}


def _nodes(rig: Rig, meshes: list[Json]) -> list[Json]:
    """The joints in the order of the rig, a node for each mesh, and "Avatar" above all."""
    nodes: list[Json] = []
    for joint, parent in rig.parents.items():
        offset = rig.places[joint] - (0 if parent is None else rig.places[parent])
        node: Json = {"name": joint, "translation": [float(f"{x:.7g}") for x in offset]}
        if children := [i for i, child in enumerate(rig.names) if rig.parents[child] == joint]:
            node["children"] = children
        nodes.append(node)
    joints = len(nodes)
    nodes += [{"name": mesh["name"], "mesh": i, "skin": 0} for i, mesh in enumerate(meshes)]
    nodes.append({"name": "Avatar", "children": [0, *range(joints, len(nodes))]})
    return nodes


def _inverse_bind_matrices(rig: Rig) -> Array:
    """Column-major (joints, 16): translations, since no joint is turned at rest."""
    matrices = np.tile(np.eye(4, dtype="f4"), (len(rig.names), 1, 1))
    matrices[:, 3, :3] = -np.array([rig.places[joint] for joint in rig.names])
    return matrices.reshape(-1, 16)
