"""A chin-long bob: four layers of strands that fall from a side parting, and a fringe swept to both sides."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from reactive_realizer.bake.mesh import Mesh
from reactive_realizer.bake.numeric import Array, direction, smoothstep, unit
from reactive_realizer.bake.ribbon import resample
from reactive_realizer.bake.strands import Strands

_PARTING = 0.10
"""Position of the parting, in skull radii toward the figure's left."""

_LET_GO = np.sin(np.deg2rad(-8))
"""A strand leaves the skull below this elevation at the latest, and hangs."""

_HAIR_LENGTH = 0.112
"""From the eyes down to the tips, m."""


@dataclass(frozen=True, slots=True)
class _Layer:
    """Strands at one height above the scalp (m); the outer ones are narrower, lighter and finer."""

    height: float
    fringe: int
    width: float
    shade: float
    across: int
    falling: int = 26


_LAYERS = (
    _Layer(0.0050, 9, 0.0250, 0.60, 3),
    _Layer(0.0095, 11, 0.0150, 0.82, 4, 30),
    _Layer(0.0130, 13, 0.0115, 0.96, 4, 34),
    _Layer(0.0160, 8, 0.0060, 1.06, 3, 26),
)


def bob(strands: Strands) -> Iterator[Mesh]:
    """All strands, from the innermost layer outwards."""
    hairdo = _Bob(strands)
    for depth, layer in enumerate(_LAYERS):
        for side in (1, -1):
            fringe = [strands.about(i + 0.5, 0.4) / layer.fringe for i in range(layer.fringe)]
            falling = [strands.about(i + 0.5, 0.4) / layer.falling for i in range(layer.falling)]
            for f in fringe:
                yield hairdo.strand(layer, hairdo.fringe_path(side, f, *hairdo.variation(layer, depth)))
            for f in falling:
                yield hairdo.strand(layer, hairdo.falling_path(side, f, *hairdo.variation(layer, depth)))


class _Bob:
    """The paths of the strands on one head."""

    def __init__(self, strands: Strands) -> None:
        self.strands, self.skull, self.center = strands, strands.skull, strands.skull.center
        self.tips = strands.head.eye[1] - _HAIR_LENGTH
        skin = strands.body.positions[np.unique(strands.head.triangles)]
        above_jaw = skin[:, 1] > strands.head.eye[1] - 0.06
        x = np.abs(skin[:, 0])
        ear = skin[(x > x[above_jaw].max() - 0.012) & above_jaw]
        self.ear_x, self.ear_z, self.ear_top = np.abs(ear[:, 0]).max(), ear[:, 2].mean(), ear[:, 1].max()

    def variation(self, layer: _Layer, depth: int) -> tuple[float, float, float]:
        """Height above the scalp, curl of the tip, and length of one strand (m)."""
        height = self.strands.about(layer.height, 0.003)
        curl = self.strands.varied(0.006, 0.014)
        return height, curl, 0.012 * (self.strands.rng.random() - 0.5) - 0.0025 * depth

    def strand(self, layer: _Layer, path: Array) -> Mesh:
        """The ribbon along a path: narrow at the root, a pointed tip."""
        level = np.where(path[:, 1:2] < self.center[1], (path - self.center) * [1, 0.15, 1], path - self.center)
        s = np.linspace(0, 1, len(path))
        width = layer.width * (0.40 + 0.80 * smoothstep(0, 0.35, s)) * (1 - 0.62 * smoothstep(0.84, 1, s))
        width = width * self.strands.varied(0.85, 0.3)
        shade = layer.shade * self.strands.varied(0.85, 0.30) * (0.80 + 0.25 * smoothstep(0.0, 0.4, s))
        return self.strands.strand(path, unit(level), width, layer.across, 0.42, shade)

    def fringe_path(self, side: int, f: float, height: float, curl: float, longer: float) -> Array:
        """From the parting across the forehead to the temple, then down: a cubic Bezier curve in azimuth and elevation.

        Args:
            side: its sign.
            f: 0 is the strand at the forehead, 1 the one at the crown.
            height: above the scalp, m.
            curl: of the tip, m.
            longer: than the others, m.
        """
        controls = _fringe_controls(side, f)
        points = []
        for t in np.linspace(0, 1, 22):
            azimuth, elevation = np.array([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3]) @ controls
            d = direction(elevation, azimuth)
            lift = height * (0.5 + 0.5 * smoothstep(0, 0.45, t))
            swept = 0.004 * np.sin(t * np.pi) * (side < 0)
            points.append(self.center + d * (self.skull.radius(d) + lift + 0.0025 + swept))
        return self._hang(points, self.tips - longer + 0.010 * (1 - f), curl * 0.6, 15)

    def falling_path(self, side: int, f: float, height: float, curl: float, longer: float) -> Array:
        """From the parting over the skull and down; f runs from the front (0) to the nape (1)."""
        if f < 0.42:
            back = f / 0.42
            root = _on_parting(_PARTING, 64 + back * 49)
            flow = np.array([side, 0.0, 0.02 - 0.75 * back])
        else:
            back = (f - 0.42) / 0.58
            root = _on_parting(_PARTING * (1 - back), 113)
            turn = np.deg2rad(35 + 55 * back)
            flow = np.array([side * np.cos(turn), 0, -np.sin(turn)])
            longer += 0.010 * back
        points = self._over_skull(unit(root), flow, height, 0.0 if f < 0.36 else -0.22)
        return self._hang(points, self.tips - longer, curl, 14)

    def _over_skull(self, root: Array, flow: Array, height: float, start: float) -> list[Array]:
        """Along a great circle, from an angle start (rad) at the root until the skull recedes below."""
        flow = unit(flow - root * (flow @ root))
        points: list[Array] = []
        for angle in np.linspace(start, 2.2, 60):
            d = root * np.cos(angle) + flow * np.sin(angle)
            lift = height * (0.5 + 0.5 * smoothstep(0, 0.5, abs(angle))) + 0.0025
            points.append(self.center + d * (self.skull.radius(d) + lift))
            if d[1] < _LET_GO or (angle > 0.6 and self._recedes(points[-2], points[-1])):
                break
        return points

    def _recedes(self, before: Array, after: Array) -> bool:
        def breadth(p: Array) -> float:
            return abs(p[0]) + abs(p[2] - self.center[2])

        return after[1] < before[1] and breadth(after) < breadth(before)

    def _hang(self, points: list[Array], end: float, curl: float, count: int) -> Array:
        """Let a strand hang from its last point down to a height end, clear of the ears, the tip curled inwards."""
        last = points[-1]
        level = np.array([last[0], 0, last[2] - self.center[2]])
        level = level / np.linalg.norm(level)
        length = last[1] - end
        t = np.linspace(0.08, 1, 12)[:, None]
        hanging = last + t * [0, -length, 0] + level * (0.007 * np.sin(t * np.pi) - curl * t**2.2)
        path = np.vstack([points, hanging])
        path[:, 0] = np.sign(path[:, 0]) * np.maximum(np.abs(path[:, 0]), (self.ear_x - 0.003) * self._at_ear(path))
        for _ in range(8):
            path[1:-1] = 0.5 * path[1:-1] + 0.25 * (path[2:] + path[:-2])
        return resample(path, count, path[:, 1] < last[1] - 0.01)

    def _at_ear(self, path: Array) -> Array:
        """The share by which each point makes room for an ear, 0..1."""
        behind = path[:, 2] < self.ear_z
        away = np.maximum(np.abs(path[:, 2] - self.ear_z - 0.006) - 0.012, 0) / np.where(behind, 0.060, 0.034)
        return np.exp(-(away**2)) * smoothstep(self.ear_top + 0.030, self.ear_top, path[:, 1])


def _on_parting(x: float, angle: float) -> Array:
    """A direction on the parting, at an angle (degrees) from the front over the top to the back."""
    return np.array([x, np.sin(np.deg2rad(angle)), np.cos(np.deg2rad(angle))])


def _fringe_controls(side: int, f: float) -> Array:
    """Azimuth and elevation (degrees) of the four control points."""
    if side < 0:
        return np.array(
            [(9, 30 + 37 * f), (-20 - 4 * f, 22 + 34 * f), (-46, 4 + 32 * f), (-64 - 30 * f**1.7, -20 + 20 * f)]
        )
    return np.array([(10, 30 + 37 * f), (28, 30 + 29 * f), (50, 12 + 27 * f), (65 + 29 * f**1.7, -18 + 18 * f)])
