"""Strokes of gestures with expressivity: larger or smaller, with a back-swing, and beyond their end."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

from reactive_realizer.bml.expressivity import Expressivity
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, cross, distance, dot, length, scale, subtract, unit
from reactive_realizer.engines.animation.arm_shift import CarriedArm
from reactive_realizer.engines.animation.easing import minimum_jerk, share

TOUCHING = 0.15
"""Distance between two wrists within which hands may touch, m."""

_ON_BODY = 0.4
"""Distance of a palm from the axis of trunk and neck within which it may touch the body, in lengths of the arm."""

_SAMPLES = 16
"""Number of parts into which a stroke is divided to find where it goes."""

_SHORTEST = 0.02
"""A stroke in which the hand moves less than this is a hold, m."""

_RETURN = 0.25
"""Time in which a powerful stroke is beyond its end, s (ours)."""


class _Hand(NamedTuple):
    """The stroke of a hand, relative to what carries its shoulder girdle (`CarriedArm`), without expressivity.

    Attributes:
        arm: that carries it.
        center: that stays in place when the stroke grows or shrinks: where the hand touches something, or else the
            center of the bounding box of the places of both hands, m.
        way: from ready to the end of the stroke, m.
        touches: whether it touches the body or the other hand.
    """

    arm: CarriedArm
    center: Vec3
    way: Vec3
    touches: bool


@dataclass(frozen=True, slots=True)
class StrokePhases:
    """The phases of a gesture that matter for its expressivity, 0 to 1.

    Attributes:
        begins: of the stroke.
        turns: at its end, where the hand holds or turns back.
        back: until which a powerful stroke is back from beyond its end.
    """

    begins: float
    turns: float
    back: float

    @classmethod
    def of(cls, key_positions: Mapping[str, float], duration: float) -> "StrokePhases":
        """Return the phases of a gesture from its points and its duration, s."""
        begins = key_positions["strokeStart"]
        turns = next((key_positions[each] for each in ("stroke", "strokeEnd") if key_positions[each] > begins), begins)
        return cls(begins, turns, min(turns + _RETURN / duration, key_positions["relax"]))


class ExpressiveStroke:
    """Where the hands of a gesture go, and how expressivity changes it.

    A hand keeps its direction, and the trunk carries it.

    Attributes:
        moves: whether a hand moves from ready to relax.
    """

    def __init__(self, body_at: Callable[[float], Body], points: Sequence[float], joints: Collection[str]) -> None:
        """Find where the hands go.

        Args:
            body_at: returns the body at a phase of the animation.
            points: phases of ready, strokeStart, stroke, strokeEnd and relax in the animation.
            joints: that the animation turns; hands count whose shoulder and elbow turn.
        """
        self._sides = tuple(side for side in SIDES if {f"{side}_shoulder", f"{side}_elbow"} <= set(joints))
        first, last = points[0], points[-1]
        phases = sorted({*points, *(first + (last - first) * number / _SAMPLES for number in range(_SAMPLES + 1))})
        bodies = {phase: body_at(phase) for phase in phases}
        arms = {side: CarriedArm.of(bodies[first].skeleton, side) for side in self._sides}
        places = {side: {phase: arm.place({}, body) for phase, body in bodies.items()} for side, arm in arms.items()}
        low, high = _box([place for own in places.values() for place in own.values()])
        self._hands = dict[str, _Hand]()
        for side, own in places.items():
            contact = self._contact(side, [(phase, bodies[phase]) for phase in points])
            center = scale(add(low, high), 0.5) if contact is None else own[contact]
            self._hands[side] = _Hand(arms[side], center, _way(own, points), contact is not None)
        self.moves = any(length(hand.way) >= _SHORTEST for hand in self._hands.values())

    def _contact(self, side: str, bodies: Sequence[tuple[float, Body]]) -> float | None:
        """Return the last of some phases at which a hand touches something; None if there is none."""
        return next((phase for phase, body in reversed(bodies) if self._touches(side, body)), None)

    def _touches(self, side: str, body: Body) -> bool:
        if len(self._sides) > 1:
            left, right = (body.transform(f"{each}_wrist").position for each in SIDES)
            if distance(left, right) < TOUCHING:
                return True
        palm = f"{side}_middle1" if f"{side}_middle1" in body.skeleton else f"{side}_wrist"
        near = _ON_BODY * CarriedArm.of(body.skeleton, side).limb.reach
        return _from_axis(body.transform(palm).position, body) < near

    def expressed(
        self, rotations: Mapping[str, Quat], body: Body, expressivity: Expressivity, along: float, amount: float = 1.0
    ) -> Mapping[str, Quat]:
        """Return the rotations of a stroke with expressivity.

        Args:
            rotations: without it.
            body: with the rotations of all other joints.
            expressivity: of the stroke.
            along: how far the hands are ahead in the direction of the stroke, as a share of its length (`along`).
            amount: of the gesture.
        """
        grown = amount * (expressivity.size - 1.0)
        for side, hand in self._hands.items():
            if f"{side}_shoulder" in rotations:
                ahead = min(0.0, along) if hand.touches else along
                away = scale(subtract(hand.arm.place(rotations, body), hand.center), grown)
                shift = add(away, scale(hand.way, ahead * expressivity.size * amount))
                rotations = hand.arm.shifted(rotations, body, shift)
        return rotations

    @staticmethod
    def along(expressivity: Expressivity, phases: StrokePhases, phase: float) -> float:
        """Return how far the hands are ahead in the direction of the stroke, as a share of its length.

        They swing back before it, go beyond its end with power, and lag behind without.
        """
        gone = share(phase, phases.begins, phases.turns)
        back = expressivity.back_swing * (1.0 - minimum_jerk(gone))
        beyond = expressivity.beyond(share(phase, phases.turns, phases.back))
        return beyond - back + min(0.0, expressivity.arriving(gone))

    @property
    def arms(self) -> list[CarriedArm]:
        """The arms that carry its hands."""
        return [hand.arm for hand in self._hands.values()]


def _box(places: Sequence[Vec3]) -> tuple[Vec3, Vec3]:
    """Return the corners of the bounding box of places, m."""
    if not places:
        return ZERO, ZERO
    x, y, z = zip(*places, strict=True)
    return (min(x), min(y), min(z)), (max(x), max(y), max(z))


def _way(places: Mapping[float, Vec3], points: Sequence[float]) -> Vec3:
    """Return the way from ready to the end of a stroke, or else to where the hand is farthest from its ready, m."""
    ready, _, stroke, end, _ = points
    way = subtract(places[stroke if stroke > ready else end], places[ready])
    if length(way) >= _SHORTEST:
        return way
    return max((subtract(place, places[ready]) for place in places.values()), key=length)


def _from_axis(place: Vec3, body: Body) -> float:
    """Return the distance of a place from the axis of trunk and neck, m."""
    joints = [body.transform(joint).position for joint in body.skeleton.chain("skullbase")]
    return min(_from_line(place, *ends) for ends in pairwise(joints))


def _from_line(place: Vec3, begin: Vec3, end: Vec3) -> float:
    """Return the distance of a place from a line between two points, m."""
    line, way = subtract(end, begin), subtract(place, begin)
    far = length(line)
    if far == 0.0:
        return length(way)
    along = dot(way, unit(line))
    return length(cross(way, unit(line))) if 0.0 <= along <= far else min(length(way), distance(place, end))
