"""The pose of neck, head and trunk that meets goals: where the face points, and how the head tilts."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

from reactive_realizer.bml.vocabulary import BodyAxis, BodyGroup, Influence
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import Quat, angle, between, conjugate, multiply, power, rotate
from reactive_realizer.embodiment.vector import UP, Vec3, add, scale
from reactive_realizer.engines.animation.gaze.head_turn import (
    EYE_WEIGHT,
    JOINT_GROUPS,
    HeadTurn,
    default_weights,
    head_turn_toward,
    joint_weights,
)
from reactive_realizer.engines.animation.key_poses.direction import FAR, Direction, Unturned

_HEAD = "skullbase"

_MOST_TILT = math.radians(40.0)
"""Limit of the tilt of a head: sideways bend of a healthy neck."""

HEAD_AXES: Final[Mapping[BodyAxis, Vec3]] = MappingProxyType(
    {BodyAxis.FACE: (0.0, 0.0, 1.0), BodyAxis.CROWN: UP, BodyAxis.LEFT_EAR: (1.0, 0.0, 0.0)}
)
"""The axes of a head in the axes of its joint."""

WEIGHTS: Final[Mapping[BodyGroup, Mapping[str, float]]] = MappingProxyType(
    {
        BodyGroup.HEAD: {**dict.fromkeys(JOINT_GROUPS, 0.0), "head": 1.0},
        BodyGroup.HEAD_NECK: default_weights(Influence.HEAD),
        BodyGroup.HEAD_CHEST: default_weights(Influence.SHOULDER),
        BodyGroup.HEAD_BACK: default_weights(Influence.WAIST),
    }
)
"""Shares of the joints in a turn of the head, by group."""


@dataclass(frozen=True, slots=True)
class HeadPose:
    """The goals of a head.

    Attributes:
        group: of the joints that take part.
        place: that it looks at, from the pelvis, in the figure's axes, m; None if there is none.
        directions: of axes of the head; that of its face is without effect if it looks at a place.
    """

    group: BodyGroup
    place: Vec3 | None = None
    directions: tuple[Direction, ...] = ()

    @property
    def joints(self) -> tuple[str, ...]:
        """The joints that it turns."""
        return tuple({**joint_weights(WEIGHTS[self.group]), _HEAD: 1.0})

    def solve(self, body: Body, rest: Mapping[str, Quat]) -> dict[str, Quat]:
        """Return the rotations of its joints, local to their parents.

        Args:
            body: as it is; its rotations of these joints have no effect.
            rest: rotations of these joints without goals.
        """
        here = {joint: rest[joint] for joint in self.joints if joint in rest}
        turned = self._turned(body, rest)
        if turned is not None:
            here |= turned.rotations
        for each in self.directions:
            if each.axis != HEAD_AXES[BodyAxis.FACE]:
                here[_HEAD] = _tilted(body.posed(here), each)
        return here

    def unturned(self, body: Body, rest: Mapping[str, Quat]) -> Iterator[Unturned]:
        """Yield by how much the face falls short of what it looks at, or else the head of its first direction."""
        turned = self._turned(body, rest)
        if turned is not None and turned.missing is not None:
            yield Unturned(_HEAD, turned.missing)
        elif turned is None and self.directions:
            yield Unturned(_HEAD, self.directions[0].left(body.transform(_HEAD).rotation))

    def _turned(self, body: Body, rest: Mapping[str, Quat]) -> HeadTurn | None:
        """Return the turn of the face to where it looks; None if it looks nowhere."""
        faced = [each.way for each in self.directions if each.axis == HEAD_AXES[BodyAxis.FACE]]
        if self.place is None and not faced:
            return None

        def point(eyes: Vec3) -> Vec3:
            if self.place is None:
                return add(eyes, scale(faced[0], FAR))
            return add(body.transform(body.skeleton.joints[0]).position, self.place)

        return head_turn_toward(body, rest, point, {**WEIGHTS[self.group], EYE_WEIGHT: 0.0})


def _tilted(body: Body, direction: Direction) -> Quat:
    """Return the rotation of the head after the shortest turn that gives it a direction, within its limit."""
    head = body.transform(_HEAD).rotation
    turn = between(rotate(head, direction.axis), direction.way)
    far = angle(turn)
    turn = turn if far <= _MOST_TILT else power(turn, _MOST_TILT / far)
    above = multiply(head, conjugate(body.rotation(_HEAD)))
    return multiply(conjugate(above), multiply(turn, head))
