"""The ways of feet from where they stand to where they are to stand."""

import math
from collections.abc import Sequence

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


def leading(before: Sequence[Place], after: Sequence[Place]) -> int:
    """The foot that goes first (0 the left, 1 the right).

    It is the left one, unless the right one comes down to the ground: so there is always one to stand on.
    """
    left, right = (b.position[1] - a.position[1] for a, b in zip(before, after, strict=True))
    return 1 if right < left - _LEVEL else 0


def lift(before: Sequence[Place], after: Sequence[Place]) -> float:
    """How high the feet are lifted where one step of each is enough, m: the higher of both."""
    return max(_lift(_way(a, b)) for a, b in zip(before, after, strict=True))


def stepped(before: Sequence[Place], after: Sequence[Place], weight: float, leader: int) -> tuple[Place, ...]:
    """The feet on their way from place to place: one steps, then the other, and if that is far they go on in turn.

    As in walking each comes down a stride ahead of the other, and the pelvis is half a stride behind by then: so the
    first step and the last are half as long as the others. Who walks keeps up with the pelvis; where one step of each
    foot is enough, both get the same time of a weight that is eased in and out.

    Args:
        before: of both feet, the left one first.
        after: the same.
        weight: how much of the way the pelvis has gone, 0 to 1.
        leader: the foot that goes first.
    """
    far = max(distance(a.position, b.position) for a, b in zip(before, after, strict=True))
    strides = max(1, math.ceil(far / _STRIDE))
    gone = weight * strides if strides > 1 else _steady(weight)
    pairs = enumerate(zip(before, after, strict=True))
    return tuple(_step(a, b, foot == leader, gone, strides) for foot, (a, b) in pairs)


def _step(before: Place, after: Place, leads: bool, gone: float, strides: int) -> Place:
    """Where the foot that leads, or the other, is when the pelvis has gone so many of the strides."""
    number = min(int(gone + 0.5), strides)
    if (number % 2 == 0) != leads:
        return _along(before, after, number / strides)
    begin, end = max(0.0, number - 0.5), min(number + 0.5, strides)
    start, goal = max(0, number - 1) / strides, min(number + 1, strides) / strides
    return _swung(_along(before, after, start), _along(before, after, goal), (gone - begin) / (end - begin))


def _swung(start: Place, goal: Place, done: float) -> Place:
    """A foot in its step, of which a share is done: up first, then over, then down.

    So no sole slides: it is a centimeter above the ground before it goes anywhere. The height is a bell that is at rest
    at both ends, and grows with the way of the step up to a bound. It is our choice, for who steps aside; who walks at
    speed clears the ground by little more than that (D. A. Winter, "Foot trajectory in human gait", Physical Therapy
    72, 1992).
    """
    over = _along(start, goal, smoothstep(share(done, _RISING, 1.0 - _RISING)))
    high = _lift(_way(start, goal)) * 16.0 * (done * (1.0 - done)) ** 2
    return Place(add(over.position, scale(UP, high)), over.rotation)


def _lift(way: float) -> float:
    return _HIGHEST * way / (way + _HALF_AS_HIGH)


def _way(start: Place, goal: Place) -> float:
    """How far over the ground some part of a foot has to go, m: what only rises needs no lift."""
    ways = (subtract(_point(goal, part), _point(start, part)) for part in ((0.0, 0.0, 0.0), _BALL))
    return max(math.hypot(x, z) for x, _, z in ways)


def _point(foot: Place, part: Vec3) -> Vec3:
    return add(foot.position, rotate(foot.rotation, part))


def _along(before: Place, after: Place, share: float) -> Place:
    way = subtract(after.position, before.position)
    return Place(add(before.position, scale(way, share)), slerp(before.rotation, after.rotation, share))


def _steady(weight: float) -> float:
    """The share of the time that has passed when an eased weight (3t^2 - 2t^3) has come so far."""
    return 0.5 - math.sin(math.asin(1.0 - 2.0 * max(0.0, weight)) / 3.0)
