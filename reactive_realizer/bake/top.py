"""The shirt: draped from chest and shoulders, with sleeves, wrinkles, a collar and cuffs."""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import distance_transform_edt, gaussian_filter, map_coordinates

from reactive_realizer.bake.body import Body, sum_columns
from reactive_realizer.bake.characters import TopDesign
from reactive_realizer.bake.cloth import SLIVER, Garment, Surface, band, cut_cloth, hem
from reactive_realizer.bake.lowered_arms import LoweredArms
from reactive_realizer.bake.mesh import Mesh, merge, vertex_normals
from reactive_realizer.bake.neckline import collar, even_rim, neck_field, smooth_neck
from reactive_realizer.bake.numeric import Array, Field, Mask, gaussian, smoothstep, value_noise
from reactive_realizer.bake.rig import SIDES
from reactive_realizer.bake.surgery import Rim, RimRow, clip, collapse_rim, relax, rim_vertices, rims

_ROWS, _SECTORS = 48, 64
"""Resolution of the drape around the torso."""

_SHOULDER_ROUNDS = 60
"""Rounds of smoothing of the shoulders."""


@dataclass(frozen=True, slots=True)
class _Pattern:
    """The lines of the shirt on this body (m): heights y of hem and hips, distances x along the spread arm."""

    hem: float
    hip: float
    shoulder_height: float
    shoulder: float
    elbow: float
    wrist: float
    sleeve: float
    neck: Array

    @classmethod
    def for_body(cls, body: Body, design: TopDesign) -> "_Pattern":
        places = body.places
        hip = places["LeftUpLeg"][1]
        along = {bone: abs(places["Left" + bone][0]) for bone in ("Arm", "ForeArm", "Hand")}
        start, end = ("Arm", "ForeArm") if design.sleeve_bone == "Arm" else ("ForeArm", "Hand")
        return cls(
            hem=hip - 0.035,
            hip=hip,
            shoulder_height=places["LeftArm"][1],
            shoulder=along["Arm"],
            elbow=along["ForeArm"],
            wrist=along["Hand"],
            sleeve=along[start] + design.sleeve_part * (along[end] - along[start]),
            neck=places["Neck"],
        )


class _Shirt:
    """The cloth while it is being worked on."""

    def __init__(self, body: Body) -> None:
        self.body, self.design = body, body.character.top
        self.pattern = _Pattern.for_body(body, self.design)
        lines, p = self.pattern, body.positions
        near = body.is_skin & (p[:, 1] > lines.hem - 0.2) & (p[:, 1] < lines.neck[1] + 0.12)
        self.skin = Surface.of(body, near & (np.abs(p[:, 0]) < lines.sleeve + 0.12))
        self.cloth = cut_cloth(body, lambda q: (q[:, 1] > lines.hem - 0.10) & (np.abs(q[:, 0]) < lines.sleeve + 0.08))
        self.cloth.weights = Surface.of(body, near).weights_for(self.cloth)
        self.arm = sum_columns(self.cloth.weights, body.rig.columns("Arm", "Hand"))
        self.points = self.skin.push(relax(self.cloth.positions, self.cloth.triangles, 6), 0.006)
        on_torso = (self.arm < 0.35) & (self.points[:, 1] < lines.shoulder_height - 0.02)
        self.on_torso = np.where(on_torso)[0]
        self.axis_z = np.median(self.points[on_torso][:, 2])

    def drape(self) -> None:
        """Hang the torso from chest and shoulder blades instead of clinging to the waist."""
        p, lines = self.points, self.pattern
        turn = (np.arctan2(p[:, 0], p[:, 2] - self.axis_z) / (2 * np.pi)) % 1
        bottom, top = lines.hem - 0.1, lines.shoulder_height
        row = (p[:, 1] - bottom) / (top - bottom) * (_ROWS - 1)
        added = self._hanging_room(row, turn, (top - bottom) / (_ROWS - 1))
        below_shoulder = np.where(p[:, 1] < top, 1, 0) * smoothstep(0.5, 0.1, self.arm)
        at = [np.clip(row, 0, _ROWS - 1), turn * _SECTORS - 0.5 + 2]
        outwards = map_coordinates(added, at, order=1, mode="nearest") * below_shoulder
        outwards = outwards + 0.006 * smoothstep(lines.hem + 0.22, lines.hem, p[:, 1])
        radial = np.stack([np.sin(turn * 2 * np.pi), 0 * turn, np.cos(turn * 2 * np.pi)], 1)
        self.points = p + radial * outwards[:, None]

    def _hanging_room(self, row: Array, turn: Array, row_height: float) -> Array:
        """By how much the cloth stands off when it hangs; (rows, sectors + 2 on either side)."""
        radius = self._radii(row, turn)
        hanging = radius.copy()
        for i in range(_ROWS - 2, -1, -1):
            hanging[i] = np.maximum(hanging[i], hanging[i + 1] - self.design.fall * row_height)
        hanging = gaussian_filter(hanging, (1.0, 2.5), mode=("nearest", "wrap"))
        room = np.maximum(hanging - radius, 0) * (1 - self.design.cling)
        return np.concatenate([room[:, -2:], room, room[:, :2]], 1)

    def _radii(self, row: Array, turn: Array) -> Array:
        """The outermost distance of the torso's cloth from its axis: (rows, sectors)."""
        radius = np.full((_ROWS, _SECTORS), np.nan)
        distance = np.hypot(self.points[:, 0], self.points[:, 2] - self.axis_z)
        for i in self.on_torso:
            cell = round(np.clip(row[i], 0, _ROWS - 1)), int(turn[i] * _SECTORS) % _SECTORS
            radius[cell] = np.fmax(radius[cell], distance[i])
        around = np.concatenate([radius, radius, radius], 1)
        y, x = distance_transform_edt(np.isnan(around), return_distances=False, return_indices=True)
        return gaussian_filter(around[y, x][:, _SECTORS : 2 * _SECTORS], (1.2, 1.5), mode=("nearest", "wrap"))

    def widen_sleeves(self) -> None:
        """Keep at least the sleeve's radius around the bones of the arm."""
        p, lines = self.points, self.pattern
        for side, sign in SIDES:
            from_bone = p[:, 1:] - self.body.places[side + "Arm"][1:]
            radius = np.linalg.norm(from_bone, axis=1)
            x = p[:, 0] * sign
            missing = np.maximum(self._sleeve_radius(x) - radius, 0) * smoothstep(
                lines.shoulder + 0.035, lines.shoulder + 0.13, x
            )
            p[:, 1:] += from_bone / np.maximum(radius, 1e-6)[:, None] * missing[:, None]

    def _sleeve_radius(self, x: Array) -> Array:
        lines, radius = self.pattern, self.design.sleeve_radius
        if self.design.sleeve_bone == "Arm":
            return radius * (1 - 0.06 * smoothstep(lines.shoulder, lines.sleeve, x))
        return np.interp(x, [lines.shoulder, lines.elbow, lines.sleeve], [radius * 1.08, radius, radius * 0.84])

    def wrinkle(self) -> None:
        """Soft folds at waist and elbows."""
        p, lines, triangles = self.points, self.pattern, self.cloth.triangles
        waist = gaussian(p[:, 1], lines.hip + 0.10, 0.07) * smoothstep(0.4, 0.1, self.arm)
        folds = 0.0012 * waist * np.sin(p[:, 1] * 2 * np.pi / 0.052 + 2.2 * value_noise(p * 9))
        folds = folds + 0.0022 * value_noise(p * np.array([22, 12, 22])) * smoothstep(0.6, 0.1, self.arm)
        elbow = gaussian(np.abs(p[:, 0]), lines.elbow, 0.05) * (self.arm > 0.5)
        folds += 0.0024 * elbow * np.sin(p[:, 0] * 2 * np.pi / 0.030 + 1.5 * value_noise(p * 14))
        p = p + vertex_normals(p, triangles) * folds[:, None]
        p = self.skin.push(relax(p, triangles, 2, 0.4), 0.0045)
        self.cloth.positions = relax(p, triangles, 1, 0.3)

    def settle(self) -> None:
        """Round the shoulders while the arms hang, as they mostly do: linear skinning leaves pads there."""
        pose = LoweredArms(self.body.rig, self.cloth.weights)
        points = pose.apply(self.cloth.positions)
        near = np.zeros(len(points))
        for side, _ in SIDES:
            away = np.linalg.norm(points - self.body.places[side + "Arm"], axis=1)
            near = np.maximum(near, smoothstep(0.15, 0.06, away))
        smooth = relax(points, self.cloth.triangles, _SHOULDER_ROUNDS)
        self.cloth.positions = pose.undo(points + (smooth - points) * near[:, None])

    def finish(self, neck: Field) -> Mesh:
        """Cut at neck, hem and sleeves, and sew on collar, hem and cuffs."""
        lines, axis_z, cloth = self.pattern, self.axis_z, self.cloth

        def above_hem(p: Array) -> Array:
            return p[..., 1] - lines.hem - 0.006 * np.cos(np.arctan2(p[..., 0], p[..., 2] - axis_z) * 2)

        for field in (neck, above_hem, lambda p: lines.sleeve - np.abs(p[..., 0])):
            cloth = clip(cloth, field)
        cloth = collapse_rim(cloth, SLIVER)
        cloth.paint(self.design.color)
        normals = vertex_normals(cloth.positions, cloth.triangles)
        return merge([cloth, *(self._edging(cloth, rim, normals) for rim in rims(cloth.triangles)[:4])])

    def _edging(self, cloth: Mesh, rim: Rim, normals: Array) -> Mesh:
        middle = cloth.positions[rim_vertices(rim)].mean(0)
        if middle[1] > self.pattern.neck[1] - 0.15 and abs(middle[0]) < 0.05:
            even_rim(cloth, rim, self.body)
            return collar(cloth, rim, self.body)
        if middle[1] < self.pattern.hem + 0.05:
            return hem(cloth, rim, normals, self.design.color, depth=0.03, thickness=0.0026)
        return _cuff(cloth, rim, normals, self.design)


def _cuff(cloth: Mesh, rim: Rim, normals: Array, design: TopDesign) -> Mesh:
    """A short turned band."""
    rows: list[RimRow] = [
        lambda p, n, out: p + n * 0.0018 - out * 0.0005,
        lambda p, n, out: p + n * 0.0020 + out * 0.012,
        lambda p, n, out: p - n * 0.0006 + out * 0.0128,
        lambda p, n, out: p - n * 0.0020 - out * 0.020,
    ]
    return band(cloth, rim, rows, normals, design.trim, 0.3)


def build_top(body: Body) -> tuple[Garment, float]:
    """The shirt, and the height of its hem (m)."""
    shirt = _Shirt(body)
    shirt.drape()
    shirt.widen_sleeves()
    shirt.wrinkle()
    lines = shirt.pattern
    neck = neck_field(body, shirt.design.neckline)
    shirt.settle()
    smooth_neck(shirt.cloth, neck, body)

    def covers(points: Array) -> Mask:
        on_trunk = (neck(points) > 0.003) & (points[:, 1] > lines.hem + 0.02)
        return on_trunk & (np.abs(points[:, 0]) < lines.sleeve - 0.015)

    return Garment(shirt.finish(neck), covers), lines.hem
