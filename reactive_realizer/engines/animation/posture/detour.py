"""The way of the arms around the body when they go from one pose to another."""

import math
from collections.abc import Generator, Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.clearance import Clear
from reactive_realizer.embodiment.joints import LEGS, SIDES
from reactive_realizer.embodiment.pose import Layer, LayerKind, over
from reactive_realizer.embodiment.quaternion import (
    Quat,
    difference,
    from_euler,
    from_rotation_vector,
    multiply,
    rotation_vector,
    slerp,
)
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, length, scale
from reactive_realizer.engines.animation.posture.foot_planting import planted

_TURNED = {side: (f"{side}_shoulder", f"{side}_elbow") for side in SIDES}

_COARSE, _FINE = (tuple(number / 14 for number in range(first, 14, 2)) for first in (2, 1))
"""Shares of the way at which the arms are looked at first, and once they are clear there."""

_STEPS = 4
"""Steps of the solution; what it leaves, the figure keeps clear of in each frame."""

_FEW_POSES = 10
"""Poses that were looked at after which no further step is made, from the first detour on."""

_LOOK = 70
"""Work of each pose that is looked at, as the limit `planning_per_tick` counts."""

_ENOUGH = 0.03
"""A smaller turn is left to that, rad."""

_MUCH = 0.1
"""A turn that is left over from which on another search begins with arms that are turned otherwise, rad."""

SWING = MappingProxyType(
    {
        "l_shoulder": (-0.8, 0.0, 0.4),
        "r_shoulder": (-0.8, 0.0, -0.4),
        "l_elbow": (-1.0, 0.0, 0.0),
        "r_elbow": (-1.0, 0.0, 0.0),
    }
)
"""A swing of the arms forward and aside, over thighs that rise; Euler angles, rad."""

_RAISED = {joint: scale(angles, 0.6) for joint, angles in SWING.items()}
_SPREAD = {
    "l_shoulder": (0.0, -0.3, 0.3),
    "r_shoulder": (0.0, 0.3, -0.3),
    "l_elbow": (-0.3, 0.0, 0.0),
    "r_elbow": (-0.3, 0.0, 0.0),
}
_OTHERWISE = ((_RAISED, 30, 1.0), (_SPREAD, 60, 0.5))
"""The turns with which these searches begin, as rotation vectors, rad, the poses after which they end, and the share of
the turn left over that their detour may leave over.

Shoulders that turn by almost half a turn on their way cannot be raised further, but spread.
"""

_AWAY = 0.02
"""Distance that they keep from the body on their way, m."""

_LARGEST = (0.01, 0.1, 0.33, 0.6)
"""Weights at which the detour of the goal is largest."""

_PARTS = (1.0, 0.8, 0.6, 0.4, 0.2)
"""Parts of a turn that are tried where the whole one is too much for a joint."""

_ELBOWS = frozenset(f"{side}_elbow" for side in SIDES)

_Turns = Mapping[str, Vec3]

_HALF_A_TURN = math.cos(0.5 * math.radians(172.0))
"""Least product of the rotations between which a joint goes, as quaternions: at 0, it would go the other way round."""


class Detour(NamedTuple):
    """The further turns of joints on the way between two poses.

    Attributes:
        bends: joint -> Euler angles in the axes of the joint above it, rad: how much further it bends midway in any
            case.
        turns: joint of an arm -> rotation vector in its own axes, rad: how much further it turns midway.
    """

    bends: Mapping[str, Vec3] = MappingProxyType({})
    turns: Mapping[str, Vec3] = MappingProxyType({})

    def turned(self, goal: Mapping[str, Quat], weight: float) -> Mapping[str, Quat]:
        """Return the rotations of a goal on the way to it; joints that it does not turn are left out.

        Args:
            goal: rotations.
            weight: of the goal, 0 to 1: the turns that are shown are this share of those of the goal.
        """
        if weight == 1.0:
            return goal
        turned = goal.keys() & (self.bends.keys() | self.turns.keys())
        return {**goal, **{joint: self.turned_joint(joint, goal[joint], weight) for joint in turned}}

    def turned_joint(self, joint: str, goal: Quat, weight: float) -> Quat:
        """Return the rotation of one joint, likewise."""
        if (bend := self.bends.get(joint)) is not None:
            goal = multiply(from_euler(*scale(bend, 4.0 * weight * (1.0 - weight))), goal)
        turn = self.turns.get(joint)
        return goal if turn is None else multiply(goal, from_rotation_vector(scale(turn, _share(weight))))

    def limited(self, begin: Body, goal: Body) -> "Detour":
        """Return the detour, smaller where a joint would go the other way round, or an elbow would bend backward."""
        way = self._replace(bends={}, turns={})
        for joint, bend in self.bends.items():
            smaller = (way._replace(bends={**way.bends, joint: scale(bend, part)}) for part in _PARTS)
            way = next((each for each in smaller if each._fits(joint, begin, goal)), way)
        for joint, turn in self.turns.items():
            smaller = (way._replace(turns={**way.turns, joint: scale(turn, part)}) for part in _PARTS)
            way = next((each for each in smaller if each._fits(joint, begin, goal)), way)
        return way

    def _fits(self, joint: str, begin: Body, goal: Body) -> bool:
        """Return whether a joint turns the same way round as without a detour, and no elbow bends backward."""
        start, end = begin.rotation(joint), goal.rotation(joint)
        same = math.copysign(1.0, _product(start, end))
        ways = [self.turned_joint(joint, end, weight) for weight in _LARGEST]
        if joint in _ELBOWS and max(map(_backward, ways)) > max(0.0, _backward(start), _backward(end)):
            return False
        return all(same * _product(start, way) > _HALF_A_TURN for way in ways)


def find_detour(begin: Body, goal: Body, clear: Clear, first: Detour) -> Generator[int, None, Detour]:
    """Find the detour on which the arms keep clear of the body, as far as one turn of each joint can.

    It takes some milliseconds, so it is done in steps that yield their work, as the limit `planning_per_tick` counts.

    Args:
        begin: the body from which they go.
        goal: the body to which they go, by their weight.
        clear: brings the arms of a body out of its flesh.
        first: the detour that is tried first.
    """
    search = _Search(begin, goal, clear, first)
    yield 2 * _LOOK
    best, left = yield from search.best(first, _FEW_POSES)
    for turns, most, share in _OTHERWISE:
        if left < _MUCH:
            break
        other, still_left = yield from search.best(first._replace(turns=turns).limited(begin, goal), most)
        if still_left < share * left:
            best, left = other, still_left
    return best


class _Search:
    """The search for a detour, in steps."""

    def __init__(self, begin: Body, goal: Body, clear: Clear, first: Detour) -> None:
        self._poses = 0
        self._begin, self._goal, self._clear, self._first = begin, goal, clear, first
        self._stand = all(begin.rotation(joint) == goal.rotation(joint) for joint in LEGS) and begin.root == goal.root
        self._on_first: dict[float, Body] = {}
        self._arms = begin.skeleton.carried(joint for joints in _TURNED.values() for joint in joints)
        self._ends = [self._turns(body) for body in (begin, goal)]

    def best(self, way: Detour, most: int) -> Generator[int, None, tuple[Detour, float]]:
        """Find the best detour, and how far the arms still have to turn on it to be out of flesh, rad.

        Args:
            way: the detour with which the search begins.
            most: poses after which it ends.
        """
        best, least = way, (True, math.inf)
        for _ in range(_STEPS + 1):
            worst, further = yield from self._worst(way, _COARSE)
            if not (rough := bool(worst)):
                worst, further = yield from self._worst(way, _FINE)
            left = rough, max(worst.values(), default=0.0)
            if left < least:
                best, least = way, left
            if not worst or self._poses >= most:
                break
            turns = {joint: add(way.turns.get(joint, ZERO), turn) for joint, turn in further.items()}
            way = way._replace(turns={**way.turns, **turns}).limited(self._begin, self._goal)
        return best, least[1]

    def _worst(
        self, way: Detour, weights: Sequence[float]
    ) -> Generator[int, None, tuple[dict[str, float], dict[str, Vec3]]]:
        """Find how far each arm has to turn to be out of flesh where it is deepest, rad, and the turns of a detour.

        What an arm needs at an end of the way, too, is left out.

        Args:
            way: the detour so far.
            weights: of the goal at which the arms are looked at.
        """
        worst: dict[str, float] = {}
        further: dict[str, Vec3] = {}
        for weight in weights:
            turns = self._turns(self._body(way, weight))
            for side in SIDES if turns else ():
                begin, goal, size = (_size(each, side) for each in (*self._ends, turns))
                beyond = size - (1.0 - weight) * begin - weight * goal
                if beyond > worst.get(side, _ENOUGH):
                    worst[side] = beyond
                    factor = beyond / size / (weight * _share(weight))
                    further |= {joint: scale(turns[joint], factor) for joint in _TURNED[side]}
            yield _LOOK
        return worst, further

    def _body(self, way: Detour, weight: float) -> Body:
        """Return the body on a detour. Its feet step as in a frame: a knee rises with its foot."""
        if (body := self._on_first.get(weight)) is None:
            layer = Layer(LayerKind.POSTURE, self._first.turned(self._goal.pose, weight), weight, root=self._goal.root)
            body = over(self._begin, layer) if self._stand else planted(self._begin, layer)
            self._on_first[weight] = body
        ends = ((joint, self._begin.rotation(joint), self._goal.rotation(joint)) for joint in way.turns)
        turns = {joint: slerp(begin, way.turned_joint(joint, goal, weight), weight) for joint, begin, goal in ends}
        return body.turned(turns, self._arms)

    def _turns(self, body: Body) -> _Turns:
        """Return how the joints of the arms turn to be out of flesh, rad; none if they are."""
        self._poses += 1
        out = self._clear(body, _AWAY)
        if out is body:
            return {}
        joints = (joint for side in SIDES for joint in _TURNED[side])
        return {joint: rotation_vector(difference(body.rotation(joint), out.rotation(joint))) for joint in joints}


def _share(weight: float) -> float:
    """Return how much of the turns is added to a goal: times its weight, it is 0 at both ends, and 1 midway."""
    return 4.0 * (1.0 - weight)


def _backward(elbow: Quat) -> float:
    """Return the angle by which an elbow bends backward, rad; negative if it bends forward."""
    return rotation_vector(elbow)[0]


def _size(turns: _Turns, side: str) -> float:
    return max(length(turns[joint]) for joint in _TURNED[side]) if turns else 0.0


def _product(a: Quat, b: Quat) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]
