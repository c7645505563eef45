"""Rotations of several joints as arrays of unit quaternions w x y z."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_NOTHING = 1e-12
"""A length below which a vector has no direction."""


def lengths(vectors: Array) -> Array:
    """Return the lengths of vectors, (N, 1)."""
    squares: Array = np.einsum("ij,ij->i", vectors, vectors)
    return np.sqrt(squares)[:, np.newaxis]


def rotation_vectors(rotations: Array) -> Array:
    """Return the rotation vectors of rotations, the short way round, rad, (N, 3)."""
    cosines, axes = rotations[:, :1], rotations[:, 1:]
    sines = np.maximum(lengths(axes), _NOTHING)
    factors: Array = np.copysign(2.0 * np.arctan2(sines, np.abs(cosines)) / sines, cosines)
    return factors * axes


def swing_and_twist(rotations: Array) -> tuple[Array, Array]:
    """Return the rotation vectors of the two parts of rotations, rad, (N, 3) each.

    A rotation is a twist about y, followed by a swing, the short way round, about an axis in the x-z plane.
    """
    w, x, y, z = rotations.T
    cosines = np.maximum(np.hypot(w, y), _NOTHING)
    c, s = w / cosines, y / cosines
    none = np.zeros_like(w)
    swings = rotation_vectors(np.stack((cosines, x * c + z * s, none, z * c - x * s), axis=1))
    twists = np.stack((none, 2.0 * np.arctan2(np.copysign(1.0, c) * s, np.abs(c)), none), axis=1)
    return swings, twists


def turned_about_y(vectors: Array, angles: Array) -> Array:
    """Return vectors turned about y by angles, rad, (N, 3)."""
    c, s = np.cos(angles), np.sin(angles)
    x, y, z = vectors.T
    return np.stack((x * c + z * s, y, z * c - x * s), axis=1)


def long_way(vectors: Array) -> Array:
    """Return the rotation vectors of the same rotations the long way round, rad, (N, 3)."""
    turned: Array = vectors * (1.0 - 2.0 * np.pi / np.maximum(lengths(vectors), _NOTHING))
    return turned


def turns(before: Array, after: Array) -> Array:
    """Return the rotation vectors that lead from rotations to others, in the axes of the former, rad, (N, 3)."""
    w, v = before[:, :1], before[:, 1:]
    other, axes = after[:, :1], after[:, 1:]
    x, y, z = v.T
    a, b, c = axes.T
    crossed = np.stack((y * c - z * b, z * a - x * c, x * b - y * a), axis=1)
    cosines = w * other + np.einsum("ij,ij->i", v, axes)[:, np.newaxis]
    return rotation_vectors(np.concatenate((cosines, w * axes - other * v - crossed), axis=1))
