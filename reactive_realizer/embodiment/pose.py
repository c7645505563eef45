"""Layers of motion become one pose, in one fixed order."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import IntEnum

from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, multiply, power, slerp
from reactive_realizer.embodiment.skeleton import Skeleton


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
    """

    kind: LayerKind
    rotations: Mapping[str, Quat]
    weight: float = 1.0
    priority: int = 0


@dataclass(frozen=True, slots=True)
class Composed:
    """A pose of all layers.

    Attributes:
        pose: with every layer.
        steady: without the additive ones. A motion that begins from "where the body is" begins here: nodding goes on
            while it plays and must not be counted twice.
    """

    pose: dict[str, Quat]
    steady: dict[str, Quat]


def compose(skeleton: Skeleton, layers: Iterable[Layer]) -> Composed:
    """One pose of all layers; joints that no layer turns are in the default pose, joints not in the skeleton are left.

    Replacing layers blend over the pose below by their weight along the shorter arc; additive ones turn about the
    joint's own axes as it stands by then, so that a head turned aside still nods about its own ears.
    """
    pose = dict.fromkeys(skeleton.joints, IDENTITY)
    steady = dict(pose)
    for layer in sorted(layers, key=lambda layer: (layer.kind, layer.priority)):
        if layer.kind is LayerKind.ADDITIVE:
            _turn_further(pose, layer)
        else:
            _replace(pose, layer)
            _replace(steady, layer)
    return Composed(pose, steady)


def _replace(pose: dict[str, Quat], layer: Layer) -> None:
    for joint, rotation in layer.rotations.items():
        if joint in pose:
            pose[joint] = rotation if layer.weight >= 1.0 else slerp(pose[joint], rotation, layer.weight)


def _turn_further(pose: dict[str, Quat], layer: Layer) -> None:
    for joint, rotation in layer.rotations.items():
        if joint in pose:
            pose[joint] = multiply(pose[joint], rotation if layer.weight >= 1.0 else power(rotation, layer.weight))
