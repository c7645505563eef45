"""Inertialization: joints have a new goal at once, and their offset from it decays.

D. Bollo, "Inertialization: high-performance animation transitions in Gears of War" (GDC 2018): no two motions are
blended. Whatever replaces a motion, the figure goes on with the rotation, velocity and acceleration that it had, and
the difference from the new motion decays as a polynomial of degree 5, which is the path of minimum jerk (T. Flash and
N. Hogan, 1985).
"""

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, JointRotations, Skeleton
from reactive_realizer.embodiment.joints import EYES, LOWER_BODY
from reactive_realizer.embodiment.quaternion import (
    IDENTITY,
    Quat,
    angle,
    difference,
    from_rotation_vector,
    multiply,
    rotation_vector,
)
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, length, scale, subtract

CARRIED = 0.4
"""Longest time in which the velocity of an offset decays, s: it is 0 after a third of that."""

_LONGEST_PUSH = 0.2
"""Longest time in which its acceleration decays, s."""

_HARDEST = 200.0
"""Limit of this acceleration, rad/s²; more comes from a speed limit rather than from a motion."""

_NEAR = 2e-3
"""A joint that comes so near to its goal within a frame follows it, rad."""

_GAP = 0.1
"""After a longer time without a frame, the velocity is unknown, s."""


def remaining(t: float) -> float:
    """Return the remaining share of an offset after a share of its time, 0 to 1: it starts and ends at rest."""
    return 1.0 - t * t * t * (10.0 + t * (6.0 * t - 15.0))


def carried(t: float) -> float:
    """Return the way on which a velocity of 1 carries, after a share of the time in which it decays, 0 to 1."""
    rest = 1.0 - t
    return t * rest * rest * rest * (1.0 + 3.0 * t)


def _pushed(t: float) -> float:
    """Return the way on which an acceleration of 1 carries, after a share of the time in which it decays, 0 to 1."""
    rest = 1.0 - t
    return 0.5 * t * t * rest * rest * rest


class Offset(NamedTuple):
    """The offset of a joint from its goal: a rotation vector in the axes of the goal.

    Attributes:
        since: time of its beginning, s.
        until: time from which on it is 0, s.
        turn: at the beginning, rad.
        velocity: at the beginning, rad/s.
        acceleration: at the beginning, rad/s².
    """

    since: GlobalTime
    until: GlobalTime
    turn: Vec3
    velocity: Vec3
    acceleration: Vec3

    def at(self, now: GlobalTime) -> Vec3:
        """Return the offset at a time, rad."""
        passed, whole = now - self.since, self.until - self.since
        if passed >= whole:
            return ZERO
        carry, push = min(0.6 * whole, CARRIED), min(0.6 * whole, _LONGEST_PUSH)
        turn = scale(self.turn, remaining(passed / whole))
        if passed < carry:
            turn = add(turn, scale(self.velocity, carry * carried(passed / carry)))
        if passed < push:
            turn = add(turn, scale(self.acceleration, push * push * _pushed(passed / push)))
        return turn


class _Sample(NamedTuple):
    """A pose at a time, s. A body would keep its transforms alive, too."""

    time: GlobalTime
    pose: JointRotations


class Inertialization:
    """Lets the joints of a figure follow their goals without a jump, wherever their motions say that they switch.

    A switch is told, never guessed from the movement. Legs, root and eyes are left out: feet are planted, and eyes look
    for themselves.
    """

    def __init__(self, skeleton: Skeleton) -> None:
        """Inertialize the joints of a skeleton."""
        self._switches: dict[str, GlobalTime] = {}
        # Joints that went over to another goal in the last frame: its velocity is known only now.
        self._fresh: dict[str, GlobalTime] = {}
        self._offsets: dict[str, Offset] = {}
        self._turns: dict[str, Quat] = {}
        self._shown: tuple[_Sample, ...] = ()
        self._goal = Body(skeleton)

    def switch(self, joints: Iterable[str], until: GlobalTime) -> None:
        """Expect another motion of some joints in the next frame; a later call for a joint replaces an earlier one.

        Args:
            joints: joints of any body.
            until: time from which on they follow it, s.
        """
        self._switches.update(dict.fromkeys(joints, until))

    def __call__(self, goal: Body, now: GlobalTime) -> Body:
        """Return the body to show for a goal at a time."""
        if self._shown:
            self._note_switches(goal, now)
        self._switches, self._goal = {}, goal
        self._offsets = {joint: offset for joint, offset in self._offsets.items() if offset.until > now}
        self._turns = {joint: from_rotation_vector(offset.at(now)) for joint, offset in self._offsets.items()}
        return self.offset(goal)

    def offset(self, body: Body) -> Body:
        """Return a body with the present offsets of its joints."""
        if not self._turns:
            return body
        return body.posed({joint: multiply(body.rotation(joint), turn) for joint, turn in self._turns.items()})

    def note_shown(self, body: Body, now: GlobalTime) -> None:
        """Note what was shown in the end: limits of speed, or forces, may have changed it."""
        self._shown = (_Sample(now, body.pose), *self._shown[:2])

    def _note_switches(self, goal: Body, now: GlobalTime) -> None:
        for joint, until in self._fresh.items():
            self._set_offset(joint, until, (self._goal, goal), now)
        for joint, until in self._switches.items():
            self._set_offset(joint, until, (goal, goal), now)
        self._fresh = {joint: until for joint, until in self._switches.items() if self._moves(joint)}

    def _moves(self, joint: str) -> bool:
        """Return whether a joint has an offset, or moved in the last frame: a motion that begins at rest has none."""
        last, *before = (each.pose.get(joint, IDENTITY) for each in self._shown)
        return joint in self._offsets or any(angle(difference(turn, last)) > _NEAR for turn in before[:1])

    def _set_offset(self, joint: str, until: GlobalTime, goals: tuple[Body, Body], now: GlobalTime) -> None:
        """Set the offset of a joint since the last frame, unless it is negligible.

        Args:
            joint: its name.
            until: time from which on it is 0, s.
            goals: at the time of the last frame, and now.
            now: time of the present frame, s.
        """
        self._offsets.pop(joint, None)
        last = self._shown[0].time
        if until <= last or joint in _LEFT_OUT or joint not in goals[1].pose:
            return
        was, goes = (body.rotation(joint) for body in goals)
        recent = [each for each in self._shown if now - each.time <= _GAP] or self._shown[:1]
        turns = [(each.time, each.pose.get(joint, IDENTITY)) for each in recent]
        if was == goes and all(turn == goes for _, turn in turns):
            return
        turn, velocity, acceleration = _derivatives(_turns(was, goes, turns, now))
        passed = now - last
        further = add(scale(velocity, passed), scale(acceleration, 0.5 * passed * passed))
        # How fast another goal moves is seen in the next frame.
        follows = goals[0] is goals[1] or length(further) < _NEAR
        if not follows or length(add(turn, further)) >= _NEAR:
            self._offsets[joint] = Offset(last, until, turn, velocity, acceleration)


_LEFT_OUT = frozenset((*LOWER_BODY, *EYES))

_Turn = tuple[GlobalTime, Vec3]


def _turns(was: Quat, goes: Quat, shown: Sequence[tuple[GlobalTime, Quat]], now: GlobalTime) -> list[_Turn]:
    """Return the turns from a goal to the rotations shown in some frames, the latest first.

    Args:
        was: the goal in the last of these frames; it has moved as fast before as it does now.
        goes: the goal now.
        shown: time of each frame, s, and the rotation shown.
        now: s.
    """
    last = shown[0][0]
    step = rotation_vector(difference(was, goes))
    turns: list[Quat] = []
    for time, turn in shown:
        before = multiply(was, from_rotation_vector(scale(step, (time - last) / (now - last))))
        turns.append(_nearer(difference(before, turn), turns[-1] if turns else IDENTITY))
    return [(time, _long_rotation_vector(turn)) for (time, _), turn in zip(shown, turns, strict=True)]


def _nearer(turn: Quat, other: Quat) -> Quat:
    """Return a quaternion or its negative, which is the same turn the other way round: the one nearer to another."""
    cosine = turn[0] * other[0] + turn[1] * other[1] + turn[2] * other[2] + turn[3] * other[3]
    return turn if cosine >= 0.0 else (-turn[0], -turn[1], -turn[2], -turn[3])


def _long_rotation_vector(turn: Quat) -> Vec3:
    """Return the axis of a turn, scaled to its angle, rad: from 0 to 2 pi, where `rotation_vector` goes to pi."""
    if turn[0] >= 0.0:
        return rotation_vector(turn)
    short = rotation_vector(turn)
    size = length(short)
    return scale(short, 1.0 - 2.0 * math.pi / size)


def _derivatives(turns: Sequence[_Turn]) -> tuple[Vec3, Vec3, Vec3]:
    """Return the last of up to three turns, with its velocity and acceleration, as far as they are known."""
    (last, turn), *others = turns
    if not others:
        return turn, ZERO, ZERO
    (middle, before), *first = others
    later = scale(subtract(turn, before), 1.0 / (last - middle))
    if not first:
        return turn, later, ZERO
    sooner = scale(subtract(before, first[0][1]), 1.0 / (middle - first[0][0]))
    acceleration = scale(subtract(later, sooner), 2.0 / (last - first[0][0]))
    hardest = length(acceleration)
    if hardest > _HARDEST:
        acceleration = scale(acceleration, _HARDEST / hardest)
    # A mean velocity is the velocity at the middle of its interval.
    return turn, add(later, scale(acceleration, 0.5 * (last - middle))), acceleration
