"""A naked body: shape, rig and weights of one character, in a T-pose with its soles where the shoes will hold them."""

import numpy as np

from reactive_realizer.bake.characters import Character
from reactive_realizer.bake.further_shapes import parameter_shapes, parts_of_units, tongue_out, visemes
from reactive_realizer.bake.makehuman import DECIMETER, BaseMesh, MakeHuman
from reactive_realizer.bake.mesh import vertex_normals
from reactive_realizer.bake.mouth import close_lips, place_mouth
from reactive_realizer.bake.numeric import Array, Indices, Mask
from reactive_realizer.bake.rig import bind, read_rig, t_pose

SOLE = 0.018
"""Thickness of the shoe sole, m: the whole body is lifted by this much."""


class Body:
    """The base mesh of MakeHuman as one person.

    Attributes:
        character: its description.
        groups: vertex indices by group.
        rig: joints in the T-pose.
        places: (3,) m by joint, those of the rig.
        positions: (v, 3) m, body and helpers, T-pose.
        weights: (v, joints) bone weights.
        turns: (v, 3, 3) how the T-pose turned each vertex: face units are turned likewise.
        face_units: (v, 3) m by ARKit name, before that turn.
        shapes: all blend shapes of the face likewise, the face units first.
        triangles: (t, 3) of the skin, without helpers.
        uvs: (t, 3, 2) original texture coordinates of the skin.
        normals: (v, 3) of the skin, unit.
    """

    def __init__(self, data: MakeHuman, character: Character) -> None:
        self.character = character
        self.groups = data.groups()
        self._data = data
        self._base = data.base_mesh()
        count = len(self._base.positions)
        self.shapes = self.face_units = data.face_units(count)
        shaped = self._shape(self._base, character)
        rig = read_rig(data.rig(), shaped, self.groups)
        self.weights = bind(rig, data.rig_weights(), self.groups, count)
        self.rig, rotations, translations = t_pose(rig)
        self.places = self.rig.places
        self.turns = np.einsum("vk,kij->vij", self.weights, rotations)
        self.positions = np.einsum("vij,vj->vi", self.turns, shaped) + self.weights @ translations
        place_mouth(self.positions, self.groups)
        self.triangles, self.uvs = self.triangles_of("body")
        inside = self.is_inside_mouth
        close_lips(self.positions, self.triangles[~inside], self.triangles[inside], self.moved("jawOpen")[:, 1])
        self.normals = vertex_normals(self.positions, self.triangles)
        units = self.face_units
        units["tongueOut"] = tongue_out(units["tongueOut"], self.positions, self.groups["helper-tongue"])
        self.shapes = {**self.face_units, **parameter_shapes(data, self.positions, self.groups, self.places)}
        self.shapes |= parts_of_units(self.face_units, self.positions)
        self.shapes |= visemes(self.face_units)

    def _shape(self, base: BaseMesh, character: Character) -> Array:
        positions = base.positions
        for target, amount in character.targets():
            positions = positions + amount * self._data.target(target, len(base.positions))
        positions = positions * DECIMETER
        smile = self.face_units["mouthSmileLeft"] + self.face_units["mouthSmileRight"]
        positions = positions + character.smile * smile
        positions[:, 1] -= positions[self.groups["body"]][:, 1].min() - SOLE
        return positions

    @property
    def is_skin(self) -> Mask:
        """A mask of the vertices that belong to the body and not to a helper."""
        return self.among(np.unique(self.triangles))

    @property
    def is_inside_mouth(self) -> Mask:
        """Which triangles of the skin line the mouth: (t,)."""
        middle = self.uvs.mean(1)
        of_head = self.weight_of("Head", "Neck")[self.triangles].min(1) > 0.5
        return of_head & (middle[:, 0] > 0.75) & (middle[:, 1] < 0.14)

    @property
    def eye_center(self) -> Array:
        """The point between the eyes."""
        return (self.places["LeftEye"] + self.places["RightEye"]) / 2

    def among(self, vertices: Indices) -> Mask:
        """A mask of all vertices that is true for these."""
        mask = np.zeros(len(self.positions), bool)
        mask[vertices] = True
        return mask

    def weight_of(self, *parts: str) -> Array:
        """The weight of each vertex for the joints whose names contain one of the parts, 0..1."""
        return sum_columns(self.weights, self.rig.columns(*parts))

    def mask(self, name: str, size: int = 2048) -> Array:
        """A picture (size, size), 0..1, of a part of the skin."""
        return self._data.mask(name, size)

    def moved(self, unit_name: str) -> Array:
        """The displacement of each vertex by a face unit at full strength: (v, 3) m in the T-pose."""
        return np.einsum("vij,vj->vi", self.turns, self.shapes[unit_name])

    def triangles_of(self, *groups: str) -> tuple[Indices, Array]:
        """Triangles and original texture coordinates of groups; quads are split along the shorter diagonal."""
        triangles, uvs = [], []
        for group, vertices, uv in self._base.faces:
            if group in groups:
                for corners in self._split(vertices):
                    triangles.append([vertices[i] for i in corners])
                    uvs.append([self._base.uvs[uv[i]] for i in corners])
        return np.array(triangles), np.array(uvs)

    def _split(self, polygon: tuple[int, ...]) -> tuple[tuple[int, int, int], ...]:
        if len(polygon) == 3:
            return ((0, 1, 2),)
        a, b, c, d = (self.positions[vertex] for vertex in polygon)
        if np.linalg.norm(a - c) > np.linalg.norm(b - d):
            return ((0, 1, 3), (1, 2, 3))
        return ((0, 1, 2), (0, 2, 3))


def sum_columns(weights: Array, columns: list[int]) -> Array:
    """The sum (v,) of some columns, in their order."""
    total = np.zeros(len(weights))
    for column in columns:
        total = total + weights[:, column]
    return total
