"""Foot planting: feet stay in place while the pelvis moves."""

import math
from collections.abc import Iterable, Iterator, Sequence
from functools import reduce
from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton, Transform
from reactive_realizer.embodiment.feet import LEG_JOINTS, feet, legs, reach, walks
from reactive_realizer.embodiment.joints import ROOT, SIDES
from reactive_realizer.embodiment.pose import Layer, LayerKind, checked, compose, over, turned_further
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import subtract
from reactive_realizer.engines.animation.posture.stepping import Foot, FootAlternation, leading, lift, stepped

_MOVING = LEG_JOINTS | {ROOT}

_DEEPEST = 0.25
"""Limit by which the pelvis is lowered for feet that it has left behind, m; beyond it they are dragged along."""

_NOTHING = 1e-6
"""m"""

_SOFTNESS = 0.1
"""Softness with which the pelvis keeps the height at which a leg is straight, per meter of foot lift.

Near there the bend of a knee is the root of what the leg lacks in length, so it would lock and unlock abruptly when the
foot comes down and when it leaves. So a figure that is about to step bends both knees a little. This is our choice.
"""

_CAUTIOUS = 0.007
"""The softness while a foot is delayed, m: as in the middle of a long step, because the waiting leg may be straight."""


class _LegState(NamedTuple):
    """Pelvis and legs under some layers.

    Attributes:
        body: as the layers pose it.
        feet: goals of the feet, left first.
        ground: feet in the topmost layer with full weight.
        softness: with which the pelvis keeps the length of the legs, m; 0 if no foot steps.
    """

    body: Body
    feet: tuple[Foot, ...]
    ground: tuple[Transform, ...]
    softness: float


class FootPlanting:
    """Determines the legs, after all other layers.

    Blending two postures joint by joint would make the feet slide: if the pelvis is lowered halfway, half-bent knees do
    not reach the ground. So each layer gives goals for the *feet*, by its own legs and root. Between these goals the
    feet step, never both at once (`FootAlternation`). Hips, knees and ankles follow from the feet and from the pelvis,
    which is lowered where a leg would be too short, or straight in a step. Additive motion of pelvis and legs does not
    move the feet: they stay in place in weight shifts and knee noise.
    """

    def __init__(self, skeleton: Skeleton) -> None:
        """Create foot planting for a skeleton. Legs without a length are left alone."""
        self._start = Body(skeleton)
        self._legs = walks(skeleton)
        self._alternation = FootAlternation()
        self._leg_parts: object = None
        self._lower: tuple[list[object], _LegState] | None = None
        self._layers: tuple[Layer, ...] = ()

    def layers(self, layers: Iterable[Layer], now: GlobalTime, walking: Sequence[Transform] = ()) -> tuple[Layer, ...]:
        """Return further layers for the legs in a frame; none if other layers already place the feet.

        Args:
            layers: of the frame.
            now: s.
            walking: goals of the ankles of a figure that walks, left first; they take precedence over those of layers.
        """
        concerned = [layer for layer in layers if layer.root is not None or not _MOVING.isdisjoint(layer.rotations)]
        parts = [_leg_part(layer) for layer in concerned]
        # The pelvis usually rests; then the layers of the last frame are still valid.
        if walking:
            lower, added = _in_order(concerned)
            body = turned_further(over(self._start, *map(_legs_of, lower)), *map(_legs_of, added))
            self._leg_parts, self._layers = None, (checked(Layer(LayerKind.END_EFFECTOR, legs(body, walking))),)
        elif self._legs and not (parts == self._leg_parts and self._alternation.settled):
            self._leg_parts, self._layers = parts, tuple(map(checked, self._planted(concerned, now)))
        return self._layers

    def _planted(self, layers: Iterable[Layer], now: GlobalTime) -> Iterator[Layer]:
        lower, added = _in_order(layers)
        below, wanted, _, softness = self._below(lower)
        places = self._alternation(wanted, now)
        if not added and self._alternation.settled and all(layer.weight_of(ROOT) == 1.0 for layer in lower):
            return
        softness = max(softness, _CAUTIOUS * self._alternation.caution)
        body = turned_further(below, *map(_legs_of, added))
        lacking = [_lacking(body, side, foot) for side, foot in zip(SIDES, places, strict=True)]
        sinking = min(_DEEPEST, _highest((0.0, *lacking), softness))
        if sinking > _NOTHING:
            lowered = Layer(LayerKind.ADDITIVE, {}, root=(0.0, -sinking, 0.0))
            body = turned_further(body, lowered)
            yield lowered
        yield Layer(LayerKind.END_EFFECTOR, legs(body, places))

    def _below(self, lower: Sequence[Layer]) -> _LegState:
        """Return pelvis and legs under the layers that are not additive: they often rest while additive ones move."""
        parts = [_leg_part(layer) for layer in lower]
        if self._lower is None or self._lower[0] != parts:
            self._lower = parts, reduce(_over, lower, _stand(self._start))
        return self._lower[1]


def planted(body: Body, layer: Layer) -> Body:
    """Return a body under a layer, with its feet as they step from where they stand to where the layer has them."""
    layers = (Layer(LayerKind.BASE, body.pose, root=body.root), layer)
    return compose(body.skeleton, (*layers, *FootPlanting(body.skeleton).layers(layers, GlobalTime(0.0)))).shown


def _in_order(layers: Iterable[Layer]) -> tuple[list[Layer], list[Layer]]:
    """Return the layers that are not additive, and those that are, the lowest first."""
    ordered = sorted(layers, key=lambda layer: (layer.kind, layer.priority))
    return (
        [layer for layer in ordered if layer.kind is not LayerKind.ADDITIVE],
        [layer for layer in ordered if layer.kind is LayerKind.ADDITIVE],
    )


def _stand(body: Body) -> _LegState:
    places = feet(body)
    return _LegState(body, tuple(map(Foot, places)), places, 0.0)


def _leg_part(layer: Layer) -> object:
    """Return the part of a layer that affects the legs."""
    rotations = _moving(layer) if layer.kind is LayerKind.ADDITIVE else layer.rotations
    return rotations, layer.weight, layer.weights, layer.root


def _moving(layer: Layer) -> dict[str, Quat]:
    return {joint: layer.rotations[joint] for joint in _MOVING & layer.rotations.keys()}


def _over(below: _LegState, layer: Layer) -> _LegState:
    part = _legs_of(layer)
    goal = below.body.posed(part.rotations, layer.root)
    weight = layer.weight_of(ROOT)
    if weight == 1.0:
        return _stand(goal)
    places = feet(goal)
    return below._replace(
        body=over(below.body, part),
        feet=stepped(below.feet, places, weight, leading(below.ground, places)),
        softness=(1.0 - weight)
        * (below.softness + 4.0 * weight * _SOFTNESS * lift([foot.place for foot in below.feet], places)),
    )


def _legs_of(layer: Layer) -> Layer:
    """Return the part of a layer for pelvis and legs."""
    # Without `replace`, which takes longer: some are made in each frame in which a pelvis moves.
    return Layer(layer.kind, _moving(layer), layer.weight, layer.priority, layer.root, layer.weights)


def _lacking(body: Body, side: str, foot: Transform) -> float:
    """Return how much lower the pelvis must be for a leg to reach its foot, m; negative if the leg reaches it."""
    x, y, z = subtract(body.transform(f"{side}_hip").position, foot.position)
    return y - math.sqrt(max(0.0, reach(body.skeleton, side) ** 2 - x * x - z * z))


def _highest(values: Sequence[float], softness: float) -> float:
    """Return a smooth maximum: the highest value, and a little more where others come near to it."""
    highest = max(values)
    if softness < _NOTHING:
        return highest
    return highest + softness * math.log(sum(math.exp((value - highest) / softness) for value in values))
