"""Weights of morph targets, and sums of them."""

from collections.abc import Mapping, Sequence

Weights = Mapping[str, float]
"""Weights of morph targets, 0 to 1."""


def scaled(weights: Weights, factor: float) -> dict[str, float]:
    """Each weight times a factor."""
    return {morph: factor * weight for morph, weight in weights.items()}


def added(faces: Sequence[Weights]) -> dict[str, float]:
    """The sum of several weights; it may exceed 1."""
    total: dict[str, float] = {}
    for face in faces:
        for morph, weight in face.items():
            total[morph] = total.get(morph, 0.0) + weight
    return total


def limited(weights: Weights) -> dict[str, float]:
    """Weights that are at most 1."""
    return {morph: min(weight, 1.0) for morph, weight in weights.items()}
