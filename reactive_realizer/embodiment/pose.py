"""Layers of motion become one pose, in one fixed order."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import IntEnum
from functools import reduce
from operator import attrgetter
from typing import NamedTuple

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, multiply, power, slerp
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import Vec3, add, length, scale, subtract
from reactive_realizer.errors import error

# Of the square of a quaternion's length from 1: rounding stays far below, and a product of ten stays a rotation.
_NEARLY_ZERO = 1e-6

FARTHEST = 10.0
"""m that a motion may move HumanoidRoot from its default place: more than a stage is wide."""


class LayerKind(IntEnum):
    """Kinds of layers, the lowest first."""

    BASE = 0
    POSTURE = 1
    FULL_BODY = 2
    GAZE = 3
    GESTURE = 4
    ADDITIVE = 5
    END_EFFECTOR = 6


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


class Composed(NamedTuple):
    """A body under all layers.

    Attributes:
        shown: with every layer.
        steady: without the additive ones. A motion that begins from "where the body is" begins here: nodding goes on
            while it plays and must not be counted twice.
    """

    shown: Body
    steady: Body


def compose(skeleton: Skeleton, layers: Iterable[Layer]) -> Composed:
    """One pose of all layers; joints that no layer turns are in the default pose.

    Replacing layers lie over the pose below (`over`); additive ones turn what has come together by then further
    (`turned_further`), so that a head turned aside still nods about its own ears.
    """
    lower, added, upper = _sorted(layers)
    steady = reduce(over, lower, Body(skeleton, dict.fromkeys(skeleton.joints, IDENTITY)))
    shown = reduce(turned_further, added, steady)
    return Composed(reduce(over, upper, shown), reduce(over, upper, steady))


def over(body: Body, layer: Layer) -> Body:
    """A body with a layer laid over it, by its weight along the shorter arc; joints that it has not are left out."""
    rotations = _known(layer.rotations, body)
    if layer.weight < 1.0 or layer.weights is not None:
        rotations = {
            joint: slerp(body.rotation(joint), goal, layer.weight_of(joint)) for joint, goal in rotations.items()
        }
    if layer.root is None:
        return body.posed(rotations)
    return body.posed(rotations, add(body.root, scale(subtract(layer.root, body.root), layer.weight_of(ROOT))))


def turned_further(body: Body, layer: Layer) -> Body:
    """A body with an additive layer, by its weight: each joint turns about its own axes as it stands.

    Joints that the body has not are left out.
    """
    rotations = {
        joint: multiply(body.rotation(joint), _weighed(turn, layer.weight_of(joint)))
        for joint, turn in _known(layer.rotations, body).items()
    }
    root = body.root if layer.root is None else add(body.root, scale(layer.root, layer.weight_of(ROOT)))
    return body.posed(rotations, root)


def _weighed(turn: Quat, weight: float) -> Quat:
    return turn if weight == 1.0 else power(turn, weight)


def _known(rotations: Mapping[str, Quat], body: Body) -> Mapping[str, Quat]:
    # Nearly always the pose has all of them.
    if rotations.keys() <= body.pose.keys():
        return rotations
    return {joint: turn for joint, turn in rotations.items() if joint in body.skeleton}


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
        RealizerError: "bad-pose": a rotation is no unit quaternion, a weight is no finite number, or the root is
            further away than `FARTHEST`.
    """
    for joint, (w, x, y, z) in layer.rotations.items():
        if not abs(w * w + x * x + y * y + z * z - 1.0) < _NEARLY_ZERO:
            raise error("bad-pose", what=joint, value=(w, x, y, z))
    for weight in (layer.weight, *(layer.weights or {}).values()):
        if not math.isfinite(weight):
            raise error("bad-pose", what="its weight", value=weight)
    if layer.root is not None and not length(layer.root) <= FARTHEST:
        raise error("bad-pose", what="HumanoidRoot's place", value=layer.root)
    return layer
