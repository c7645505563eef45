"""The pose of a trunk and of shoulders that have directions."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

from reactive_realizer.bml.vocabulary import BodyAxis
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.quaternion import Quat, angle, between, conjugate, multiply, power, rotate
from reactive_realizer.embodiment.vector import FORWARD, UP, Vec3, unit
from reactive_realizer.engines.animation.key_poses.direction import Direction, Unturned, turn_about
from reactive_realizer.engines.animation.spine_ik import turned_spine

TRUNK_AXES: Final[Mapping[BodyAxis, Vec3]] = MappingProxyType(
    {BodyAxis.CHEST: FORWARD, BodyAxis.SPINE: UP, BodyAxis.LEFT_SIDE: (1.0, 0.0, 0.0)}
)
"""The axes of a trunk in the axes of each of its joints."""

_MOST_OF_SHOULDER: Final = math.radians(30.0)
"""Limit of the turn of a collarbone: its elevation in healthy shoulders (American Academy of Orthopaedic Surgeons,
"Joint motion", 1965: 40 degrees, with the scapula)."""


@dataclass(frozen=True, slots=True)
class TrunkPose:
    """The goals of a trunk.

    Attributes:
        spine: the joints of the trunk that turn, from the lowest one up.
        directions: of joints of the spine, from the lowest one up. The first of a joint is met, as far as the spine
            allows, and its second one as nearly as that allows; others have no effect.
    """

    spine: tuple[str, ...]
    directions: Mapping[str, tuple[Direction, ...]]

    @property
    def joints(self) -> tuple[str, ...]:
        """The joints that it turns."""
        return self.spine[: 1 + max(map(self.spine.index, self.directions))]

    def solve(self, body: Body, rest: Mapping[str, Quat]) -> dict[str, Quat]:
        """Return the rotations of its joints, local to their parents.

        Args:
            body: as it is; its rotations of these joints have no effect.
            rest: rotations of these joints without goals.
        """
        posed = body.posed({joint: rest[joint] for joint in self.joints})
        free: Sequence[str] = self.joints
        for joint, directions in self.directions.items():
            own, free = _split(free, joint)
            turn = _turn(posed.transform(joint).rotation, directions)
            posed = turned_spine(posed, own, joint, multiply(turn, posed.transform(joint).rotation))
        return {joint: posed.rotation(joint) for joint in self.joints}

    def unturned(self, body: Body, rest: Mapping[str, Quat]) -> Iterator[Unturned]:
        """Yield by how much joints fall short of their first directions in a body that has the pose."""
        for joint, (first, *_) in self.directions.items():
            yield Unturned(joint, first.left(body.transform(joint).rotation))


def _split(joints: Sequence[str], last: str) -> tuple[Sequence[str], Sequence[str]]:
    """Split joints behind one of them."""
    number = 1 + joints.index(last)
    return joints[:number], joints[number:]


def _turn(rotation: Quat, directions: Sequence[Direction]) -> Quat:
    """Return the turn, in the figure's axes, after which the first direction is met, and the second one nearly."""
    first = directions[0]
    turn = between(rotate(rotation, first.axis), first.way)
    if len(directions) > 1:
        turn = multiply(turn_about(first.way, multiply(turn, rotation), directions[1]), turn)
    return turn


def shoulder_axis(side: str, skeleton: Skeleton) -> Vec3:
    """Return the direction of a collarbone in its own axes, a unit vector."""
    return unit(skeleton.offset(f"{side}_shoulder"))


@dataclass(frozen=True, slots=True)
class ShoulderPose:
    """The goals of shoulders.

    Attributes:
        ways: side, "l" or "r" -> direction of the collarbone, in the figure's axes, a unit vector.
    """

    ways: Mapping[str, Vec3]

    @property
    def joints(self) -> tuple[str, ...]:
        """The joints that it turns."""
        return tuple(f"{side}_sternoclavicular" for side in self.ways)

    def solve(self, body: Body, rest: Mapping[str, Quat]) -> dict[str, Quat]:
        """Return the rotations of its joints, local to their parents, as near to the directions as they can be.

        Args:
            body: as it is; its rotations of these joints have no effect.
            rest: rotations of these joints without goals.
        """
        return {f"{side}_sternoclavicular": self._turned(side, way, body, rest) for side, way in self.ways.items()}

    def unturned(self, body: Body, rest: Mapping[str, Quat]) -> Iterator[Unturned]:
        """Yield by how much collarbones fall short of their directions in a body that has the pose."""
        for side, way in self.ways.items():
            joint = f"{side}_sternoclavicular"
            direction = Direction(shoulder_axis(side, body.skeleton), way)
            yield Unturned(joint, direction.left(body.transform(joint).rotation))

    def _turned(self, side: str, way: Vec3, body: Body, rest: Mapping[str, Quat]) -> Quat:
        joint = f"{side}_sternoclavicular"
        above = multiply(body.transform(joint).rotation, conjugate(body.rotation(joint)))
        now = rotate(rest[joint], shoulder_axis(side, body.skeleton))
        turn = between(now, rotate(conjugate(above), way))
        far = angle(turn)
        return multiply(turn if far <= _MOST_OF_SHOULDER else power(turn, _MOST_OF_SHOULDER / far), rest[joint])
