"""Pictures that need no head: skin of the body, cloth, hair, lashes, teeth."""

import numpy as np
from scipy.ndimage import gaussian_filter

from bake.body import Body
from bake.images import jpeg, normal_map, picture, png
from bake.numeric import Array, smoothstep, value_noise

TOOTH, GUM = np.array([236, 229, 214]), np.array([176, 96, 92])
LASH_COLOR = [26, 19, 17]
LASHES = 52


def body_color(body: Body, size: int = 512) -> bytes:
    """Arms, hands and neck in the original unwrap: base tone, mottling, nails."""
    skin = np.array(body.character.skin)
    color = np.ones((size, size, 3)) * skin
    y, x = np.mgrid[0:size, 0:size]
    points = np.stack([x, y, 0 * x], -1) / size
    color *= (1 + 0.020 * value_noise(points * 40) + 0.015 * value_noise(points * 110))[..., None]
    color[..., 0] *= 1 + 0.015 * value_noise(points * 60)
    nails = body.mask("fingernails", size)[..., None]
    color = color * (1 - 0.55 * nails) + skin * [1.06, 1.0, 1.0] * 0.55 * nails
    return jpeg(picture(color), 85)


def fabric_normal(size: int = 512) -> bytes:
    """Seamless cloth: soft folds, creases and a fine weave."""
    spectrum = np.fft.fft2(np.random.default_rng(3).standard_normal((size, size)))
    frequency = np.fft.fftfreq(size) * size
    kx, ky = np.meshgrid(frequency, frequency)

    def band(radius: Array, middle: float, width: float) -> Array:
        waves = np.fft.ifft2(spectrum * np.exp(-(((radius - middle) / width) ** 2))).real
        return waves / waves.std()

    folds, creases = band(np.hypot(kx / 1.0, ky / 1.6), 3.2, 2.2), band(np.hypot(kx, ky), 14, 7)
    y, x = np.mgrid[0:size, 0:size]
    weave = np.sin(x * 2 * np.pi / 4) * 0.5 + np.sin(y * 2 * np.pi / 4) * 0.5
    return jpeg(picture(normal_map(folds * 2.6 + creases * 0.22 + weave * 0.12, 0.5)), 84)


def lashes(width: int = 512, height: int = 64) -> bytes:
    """Single bent hairs from the lid (top row) outwards, with alpha."""
    rng = np.random.default_rng(5)
    alpha = np.zeros((height, width))
    along = np.arange(height) / (height - 1)
    for lash in range(LASHES):
        root = width * (0.03 + 0.94 * (lash + rng.random() * 0.7) / LASHES)
        length = 0.62 + 0.38 * rng.random()
        bend = (rng.random() - 0.5) * 14
        for row, t in enumerate(along[along <= length]):
            x = root + bend * t * t
            columns = np.arange(int(x - 4), int(x + 5))
            columns = columns[(columns >= 0) & (columns < width)]
            hair = np.clip(2.3 * (1 - t / length) + 0.5 - np.abs(columns - x), 0, 1) * 0.95
            alpha[row, columns] = np.maximum(alpha[row, columns], hair)
    across = np.arange(width) / width
    alpha[:5] = np.maximum(alpha[:5], 0.60)
    alpha *= (smoothstep(0, 0.10, across) * smoothstep(1, 0.90, across))[None]
    pixels = np.zeros((height, width, 4))
    pixels[..., 3] = gaussian_filter(alpha, 0.5) * 255
    pixels[..., :3] = LASH_COLOR
    return png(picture(pixels))


def hair(size: int = 256) -> tuple[bytes, bytes]:
    """Color with alpha, and normals: four locks side by side whose strands run down; ragged tips, thin side edges."""
    rng = np.random.default_rng(11)

    def streaks(width: float) -> Array:
        noise = gaussian_filter(rng.standard_normal(size), width, mode="wrap")
        return noise / noise.std()

    streak = 0.5 * streaks(0.7) + 0.6 * streaks(2.2) + 0.45 * streaks(6)
    down = np.linspace(0, 1, size)[:, None]
    light = np.clip(0.82 + 0.11 * streak[None], 0.45, 1.15) * (0.80 + 0.20 * smoothstep(0, 0.35, down))
    across = (np.arange(size) % (size // 4)) / (size // 4) * 2 - 1
    length = 0.955 + 0.022 * streaks(2.2).clip(-2.2, 1.8) - 0.10 * np.abs(across) ** 2
    tips = np.clip((length[None] - down) * size / 14, 0, 1)
    edges = gaussian_filter(rng.standard_normal(size), 1.5, mode="wrap")
    pixels = np.zeros((size, size, 4))
    pixels[..., :3] = (light * 222)[..., None]
    pixels[..., 3] = tips * np.clip(
        (1 - np.abs(across[None])) * (size / 4) / 3 + 0.2 * (edges / edges.std())[None], 0, 1
    )
    pixels[..., 3] *= 255
    return png(picture(pixels)), png(picture(normal_map(np.repeat(streak[None], size, 0) * 1.15, 0.5)))


def teeth(size: int = 256) -> bytes:
    """Upper half: the upper row with its gum at the top; lower half: the lower row with its gum at the bottom."""
    down = np.linspace(0, 1, size // 2)
    return jpeg(picture(np.vstack([_row_of_teeth(12, down, size), _row_of_teeth(14, down[::-1], size)])), 85)


def _row_of_teeth(count: int, from_gum: Array, size: int) -> Array:
    across = (np.arange(size) + 0.5) / size
    in_tooth = (across * count) % 1
    gap = np.exp(-((np.minimum(in_tooth, 1 - in_tooth) / 0.055) ** 2))
    gum_line = 0.34 + 0.10 * np.cos(in_tooth * 2 * np.pi)
    gum = smoothstep(gum_line[None] + 0.05, gum_line[None] - 0.05, from_gum[:, None])[..., None]
    tooth = TOOTH * (1 - 0.38 * gap[None, :, None]) * (1 - 0.10 * np.abs(across - 0.5)[None, :, None] * 4)
    return tooth * (1 - gum) + GUM * gum
