"""The eyeballs: geometry and texture."""

import numpy as np
from scipy.ndimage import gaussian_filter

from reactive_realizer.bake.body import Body
from reactive_realizer.bake.further_shapes import EYE_MOVE
from reactive_realizer.bake.images import jpeg, normal_map, picture, shrunk
from reactive_realizer.bake.mesh import Mesh, grid_triangles, merge
from reactive_realizer.bake.numeric import Array, Color, smoothstep, unit, value_noise
from reactive_realizer.bake.rig import SIDES, eye_group

_RINGS, _SECTORS = 22, 28
_IRIS, _PUPIL = 0.50, 0.205
"""Radii as parts of the texture's half width."""

_WHITE, _VEIN, _COLLARETTE, _BLACK = [228, 217, 207], [205, 110, 98], [150, 104, 56], [8, 7, 8]


_WIDER, _NARROWER = 0.10, -0.08
"""By which angle the edge of a dilated and of a constricted pupil moves outward, rad."""


def build_eyes(body: Body) -> Mesh:
    """Both eyes."""
    return merge([_eyeball(body, side) for side, _ in SIDES])


def eye_moves(body: Body) -> dict[str, Array]:
    """The displacements of the vertices of both eyes by their blend shapes: (v, 3) m by name."""
    moves: dict[str, Array] = {}
    polar, pupil, iris = _polar(), np.arcsin(_PUPIL / 0.98), np.arcsin(_IRIS / 0.98)
    edge = smoothstep(0.0, pupil, polar) * smoothstep(iris, pupil, polar)
    for name, turn in (("eyeConstrict", _NARROWER), ("eyeDilation", _WIDER)):
        for side, _ in SIDES:
            moved = _surface(body, side, polar + turn * edge) - _surface(body, side, polar)
            moves[name + side] = _of_both(side, moved)
    for name, move in (("eyeThrust", EYE_MOVE), ("eyeSink", -EYE_MOVE)):
        for side, _ in SIDES:
            moves[name + side] = _of_both(side, np.tile((0.0, 0.0, move), (_RINGS * _SECTORS, 1)))
    return moves


def _of_both(side: str, moves: Array) -> Array:
    """The displacements of both eyes when one moves."""
    return np.concatenate([moves if side == each else np.zeros(moves.shape) for each, _ in SIDES])


def _eyeball(body: Body, side: str) -> Mesh:
    """Two thirds of a sphere with a bulging cornea that follows its eye joint."""
    polar, around = _polar(), _around()
    positions = _surface(body, side, polar)
    disc = np.where(polar < np.pi / 2, np.sin(polar), 1.0)
    uvs = np.stack([0.5 + 0.49 * disc * np.cos(around), 0.5 - 0.49 * disc * np.sin(around)], -1).reshape(-1, 2)
    triangles = grid_triangles(_RINGS, _SECTORS, closed=True)[:, [0, 2, 1]]
    weights = np.zeros((len(positions), len(body.rig.names)))
    weights[:, body.rig.index(side + "Eye")] = 1
    return Mesh(positions, weights, triangles, uvs[triangles], normals=unit(positions - body.places[side + "Eye"]))


def _polar() -> Array:
    """The angles of the rings from the middle of the pupil: (rings, 1), rad."""
    return np.r_[0, np.linspace(0.05, 1, _RINGS - 1) ** 1.15 * 2.0][:, None]


def _around() -> Array:
    """The angles of the sectors: (1, sectors), rad."""
    return (np.arange(_SECTORS) / _SECTORS * 2 * np.pi)[None]


def _surface(body: Body, side: str, polar: Array) -> Array:
    """The points (n, 3) of an eye on rings at angles (rings, 1) from the middle of the pupil, rad."""
    center, around = body.places[side + "Eye"], _around()
    radius = np.abs(body.positions[body.groups[eye_group(side)]][:, 0] - center[0]).max() * 0.995
    outward = np.stack(
        [np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar) + 0 * around], -1
    ).reshape(-1, 3)
    bulge = np.repeat(0.045 * smoothstep(0.62, 0.0, polar), _SECTORS)
    positions: Array = center + radius * outward * (1 + bulge)[:, None]
    return positions


def paint_eye(iris: Color, size: int = 512) -> tuple[bytes, bytes]:
    """Color and normals of an eye seen from the front."""
    rng = np.random.default_rng(7)
    y, x = np.mgrid[0:size, 0:size]
    x, y = (x + 0.5) / size * 2 - 1, (y + 0.5) / size * 2 - 1
    radius, angle = np.hypot(x, y), np.arctan2(y, x)

    def fibers(count: int) -> Array:
        values = rng.random(count)
        return np.interp((angle / (2 * np.pi)) % 1, np.linspace(0, 1, count + 1), np.r_[values, values[:1]])

    color = _sclera(x, y, radius)
    structure = 0.55 * fibers(220) + 0.45 * fibers(90)
    in_iris = smoothstep(_IRIS + 0.018, _IRIS - 0.018, radius)[..., None]
    color = color * (1 - in_iris) + _iris(iris, y, radius, structure) * in_iris
    in_pupil = smoothstep(_PUPIL + 0.012, _PUPIL - 0.012, radius + 0.012 * (fibers(60) - 0.5))[..., None]
    color = color * (1 - in_pupil) + np.array(_BLACK) * in_pupil
    return jpeg(picture(color), 88), jpeg(shrunk(_eye_relief(radius, structure), 256), 85)


def _sclera(x: Array, y: Array, radius: Array) -> Array:
    color = np.ones((*x.shape, 3)) * _WHITE
    noise = value_noise(np.stack([x * 9, y * 9, 0 * x], -1))
    vein = np.exp(-((noise / 0.05) ** 2)) * smoothstep(0.55, 0.95, radius)
    color = color * (1 - 0.22 * vein[..., None]) + np.array(_VEIN) * 0.22 * vein[..., None]
    in_shade_of_lids = 0.30 * smoothstep(0.52, 1.0, radius), 0.30 * smoothstep(0.1, -0.75, y)
    return color * (1 - in_shade_of_lids[0] - in_shade_of_lids[1])[..., None]


def _iris(color: Color, y: Array, radius: Array, structure: Array) -> Array:
    base = np.array(color, float)
    t = (radius - _PUPIL) / (_IRIS - _PUPIL)
    dark, light = base * 0.62, np.minimum(base * 1.40 + 10, 255)
    k = np.clip(0.25 + 0.75 * structure * (1 - 0.35 * t), 0, 1)[..., None]
    iris = dark * (1 - k) + light * k
    warm = np.exp(-(((t - 0.16) / 0.13) ** 2))[..., None] * 0.45
    iris = iris * (1 - warm) + np.array(_COLLARETTE) * 0.9 * warm
    iris *= (1 - 0.75 * smoothstep(0.78, 1.0, t))[..., None]  # limbal ring
    iris *= (0.72 + 0.40 * smoothstep(-0.45, 0.45, y))[..., None]  # light falls in from above
    return iris


def _eye_relief(radius: Array, structure: Array) -> Array:
    """A dished iris under the clear coat, with its fibers."""
    size = len(radius)
    dish = np.where(radius < _IRIS, -6 * (1 - (radius / _IRIS) ** 2), 0) * size / 512 * 3
    return normal_map(gaussian_filter(dish + structure * 0.8 * (radius < _IRIS) * (radius > _PUPIL), 1.2), 0.35)
