"""The shirt at the neck: its cut, its fit and its collar."""

from dataclasses import replace

import numpy as np

from reactive_realizer.bake.body import Body
from reactive_realizer.bake.characters import Neckline
from reactive_realizer.bake.cloth import Surface, band
from reactive_realizer.bake.lowered_arms import LoweredArms
from reactive_realizer.bake.mesh import Mesh, subdivide, vertex_normals
from reactive_realizer.bake.numeric import Array, Field, smoothstep, unit
from reactive_realizer.bake.rig import BONES
from reactive_realizer.bake.surgery import Rim, RimRow, relax, rim_vertices

_COLLAR_HEIGHT = {Neckline.CREW: 0.016, Neckline.SCOOP: 0.008}
_CLOTH_EASE = 0.0035
"""Height of the cloth above the skin at the neckline, m."""

_FITTINGS = 4
"""Rounds of laying and smoothing the cloth."""

_SAMPLES, _EVENING = 240, 16
"""Samples around the neck, about 2 mm apart, and rounds of smoothing them."""

_ROUNDING = 0.05
"""Where the two cuts of a scoop meet, m."""

_REACH = 0.16
"""Depth below the neck joint to which the neckline cuts, m; the cutting shapes extend further."""


def neck_field(body: Body, style: Neckline) -> Field:
    """Positive where there is cloth, zero along the neckline."""
    cut = _scoop(body) if style is Neckline.SCOOP else _crew(body)
    height = body.places["Neck"][1]

    def field(points: Array) -> Array:
        return np.where(points[..., 1] > height - _REACH, cut(points), 1.0)

    return field


def _scoop(body: Body) -> Field:
    """An ellipsoid in front of the neck is cut out."""
    neck = body.places["Neck"]
    center, radii = np.array([0, neck[1] + 0.012, neck[2] + 0.052]), np.array([0.082, 0.082, 0.086])

    def field(points: Array) -> Array:
        outside = (np.linalg.norm((points - center) / radii, axis=-1) - 1) * 0.085
        return _smooth_minimum(outside, neck[1] + 0.022 - points[..., 1])

    return field


def _smooth_minimum(a: Array, b: Array) -> Array:
    """The minimum with a rounded corner."""
    share = np.clip(0.5 + 0.5 * (b - a) / _ROUNDING, 0, 1)
    return b + (a - b) * share - _ROUNDING * share * (1 - share)


def _crew(body: Body) -> Field:
    """A plane across the neck, lower in front."""
    neck = body.places["Neck"]
    axis = unit(unit(body.places["Head"] - neck) + np.array([0, 0, 0.35]))
    return lambda points: -((points - neck) @ axis) - 0.005


def smooth_neck(cloth: Mesh, neck: Field, body: Body) -> None:
    """Lay the cloth near the neckline on the skin, while the arms hang, so that its rim does not stand off there."""
    skin = _skin(body)
    near_rim = smoothstep(0.075, 0.010, np.abs(neck(cloth.positions)))
    near_rim *= smoothstep(0, 0.02, cloth.positions[:, 1] - body.places["Neck"][1] + _REACH)
    points = LoweredArms(body.rig, cloth.weights).apply(cloth.positions)
    for _ in range(_FITTINGS):
        laid = relax(skin.lay(points, _CLOTH_EASE), cloth.triangles, 1, 0.4)
        points = points + (skin.push(laid, _CLOTH_EASE) - points) * near_rim[:, None]
    cloth.weights = _strongest(cloth.weights + (skin.weights_at(points) - cloth.weights) * near_rim[:, None])
    cloth.positions = LoweredArms(body.rig, cloth.weights).undo(points)


def _skin(body: Body) -> Surface:
    """The skin around the neck while the arms hang, at points that are closer together than its vertices."""
    near = (body.positions[:, 1] > body.places["Neck"][1] - 0.25)[body.triangles].all(1)
    lowered = LoweredArms(body.rig, body.weights).apply(body.positions)
    skin = Mesh(lowered, body.weights, body.triangles[near], body.uvs[near]).compact()
    fine = subdivide(subdivide(skin))
    return Surface(fine.positions, vertex_normals(fine.positions, fine.triangles), fine.weights)


def even_rim(cloth: Mesh, rim: Rim, body: Body) -> None:
    """Smooth the rim of the cloth at the neckline, which has been cut across triangles of all sizes."""
    vertices, pose = rim_vertices(rim), LoweredArms(body.rig, cloth.weights)
    points = pose.apply(cloth.positions)
    points[vertices] = _skin(body).lay(_even(points[vertices]), _CLOTH_EASE)
    cloth.positions = pose.undo(points)


def collar(cloth: Mesh, rim: Rim, body: Body) -> Mesh:
    """A rounded band that lies on the neck; its inner edge is below the skin."""
    design, skin = body.character.top, _skin(body)
    height = _COLLAR_HEIGHT[design.neckline]

    def row(ease: float, upward: float) -> RimRow:
        return lambda p, n, out: skin.lay(_even(p + out * upward), ease)

    rows = [
        row(0.0052, -0.0015),
        row(0.0062, height * 0.3),
        row(0.0056, height * 0.75),
        row(0.0042, height * 0.96),
        row(0.0018, height),
        row(-0.0030, height * 0.8),
    ]
    lowered = replace(cloth, positions=LoweredArms(body.rig, cloth.weights).apply(cloth.positions))
    sewn = band(lowered, rim, rows, vertex_normals(lowered.positions, cloth.triangles), design.trim, 0.3)
    sewn.weights[len(rim) :] = _strongest(skin.weights_at(sewn.positions[len(rim) :]))
    sewn.positions = LoweredArms(body.rig, sewn.weights).undo(sewn.positions)
    return sewn


def _strongest(weights: Array) -> Array:
    """Bone weights (n, joints) without those that the file has no room for."""
    kept = np.where(weights >= np.sort(weights, 1)[:, -BONES, None], weights, 0)
    return kept / kept.sum(1, keepdims=True)


def _even(loop: Array) -> Array:
    """A closed loop of points (k, 3) without kinks shorter than a centimeter; each point keeps its place along it."""
    closed = np.vstack([loop, loop[:1]])
    along = np.r_[0, np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))]
    at = np.linspace(0, along[-1], _SAMPLES, endpoint=False)
    dense = np.stack([np.interp(at, along, axis) for axis in closed.T], 1)
    for _ in range(_EVENING):
        dense = 0.5 * dense + 0.25 * (np.roll(dense, 1, 0) + np.roll(dense, -1, 0))
    return np.stack([np.interp(along[:-1], at, axis, period=along[-1]) for axis in dense.T], 1)
