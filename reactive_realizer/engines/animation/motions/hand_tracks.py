"""The state of a hand along a stroke: its place, its directions and its shape, each from value to value."""

import math
from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from reactive_realizer.bml.murml.description import Bend
from reactive_realizer.embodiment.quaternion import Quat, slerp
from reactive_realizer.embodiment.vector import Vec3, add, cross, length, scale, subtract, unit
from reactive_realizer.engines.animation.easing import smoothstep
from reactive_realizer.engines.animation.key_poses.arm_pose import ArmGoals
from reactive_realizer.engines.animation.key_poses.direction import Direction
from reactive_realizer.engines.animation.key_poses.solved_pose import SolvedPose

T = TypeVar("T")

_STEEPEST = 0.95
"""Limit of the change of speed along the chord of a curve, relative to its mean."""

_OPPOSITE = 1e-3
"""The sum of two directions that is shorter has no direction of its own."""


@dataclass(frozen=True, slots=True)
class Course(Generic[T]):
    """Values at positions, and in between. Before the first one, there is none; after the last one, it is kept.

    Attributes:
        positions: increasing.
        values: at the positions.
        between: returns the value after a share of the way from one to the next, by the index of the latter.
    """

    positions: Sequence[float]
    values: Sequence[T]
    between: Callable[[T, T, float, int], T]

    def at(self, position: float) -> T | None:
        """Return the value at a position."""
        after = bisect_right(self.positions, position)
        if after == 0:
            return None
        if after == len(self.positions) or self.positions[after - 1] == position:
            return self.values[after - 1]
        begin, end = self.positions[after - 1], self.positions[after]
        done = (position - begin) / (end - begin)
        return self.between(self.values[after - 1], self.values[after], done, after)


def place_course(positions: Sequence[float], places: Sequence[Vec3], bends: Sequence[Bend | None]) -> Course[Vec3]:
    """Return the course of a hand through places, on straight lines or curves.

    Args:
        positions: of the places.
        places: from the pelvis, m.
        bends: of the way to each place.
    """
    return Course(positions, places, lambda a, b, done, after: _bent(a, b, done, bends[after]))


def _bent(start: Vec3, goal: Vec3, done: float, bend: Bend | None) -> Vec3:
    chord = subtract(goal, start)
    if bend is None or length(chord) < _OPPOSITE:
        return add(start, scale(chord, done))
    along, aside = curve(done, bend)
    side = cross(unit(bend.normal), chord)
    return add(add(start, scale(chord, along)), scale(side, bend.height * aside))


def curve(done: float, bend: Bend) -> tuple[float, float]:
    """Return a point of a curve after a share of its way: along its chord, 0 to 1, and aside, -1 to 1.

    The place aside is a sine. A curve becomes broad or pointed by the speed along the chord, which is then lower or
    higher at its ends than where it is highest; a C becomes skewed in the same way.
    """
    turns = (2.0 if bend.double else 1.0) * math.pi
    skew = 0.0 if bend.double else bend.skewedness
    # Beyond this length of both together, the hand would go backward.
    longest = max(1.0, math.hypot(bend.roundness, skew) / _STEEPEST)
    broad, later = -bend.roundness / longest, skew / longest
    angle = 2.0 * turns * done
    along = done - (broad * math.sin(angle) - later * (1.0 - math.cos(angle))) / (2.0 * turns)
    aside = math.sin(turns * done)
    if bend.double:  # one half of an S is lower
        aside *= 1.0 - 0.5 * abs(bend.skewedness) * smoothstep(1.0 - done if bend.skewedness > 0.0 else done)
    return along, aside


def direction_course(positions: Sequence[float], directions: Sequence[Vec3]) -> Course[Vec3]:
    """Return the course of an axis of a hand through directions, unit vectors."""
    return Course(positions, directions, lambda a, b, done, _: _turned(a, b, done))


def _turned(start: Vec3, goal: Vec3, done: float) -> Vec3:
    mixed = add(scale(start, 1.0 - done), scale(goal, done))
    if length(mixed) < _OPPOSITE:  # halfway between opposite directions
        return start
    return unit(mixed)


def shape_course(positions: Sequence[float], shapes: Sequence[Mapping[str, Quat]]) -> Course[Mapping[str, Quat]]:
    """Return the course of the joints of a hand through its shapes."""
    return Course(
        positions, shapes, lambda a, b, done, _: {j: slerp(a.get(j, turn), turn, done) for j, turn in b.items()}
    )


@dataclass(frozen=True, slots=True)
class HandTracks:
    """The courses of one hand.

    Attributes:
        side: "l" or "r".
        place: of the wrist, from the pelvis; None if the hand stays where it is.
        headings: axis in the axes of the wrist -> its course; the first one is met, the second as nearly as possible.
        shape: rotations of the joints of the hand; None for none.
    """

    side: str
    place: Course[Vec3] | None
    headings: Sequence[tuple[Vec3, Course[Vec3]]]
    shape: Course[Mapping[str, Quat]] | None

    @property
    def courses(self) -> list[Sequence[float]]:
        """The positions of each course."""
        courses: list[Course[Vec3] | Course[Mapping[str, Quat]] | None] = [self.place, self.shape]
        courses += [course for _, course in self.headings]
        return [course.positions for course in courses if course is not None]

    def at(self, position: float) -> SolvedPose:
        """Return the state of the hand at a position."""
        place = self.place.at(position) if self.place else None
        headings = ((axis, course.at(position)) for axis, course in self.headings)
        directions = tuple(Direction(axis, way) for axis, way in headings if way is not None)
        arm = ArmGoals(self.side, place, directions=directions) if place is not None or directions else None
        return SolvedPose((self.shape.at(position) if self.shape else None) or {}, arm=arm)
