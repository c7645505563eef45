"""Teeth and gums: single crowns along the dental arch of MakeHuman's mesh, which has only a folded sheet of them.

Crown sizes after Wheeler's Dental Anatomy, scaled to the arch.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reactive_realizer.bake.body import Body
from reactive_realizer.bake.mesh import Mesh, grid_triangles, merge, no_uvs
from reactive_realizer.bake.numeric import Array, Color, linear, smoothstep

_ENAMEL: Color = (233, 225, 208)
_NECK: Color = (222, 205, 172)
_GUM: Color = (188, 104, 98)
_MILLIMETER = 0.001
_AROUND, _GUM_COLUMNS = 14, 97
"""Points around a crown and along a gum."""

_SQUARENESS = 0.72
"""Exponent of the section of a crown: 1 is an ellipse, 0 a rectangle."""

_EDGE_SHARE = 0.28
"""The part of the height of MakeHuman's row in which its biting edge lies."""

_WIDTH = 0.050
"""Breadth of the upper row at the molars, m. MakeHuman's is wider than its mouth, and stands in the cheeks."""

_SIDE_SHADE = 0.55
"""Share of the light from the front that lips and cheeks keep from the side teeth."""

_SHADE_TINT = np.array([1, 1.35, 1.45])
"""Exponents of red, green and blue in shade: what light there is comes from lips, gums and tongue."""

_OVERJET = 0.0022
"""Distance of the lower row behind the upper one, m."""


@dataclass(frozen=True, slots=True)
class _Tooth:
    """A kind of tooth: breadth along the arch, height of the crown and depth (mm), and how its edge looks.

    Attributes:
        edge: depth of the biting edge as a part of the depth.
        short: by how much it ends before the others, mm.
        tip: by how much its corners are cut off, mm.
    """

    breadth: float
    height: float
    depth: float
    edge: float
    short: float
    tip: float


_UPPER = (
    _Tooth(8.6, 9.6, 6.0, 0.22, 0.0, 0.25),
    _Tooth(6.6, 8.6, 5.4, 0.22, 0.7, 0.40),
    _Tooth(7.4, 9.4, 7.0, 0.25, 0.1, 1.40),
    _Tooth(7.0, 8.0, 8.4, 0.75, 0.7, 0.90),
    _Tooth(6.8, 7.4, 8.4, 0.80, 0.9, 0.70),
    _Tooth(9.6, 6.8, 9.6, 0.85, 1.0, 0.50),
    _Tooth(9.2, 6.4, 9.6, 0.85, 1.1, 0.50),
)
_LOWER = (
    _Tooth(5.4, 8.2, 5.2, 0.22, 0.0, 0.15),
    _Tooth(6.0, 8.3, 5.4, 0.22, 0.1, 0.25),
    _Tooth(6.9, 9.0, 6.4, 0.25, 0.0, 1.10),
    _Tooth(7.0, 7.8, 7.4, 0.70, 0.4, 0.80),
    _Tooth(7.1, 7.2, 7.8, 0.80, 0.7, 0.60),
    _Tooth(10.2, 6.6, 9.2, 0.85, 0.9, 0.45),
    _Tooth(9.6, 6.2, 9.2, 0.85, 1.0, 0.45),
)


class _Arch:
    """The outer line of a row of teeth, seen from above, and the height of the biting edge along it.

    Attributes:
        length: of one side, m.
        front: z of its middle.
    """

    def __init__(self, points: Array, up: int, inset: float) -> None:
        """Fit the arch to the vertices (n, 3) of a row, and draw it in; up is 1 where teeth grow upwards."""
        heights = points[:, 1] * up
        edge = points[heights > heights.max() - _EDGE_SHARE * np.ptp(heights)]
        edge = edge * [_WIDTH / np.ptp(edge[:, 0]), 1, 1]
        self._back = edge[:, 2].min() - 0.004
        angle = np.arctan2(edge[:, 0], edge[:, 2] - self._back)
        radius = np.hypot(edge[:, 0], edge[:, 2] - self._back) - inset
        self._radius, self._height = (np.polyfit(angle**2, values, 3) for values in (radius, edge[:, 1]))
        self._angles = np.linspace(0, np.abs(angle).max(), 400)
        steps = np.linalg.norm(np.diff(self._at_angle(self._angles), axis=0), axis=1)
        self._lengths = np.r_[0, np.cumsum(steps)]
        self.length = self._lengths[-1]
        self.front = self._at_angle(np.zeros(1))[0, 2]

    def at(self, along: Array) -> tuple[Array, Array]:
        """Points (n, 3) at distances (m) from the middle, positive to the figure's left, and the way outwards there."""
        angle = np.sign(along) * np.interp(np.abs(along), self._lengths, self._angles)
        x, _, z = (self._at_angle(angle + 0.01) - self._at_angle(angle - 0.01)).T
        return self._at_angle(angle), np.stack([-z, 0 * x, x], 1) / np.hypot(x, z)[:, None]

    def _at_angle(self, angle: Array) -> Array:
        radius, height = np.polyval(self._radius, angle**2), np.polyval(self._height, angle**2)
        return np.stack([radius * np.sin(angle), height, self._back + radius * np.cos(angle)], 1)


class _Row:
    """One row of teeth in their gum."""

    def __init__(self, body: Body, group: str, teeth: Sequence[_Tooth], up: int, inset: float, light: float) -> None:
        vertices = body.groups[group]
        self._teeth, self._up, self._light = teeth, up, light
        self._arch = _Arch(body.positions[vertices], up, inset)
        self._weights = body.weights[vertices[0]]
        breadths = np.array([tooth.breadth for tooth in teeth])
        borders = np.r_[0, np.cumsum(breadths)] * self._arch.length / breadths.sum()
        self._borders, self._middles = borders, (borders[1:] + borders[:-1]) / 2

    def mesh(self) -> Mesh:
        """Crowns and gum."""
        crowns = [self._crown(i, side) for side in (-1, 1) for i in range(len(self._teeth))]
        return merge([*crowns, self._gum()])

    def _crown(self, index: int, side: int) -> Mesh:
        """A loft of rounded sections from below the gum (level 0) to the biting edge (1)."""
        tooth = self._teeth[index]
        (middle,), (outward,) = self._arch.at(side * self._middles[index : index + 1])
        level = np.array([0.0, 0.2, 0.4, 0.6, 0.78, 0.91, 0.98, 1.0, 1.0])[:, None]
        closing = np.array([1, 1, 1, 1, 1, 0.99, 0.94, 0.78, 0.0])[:, None]
        turn = (np.arange(_AROUND) / _AROUND * 2 * np.pi)[None]
        x, y = (np.sign(part) * np.abs(part) ** _SQUARENESS * closing for part in (np.cos(turn), np.sin(turn)))
        breadth = np.diff(self._borders)[index] * 0.985 * (0.76 + 0.24 * smoothstep(0, 0.6, level))
        depth = tooth.depth * _MILLIMETER * (1 - (1 - tooth.edge) * smoothstep(0.15, 1.0, level))
        face = -_MILLIMETER * (0.9 * (1 - level) ** 2 + 0.35 * level**4)
        rise = tooth.height * (level - 1) - tooth.short - tooth.tip * np.abs(x) ** 1.8 * smoothstep(0.5, 1, level)
        across, out = x * breadth / 2, face + (y - 1) * depth / 2
        sideways = np.array([outward[2], 0, -outward[0]])
        points = middle + across[..., None] * sideways + out[..., None] * outward
        points[..., 1] += self._up * rise * _MILLIMETER
        neck = smoothstep(0.65, 0.15, level)[..., None]
        between_teeth = 1 - 0.45 * np.abs(np.cos(turn)[..., None]) ** 6
        color = (linear(_ENAMEL) * (1 - neck) + linear(_NECK) * neck) * between_teeth
        return self._part(points, color, closed=True, flipped=self._up < 0)

    def _gum(self) -> Mesh:
        """A ridge around the necks; between the teeth it reaches further towards the edge."""
        along = np.linspace(-1, 1, _GUM_COLUMNS) * (self._arch.length - 0.0005)
        middle, outward = self._arch.at(along)
        height, depth = (self._interpolated(along, name) for name in ("height", "depth"))
        nearest = np.abs(np.abs(along)[:, None] - self._borders).min(1)
        line = height - 0.5 - 2.6 * smoothstep(2.6 * _MILLIMETER, 0, nearest)
        none = 0 * along
        profile = (
            (none + 0.2, height + 6.5),
            (none + 0.9, height + 2.8),
            (none + 0.4, line + 0.9),
            (none - 0.7, line),
            (-depth / 2, line + 0.6),
            (0.9 - depth, line),
            (-0.6 - depth, line + 1.2),
            (-1.6 - depth, height + 5.5),
        )
        rows = [middle + outward * (out * _MILLIMETER)[:, None] for out, _ in profile]
        for row, (_, down) in zip(rows, profile, strict=True):
            row[:, 1] -= self._up * down * _MILLIMETER
        points = np.array(rows)
        return self._part(points, np.ones(points.shape) * linear(_GUM), closed=False, flipped=self._up > 0)

    def _interpolated(self, along: Array, name: str) -> Array:
        return np.interp(np.abs(along), self._middles, [getattr(tooth, name) for tooth in self._teeth])

    def _part(self, points: Array, color: Array, *, closed: bool, flipped: bool) -> Mesh:
        """A mesh of a grid of points (rows, columns, 3), darker towards the throat and the cheeks."""
        triangles = grid_triangles(*points.shape[:2], closed=closed)
        behind = self._arch.front - points[..., 2:]
        beside = np.abs(points[..., :1])
        reached = smoothstep(0.027, 0.002, behind) * (1 - _SIDE_SHADE * smoothstep(0.009, 0.019, beside))
        shade = self._light * (0.14 + 0.86 * reached) ** _SHADE_TINT
        count = points.size // 3
        weights = np.tile(self._weights, (count, 1))
        colors = (color * shade).reshape(-1, 3)
        mesh = Mesh(points.reshape(-1, 3), weights, triangles, no_uvs(triangles), colors)
        if flipped:
            mesh.flip()
        return mesh


def build_teeth(body: Body) -> tuple[Mesh, Mesh]:
    """The upper and the lower row."""
    upper = _Row(body, "helper-upper-teeth", _UPPER, -1, 0.0, 1.0)
    lower = _Row(body, "helper-lower-teeth", _LOWER, 1, _OVERJET, 0.66)
    return upper.mesh(), lower.mesh()


def jaw_moves(body: Body, group: str, points: Array) -> dict[str, Array]:
    """How the face units move points (n, 3) as they move a group of vertices: an affine map fitted to each."""
    at = np.c_[body.positions[body.groups[group]], np.ones(len(body.groups[group]))]
    moves = {}
    for unit in body.shapes:
        fit = np.linalg.lstsq(at, body.moved(unit)[body.groups[group]], rcond=None)[0]
        moves[unit] = np.c_[points, np.ones(len(points))] @ fit
    return moves
