"""Vectors of three floats as tuples. At this size they are faster than arrays, and immutable."""

import math

Vec3 = tuple[float, float, float]

ZERO: Vec3 = (0.0, 0.0, 0.0)
UP: Vec3 = (0.0, 1.0, 0.0)
FORWARD: Vec3 = (0.0, 0.0, 1.0)


def add(a: Vec3, b: Vec3) -> Vec3:
    """The sum."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a: Vec3, b: Vec3) -> Vec3:
    """The vector from b to a."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(v: Vec3, factor: float) -> Vec3:
    """The vector times a factor."""
    return (v[0] * factor, v[1] * factor, v[2] * factor)


def dot(a: Vec3, b: Vec3) -> float:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vec3, b: Vec3) -> Vec3:
    """Vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(v: Vec3) -> float:
    """Euclidean length."""
    return math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])


def distance(a: Vec3, b: Vec3) -> float:
    """Euclidean distance."""
    return length(subtract(a, b))


def unit(v: Vec3) -> Vec3:
    """The direction of v, which must not be (nearly) zero.

    Raises:
        ArithmeticError: v is zero, or too long to be normalized in floats.
    """
    factor = 1.0 / length(v)
    if not factor:
        raise OverflowError(v)
    return scale(v, factor)


def rejected(v: Vec3, axis: Vec3) -> Vec3:
    """The component of v perpendicular to a unit axis."""
    return subtract(v, scale(axis, dot(v, axis)))
