"""The ways of feet from where they stand to where they are to stand."""

import math
from collections.abc import Sequence
from typing import NamedTuple

from reactive_realizer.embodiment.quaternion import rotate, slerp
from reactive_realizer.embodiment.skeleton import Place
from reactive_realizer.embodiment.vector import UP, Vec3, add, distance, scale, subtract
from reactive_realizer.engines.animation.easing import share, smoothstep

_STRIDE = 0.55
"""m from foot to foot of who walks, at most."""

_HIGHEST = 0.1
"""m, near which the longest steps are lifted."""

_HALF_AS_HIGH = 0.08
"""m of way on which a foot is lifted half as high."""

_RISING = 0.1
"""The share of a step in which a foot goes only up, and as much again in which it comes only down."""

_LEVEL = 0.01
"""m; feet that differ by less in height stand on the same ground."""

_BALL: Vec3 = (0.0, 0.0, 0.15)
"""From the ankle to the ball of the foot, m: it goes far, too, where the foot turns."""


class Foot(NamedTuple):
    """A foot that stands or steps.

    Attributes:
        place: of its ankle.
        lift: how much of its height is that of a step, m; 0 where it stands.
    """

    place: Place
    lift: float = 0.0


def leading(before: Sequence[Place], after: Sequence[Place]) -> int:
    """The foot that goes first (0 the left, 1 the right).

    It is the left one, unless the right one comes down to the ground: so there is always one to stand on.
    """
    left, right = (b.position[1] - a.position[1] for a, b in zip(before, after, strict=True))
    return 1 if right < left - _LEVEL else 0


def lift(before: Sequence[Place], after: Sequence[Place]) -> float:
    """How high the feet are lifted where one step of each is enough, m: the higher of both."""
    return max(_lift(_way(a, b)) for a, b in zip(before, after, strict=True))


def stepped(before: Sequence[Foot], after: Sequence[Place], weight: float, leader: int) -> tuple[Foot, ...]:
    """The feet on their way from place to place: one steps, then the other, and if that is far they go on in turn.

    As in walking each comes down a stride ahead of the other, and the pelvis is half a stride behind by then: so the
    first step and the last are half as long as the others. Who walks keeps up with the pelvis; where one step of each
    foot is enough, both get the same time of a weight that is eased in and out.

    Args:
        before: both feet, the left one first; one that steps already has less of that the farther it goes.
        after: where they are to be.
        weight: how much of the way the pelvis has gone, 0 to 1.
        leader: the foot that goes first.
    """
    far = max(distance(a.place.position, b.position) for a, b in zip(before, after, strict=True))
    strides = max(1, math.ceil(far / _STRIDE))
    gone = weight * strides if strides > 1 else _steady(weight)
    pairs = enumerate(zip(before, after, strict=True))
    return tuple(_step(a, b, foot == leader, gone, strides) for foot, (a, b) in pairs)


def _step(before: Foot, after: Place, leads: bool, gone: float, strides: int) -> Foot:
    """Where the foot that leads, or the other, is when the pelvis has gone so many of the strides."""
    number = min(int(gone + 0.5), strides)
    if (number % 2 == 0) != leads:
        return _along(before, Foot(after), number / strides)
    begin, end = max(0.0, number - 0.5), min(number + 0.5, strides)
    start, goal = max(0, number - 1) / strides, min(number + 1, strides) / strides
    return swung(_along(before, Foot(after), start), _along(before, Foot(after), goal), (gone - begin) / (end - begin))


def swung(start: Foot, goal: Foot, done: float) -> Foot:
    """A foot in its step, of which a share is done: up first, then over, then down.

    So no sole slides: it is a centimeter above the ground before it goes anywhere. The height is a bell that is at rest
    at both ends, and grows with the way of the step up to a bound. It is our choice, for who steps aside; who walks at
    speed clears the ground by little more than that (D. A. Winter, "Foot trajectory in human gait", Physical Therapy
    72, 1992).
    """
    over = _along(start, goal, smoothstep(share(done, _RISING, 1.0 - _RISING)))
    high = _lift(_way(start.place, goal.place)) * 16.0 * (done * (1.0 - done)) ** 2
    return Foot(Place(add(over.place.position, scale(UP, high)), over.place.rotation), over.lift + high)


def _lift(way: float) -> float:
    return _HIGHEST * way / (way + _HALF_AS_HIGH)


def _way(start: Place, goal: Place) -> float:
    """How far over the ground some part of a foot has to go, m: what only rises needs no lift."""
    ways = (subtract(_point(goal, part), _point(start, part)) for part in ((0.0, 0.0, 0.0), _BALL))
    return max(math.hypot(x, z) for x, _, z in ways)


def _point(foot: Place, part: Vec3) -> Vec3:
    return add(foot.position, rotate(foot.rotation, part))


def _along(before: Foot, after: Foot, share: float) -> Foot:
    (start, lift), (goal, other) = before, after
    way = subtract(goal.position, start.position)
    place = Place(add(start.position, scale(way, share)), slerp(start.rotation, goal.rotation, share))
    return Foot(place, lift + share * (other - lift))


def _steady(weight: float) -> float:
    """The share of the time that has passed when an eased weight (3t^2 - 2t^3) has come so far."""
    return 0.5 - math.sin(math.asin(1.0 - 2.0 * max(0.0, weight)) / 3.0)
