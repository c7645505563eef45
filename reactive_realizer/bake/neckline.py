"""The shirt at the neck: its cut, its fit and its collar."""

import numpy as np

from reactive_realizer.bake.body import Body
from reactive_realizer.bake.characters import Neckline, TopDesign
from reactive_realizer.bake.cloth import Surface, band
from reactive_realizer.bake.mesh import Mesh
from reactive_realizer.bake.numeric import Array, Field, smoothstep, unit
from reactive_realizer.bake.surgery import Rim, RimRow, relax

_COLLAR_HEIGHT = {Neckline.CREW: 0.016, Neckline.SCOOP: 0.008}
_ROUNDING = 0.03
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
    center, radii = np.array([0, neck[1] + 0.012, neck[2] + 0.052]), np.array([0.090, 0.082, 0.086])

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


def smooth_neck(cloth: Mesh, neck: Field, body: Body, skin: Surface) -> None:
    """Draw the cloth near the neckline onto the skin, so that its rim does not stand off."""
    height = body.places["Neck"][1]
    p = cloth.positions
    near_rim = smoothstep(0.050, 0.012, np.abs(neck(p))) * (p[:, 1] > height - _REACH)
    around = Surface(body, body.is_skin & (body.positions[:, 1] > height - 0.25))
    above, normals = around.height_of(p)
    p = p - normals * (np.clip(above - 0.006, 0, 0.03) * near_rim * 0.85)[:, None]
    cloth.positions = skin.push(relax(p, cloth.triangles, 1, 0.4), 0.005)


def collar(cloth: Mesh, rim: Rim, normals: Array, design: TopDesign, skin: Surface) -> Mesh:
    """A rounded band that lies on the neck."""
    height = _COLLAR_HEIGHT[design.neckline]

    def fit(points: Array, ease: float) -> Array:
        return skin.push(points, ease, 0.01)

    rows: list[RimRow] = [
        lambda p, n, out: p + n * 0.0016 + out * 0.0004,
        lambda p, n, out: fit(p + n * 0.0024 + out * height * 0.35, 0.004),
        lambda p, n, out: fit(p + n * 0.0018 + out * height * 0.8, 0.004),
        lambda p, n, out: fit(p + n * 0.0004 + out * height, 0.0030),
        lambda p, n, out: p - n * 0.0012 + out * height * 0.92,
        lambda p, n, out: p - n * 0.0042 - out * 0.005,
    ]
    return band(cloth, rim, rows, normals, design.trim, 0.3)
