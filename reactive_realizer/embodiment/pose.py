"""Composes layers of motion into one pose, in a fixed order."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from functools import lru_cache
from operator import attrgetter
from typing import NamedTuple

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, multiply, power, slerp
from reactive_realizer.embodiment.vector import Vec3, add, length, scale, subtract
from reactive_realizer.errors import PlayingFault, RealizerError

# Tolerance of a squared quaternion length from 1: rounding errors of ten products stay far below.
_NEARLY_ZERO = 1e-6

FARTHEST = 10.0
"""Limit of the displacement of HumanoidRoot from its default position, m: more than the width of a scene."""


class LayerKind(IntEnum):
    """Kinds of layers, lowest first."""

    BASE = 0
    POSTURE = 1
    FULL_BODY = 2
    GAZE = 3
    GESTURE = 4
    ADDITIVE = 5
    END_EFFECTOR = 6


class BadPose(PlayingFault):
    """A layer with an invalid value."""

    code = "bad-pose"
    template = "its motion sets {what} to {value}, which is not a valid value"
    what: str
    value: float | tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Layer:
    """The rotations that one motion requests in a frame.

    Attributes:
        kind: position in the layer order. An ADDITIVE layer adds to the layers below; any other replaces them.
        rotations: joint -> rotation local to the parent.
        weight: 0 shows only the layers below, 1 only this layer.
        priority: within a kind, higher layers are above; equal ones keep the given order.
        root: displacement of HumanoidRoot from its position in the default pose, m; None leaves it.
        weights: joint -> factor of the weight, for joints that weigh less; HumanoidRoot's also applies to `root`.
    """

    kind: LayerKind
    rotations: Mapping[str, Quat]
    weight: float = 1.0
    priority: int = 0
    root: Vec3 | None = None
    weights: Mapping[str, float] | None = None
    # A layer is checked where it is made, and again with the output of its engine; the second time costs nothing.
    _checked: bool = field(init=False, repr=False, compare=False, default=False)

    @property
    def whole(self) -> bool:
        """Return whether every joint has the weight 1."""
        return self.weight >= 1.0 and self.weights is None

    def weight_of(self, joint: str) -> float:
        """Return the weight of one joint, 0 to 1."""
        return min(1.0, self.weight if self.weights is None else self.weight * self.weights.get(joint, 1.0))


class ComposedBody(NamedTuple):
    """A body under all layers.

    Attributes:
        shown: with every layer.
        steady: without additive layers. Motions start from this body: a nod continues while they play and must not be
            counted twice.
    """

    shown: Body
    steady: Body


def compose(skeleton: Skeleton, layers: Iterable[Layer]) -> ComposedBody:
    """Compose all layers into one body. Joints that no layer turns are in the default pose.

    Replacing layers are laid over the pose below (`over`). Additive layers then turn the result further
    (`turned_further`), so that a head that is turned aside nods about its own axis.
    """
    lower, added, upper = _sorted(layers)
    steady = over(_default(skeleton), *lower)
    shown = turned_further(steady, *added)
    return ComposedBody(over(shown, *upper), over(steady, *upper))


@lru_cache
def _default(skeleton: Skeleton) -> Body:
    """Return the body in the default pose, with a rotation for each joint."""
    return Body(skeleton, dict.fromkeys(skeleton.joints, IDENTITY))


def over(body: Body, *layers: Layer) -> Body:
    """Lay layers over a body by their weights, along the shorter arc, one after another.

    Joints that the body lacks are ignored.
    """
    if not layers:
        return body
    pose, root = dict(body.pose), body.root
    for layer in layers:
        if layer.whole:
            pose.update(layer.rotations)
        else:
            for joint, goal in layer.rotations.items():
                pose[joint] = slerp(pose.get(joint, IDENTITY), goal, layer.weight_of(joint))
        if layer.root is not None:
            root = add(root, scale(subtract(layer.root, root), layer.weight_of(ROOT)))
    return Body(body.skeleton, _known(pose, body), root)


def turned_further(body: Body, *layers: Layer) -> Body:
    """Add additive layers to a body by their weights, one after another: each joint turns about its own axes.

    Joints that the body lacks are ignored.
    """
    if not layers:
        return body
    pose, root = dict(body.pose), body.root
    for layer in layers:
        whole = layer.whole
        for joint, turn in layer.rotations.items():
            part = turn if whole else power(turn, layer.weight_of(joint))
            pose[joint] = multiply(pose.get(joint, IDENTITY), part)
        if layer.root is not None:
            root = add(root, scale(layer.root, layer.weight_of(ROOT)))
    return Body(body.skeleton, _known(pose, body), root)


def _known(pose: dict[str, Quat], body: Body) -> dict[str, Quat]:
    """Return a pose that layers were added to, without the joints that the body lacks."""
    if len(pose) == len(body.pose):  # the usual case: it had all joints
        return pose
    return {joint: turn for joint, turn in pose.items() if joint in body.skeleton}


def _sorted(layers: Iterable[Layer]) -> tuple[list[Layer], list[Layer], list[Layer]]:
    """Sort layers from lowest to highest: those below the additive layers, the additive ones, those above."""
    lower: list[Layer] = []
    added: list[Layer] = []
    upper: list[Layer] = []
    additive = LayerKind.ADDITIVE
    for layer in sorted(layers, key=attrgetter("kind", "priority")):
        (added if layer.kind is additive else lower if layer.kind < additive else upper).append(layer)
    return lower, added, upper


def checked(layer: Layer) -> Layer:
    """Return the layer if it can be composed.

    Raises:
        RealizerError: "bad-pose": a rotation is not a unit quaternion, a weight is not finite, or the root is further
            away than `FARTHEST`.
    """
    if layer._checked:
        return layer
    check_rotations(layer.rotations)
    for weight in (layer.weight, *(layer.weights or {}).values()):
        if not math.isfinite(weight):
            raise RealizerError(BadPose(what="its weight", value=weight))
    if layer.root is not None and not length(layer.root) <= FARTHEST:
        raise RealizerError(BadPose(what="HumanoidRoot's place", value=layer.root))
    object.__setattr__(layer, "_checked", True)
    return layer


def check_layers(layers: Iterable[Layer]) -> None:
    """Check that layers of any origin can be composed.

    Raises:
        RealizerError: "bad-pose", as `checked`.
        TypeError, ValueError: something is not a layer, or has no rotations.
    """
    for layer in layers:
        if not (isinstance(layer, Layer) and isinstance(layer.kind, LayerKind) and isinstance(layer.priority, int)):
            raise TypeError(f"{layer!r} is not a layer")
        checked(layer)


def check_rotations(rotations: Mapping[str, Quat]) -> None:
    """Check that all rotations are unit quaternions.

    Raises:
        RealizerError: "bad-pose": one is not.
        TypeError, ValueError: one does not have four numbers.
    """
    for joint, (w, x, y, z) in rotations.items():
        if not -_NEARLY_ZERO < w * w + x * x + y * y + z * z - 1.0 < _NEARLY_ZERO:
            raise RealizerError(BadPose(what=joint, value=(w, x, y, z)))
