"""Weights that turn joints, beside those of morph targets: what a face does with jaw, eyes and head.

The name of such a weight is a joint, a sign and an axis of the joint, as in ``temporomandibular+x``. A weight of 1 is a
rotation by one radian. So turns are blended, faded and limited by the same code as morph targets.
"""

from collections import defaultdict
from collections.abc import Container, Mapping
from functools import lru_cache
from typing import Final

from reactive_realizer.embodiment.quaternion import Quat, from_rotation_vector
from reactive_realizer.embodiment.vector import Vec3

_AXES: Final = "xyz"


def turn_weights(joint: str, rotation: Vec3) -> dict[str, float]:
    """The weights that turn a joint by a rotation vector about its axes, rad, each component from -1 to 1."""
    parts = zip(_AXES, rotation, strict=True)
    return {f"{joint}{'+' if part > 0.0 else '-'}{axis}": abs(part) for axis, part in parts if part}


def weights_of_joint(joint: str) -> tuple[str, ...]:
    """The names of all weights that turn a joint."""
    return tuple(f"{joint}{sign}{axis}" for axis in _AXES for sign in "+-")


@lru_cache(1024)
def turned_joint(weight: str) -> str | None:
    """The joint that a weight turns; None for the weight of a morph target."""
    return weight[:-2] if weight[-2:-1] in ("+", "-") and weight[-1] in _AXES else None


def turns(weights: Mapping[str, float], joints: Container[str]) -> dict[str, Quat]:
    """The rotations of joints, about their own axes, by the weights that turn them.

    Args:
        weights: of a face, by name.
        joints: those that turn; others are left out.
    """
    vectors: defaultdict[str, list[float]] = defaultdict(lambda: [0.0, 0.0, 0.0])
    for name, weight in weights.items():
        if weight and (joint := turned_joint(name)) is not None and joint in joints:
            vectors[joint][_AXES.index(name[-1])] += weight if name[-2] == "+" else -weight
    return {joint: from_rotation_vector((x, y, z)) for joint, (x, y, z) in vectors.items()}
