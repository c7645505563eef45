"""The skin of arms and hands: color, occlusion and roughness, and fine relief, painted in three dimensions."""

from itertools import product

import numpy as np
from scipy.ndimage import gaussian_filter

from reactive_realizer.bake.body import Body
from reactive_realizer.bake.images import jpeg, normal_map, orm, picture, shrunk
from reactive_realizer.bake.numeric import Array, Indices, smoothstep, unit, value_noise
from reactive_realizer.bake.skin_paint import Paint, SkinTextures, mottled_skin
from reactive_realizer.bake.texels import TexelMap

_SIZE, _RELIEF_SIZE = 2048, 1024
_JOINT, _FREE_EDGE = 0.016, 0.0012
"""Reach of the folds at a joint, and length of the white end of a nail, m."""

_FINGERS = ("Thumb", "Index", "Middle", "Ring", "Pinky")


class _Hands:
    """The parts of the hands: pictures (n, n), 0..1."""

    def __init__(self, body: Body, points: Array, up: Array, nails: Array) -> None:
        self.nails = nails
        self.knuckles, self.creases, self.nail_ends = (np.zeros(nails.shape) for _ in range(3))
        for side, finger in product(("Left", "Right"), _FINGERS):
            joints = [body.places[f"{side}Hand{finger}{i}"] for i in (1, 2, 3)]
            for joint, axis in zip(joints[1:], unit(np.diff(joints, axis=0)), strict=True):
                self._add_joint(points, up, joint, axis)
            self._add_nail_end(points, joints[2], unit(joints[2] - joints[1]))

    def _add_joint(self, points: Array, up: Array, joint: Array, axis: Array) -> None:
        """Folds across the back of a finger at a joint, one crease on the other side."""
        own = np.abs(points - joint).max(-1) < _JOINT
        away, back = points[own] - joint, up[own]
        along, distance = away @ axis + 0.0006 * value_noise(points[own] * 260), np.linalg.norm(away, axis=-1)
        folds = np.max([np.exp(-(((along - at) / 0.00055) ** 2)) for at in (-0.0030, -0.0008, 0.0016)], 0)
        creases = np.where(back > 0, folds * back.clip(0, 1), np.exp(-((along / 0.0007) ** 2)))
        self.creases[own] = np.maximum(self.creases[own], smoothstep(_JOINT, 0.009, distance) * creases)
        red = np.exp(-((distance / 0.008) ** 2)) * smoothstep(-0.2, 0.5, back)
        self.knuckles[own] = np.maximum(self.knuckles[own], red)

    def _add_nail_end(self, points: Array, joint: Array, axis: Array) -> None:
        own = (self.nails > 0.5) & (np.abs(points - joint).max(-1) < 0.035)
        along = (points[own] - joint) @ axis
        if (along > 0).any():
            end = np.percentile(along[along > 0], 99) - _FREE_EDGE
            self.nail_ends[own] = np.maximum(self.nail_ends[own], smoothstep(end - 0.0004, end, along))


def paint_body(body: Body, seen: Indices, uvs: Array, exposure: Array) -> SkinTextures:
    """Paint the skin of a body.

    Args:
        body: whose skin it is.
        seen: (t, 3) its triangles that have this texture.
        uvs: (t, 3, 2) of their corners.
        exposure: (v,) of the vertices to light, 0..1.
    """
    texels = TexelMap(uvs, _SIZE)
    points, up = texels.carry(body.positions[seen]), texels.carry(body.normals[seen][..., 1])
    hands = _Hands(body, points, up, gaussian_filter(body.mask("fingernails", _SIZE), 1.0))
    roughness = 0.57 + 0.03 * value_noise(points * 520 + 31.7)
    roughness = roughness * (1 - hands.nails) + 0.34 * hands.nails
    return SkinTextures(
        color=jpeg(picture(_color(body, hands, points)), 86),
        surface=orm(texels.carry(exposure[seen]), roughness, _SIZE),
        normal=jpeg(shrunk(_relief(hands, points), _RELIEF_SIZE), 84),
    )


def _color(body: Body, hands: _Hands, points: Array) -> Array:
    who = body.character
    skin = np.array(who.skin)
    paint = Paint(mottled_skin(who, points))
    paint.lay(hands.knuckles, who.flush, 0.30)
    paint.lay(hands.creases, skin * [0.80, 0.68, 0.64], 0.35)
    paint.lay(hands.nails, np.minimum(skin * [1.06, 0.98, 0.98] + 6, 250), 0.75)
    paint.lay(_rim(hands.nails), skin * [0.78, 0.64, 0.60], 0.55)
    paint.lay(hands.nail_ends, np.array([238, 226, 212]) * 0.35 + skin * 0.65, 0.9)
    return paint.pixels


def _rim(nails: Array) -> Array:
    """The fold of skin around the nails."""
    return np.clip(4 * gaussian_filter(nails, 2.0) * (1 - gaussian_filter(nails, 1.0)), 0, 1)


def _relief(hands: _Hands, points: Array) -> Array:
    """Fine lines of the skin, folds at the joints, raised nails."""
    lines = -0.35 * np.abs(value_noise(points * [700, 1100, 900])) + 0.25 * value_noise(points * 380)
    plate = 2.2 * hands.nails - 1.6 * _rim(hands.nails)
    height = lines * (1 - hands.nails) * 0.5 - 1.1 * hands.creases + plate
    return normal_map(gaussian_filter(height, 0.8), 0.42)
