"""Feet that stay where they stand while the pelvis moves."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import reduce
from typing import NamedTuple

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import ROOT, SIDES
from reactive_realizer.embodiment.pose import Layer, LayerKind, checked, over, turned_further
from reactive_realizer.embodiment.quaternion import Quat, between, conjugate, multiply, rotate, slerp
from reactive_realizer.embodiment.skeleton import Place, Skeleton
from reactive_realizer.embodiment.two_bone_ik import Leg
from reactive_realizer.embodiment.vector import UP, add, distance, length, scale, subtract, unit
from reactive_realizer.engines.animation.easing import smoothstep

_LEGS = frozenset(f"{side}_{joint}" for side in SIDES for joint in Leg.JOINTS)
_MOVING = _LEGS | {ROOT}

_STRIDE = 0.6
"""m from foot to foot of who walks, at most."""

_LIFT = 0.25
"""A foot that goes elsewhere is lifted by this part of its step, at most `_HIGHEST`."""

_HIGHEST = 0.08
"""m"""

_DEEPEST = 0.25
"""m that the pelvis sinks for feet that it has left behind, at most: then they are dragged along."""

_NOTHING = 1e-6
"""m"""

Feet = tuple[Place, ...]


class _Stand(NamedTuple):
    """What some layers come to, below the waist: the body, and where its ankles are to be."""

    body: Body
    feet: Feet


class Footing:
    """The last word on legs.

    Blending two postures joint by joint would let the feet swim: where the pelvis is lowered by half, half-bent knees
    do not reach the ground. So the layers are asked where they want the *feet*, each by its own legs and root; between
    these places the feet step, and hips, knees and ankles follow from there and from the pelvis, which sinks where a
    leg would be too short. Additive motion of the pelvis, as of one who shifts his weight, leaves the feet where they
    are.
    """

    def __init__(self, skeleton: Skeleton) -> None:
        """Of a skeleton; one whose legs have no length is left alone."""
        self._start = Body(skeleton)
        self._legs = all(joint in skeleton and length(skeleton.offset(joint)) > 0.0 for joint in _LEGS)
        self._asked: object = None
        self._layers: tuple[Layer, ...] = ()

    def layers(self, layers: Iterable[Layer]) -> tuple[Layer, ...]:
        """Further layers for the legs; none where the others have put the feet in the right place already."""
        concerned = [layer for layer in layers if layer.root is not None or not _MOVING.isdisjoint(layer.rotations)]
        asked = [_asked(layer) for layer in concerned]
        # Most of the time the pelvis rests, and the answer is the one of the last frame.
        if asked != self._asked:
            self._asked, self._layers = asked, tuple(map(checked, self._planted(concerned))) if self._legs else ()
        return self._layers

    def _planted(self, layers: Iterable[Layer]) -> Iterator[Layer]:
        ordered = sorted(layers, key=lambda layer: (layer.kind, layer.priority))
        lower = [layer for layer in ordered if layer.kind is not LayerKind.ADDITIVE]
        added = [layer for layer in ordered if layer.kind is LayerKind.ADDITIVE]
        if not added and all(layer.weight_of(ROOT) == 1.0 for layer in lower):
            return
        if any(not _LEGS.isdisjoint(layer.rotations) for layer in added):
            return
        body, feet = reduce(_over, lower, _Stand(self._start, _feet(self._start)))
        body = reduce(_pushed, added, body)
        sinking = min(_DEEPEST, max(_sinking(body, side, foot) for side, foot in zip(SIDES, feet, strict=True)))
        if sinking > _NOTHING:
            lowered = Layer(LayerKind.ADDITIVE, {}, root=(0.0, -sinking, 0.0))
            body = _pushed(body, lowered)
            yield lowered
        left, right = (_leg(body, side, foot) for side, foot in zip(SIDES, feet, strict=True))
        yield Layer(LayerKind.END_EFFECTOR, left | right)


def _asked(layer: Layer) -> object:
    """What of a layer matters here."""
    rotations = layer.rotations.get(ROOT) if layer.kind is LayerKind.ADDITIVE else layer.rotations
    return rotations, layer.weight, layer.weights, layer.root


def _feet(body: Body) -> Feet:
    return tuple(body.place(f"{side}_ankle") for side in SIDES)


def _over(below: _Stand, layer: Layer) -> _Stand:
    rotations = {joint: layer.rotations[joint] for joint in _MOVING & layer.rotations.keys()}
    goal = below.body.posed(rotations, layer.root)
    weight = layer.weight_of(ROOT)
    if weight == 1.0:
        return _Stand(goal, _feet(goal))
    body = over(below.body, replace(layer, rotations=rotations))
    return _Stand(body, _stepped(below.feet, _feet(goal), weight))


def _pushed(body: Body, layer: Layer) -> Body:
    """A body with an additive layer's turn and way of the pelvis."""
    turns = {joint: turn for joint, turn in layer.rotations.items() if joint == ROOT}
    return turned_further(body, replace(layer, rotations=turns))


def _stepped(before: Feet, after: Feet, weight: float) -> Feet:
    """The feet on their way from place to place: the left one goes first, and if that is far they go on in turn.

    As in walking each comes down a stride ahead of the other, and the pelvis is half a stride behind by then: so the
    first step and the last are half as long as the others.
    """
    far = max(distance(a.position, b.position) for a, b in zip(before, after, strict=True))
    strides = max(1, math.ceil(far / _STRIDE))
    return tuple(
        _step(a, b, foot, weight * strides, strides) for foot, (a, b) in enumerate(zip(before, after, strict=True))
    )


def _step(before: Place, after: Place, foot: int, gone: float, strides: int) -> Place:
    """Where a foot (0 the left, 1 the right) is when the pelvis has gone so many of the strides."""
    number = min(int(gone + 0.5), strides)
    if number % 2 != foot:
        return _along(before, after, number / strides)
    begin, end = max(0.0, number - 0.5), min(number + 0.5, strides)
    done = smoothstep((gone - begin) / (end - begin))
    start, goal = max(0, number - 1) / strides, min(number + 1, strides) / strides
    swinging = _along(before, after, start + done * (goal - start))
    high = min(_HIGHEST, _LIFT * (goal - start) * distance(before.position, after.position)) * 4.0 * done * (1.0 - done)
    return Place(add(swinging.position, scale(UP, high)), swinging.rotation)


def _along(before: Place, after: Place, share: float) -> Place:
    way = subtract(after.position, before.position)
    return Place(add(before.position, scale(way, share)), slerp(before.rotation, after.rotation, share))


def _sinking(body: Body, side: str, foot: Place) -> float:
    """How much lower the pelvis has to be for a leg to reach the place of its foot, m; 0 where it does.

    A leg is as long as in the default pose, where its knee is not quite straight.
    """
    knee, ankle = (body.skeleton.offset(f"{side}_{joint}") for joint in ("knee", "ankle"))
    x, y, z = subtract(body.place(f"{side}_hip").position, foot.position)
    return max(0.0, y - math.sqrt(max(0.0, length(add(knee, ankle)) ** 2 - x * x - z * z)))


def _leg(body: Body, side: str, foot: Place) -> dict[str, Quat]:
    """Rotations of hip, knee and ankle that bring a foot to its place, the knee turned as it was.

    The knee bends until the leg is as long as the way; then the hip turns the leg there by the smallest turn, and the
    ankle turns the foot back.
    """
    hip, knee, ankle = (f"{side}_{joint}" for joint in ("hip", "knee", "ankle"))
    pelvis = body.place(ROOT).rotation
    way = rotate(conjugate(pelvis), subtract(foot.position, body.place(hip).position))
    shank = rotate(body.rotation(knee), body.skeleton.offset(ankle))
    bend, end = Leg(body.skeleton.offset(knee), shank).bent(Leg.HINGE, length(way))
    leg = rotate(body.rotation(hip), end)
    hip_turn = multiply(between(unit(leg), unit(way)), body.rotation(hip))
    knee_turn = multiply(bend, body.rotation(knee))
    above = multiply(multiply(pelvis, hip_turn), knee_turn)
    return {hip: hip_turn, knee: knee_turn, ankle: multiply(conjugate(above), foot.rotation)}
