"""Layers of one kind laid over each other, before it is known over what."""

from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, multiply, power, slerp
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, scale, subtract
from reactive_realizer.engines.animation.motion_unit import Posed


class Stack:
    """Many layers made one.

    Where a layer of weight v lies over one of weight u, what is below them shows by (1 - u)(1 - v): so together they
    weigh w = u + v - uv, and the upper one makes v / w of that. Additive layers simply add up.
    """

    def __init__(self, kind: LayerKind) -> None:
        self._adds = kind is LayerKind.ADDITIVE
        self._rotations: dict[str, Quat] = {}
        self._weights: dict[str, float] = {}
        self._root: Vec3 | None = None

    def lay(self, layer: Layer, weight: float) -> None:
        """Put so much of another layer on top."""
        below = self._weights.get(ROOT, 0.0)
        for joint, turn in layer.rotations.items():
            self._turn(joint, turn, weight * layer.weight_of(joint))
        if layer.root is not None:
            self._move(layer.root, weight * layer.weight_of(ROOT), below)

    @property
    def posed(self) -> Posed:
        """What has come together."""
        return Posed(self._rotations, root=self._root, weights=None if self._adds else self._weights)

    def _turn(self, joint: str, turn: Quat, weight: float) -> None:
        if self._adds:
            self._rotations[joint] = multiply(self._rotations.get(joint, IDENTITY), power(turn, weight))
            return
        below = self._weights.get(joint, 0.0)
        self._weights[joint] = together = _together(below, weight)
        self._rotations[joint] = slerp(self._rotations[joint], turn, weight / together) if below > 0.0 else turn

    def _move(self, root: Vec3, weight: float, below: float) -> None:
        if self._adds:
            self._root = add(self._root or ZERO, scale(root, weight))
            return
        self._weights[ROOT] = together = _together(below, weight)
        under = self._root if self._root is not None and below > 0.0 else root
        self._root = add(under, scale(subtract(root, under), weight / together if together > 0.0 else 0.0))


def _together(below: float, above: float) -> float:
    return below + above - below * above
