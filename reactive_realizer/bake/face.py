"""The parts that the face units move: skin of the head, inside of the mouth, teeth, tongue, lashes."""

from collections.abc import Iterator

import numpy as np
from scipy.spatial import cKDTree

from reactive_realizer.bake.body import Body
from reactive_realizer.bake.hairline import scalp
from reactive_realizer.bake.head_map import HeadMap
from reactive_realizer.bake.mesh import Mesh, no_uvs, vertex_normals
from reactive_realizer.bake.mouth import groove
from reactive_realizer.bake.numeric import Array, Color, Indices, Mask, linear, smoothstep, unit
from reactive_realizer.bake.primitive import Part
from reactive_realizer.bake.rig import SIDES
from reactive_realizer.bake.teeth import build_teeth, jaw_moves

_GUMS: Color = (140, 62, 60)
_TONGUE: Color = (172, 78, 78)
_CHEEK_TURN, _TONGUE_TURN = 0.9, 0.35
"""How far normals in the mouth are turned forward; the tongue has to look round."""

_FURROW_SHADE = 0.45
"""Share of the light that does not reach the bottom of the tongue's furrow."""

_LASH_BINS = 9


def face_parts(body: Body, head: HeadMap, positions: Array, covered: Mask) -> Iterator[Part]:
    """The parts; all of them but the teeth use the vertices of the base mesh.

    Args:
        body: with the face.
        head: its unwrap.
        positions: (v, 3) m, the skin already drawn back under the clothes.
        covered: (v,) vertices that clothes hide.
    """

    def part(name: str, material: str, triangles: Indices, uvs: Array, colors: Array | None, normals: Array) -> Part:
        return Part(name, Mesh(positions, body.weights, triangles, uvs, colors), normals, material)

    seen = _seen_skin(body, head, covered)
    yield part("Head", "Skin", head.triangles[seen], head.uvs[seen], _lip_shade(body, head), body.normals)
    inside, no_texture = head.mouth_triangles, no_uvs(head.mouth_triangles)
    normals = _lit_from_front(body.normals, _CHEEK_TURN)
    yield part("Mouth", "Mouth", inside, no_texture, _fade(body, head, _GUMS), normals)
    for row, name in zip(build_teeth(body), ("upper-teeth", "lower-teeth"), strict=True):
        normals = vertex_normals(row.positions, row.triangles)
        yield Part(name, row, normals, "Teeth", jaw_moves(body, "helper-" + name, row.positions))
    triangles, _ = body.triangles_of("helper-tongue")
    normals = _lit_from_front(vertex_normals(body.positions, triangles), _TONGUE_TURN)
    yield part("Tongue", "Tongue", triangles, no_uvs(triangles), _tongue_color(body, head), normals)
    triangles, _ = body.triangles_of("helper-l-eyelashes-2", "helper-r-eyelashes-2")
    normals = vertex_normals(body.positions, triangles)
    yield part("Lashes", "Lashes", triangles, _lash_uvs(body)[triangles], None, normals)


def _seen_skin(body: Body, head: HeadMap, covered: Mask) -> Mask:
    """The head's triangles that neither clothes nor hair hide."""
    under_hair = scalp(body.character.hair, head.center)(body.positions) > 6
    under_hair &= np.abs(body.positions[:, 0]) < 0.066
    hidden: Mask = np.all(covered[head.triangles], axis=1) | np.all(under_hair[head.triangles], axis=1)
    return ~hidden


def _fade(body: Body, head: HeadMap, color: Color) -> Array:
    """A color (v, 3) that grows darker towards the throat and the cheeks."""
    lips = body.positions[np.unique(head.mouth_triangles)][:, 2].max()
    x, z = np.abs(body.positions[:, 0]), body.positions[:, 2]
    near = smoothstep(lips - 0.050, lips - 0.006, z) * (1 - 0.88 * smoothstep(0.013, 0.026, x))
    return linear(color)[None] * np.clip(0.10 + 0.90 * near, 0, 1)[:, None]


def _tongue_color(body: Body, head: HeadMap) -> Array:
    """That of the tongue (v, 3), with less light in its furrow."""
    tongue, color = body.groups["helper-tongue"], _fade(body, head, _TONGUE)
    color[tongue] *= 1 - _FURROW_SHADE * groove(body.positions[tongue])[:, None]
    return color


def _lit_from_front(normals: Array, turn: float) -> Array:
    """Normals (v, 3) turned forward: light comes through the lips, and never through the back of the head."""
    return unit(normals + np.array([0, 0, turn]))


def _lip_shade(body: Body, head: HeadMap) -> Array:
    """White (v, 3) with a warm shade where the lips turn inside."""
    distance = cKDTree(body.positions[head.lip_seam]).query(body.positions)[0]
    near = distance < 0.006
    shade = np.ones((len(body.positions), 3))
    shade[near] = (0.40 + 0.60 * smoothstep(0.0008, 0.0045, distance[near]))[:, None]
    shade[~body.among(np.unique(head.triangles))] = 1
    shade[:, 1:] **= 1.15
    return shade


def _lash_uvs(body: Body) -> Array:
    """Texture coordinates (v, 2): along the lid, and outwards from its edge, which has to be found first."""
    uvs = np.zeros((len(body.positions), 2))
    for side, _ in SIDES:
        lashes = body.groups[f"helper-{side[0].lower()}-eyelashes-2"]
        p = body.positions[lashes]
        along = (p[:, 0] - p[:, 0].min()) / np.ptp(p[:, 0])
        from_eye = np.linalg.norm(p - body.places[side + "Eye"], axis=1)
        outwards = np.maximum(from_eye - _lid_edge(along, from_eye), 0)
        uvs[lashes, 0] = along * 0.998 + 0.001
        longest = np.percentile(outwards, 95)
        uvs[lashes, 1] = np.clip(outwards / longest / body.character.lash_length, 0.01, 0.99)
    return uvs


def _lid_edge(along: Array, from_eye: Array) -> Array:
    """The distance (n,) from the eye at which the lashes begin: the least of those nearby."""
    bins = np.clip((along * _LASH_BINS).astype(int), 0, _LASH_BINS - 1)
    filled = np.unique(bins)
    least = [from_eye[bins == i].min() for i in filled]
    return np.interp(along * _LASH_BINS, filled + 0.5, least)
