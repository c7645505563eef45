"""Pictures that need no body: cloth, hair, lashes."""

import numpy as np
from scipy.ndimage import gaussian_filter

from reactive_realizer.bake.images import jpeg, normal_map, picture, png, shrunk
from reactive_realizer.bake.numeric import Array, smoothstep
from reactive_realizer.bake.ribbon import LOCKS, LONG_LOCKS

LASH_COLOR = [26, 19, 17]
LASHES = 80


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
    return jpeg(picture(normal_map(folds * 2.6 + creases * 0.22 + weave * 0.06, 0.5)), 84)


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
    alpha[:5] = np.maximum(alpha[:5], 0.80)
    alpha *= (smoothstep(0.02, 0.30, across) * smoothstep(0.98, 0.70, across))[None]
    pixels = np.zeros((height, width, 4))
    pixels[..., 3] = gaussian_filter(alpha, 0.5) * 255
    pixels[..., :3] = LASH_COLOR
    return png(picture(pixels))


def hair(size: int = 512) -> tuple[bytes, bytes]:
    """Color with alpha, and normals: locks side by side whose strands run down.

    The first locks are of long hair, the others of short hair, which ends over half of its length.
    """
    rng = np.random.default_rng(11)

    def streaks(width: float) -> Array:
        noise = gaussian_filter(rng.standard_normal(size), width, mode="wrap")
        return noise / noise.std()

    streak = 0.5 * streaks(1.0) + 0.6 * streaks(4.0) + 0.45 * streaks(12)
    fine = streaks(1.2)[None]
    down = np.linspace(0, 1, size)[:, None]
    light = np.clip(0.82 + 0.11 * streak[None], 0.45, 1.15) * (0.80 + 0.20 * smoothstep(0, 0.35, down))
    across = np.abs((np.arange(size) % (size // LOCKS) + 0.5) / (size // LOCKS) * 2 - 1)[None]
    length = 0.93 + 0.03 * fine.clip(-2, 2) + 0.02 * streaks(5)[None].clip(-2, 2) - 0.05 * across**2
    short = np.arange(size)[None] >= size * LONG_LOCKS / LOCKS
    tips = np.clip((length - down) / np.where(short, 0.50, 0.075) * (1 + 0.40 * fine), 0, 1)
    edges = np.clip((1 - across) / 0.20 * (1 + 0.45 * fine), 0, 1)
    pixels = np.zeros((size, size, 4))
    pixels[..., :3] = (light * 222)[..., None]
    pixels[..., 3] = 255 * tips * edges * (0.35 + 0.65 * smoothstep(0, 0.04, down))
    pixels[..., 3] *= across < 0.98
    relief = normal_map(np.repeat(streak[None], size, 0) * 1.15, 0.5)
    return png(picture(pixels)), png(shrunk(relief, size // 2))
