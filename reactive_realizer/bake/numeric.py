"""Numbers: the small functions that every other module uses."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[np.float64]
Indices: TypeAlias = NDArray[np.int64]
Mask: TypeAlias = NDArray[np.bool_]
Field: TypeAlias = Callable[[Array], Array]
"""A function of points (..., 3); where it is a surface, that is its zero and inside is positive."""

Color: TypeAlias = tuple[int, int, int]
"""sRGB, 0..255."""


def unit(vectors: Array) -> Array:
    """Vectors (..., n) scaled to length 1; zero stays zero."""
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12)


def smoothstep(start: float, stop: float, x: Array | float) -> Array:
    """0 at start, 1 at stop, level at both; start may lie above stop."""
    t = np.clip((x - start) / (stop - start), 0, 1)
    return t * t * (3 - 2 * t)


def gaussian(x: Array, middle: float, width: float) -> Array:
    """A bump of height 1."""
    return np.exp(-(((x - middle) / width) ** 2))


def linear(rgb: Color | Array) -> Array:
    """An sRGB color, 0..255, in linear light 0..1: vertex colors and factors of glTF are linear, textures are not."""
    return (np.asarray(rgb, float) / 255) ** 2.2


def direction(elevation: Array | float, azimuth: Array | float) -> Array:
    """Unit vectors (..., 3) from angles in degrees; azimuth 0 is the front, 90 the figure's left."""
    e, a = np.deg2rad(elevation), np.deg2rad(azimuth)
    return np.stack([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)], -1)


def fibonacci_sphere(count: int) -> Array:
    """Directions (count, 3) spread evenly."""
    i = np.arange(count) + 0.5
    polar, turn = np.arccos(1 - 2 * i / count), np.pi * (1 + 5**0.5) * i
    return np.stack([np.sin(polar) * np.cos(turn), np.cos(polar), np.sin(polar) * np.sin(turn)], 1)


def inverse_distance_weights(distances: Array, softening: float) -> Array:
    """Weights (n, k) that sum to 1 a row, for the k nearest neighbors at these distances."""
    weights = 1 / (distances + softening) ** 2
    return weights / weights.sum(1, keepdims=True)


def blend_neighbors(values: Array, neighbors: Indices, weights: Array) -> Array:
    """The weighted mean (n, d) of the neighbors' values."""
    return (values[neighbors] * weights[..., None]).sum(1)


def value_noise(points: Array) -> Array:
    """Smooth pseudo-random field of points (..., 3), -1..1, on a grid of 1; it has no state."""
    points = np.nan_to_num(points)
    cell = np.floor(points).astype(np.int64)
    f = points - cell
    f = f * f * (3 - 2 * f)
    shares = [(1 - f[..., axis], f[..., axis]) for axis in range(3)]
    total = np.zeros(points.shape[:-1])
    for corner in range(8):
        x, y, z = corner & 1, corner >> 1 & 1, corner >> 2
        total = total + _hash(cell + np.array([x, y, z])) * (shares[0][x] * shares[1][y] * shares[2][z])
    return total * 2 - 1


def _hash(cells: Indices) -> Array:
    x = cells[..., 0] * 374761393 + cells[..., 1] * 668265263 + cells[..., 2] * 2147483647
    x = (x ^ (x >> 13)) * 1274126177
    return ((x ^ (x >> 16)) & 0xFFFF) / 65535.0
