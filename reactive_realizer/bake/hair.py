"""The hair: a dark shell on the scalp, and over it the strands of a hairdo."""

import numpy as np

from reactive_realizer.bake.bob import bob
from reactive_realizer.bake.body import Body
from reactive_realizer.bake.characters import HairStyle
from reactive_realizer.bake.crop import crop
from reactive_realizer.bake.hairline import scalp
from reactive_realizer.bake.head_map import HeadMap
from reactive_realizer.bake.mesh import Mesh, grid_triangles, merge
from reactive_realizer.bake.numeric import Array, direction, linear, smoothstep, unit
from reactive_realizer.bake.ribbon import face_outward
from reactive_realizer.bake.skull import Skull
from reactive_realizer.bake.strands import Strands
from reactive_realizer.bake.surgery import clip

_SEED = 21
_SHELL_HEIGHT = {HairStyle.BOB: 0.0035, HairStyle.CROP: 0.0030}
_HAIRDOS = {HairStyle.BOB: bob, HairStyle.CROP: crop}


def build_hair(body: Body, head: HeadMap) -> Mesh:
    """The hair of a character, with soft normals."""
    who = body.character
    weights = np.zeros(len(body.rig.names))
    weights[body.rig.index("Head")] = 1
    skull, color = Skull(body, head), linear(who.hair_color)
    strands = Strands(body, head, skull, np.random.default_rng(_SEED), color, weights)
    return merge([_shell(strands, who.hair), *_HAIRDOS[who.hair](strands)])


def _shell(strands: Strands, style: HairStyle) -> Mesh:
    """The shell that is visible between the strands; its rim sinks into the skin."""
    center, above_hairline = strands.skull.center, scalp(style, strands.skull.center)
    elevation, azimuth = np.meshgrid(np.linspace(-56, 89.9, 44), np.linspace(-180, 180, 81), indexing="ij")
    directions = direction(elevation, azimuth)
    positions = center + directions * (strands.skull.radius(directions) + _SHELL_HEIGHT[style])[..., None]
    triangles = grid_triangles(*elevation.shape, closed=False)
    shell = Mesh(
        positions.reshape(-1, 3),
        np.tile(strands.weights, (positions.size // 3, 1)),
        triangles,
        _shell_uvs(elevation, azimuth)[triangles],
        np.tile(strands.color * 0.55, (positions.size // 3, 1)),
    )
    shell = clip(shell, lambda p: above_hairline(p) - 1.0)
    shell.normals = unit(shell.positions - center)
    face_outward(shell)
    sunk = 0.0032 * smoothstep(6, 1, above_hairline(shell.positions))
    shell.positions = shell.positions - shell.normals * sunk[:, None]
    return shell


def _shell_uvs(elevation: Array, azimuth: Array) -> Array:
    u = (0.5 + 0.25 * np.sin(np.deg2rad(azimuth) * 14)) / 4
    return np.stack([u, np.clip(0.1 + (90 - elevation) / 400, 0, 0.5)], -1).reshape(-1, 2)
