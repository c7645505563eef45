"""Layers of motion become one pose, in one fixed order."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import IntEnum
from operator import attrgetter

from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, multiply, power, slerp
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, scale, subtract
from reactive_realizer.errors import error

_ROOT = "HumanoidRoot"
# Of the square of a quaternion's length from 1: rounding stays far below, and a product of ten stays a rotation.
_NEARLY_ZERO = 1e-6


class LayerKind(IntEnum):
    """Kinds of layers, the lowest first; eyes come last because they look from the composed head."""

    BASE = 0
    POSTURE = 1
    FULL_BODY = 2
    GAZE = 3
    GESTURE = 4
    ADDITIVE = 5
    END_EFFECTOR = 6
    PHYSICS = 7
    EYES = 8


@dataclass(frozen=True, slots=True)
class Layer:
    """Rotations that one motion asks for in this frame.

    Attributes:
        kind: where it lies among the layers; an ADDITIVE one turns what is below it further, any other replaces it.
        rotations: joint -> rotation local to the parent.
        weight: 0 leaves what is below as it is, 1 is the layer in full.
        priority: among layers of one kind, the higher lies above; equal ones lie in the order given.
        root: how far HumanoidRoot is moved from its place in the default pose, m; None leaves it where it is.
        weights: of joints that weigh less than the layer, the share of its weight; HumanoidRoot's is the root's too.
    """

    kind: LayerKind
    rotations: Mapping[str, Quat]
    weight: float = 1.0
    priority: int = 0
    root: Vec3 | None = None
    weights: Mapping[str, float] | None = None

    def weight_of(self, joint: str) -> float:
        """How much of one joint's rotation is shown, 0 to 1."""
        return min(1.0, self.weight if self.weights is None else self.weight * self.weights.get(joint, 1.0))


@dataclass(frozen=True, slots=True)
class Composed:
    """A pose of all layers.

    Attributes:
        pose: with every layer.
        steady: without the additive ones. A motion that begins from "where the body is" begins here: nodding goes on
            while it plays and must not be counted twice.
        root: how far HumanoidRoot is moved from its place in the default pose, with every layer, m.
        steady_root: the same without the additive ones.
    """

    pose: dict[str, Quat]
    steady: dict[str, Quat]
    root: Vec3 = ZERO
    steady_root: Vec3 = ZERO


def compose(skeleton: Skeleton, layers: Iterable[Layer]) -> Composed:
    """One pose of all layers; joints that no layer turns are in the default pose, joints not in the skeleton are left.

    Replacing layers blend over the pose below by their weight along the shorter arc; additive ones turn about the
    joint's own axes as it stands by then, so that a head turned aside still nods about its own ears.
    """
    lower, added, upper = _sorted(layers)
    steady = dict.fromkeys(skeleton.joints, IDENTITY)
    steady_root = ZERO
    for layer in lower:
        _replace(steady, layer)
        steady_root = _moved(steady_root, layer)
    pose, root = dict(steady), steady_root
    for layer in added:
        _turn_further(pose, layer)
        root = root if layer.root is None else add(root, scale(layer.root, layer.weight_of(_ROOT)))
    for layer in upper:
        _replace(pose, layer)
        _replace(steady, layer)
        root, steady_root = _moved(root, layer), _moved(steady_root, layer)
    return Composed(pose, steady, root, steady_root)


def _sorted(layers: Iterable[Layer]) -> tuple[list[Layer], list[Layer], list[Layer]]:
    """Layers from the lowest to the highest: those below the additive ones, these, those above."""
    ordered = sorted(layers, key=attrgetter("kind", "priority"))
    return (
        [layer for layer in ordered if layer.kind < LayerKind.ADDITIVE],
        [layer for layer in ordered if layer.kind is LayerKind.ADDITIVE],
        [layer for layer in ordered if layer.kind > LayerKind.ADDITIVE],
    )


def checked(layer: Layer) -> Layer:
    """A layer that can be composed.

    Raises:
        RealizerError: "bad-pose": a rotation is no unit quaternion, or weight or root are no finite numbers.
    """
    for joint, (w, x, y, z) in layer.rotations.items():
        if not abs(w * w + x * x + y * y + z * z - 1.0) < _NEARLY_ZERO:
            raise error("bad-pose", what=joint, value=(w, x, y, z))
    for weight in (layer.weight, *(layer.weights or {}).values()):
        if not math.isfinite(weight):
            raise error("bad-pose", what="its weight", value=weight)
    if layer.root is not None and not all(map(math.isfinite, layer.root)):
        raise error("bad-pose", what="HumanoidRoot's place", value=layer.root)
    return layer


def _moved(root: Vec3, layer: Layer) -> Vec3:
    return root if layer.root is None else add(root, scale(subtract(layer.root, root), layer.weight_of(_ROOT)))


def _replace(pose: dict[str, Quat], layer: Layer) -> None:
    rotations, weights = layer.rotations, layer.weights
    if layer.weight >= 1.0 and weights is None:
        pose |= rotations if rotations.keys() <= pose.keys() else {j: q for j, q in rotations.items() if j in pose}
        return
    for joint, rotation in rotations.items():
        if joint in pose:
            weight = layer.weight if weights is None else layer.weight_of(joint)
            pose[joint] = slerp(pose[joint], rotation, weight)


def _turn_further(pose: dict[str, Quat], layer: Layer) -> None:
    for joint, rotation in layer.rotations.items():
        if joint in pose:
            weight = layer.weight_of(joint)
            pose[joint] = multiply(pose[joint], rotation if weight == 1.0 else power(rotation, weight))
