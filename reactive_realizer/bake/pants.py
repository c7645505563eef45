"""The trousers: straight legs, creases at knee, crotch and ankle."""

from dataclasses import dataclass

import numpy as np

from reactive_realizer.bake.body import SOLE, Body
from reactive_realizer.bake.cloth import SLIVER, Garment, Surface, cut_cloth, hem
from reactive_realizer.bake.mesh import Mesh, merge, vertex_normals
from reactive_realizer.bake.numeric import Array, Mask, gaussian, smoothstep, value_noise
from reactive_realizer.bake.rig import SIDES
from reactive_realizer.bake.surgery import clip, collapse_rim, relax, rim_vertices, rims


@dataclass(frozen=True, slots=True)
class _Pattern:
    """Heights of the trousers' lines on this body (m)."""

    waist: float
    hip: float
    crotch: float
    knee: float
    ankle: float
    cuff: float

    @classmethod
    def for_body(cls, body: Body) -> "_Pattern":
        hip, ankle = body.places["LeftUpLeg"][1], body.places["LeftFoot"][1]
        skin = body.positions[body.is_skin]
        between_legs = (np.abs(skin[:, 0]) < 0.006) & (skin[:, 1] > ankle + 0.3)
        return cls(
            waist=hip + 0.02,
            hip=hip,
            crotch=skin[between_legs][:, 1].min(),
            knee=body.places["LeftLeg"][1],
            ankle=ankle,
            cuff=SOLE + 0.050,
        )


def build_pants(body: Body, shirt_hem: float) -> Garment:
    """Trousers that reach under a shirt whose hem is at this height (m)."""
    lines, design = _Pattern.for_body(body), body.character.pants
    legs = body.is_skin & (body.positions[:, 1] < lines.waist + 0.1) & (body.weight_of("Arm", "Hand") < 0.1)
    skin = Surface.of(body, legs)
    cloth = cut_cloth(body, lambda p: (p[:, 1] < lines.waist + 0.06) & (np.abs(p[:, 0]) < 0.35))
    cloth.weights = _weights(body, cloth, legs)
    p = skin.push(relax(cloth.positions, cloth.triangles, 8), 0.005)
    for side, sign in SIDES:
        _widen_leg(p, body, lines, side, sign)
    p = relax(p, cloth.triangles, 3, 0.4)
    folds = _folds(p, lines)
    cloth.positions = skin.push(p + vertex_normals(p, cloth.triangles) * folds[:, None], 0.0035)
    cloth = _trim(cloth, body, lines)
    cloth.paint(design.color)
    normals = vertex_normals(cloth.positions, cloth.triangles)
    cuffs = [rim for rim in rims(cloth.triangles)[:3] if cloth.positions[rim_vertices(rim)][:, 1].mean() < 0.3]
    hems = [hem(cloth, rim, normals, design.color, depth=0.010, thickness=0.0034) for rim in cuffs]

    def covers(points: Array) -> Mask:
        # with the shoes they hide everything below the hem of the shirt
        return (points[:, 1] < shirt_hem + 0.035) & (np.abs(points[:, 0]) < 0.40)

    return Garment(merge([cloth, *hems]), covers)


def _weights(body: Body, cloth: Mesh, legs: Mask) -> Array:
    """Each leg follows the skin of its own side: across the crotch the other leg is nearer."""
    sides = [Surface.of(body, legs & (body.positions[:, 0] * sign > -0.004)).weights_for(cloth) for _, sign in SIDES]
    x = cloth.positions[:, :1]
    return np.where(np.abs(x) < 0.004, (sides[0] + sides[1]) / 2, np.where(x > 0, sides[0], sides[1]))


def _widen_leg(p: Array, body: Body, lines: _Pattern, side: str, sign: int) -> None:
    """Give the points (n, 3) of one leg the cut's radius around the bones, in place."""
    design = body.character.pants
    own = p[:, 0] * sign > 0
    axis = _leg_axis(p[:, 1], body, lines, side)
    from_axis = p[:, [0, 2]] - axis
    radius = np.linalg.norm(from_axis, axis=1)
    heights = [lines.cuff, lines.knee, lines.crotch - 0.02]
    wanted = np.interp(p[:, 1], heights, [design.ankle * 1.08, design.knee, design.knee + 0.010])
    wide = np.maximum(radius + 0.003, radius + (np.maximum(wanted - radius, 0)) * 0.92)
    wide = radius + (wide - radius) * smoothstep(lines.crotch - 0.03, lines.crotch - 0.20, p[:, 1])
    x, z = (axis[:, i] + from_axis[:, i] / np.maximum(radius, 1e-6) * wide for i in (0, 1))
    p[own, 0], p[own, 2] = x[own], z[own]
    apart = 0.004 * smoothstep(lines.crotch + 0.01, lines.crotch - 0.02, p[:, 1])
    p[own, 0] = sign * np.maximum(p[own, 0] * sign, apart[own])


def _leg_axis(heights: Array, body: Body, lines: _Pattern, side: str) -> Array:
    """The bones' x and z (n, 2) at these heights; behind them below the knee, where the calf is."""
    joints = np.array([body.places[side + joint] for joint in ("UpLeg", "Leg", "Foot")])
    upwards = joints[np.argsort(joints[:, 1])]
    axis = np.stack([np.interp(heights, upwards[:, 1], upwards[:, i]) for i in (0, 2)], 1)
    axis[:, 1] -= 0.012 * smoothstep(lines.knee, lines.ankle + 0.1, heights)
    return axis


def _folds(p: Array, lines: _Pattern) -> Array:
    """The height of folds in the cloth (n,): at the cuff, behind the knee, in the groin, and a little everywhere."""
    x, y, z = p.T
    around = np.arctan2(np.abs(x) - 0.1, z)
    cuff_phase = y * 2 * np.pi / 0.042 + 1.3 * np.sin(around * 2) + 2 * value_noise(p * 12)
    knee_phase = y * 2 * np.pi / 0.055 + 1.7 * np.sin(around) + 2 * value_noise(p * 10)
    groin_phase = (y - 0.5 * np.abs(x)) * 2 * np.pi / 0.045
    everywhere = 0.0025 * value_noise(p * np.array([20, 8, 20])) * smoothstep(lines.hip, lines.crotch - 0.05, y)
    folds = 0.0036 * np.exp(-(((y - lines.cuff - 0.05) / 0.055) ** 2)) * np.sin(cuff_phase)
    folds += 0.0018 * gaussian(y, lines.knee, 0.07) * np.sin(knee_phase) + everywhere
    folds += 0.003 * (np.exp(-(((y - lines.crotch - 0.02) / 0.05) ** 2)) * (z > 0)) * np.sin(groin_phase)
    return folds


def _trim(cloth: Mesh, body: Body, lines: _Pattern) -> Mesh:
    """Cut at the waist, and at the cuffs, which rise over the instep."""
    ankle_z = body.places["LeftFoot"][2]
    cloth = clip(cloth, lambda p: lines.waist - p[..., 1])
    cloth = clip(cloth, lambda p: p[..., 1] - lines.cuff - 0.022 * smoothstep(-0.01, 0.07, p[..., 2] - ankle_z))
    return collapse_rim(cloth, SLIVER)
