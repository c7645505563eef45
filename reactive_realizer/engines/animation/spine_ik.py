"""Inverse kinematics of the spine: how a trunk turns, and leans where an arm does not reach. Functions are pure.

The joints of the spine bring the shoulder nearer by damped least squares (C. Wampler, "Manipulator inverse kinematic
solutions based on vector formulations and damped least-squares methods", IEEE Transactions on Systems, Man, and
Cybernetics 16, 1986), each by its mobility; the arm does the rest in closed form (`two_bone_ik`). The pelvis stays.
"""

from collections.abc import Iterable, Mapping, Sequence
from itertools import product
from math import prod, radians
from typing import Final, NamedTuple

import numpy as np

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.quaternion import (
    Quat,
    conjugate,
    difference,
    from_rotation_vector,
    multiply,
    rotate,
    rotation_vector,
)
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, cross, distance, length, scale, subtract, unit
from reactive_realizer.engines.animation.easing import share, smoothstep

Range = tuple[float, float]


def _degrees(low: float, high: float) -> Range:
    return radians(low), radians(high)


SPINE_RANGES: Final[Mapping[str, tuple[Range, Range, Range]]] = {
    "vl5": (_degrees(-8.0, 40.0), _degrees(-10.0, 10.0), _degrees(-14.0, 14.0)),
    "vt10": (_degrees(-6.0, 25.0), _degrees(-16.0, 16.0), _degrees(-9.0, 9.0)),
    "vt6": (_degrees(-6.0, 15.0), _degrees(-14.0, 14.0), _degrees(-7.0, 7.0)),
}
"""Least and greatest bow, turn to the left and bend to the right of each joint of the spine, rad.

Together they stay within what is usual of thoracic and lumbar spine: 80 degrees of flexion, 20 of extension, 45 of
rotation and 35 of lateral bending each way (American Academy of Orthopaedic Surgeons, "Joint motion", 1965). Their
shares are ours: lumbar vertebrae hardly turn.
"""

_STEPS: Final = 12
"""Steps of the solution."""

_LONGEST_STEP: Final = 0.1
"""Limit of the distance that a step covers, m: beyond what the joints allow, longer ones would not settle."""

_DAMPING: Final = 0.1
"""Of the solution, m: without leverage, the trunk does not move."""

_NEAR: Final = 1e-4
"""Distance that need not be covered, m."""

_GIVEN_UP: Final = (0.1, 0.3)
"""Distances that are left even with the trunk, m: up to the first one, it leans as far as it can, from the second one
on, not at all."""


_STRAIGHT: Final = 1e-3
"""Turn that need not be made, rad."""

_STIFFNESS: Final = 1e-4
"""Of turns about axes that no joint has, rad^2."""

_AXES: Final[tuple[Vec3, Vec3, Vec3]] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


class HandGoal(NamedTuple):
    """A place to which a motion brings a point of a hand.

    Attributes:
        side: "l" or "r".
        place: in the figure's frame, m.
        hand: by how much that point is further than the wrist in line with a straight arm, m.
        share: by which the trunk makes up for what the arm does not reach, 0 to 1: on the way there, it increases.
    """

    side: str
    place: Vec3
    hand: float = 0.0
    share: float = 1.0


class _Approach(NamedTuple):
    """How near a shoulder is to come to a place.

    Attributes:
        side: "l" or "r".
        place: in the figure's frame, m.
        distance: from the shoulder, m.
    """

    side: str
    place: Vec3
    distance: float

    @classmethod
    def of(cls, goal: HandGoal, skeleton: Skeleton) -> "_Approach":
        """Return the approach after which an arm reaches a goal."""
        return cls(goal.side, goal.place, Arm.of(skeleton, goal.side).reach + goal.hand)

    def left(self, body: Body) -> float:
        """Return by how much a shoulder is too far away, m; negative if it is nearer."""
        return distance(body.transform(f"{self.side}_shoulder").position, self.place) - self.distance

    def levers(self, body: Body, joints: Iterable[str]) -> list[Vec3]:
        """Return by how much turns of joints about their own axes bring the shoulder nearer, m/rad."""
        shoulder = body.transform(f"{self.side}_shoulder").position
        way = unit(subtract(self.place, shoulder))
        places = (body.transform(joint) for joint in joints)
        return [rotate(conjugate(rotation), cross(subtract(shoulder, position), way)) for position, rotation in places]


class Reached(NamedTuple):
    """How far a hand gets.

    Attributes:
        far: distance by which it falls short of its goal while the trunk is upright, m.
        left: the same with a trunk that leans for it as far as it can, m.
        leant: the body then.
    """

    far: float
    left: float
    leant: Body

    @classmethod
    def of(cls, body: Body, goal: HandGoal) -> "Reached":
        """Return how far a hand of a body gets that does not lean."""
        approach = _Approach.of(goal, body.skeleton)
        leant = _leant(body, [approach])
        return cls(max(0.0, approach.left(body)), max(0.0, approach.left(leant)), leant)

    @property
    def help(self) -> float:
        """The share of its lean that the trunk makes, 0 to 1: none if the place would still be far out of reach."""
        return 1.0 - smoothstep(share(self.left, *_GIVEN_UP)) if self.far > 0.0 else 0.0

    @property
    def missing(self) -> float:
        """The distance that remains, m."""
        return self.far + self.help * (self.left - self.far)


def leant(body: Body, goals: Sequence[HandGoal]) -> Body:
    """Return a body whose trunk leans for the goals of its hands; the same body if its arms reach them."""
    options = [_options((goal for goal in goals if goal.side == side), body) for side in SIDES]
    return _blended(options, body) if any(options) else body


class _Option(NamedTuple):
    """A lean for one hand.

    Attributes:
        weight: its share in the lean of the trunk, 0 to 1.
        approach: None for a hand that needs no lean.
        leant: the body after this approach alone.
    """

    weight: float
    approach: _Approach | None
    leant: Body


def _options(goals: Iterable[HandGoal], body: Body) -> list[_Option]:
    """Return the leans for the goals of a hand that its arm does not reach."""
    options = []
    for goal in goals:
        reached = Reached.of(body, goal)
        if goal.share * reached.help > 0.0:
            options.append(_Option(goal.share * reached.help, _Approach.of(goal, body.skeleton), reached.leant))
    return options


def _blended(hands: Iterable[Sequence[_Option]], body: Body) -> Body:
    """Return a body that leans for all hands: a mean of the leans for each combination of their goals, by weight."""
    turned = dict.fromkeys((joint for joint in SPINE_RANGES if joint in body.skeleton), ZERO)
    complete = [(*own, _Option(1.0 - sum(option.weight for option in own), None, body)) for own in hands]
    for combination in product(*complete):
        weight = prod(option.weight for option in combination)
        alone = [option.leant for option in combination if option.approach is not None]
        if weight > 0.0 and alone:
            approaches = [option.approach for option in combination if option.approach is not None]
            leant = alone[0] if len(alone) == 1 else _leant(body, approaches)
            for joint in turned:
                way = rotation_vector(difference(body.rotation(joint), leant.rotation(joint)))
                turned[joint] = add(turned[joint], scale(way, weight))
    return body.posed(
        {joint: multiply(body.rotation(joint), from_rotation_vector(way)) for joint, way in turned.items()}
    )


def _leant(body: Body, approaches: Sequence[_Approach]) -> Body:
    """Return a body whose spine brings its shoulders as near to places as asked, as far as its joints allow."""
    leant = body
    for _ in range(_STEPS):
        left = [each for each in approaches if each.left(leant) > _NEAR]
        if not left:
            break
        leant = leant.posed(_step(leant, body, left))
    return leant


def _step(leant: Body, upright: Body, approaches: Sequence[_Approach]) -> dict[str, Quat]:
    """Return the rotations of the spine after one step of damped least squares, weighted by the joints' mobility."""
    joints = [joint for joint in SPINE_RANGES if joint in leant.skeleton]
    mobility = np.ravel([[(0.5 * (high - low)) ** 2 for low, high in SPINE_RANGES[joint]] for joint in joints])
    levers = np.array([np.ravel(each.levers(leant, joints)) for each in approaches])
    gains = levers * mobility @ levers.T + _DAMPING * _DAMPING * np.eye(len(approaches))
    left = [min(each.left(leant), _LONGEST_STEP) for each in approaches]
    turns = mobility * (np.linalg.solve(gains, left) @ levers)
    rotations = {}
    for joint, (x, y, z) in zip(joints, turns.reshape(-1, 3).tolist(), strict=True):
        rotations[joint] = _limited(multiply(leant.rotation(joint), from_rotation_vector((x, y, z))), joint, upright)
    return rotations


def turned_spine(body: Body, joints: Sequence[str], top: str, rotation: Quat) -> Body:
    """Return a body with the uppermost of some joints of the spine turned as asked, as far as they allow.

    Args:
        body: without the turn.
        joints: that take part, each by its mobility.
        top: the uppermost of them.
        rotation: of the top, from its axes to the figure's.
    """
    turned = body
    for _ in range(_STEPS):
        left = rotation_vector(multiply(rotation, conjugate(turned.transform(top).rotation)))
        if length(left) < _STRAIGHT:
            break
        turned = turned.posed(_turning(turned, body, joints, left))
    return turned


def _turning(turned: Body, upright: Body, joints: Sequence[str], left: Vec3) -> dict[str, Quat]:
    """Return the rotations of the spine after one step of weighted least squares toward a turn, rad, of the top."""
    mobility = np.ravel([[(0.5 * (high - low)) ** 2 for low, high in SPINE_RANGES[joint]] for joint in joints])
    axes = np.hstack([np.transpose([rotate(turned.transform(j).rotation, axis) for axis in _AXES]) for j in joints])
    turns = mobility * (np.linalg.solve(axes * mobility @ axes.T + _STIFFNESS * np.eye(3), left) @ axes)
    rotations = {}
    for joint, (x, y, z) in zip(joints, turns.reshape(-1, 3).tolist(), strict=True):
        rotations[joint] = _limited(multiply(turned.rotation(joint), from_rotation_vector((x, y, z))), joint, upright)
    return rotations


def _limited(rotation: Quat, joint: str, upright: Body) -> Quat:
    """Return a rotation of a joint within its ranges, or within that of the body that does not lean."""
    now, given = rotation_vector(rotation), rotation_vector(upright.rotation(joint))
    x, y, z = (
        min(max(value, min(low, own)), max(high, own))
        for value, own, (low, high) in zip(now, given, SPINE_RANGES[joint], strict=True)
    )
    return from_rotation_vector((x, y, z))
