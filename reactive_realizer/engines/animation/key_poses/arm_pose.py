"""The pose of an arm that meets goals: its hand at a place and in a direction, its elbow out."""

import math
from dataclasses import dataclass
from typing import NamedTuple

from reactive_realizer.bml.vocabulary import BodyAxis
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.quaternion import (
    Quat,
    angle,
    between,
    conjugate,
    multiply,
    power,
    rotate,
    twist,
)
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import FORWARD, ZERO, Vec3, add, cross, dot, length, rejected, subtract, unit
from reactive_realizer.engines.animation.key_poses.direction import Direction, Unturned, turn_about
from reactive_realizer.engines.animation.procedural.effector_track import natural_arm
from reactive_realizer.engines.animation.procedural.tracks import parent_rotation
from reactive_realizer.engines.animation.spine_ik import HandGoal

_ROUNDS = 5
"""Repetitions after which a fingertip is at its place; the direction of the hand depends on where the wrist is."""

_MOST_BEND = math.radians(80.0)
"""Limit of the turn of a wrist other than about the forearm: flexion of a healthy wrist."""

_ALONG: Vec3 = (0.0, -1.0, 0.0)
"""The forearm in its own axes: it hangs in the default pose."""


def hand_axes(side: str, skeleton: Skeleton) -> dict[BodyAxis, Vec3]:
    """Return the axes of a hand in the axes of its wrist, unit vectors, from the bones of the fingers.

    A hand without fingers hangs with its palm to the thigh, as in the default pose.
    """
    fingers = unit(skeleton.offset(f"{side}_wrist"))
    if f"{side}_middle1" in skeleton:
        fingers = unit(skeleton.offset(f"{side}_middle1"))
    across = FORWARD
    if f"{side}_index1" in skeleton and f"{side}_pinky1" in skeleton:
        across = subtract(skeleton.offset(f"{side}_index1"), skeleton.offset(f"{side}_pinky1"))
    thumb = unit(rejected(across, fingers))
    palm = cross(thumb, fingers) if side == "r" else cross(fingers, thumb)
    return {BodyAxis.PALM: palm, BodyAxis.FINGERS: fingers, BodyAxis.THUMB: thumb}


class SolvedArm(NamedTuple):
    """The rotations of an arm.

    Attributes:
        rotations: of shoulder, elbow and wrist, local to their parents.
        missing: distance of the hand from its place, m.
        place: to which the wrist goes, in the figure's frame, m; None if only the wrist turns.
    """

    rotations: dict[str, Quat]
    missing: float
    place: Vec3 | None = None


@dataclass(frozen=True, slots=True)
class ArmGoals:
    """The goals of one arm.

    Attributes:
        side: "l" or "r".
        place: of the hand, from the pelvis, in the figure's axes, m; None if only the wrist turns.
        tip: from the wrist to the point of the hand that is to be there, in the axes of the wrist, m.
        directions: of the hand. The first is met, the second as nearly as that allows; others have no effect.
        swivel: of the elbow, rad, outward; it swivels further where the forearm could not turn the hand otherwise.
    """

    side: str
    place: Vec3 | None
    tip: Vec3 = ZERO
    directions: tuple[Direction, ...] = ()
    swivel: float = 0.0

    @property
    def joints(self) -> tuple[str, ...]:
        """The joints that it turns."""
        names = Arm.JOINTS if self.place is not None else Arm.JOINTS[2:]
        return tuple(f"{self.side}_{name}" for name in names)

    def solve(self, body: Body, wrist: Quat) -> SolvedArm:
        """Return the rotations of the arm.

        Args:
            body: whose trunk carries the arm; its arm turns the wrist alone if there is no place.
            wrist: rotation of a wrist without a direction.
        """
        if self.place is None:
            _, elbow, end = (f"{self.side}_{name}" for name in Arm.JOINTS)
            return SolvedArm({end: self._wrist(body.transform(elbow).rotation, wrist)}, 0.0)
        target = add(body.transform(body.skeleton.joints[0]).position, self.place)
        solved, hand = self._reaching(target, body, wrist)
        for _ in range(_ROUNDS if length(self.tip) > 0.0 else 0):
            solved, hand = self._reaching(subtract(target, rotate(hand, self.tip)), body, wrist)
        return solved._replace(rotations=dict(natural_arm(self.side, solved.rotations, body.skeleton)))

    def unturned(self, body: Body) -> tuple[Unturned, ...]:
        """Return by how much the hand falls short of its first direction in a body that has the pose."""
        wrist = f"{self.side}_wrist"
        rotation = body.transform(wrist).rotation
        return tuple(Unturned(wrist, each.left(rotation)) for each in self.directions[:1])

    def hand_goal(self, body: Body, wrist: Quat) -> HandGoal | None:
        """Return where the hand is to be; None if it only turns.

        Args:
            body: whose trunk does not lean.
            wrist: rotation of a wrist without a direction.
        """
        if self.place is None:
            return None
        if self.directions and length(self.tip) > 0.0:
            place = self.solve(body, wrist).place
            return None if place is None else HandGoal(self.side, place)
        pelvis = body.transform(body.skeleton.joints[0]).position
        return HandGoal(self.side, add(pelvis, self.place), self.hand_length(body.skeleton, wrist))

    def hand_length(self, skeleton: Skeleton, wrist: Quat) -> float:
        """Return by how much the point of the hand is further than the wrist in line with a straight arm, m."""
        along = unit(Arm.of(skeleton, self.side).lower)
        return max(0.0, dot(rotate(wrist, self.tip), along))

    def _reaching(self, goal: Vec3, body: Body, wrist: Quat) -> tuple[SolvedArm, Quat]:
        """Return the rotations that bring the wrist to a goal in the figure's frame, and that of the hand there."""
        first, elbow, end = (f"{self.side}_{name}" for name in Arm.JOINTS)
        limb, above = Arm.of(body.skeleton, self.side), parent_rotation(first, body)
        way = rotate(conjugate(above), subtract(goal, body.transform(first).position))
        upper, lower = limb.solve(way, self.swivel if self.side == "r" else -self.swivel)
        forearm = multiply(above, multiply(upper, lower))
        turned = self._wrist(forearm, wrist)
        solved = SolvedArm({first: upper, elbow: lower, end: turned}, limb.missed(way), goal)
        return solved, multiply(forearm, turned)

    def _wrist(self, forearm: Quat, wrist: Quat) -> Quat:
        """Return the rotation of the wrist that gives the hand its directions.

        Args:
            forearm: rotation from its axes to the figure's.
            wrist: rotation of a wrist without a direction.
        """
        if not self.directions:
            return wrist
        hand = multiply(forearm, wrist)
        first = self.directions[0]
        hand = multiply(between(rotate(hand, first.axis), first.way), hand)
        if len(self.directions) > 1:
            hand = multiply(turn_about(first.way, hand, self.directions[1]), hand)
        return _bent_at_most(multiply(conjugate(forearm), hand))


def _bent_at_most(wrist: Quat) -> Quat:
    """Return a rotation of a wrist with its bend limited; the forearm takes its twist."""
    about = twist(wrist, _ALONG)
    bend = multiply(wrist, conjugate(about))
    far = angle(bend)
    return wrist if far <= _MOST_BEND else multiply(power(bend, _MOST_BEND / far), about)
