"""What the textures of head and body have in common."""

from dataclasses import dataclass

import numpy as np

from reactive_realizer.bake.characters import Character
from reactive_realizer.bake.numeric import Array, Color, value_noise


@dataclass(frozen=True, slots=True)
class SkinTextures:
    """JPEG files: color; occlusion (red channel) and roughness (green); normals."""

    color: bytes
    surface: bytes
    normal: bytes


class Paint:
    """Colors (n, n, 3), 0..255, that are laid over each other."""

    def __init__(self, ground: Array) -> None:
        self.pixels = ground

    def lay(self, mask: Array, color: Color | Array, amount: float) -> None:
        """Cover the pixels with a color, by the mask and the amount."""
        cover = np.clip(mask * amount, 0, 1)[..., None]
        self.pixels = self.pixels * (1 - cover) + np.asarray(color, float) * cover


def mottled_skin(who: Character, points: Array) -> Array:
    """The tone of the skin with small variations at points (..., 3)."""
    skin = np.ones(points.shape) * who.skin
    coarse, middle, fine = (value_noise(points * frequency + 31.7) for frequency in (55, 170, 520))
    skin *= (1 + 0.020 * coarse + 0.018 * middle + 0.012 * fine)[..., None]
    skin[..., 0] *= 1 + 0.018 * middle
    skin[..., 1] *= 1 - 0.012 * coarse
    return skin
