"""Short hair: many small strands that follow a flow field away from the crown, raised at the front."""

from collections.abc import Iterator

import numpy as np

from reactive_realizer.bake.hairline import scalp
from reactive_realizer.bake.mesh import Mesh
from reactive_realizer.bake.numeric import Array, fibonacci_sphere, smoothstep, unit
from reactive_realizer.bake.strands import Strands

_ROOTS = 2200
_POINTS = 5
_CROWN = unit(np.array([0, 0.82, -0.57]))


def crop(strands: Strands) -> Iterator[Mesh]:
    """All strands."""
    center = strands.skull.center
    directions = fibonacci_sphere(_ROOTS)
    above_hairline = scalp(strands.body.character.hair, center)(center + directions * 0.1)
    for root, height in zip(directions, above_hairline, strict=True):
        if height > 1.5:
            yield _strand(strands, root, 0.55 + 0.45 * smoothstep(1.5, 12, height))


def _strand(strands: Strands, root: Array, share: Array) -> Mesh:
    """A strand from a root on the scalp; the share of its full length and width is less near the hairline."""
    elevation, azimuth = np.degrees(np.arcsin(root[1])), np.degrees(np.arctan2(root[0], root[2]))
    top = smoothstep(22, 48, elevation)
    front = top * smoothstep(75, 20, abs(azimuth)) * smoothstep(62, 30, elevation)
    length = (0.013 + 0.034 * top + 0.010 * front) * share * strands.varied(0.85, 0.3)
    flow = _flow(root, azimuth, top, front) + strands.rng.normal(0, 0.16, 3)
    lift = 0.0008 + 0.0085 * top + 0.010 * front
    path = _grow(strands, root, flow, front, length, lift)
    s = np.linspace(0, 1, _POINTS)
    width = (0.0042 + 0.0022 * top) * (0.7 + 0.5 * np.sin(s * np.pi * 0.8)) * (1 - 0.80 * smoothstep(0.6, 1, s))
    width = width * share * strands.varied(0.85, 0.3)
    shade = strands.varied(0.72, 0.45) * (0.62 + 0.45 * s)
    return strands.strand(path, unit(path - strands.skull.center), width, 3, 0.22, shade)


def _flow(root: Array, azimuth: float, top: Array, front: Array) -> Array:
    """The direction of lying hair: down at the sides, away from the crown on top, up and aside at the front."""
    back = smoothstep(95, 150, abs(azimuth))
    away = unit(root - _CROWN * (root @ _CROWN) + 1e-6)
    sides = (1 - top) * np.array([0, -1.0, -0.45 * (1 - back)])
    return sides + top * (away * 0.8 + np.array([-0.55, 0, 0.25])) + front * np.array([-0.75, 1.3, 0.10])


def _grow(strands: Strands, root: Array, flow: Array, front: Array, length: Array, lift: Array) -> Array:
    """A path (points, 3) of a length (m) from the root along the scalp, rising to lift (m) above it."""
    skull, center = strands.skull, strands.skull.center
    points = [center + root * (skull.radius(root) + 0.0015)]
    for k in range(1, _POINTS):
        outward = unit(points[-1] - center)
        pull = flow - 0.35 * front * k / _POINTS * np.array([0.5, 1.4, 0.3])
        tangent = unit(pull - outward * (pull @ outward))
        outward = unit(points[-1] + tangent * length / (_POINTS - 1) - center)
        rise = lift * np.sin(min(1, k / (_POINTS - 1) * 1.15) * np.pi / 2)
        points.append(center + outward * (skull.radius(outward) + 0.0015 + rise))
    return np.array(points)
