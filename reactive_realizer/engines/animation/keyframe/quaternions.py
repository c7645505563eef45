"""Arrays of unit quaternions w x y z, (..., 4): a whole capture is turned at once."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def product(a: Array, b: Array) -> Array:
    """The rotations b followed by a."""
    aw, ax, ay, az = np.moveaxis(a, -1, 0)
    bw, bx, by, bz = np.moveaxis(b, -1, 0)
    return np.stack(
        (
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ),
        axis=-1,
    )


def rotated(turns: Array, vectors: Array) -> Array:
    """Vectors, (..., 3), after turns."""
    pure = np.concatenate([np.zeros((*vectors.shape[:-1], 1)), vectors], axis=-1)
    out: Array = product(product(turns, pure), inverse(turns))[..., 1:]
    return out


def inverse(q: Array) -> Array:
    """The rotations back."""
    back: Array = q * (1.0, -1.0, -1.0, -1.0)
    return back


def about(axis: int, angles: Array) -> Array:
    """Turns about x (0), y (1) or z (2), rad."""
    out = np.zeros((*angles.shape, 4))
    out[..., 0] = np.cos(0.5 * angles)
    out[..., axis + 1] = np.sin(0.5 * angles)
    return out
