"""Steps: how feet move from one place to another, one foot at a time."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Transform
from reactive_realizer.embodiment.quaternion import rotate, slerp
from reactive_realizer.embodiment.vector import UP, Vec3, add, distance, scale, subtract
from reactive_realizer.engines.animation.easing import share, smoothstep

_STRIDE = 0.55
"""Longest distance from foot to foot in walking, m."""

_HIGHEST = 0.1
"""Height that the longest steps approach, m."""

_HALF_AS_HIGH = 0.08
"""Length of a step that is lifted half as high, m."""

_RISING = 0.1
"""Share of a step in which a foot only rises; in an equal share at the end it only comes down."""

_LEVEL = 0.01
"""Feet that differ less in height stand on the same ground, m."""

_BALL: Vec3 = (0.0, 0.0, 0.15)
"""From the ankle to the ball of the foot, m; it also travels when the foot turns."""


class Foot(NamedTuple):
    """A foot that stands or steps.

    Attributes:
        place: transform of its ankle.
        lift: part of its height that belongs to a step, m; 0 if it stands.
    """

    place: Transform
    lift: float = 0.0


def leading(before: Sequence[Transform], after: Sequence[Transform]) -> int:
    """Return the foot that steps first: 0 is left, 1 is right.

    The left foot leads, unless the right one comes down to the ground: one foot can always bear the weight.
    """
    left, right = (b.position[1] - a.position[1] for a, b in zip(before, after, strict=True))
    return 1 if right < left - _LEVEL else 0


def lift(before: Sequence[Transform], after: Sequence[Transform]) -> float:
    """Return the higher lift of both feet, m, if one step of each is enough."""
    return max(_lift(_way(a, b)) for a, b in zip(before, after, strict=True))


def stepped(before: Sequence[Foot], after: Sequence[Transform], weight: float, leader: int) -> tuple[Foot, ...]:
    """Return the feet on their way from place to place: they step in turn, several times over long distances.

    As in walking, each foot comes down a stride ahead of the other, when the pelvis is half a stride behind. So the
    first and the last step are half as long as the others. Walking follows the pelvis. If one step of each foot is
    enough, both get equal shares of the time of an eased weight.

    Args:
        before: both feet, left first; a foot that already steps has less of its lift the farther it gets.
        after: goal transforms.
        weight: progress of the pelvis, 0 to 1.
        leader: the foot that steps first.
    """
    far = max(distance(a.place.position, b.position) for a, b in zip(before, after, strict=True))
    strides = max(1, math.ceil(far / _STRIDE))
    gone = weight * strides if strides > 1 else _steady(weight)
    pairs = enumerate(zip(before, after, strict=True))
    return tuple(_step(a, b, foot == leader, gone, strides) for foot, (a, b) in pairs)


def _step(before: Foot, after: Transform, leads: bool, gone: float, strides: int) -> Foot:
    """Return a foot, leading or not, when the pelvis has covered a number of strides."""
    number = min(int(gone + 0.5), strides)
    if (number % 2 == 0) != leads:
        return _along(before, Foot(after), number / strides)
    begin, end = max(0.0, number - 0.5), min(number + 0.5, strides)
    start, goal = max(0, number - 1) / strides, min(number + 1, strides) / strides
    return swung(_along(before, Foot(after), start), _along(before, Foot(after), goal), (gone - begin) / (end - begin))


def swung(start: Foot, goal: Foot, done: float) -> Foot:
    """Return a foot in its swing phase, at a share of a step: up first, then over, then down.

    So soles do not slide: a foot is a centimeter above the ground before it moves over it. The height is bell-shaped,
    with zero speed at both ends, and grows with the length of the step up to a limit. This is our choice for steps to
    the side; in fast walking feet clear the ground by little more than that (D. A. Winter, "Foot trajectory in human
    gait", Physical Therapy 72, 1992).
    """
    over = _along(start, goal, smoothstep(share(done, _RISING, 1.0 - _RISING)))
    high = _lift(_way(start.place, goal.place)) * 16.0 * (done * (1.0 - done)) ** 2
    return Foot(Transform(add(over.place.position, scale(UP, high)), over.place.rotation), over.lift + high)


def _lift(way: float) -> float:
    return _HIGHEST * way / (way + _HALF_AS_HIGH)


def _way(start: Transform, goal: Transform) -> float:
    """Return the distance over the ground of the part of a foot that moves most, m.

    Purely vertical motion needs no lift.
    """
    ways = (subtract(_point(goal, part), _point(start, part)) for part in ((0.0, 0.0, 0.0), _BALL))
    return max(math.hypot(x, z) for x, _, z in ways)


def _point(foot: Transform, part: Vec3) -> Vec3:
    return add(foot.position, rotate(foot.rotation, part))


def _along(before: Foot, after: Foot, share: float) -> Foot:
    (start, lift), (goal, other) = before, after
    way = subtract(goal.position, start.position)
    place = Transform(add(start.position, scale(way, share)), slerp(start.rotation, goal.rotation, share))
    return Foot(place, lift + share * (other - lift))


def _steady(weight: float) -> float:
    """Return the share of time after which an eased weight (3t^2 - 2t^3) has a value."""
    return 0.5 - math.sin(math.asin(1.0 - 2.0 * max(0.0, weight)) / 3.0)


_STANDS = 0.002
"""A foot that is lifted less than this stands, m."""

_DURATION = 0.5
"""Duration of a delayed step, s: a little longer than the swing phase in walking."""

_HESITATION = 0.2
"""Time in which caution rises after a foot is delayed, s."""

_GAP = 0.1
"""Feet shown longer ago than this have no effect, s."""


@dataclass(frozen=True, slots=True)
class _DelayedFoot:
    """A foot that could not step when it should have.

    Attributes:
        foot: as it stands.
        held: when it should have stepped, s.
        since: when it did, s; None while it waits for the other foot.
    """

    foot: Foot
    held: GlobalTime
    since: GlobalTime | None = None

    @property
    def waits(self) -> bool:
        return self.since is None

    def over(self, now: GlobalTime) -> bool:
        return self.since is not None and now >= self.since + _DURATION

    def at(self, wanted: Foot, now: GlobalTime) -> Foot:
        if self.since is None:
            return self.foot
        return swung(self.foot, wanted, share(now, self.since, self.since + _DURATION))

    def caution(self, now: GlobalTime) -> float:
        hesitation = smoothstep(share(now, self.held, self.held + _HESITATION))
        done = 0.0 if self.since is None else share(now, self.since, self.since + _DURATION)
        return hesitation * (1.0 - smoothstep(done))


class FootAlternation:
    """Follows the goals of both feet, but never lifts both at once.

    Overlapping changes of stance may want both feet in the air. Then the standing foot stays until the other one has
    come down, and follows with a step of its own. This is our choice.
    """

    def __init__(self) -> None:
        self._time = GlobalTime(0.0)
        self._shown: tuple[Foot, ...] = ()
        self._delayed: dict[int, _DelayedFoot] = {}

    @property
    def settled(self) -> bool:
        """Whether both feet are at their goals."""
        return not self._delayed

    @property
    def caution(self) -> float:
        """Caution because of a delayed foot, 0 to 1; it decreases while that foot steps."""
        return max((delayed.caution(self._time) for delayed in self._delayed.values()), default=0.0)

    def __call__(self, wanted: Sequence[Foot], now: GlobalTime) -> tuple[Transform, ...]:
        """Return the transforms of the ankles in a frame, left first.

        Args:
            wanted: goals of the feet, left first.
            now: time of the frame, s; frames come in order.
        """
        if now - self._time > _GAP:
            self._shown, self._delayed = tuple(wanted), {}
        self._delayed = {number: delayed for number, delayed in self._delayed.items() if not delayed.over(now)}
        shown = [self._foot(number, foot, now) for number, foot in enumerate(wanted)]
        stands = [foot.lift <= _STANDS for foot in shown]
        if not any(stands):
            self._stay(shown, now)
        elif all(stands):
            self._delayed |= {
                number: replace(delayed, since=now) for number, delayed in self._delayed.items() if delayed.waits
            }
        self._time, self._shown = now, tuple(shown)
        return tuple(foot.place for foot in shown)

    def _foot(self, number: int, wanted: Foot, now: GlobalTime) -> Foot:
        delayed = self._delayed.get(number)
        return wanted if delayed is None else delayed.at(wanted, now)

    def _stay(self, shown: list[Foot], now: GlobalTime) -> None:
        """Keep the foot that stood last; if both stood, the one that was not delayed before."""
        stood = [number for number, foot in enumerate(self._shown) if foot.lift <= _STANDS]
        for number in sorted(stood, key=self._delayed.__contains__)[:1]:
            shown[number] = self._shown[number]
            held = self._delayed[number].held if number in self._delayed else now
            self._delayed[number] = _DelayedFoot(shown[number], held)
