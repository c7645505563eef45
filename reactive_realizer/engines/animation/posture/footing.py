"""Feet that stay where they stand while the pelvis moves."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import reduce
from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.feet import LEG_JOINTS, feet, legs, reach, walks
from reactive_realizer.embodiment.joints import ROOT, SIDES
from reactive_realizer.embodiment.pose import Layer, LayerKind, checked, over, turned_further
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.skeleton import Place, Skeleton
from reactive_realizer.embodiment.vector import subtract
from reactive_realizer.engines.animation.posture.carrying import Carrying
from reactive_realizer.engines.animation.posture.steps import Foot, leading, lift, stepped

_MOVING = LEG_JOINTS | {ROOT}

_DEEPEST = 0.25
"""m that the pelvis sinks for feet that it has left behind, at most: then they are dragged along."""

_NOTHING = 1e-6
"""m"""

_GIVE = 0.1
"""How softly the pelvis keeps to the height at which a leg is straight, for each meter that the feet are lifted.

Near there the bend of a knee goes with the root of what the leg lacks of its length: it would lock and unlock at once,
when the foot comes down and when it leaves. So who is about to step bends both knees a little. It is our choice.
"""

_CAREFUL = 0.007
"""m; how softly it does while a foot is late: as in the middle of a long step, for a leg that waits may be straight."""


class _Stand(NamedTuple):
    """What some layers come to, below the waist.

    Attributes:
        body: as they pose it.
        feet: as they are to be, the left one first.
        ground: where they are in the uppermost of the layers that are there in full.
        softness: how softly the pelvis keeps to the length of the legs, m; 0 where nobody steps.
    """

    body: Body
    feet: tuple[Foot, ...]
    ground: tuple[Place, ...]
    softness: float


class Footing:
    """The last word on legs.

    Blending two postures joint by joint would let the feet swim: where the pelvis is lowered by half, half-bent knees
    do not reach the ground. So the layers are asked where they want the *feet*, each by its own legs and root; between
    these places the feet step, never both at once (`Carrying`), and hips, knees and ankles follow from there and from
    the pelvis, which sinks where a leg would be too short, or straight in a step. What adds to pelvis and legs owns
    nothing: who shifts his weight, or whose knee stirs, has the feet where they were without it.
    """

    def __init__(self, skeleton: Skeleton) -> None:
        """Of a skeleton; one whose legs have no length is left alone."""
        self._start = Body(skeleton)
        self._legs = walks(skeleton)
        self._carrying = Carrying()
        self._asked: object = None
        self._layers: tuple[Layer, ...] = ()

    def layers(self, layers: Iterable[Layer], now: GlobalTime) -> tuple[Layer, ...]:
        """Further layers for the legs in the frame of a time; none where the others have put the feet in place."""
        concerned = [layer for layer in layers if layer.root is not None or not _MOVING.isdisjoint(layer.rotations)]
        asked = [_asked(layer) for layer in concerned]
        # Most of the time the pelvis rests, and the answer is the one of the last frame.
        if self._legs and not (asked == self._asked and self._carrying.settled):
            self._asked, self._layers = asked, tuple(map(checked, self._planted(concerned, now)))
        return self._layers

    def _planted(self, layers: Iterable[Layer], now: GlobalTime) -> Iterator[Layer]:
        ordered = sorted(layers, key=lambda layer: (layer.kind, layer.priority))
        lower = [layer for layer in ordered if layer.kind is not LayerKind.ADDITIVE]
        added = [layer for layer in ordered if layer.kind is LayerKind.ADDITIVE]
        below, wanted, _, softness = reduce(_over, lower, _stand(self._start))
        places = self._carrying(wanted, now)
        if not added and self._carrying.settled and all(layer.weight_of(ROOT) == 1.0 for layer in lower):
            return
        softness = max(softness, _CAREFUL * self._carrying.care)
        body = reduce(_pushed, added, below)
        lacking = [_lacking(body, side, foot) for side, foot in zip(SIDES, places, strict=True)]
        sinking = min(_DEEPEST, _highest((0.0, *lacking), softness))
        if sinking > _NOTHING:
            lowered = Layer(LayerKind.ADDITIVE, {}, root=(0.0, -sinking, 0.0))
            body = _pushed(body, lowered)
            yield lowered
        yield Layer(LayerKind.END_EFFECTOR, legs(body, places))


def _stand(body: Body) -> _Stand:
    places = feet(body)
    return _Stand(body, tuple(map(Foot, places)), places, 0.0)


def _asked(layer: Layer) -> object:
    """What of a layer matters here."""
    rotations = _moving(layer) if layer.kind is LayerKind.ADDITIVE else layer.rotations
    return rotations, layer.weight, layer.weights, layer.root


def _moving(layer: Layer) -> dict[str, Quat]:
    return {joint: layer.rotations[joint] for joint in _MOVING & layer.rotations.keys()}


def _over(below: _Stand, layer: Layer) -> _Stand:
    rotations = _moving(layer)
    goal = below.body.posed(rotations, layer.root)
    weight = layer.weight_of(ROOT)
    if weight == 1.0:
        return _stand(goal)
    places = feet(goal)
    return below._replace(
        body=over(below.body, replace(layer, rotations=rotations)),
        feet=stepped(below.feet, places, weight, leading(below.ground, places)),
        softness=(1.0 - weight)
        * (below.softness + 4.0 * weight * _GIVE * lift([foot.place for foot in below.feet], places)),
    )


def _pushed(body: Body, layer: Layer) -> Body:
    """A body with what an additive layer does to pelvis and legs."""
    return turned_further(body, replace(layer, rotations=_moving(layer)))


def _lacking(body: Body, side: str, foot: Place) -> float:
    """How much lower the pelvis has to be for a leg to reach the place of its foot, m; below 0 where it does."""
    x, y, z = subtract(body.place(f"{side}_hip").position, foot.position)
    return y - math.sqrt(max(0.0, reach(body.skeleton, side) ** 2 - x * x - z * z))


def _highest(values: Sequence[float], softness: float) -> float:
    """The highest of some values, and a little more where others come near to it: so it has no corners."""
    highest = max(values)
    if softness < _NOTHING:
        return highest
    return highest + softness * math.log(sum(math.exp((value - highest) / softness) for value in values))
