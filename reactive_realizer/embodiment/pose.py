"""Layers of motion become one pose, in one fixed order."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import IntEnum

from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, multiply, power, slerp
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, scale, subtract


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
    """

    kind: LayerKind
    rotations: Mapping[str, Quat]
    weight: float = 1.0
    priority: int = 0
    root: Vec3 | None = None


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
    pose = dict.fromkeys(skeleton.joints, IDENTITY)
    steady = dict(pose)
    root = steady_root = ZERO
    for layer in sorted(layers, key=lambda layer: (layer.kind, layer.priority)):
        if layer.kind is LayerKind.ADDITIVE:
            _turn_further(pose, layer)
            root = root if layer.root is None else add(root, scale(layer.root, layer.weight))
        else:
            _replace(pose, layer)
            _replace(steady, layer)
            root, steady_root = _moved(root, layer), _moved(steady_root, layer)
    return Composed(pose, steady, root, steady_root)


def _moved(root: Vec3, layer: Layer) -> Vec3:
    return root if layer.root is None else add(root, scale(subtract(layer.root, root), min(1.0, layer.weight)))


def _replace(pose: dict[str, Quat], layer: Layer) -> None:
    for joint, rotation in layer.rotations.items():
        if joint in pose:
            pose[joint] = rotation if layer.weight >= 1.0 else slerp(pose[joint], rotation, layer.weight)


def _turn_further(pose: dict[str, Quat], layer: Layer) -> None:
    for joint, rotation in layer.rotations.items():
        if joint in pose:
            pose[joint] = multiply(pose[joint], rotation if layer.weight >= 1.0 else power(rotation, layer.weight))
