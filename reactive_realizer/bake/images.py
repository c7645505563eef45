"""Pictures: from arrays to the bytes of the file."""

import io

import numpy as np
from PIL import Image

from reactive_realizer.bake.numeric import Array, unit


def picture(pixels: Array) -> Image.Image:
    """A picture of pixels (h, w, 3 or 4), 0..255."""
    return Image.fromarray(np.clip(pixels, 0, 255).astype("u1"))


def shrunk(pixels: Array, size: int) -> Image.Image:
    """A square picture of another size."""
    return picture(pixels).resize((size, size), Image.Resampling.LANCZOS)


def jpeg(image: Image.Image, quality: int, *, subsampling: int = 2) -> bytes:
    """As JPEG, by default with halved chroma."""
    buffer = io.BytesIO()
    image.save(buffer, "JPEG", quality=quality, subsampling=subsampling)
    return buffer.getvalue()


def orm(exposure: Array, roughness: Array, size: int) -> bytes:
    """Occlusion, roughness and no metal in the channels in which glTF looks for them, from pictures (n, n), 0..1."""
    pixels = np.stack([exposure, roughness, 0 * roughness], -1) * 255
    return jpeg(shrunk(pixels, size), 80, subsampling=0)


def png(image: Image.Image) -> bytes:
    """As PNG, for what has an alpha channel or must not blur."""
    buffer = io.BytesIO()
    image.save(buffer, "PNG", optimize=True)
    return buffer.getvalue()


def normal_map(height: Array, scale: float) -> Array:
    """Tangent-space normals (h, w, 3), 0..255 (OpenGL convention), of a height field that wraps around."""
    dx = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) * scale
    dy = (np.roll(height, -1, 0) - np.roll(height, 1, 0)) * scale
    return unit(np.stack([-dx, dy, np.ones_like(height)], -1)) * 127.5 + 127.5
