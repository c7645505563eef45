"""Limits how fast the figure moves, as a last safeguard against jumps."""

import math
from collections.abc import Collection
from functools import lru_cache

from reactive_realizer.embodiment.body import Body, JointRotations
from reactive_realizer.embodiment.feet import depth, drawn, feet, leg, soles, walks
from reactive_realizer.embodiment.joints import EYES, HEAD, LOWER_BODY, ROOT, SIDES, TRUNK
from reactive_realizer.embodiment.posed_arm import brought
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, angle, conjugate, difference, rotate, slerp
from reactive_realizer.embodiment.vector import UP, ZERO, Vec3, add, distance, dot, length, scale, subtract

WRIST_SPEED = 2.4
"""Limit for each wrist relative to the root, m/s: less than 5 cm in 20 ms. Conversational gestures stay below 2 m/s."""

WRIST_ACCELERATION = 37.5
"""Limit for each wrist that starts or turns back, m/s^2: 1.5 cm more in each 20 ms than in the 20 ms before."""

WRIST_BRAKE = 50.0
"""Limit for each wrist that has fallen behind and catches up, m/s^2: it slows down before it arrives."""

WRIST_SWERVE = 55.0
"""Limit for the change of the velocity of each wrist in the figure's frame, m/s^2: one that turns back or aside is
carried on for a while."""

_JOINT_BRAKE = 200.0
"""Limit for the turn of each joint that has fallen behind and catches up, rad/s^2."""

ROOT_SPEED = 2.0
"""Limit for the root, m/s: a brisk walk. Sitting down and standing up stay below 1 m/s."""

# Peak velocities, rad/s: the trunk in a lively turn; the neck in a fast voluntary turn; the eye in a saccade, 9 to 12
# (the thesis, 4.2.2, has a plateau of 8.7); an elbow in a throw, above 20, in conversation far below. A wrist could be
# as fast, but it adds to the motion of the fingertips: at this limit they move 3 cm in 20 ms.
_TRUNK = 4.0
_NECK = 8.0
_EYE = 16.0
_LIMB = 15.0
_WRIST = 8.0
_WRISTS = ("l_wrist", "r_wrist")
_SPEEDS = {
    **dict.fromkeys(TRUNK, _TRUNK),
    **dict.fromkeys(HEAD, _NECK),
    **dict.fromkeys(EYES, _EYE),
    **dict.fromkeys(_WRISTS, _WRIST),
}
_BEHIND = 1e-3
"""A wrist nearer than this to where it is wanted follows it, m."""

_ALL_SPEEDS = frozenset((_LIMB, *_SPEEDS.values()))
_SLOWEST = min(_ALL_SPEEDS)


def fastest(joint: str) -> float:
    """Return the limit for a joint, rad/s."""
    return _SPEEDS.get(joint, _LIMB)


def slowed(shown: JointRotations, wanted: JointRotations, duration: float) -> dict[str, Quat]:
    """Return rotations that turn no faster than their limits.

    Args:
        shown: the pose shown last.
        wanted: the requested rotations of some joints.
        duration: between the two, s, more than 0.
    """
    return {**wanted, **_held_back(shown, wanted, duration)}


def _held_back(shown: JointRotations, wanted: JointRotations, duration: float) -> dict[str, Quat]:
    """Return the rotations of the joints that would turn faster than their limits."""
    within = _within(duration)
    slowest = within[_SLOWEST]
    return {
        joint: _toward(start, goal, fastest(joint) * duration)
        for joint, goal in wanted.items()
        # Most joints stay as they are, as the same tuple, or turn by less than any limit.
        if (start := shown.get(joint, IDENTITY)) is not goal
        and (same := abs(start[0] * goal[0] + start[1] * goal[1] + start[2] * goal[2] + start[3] * goal[3])) < slowest
        and same < within[_SPEEDS.get(joint, _LIMB)]
    }


@lru_cache(16)  # nearly all frames are equally long
def _within(duration: float) -> dict[float, float]:
    """Return, for each speed limit, the least product of rotations that are no further apart than it allows."""
    return {speed: math.cos(0.5 * speed * duration) for speed in _ALL_SPEEDS}


class SpeedLimit:
    """Keeps each shown body within reach of the one before.

    No joint turns faster than its limit, no wrist moves faster than `WRIST_SPEED` or accelerates more than
    `WRIST_ACCELERATION`, and the root moves no faster than `ROOT_SPEED`. A faster pose is followed as fast as that
    allows; ordinary motion is not affected. What has fallen behind slows down before it arrives, by `WRIST_BRAKE` or
    `_JOINT_BRAKE`, so it does not overshoot. A wrist that should turn aside or back at once is carried on, so that its
    velocity changes by no more than `WRIST_SWERVE`.

    If legs and root were limited separately, the feet would leave their places and go below the ground. So the knees
    bend or stretch for a root that lags behind; what they cannot compensate raises the figure, within the limit of the
    root.
    """

    def __init__(self, shown: Body) -> None:
        """Start with the first body that is shown."""
        self._shown = shown
        self._default = dict.fromkeys(shown.skeleton.joints, IDENTITY)
        self._arms = {wrist: shown.skeleton.chain(wrist)[:-1] for wrist in _WRISTS}
        self._goal = shown
        self._places = {wrist: _from_root(wrist, shown) for wrist in _WRISTS}
        self._velocities: dict[str, Vec3] = dict.fromkeys(_WRISTS, ZERO)
        self._courses = {joint: (shown.transform(joint).position, ZERO) for joint in (ROOT, *_WRISTS)}
        self._upper = [joint for joint in shown.skeleton.joints if joint not in LOWER_BODY and joint not in EYES]
        self._soles = soles(shown.skeleton)
        self._walks = walks(shown.skeleton)

    def release(self, wanted: Body, joints: Collection[str]) -> None:
        """Let joints, and the root if it is one of them, be at once where they are wanted, when they are shown next."""
        root = wanted.root if ROOT in joints else self._shown.root
        released = {joint: wanted.rotation(joint) for joint in joints}
        behind = self._shown is not self._goal
        self._shown = self._shown.posed(released, root)
        self._goal = self._goal.posed(released) if behind else self._shown
        self._places = {wrist: _from_root(wrist, self._shown) for wrist in _WRISTS}
        self._courses = {
            joint: (self._shown.transform(joint).position, velocity) for joint, (_, velocity) in self._courses.items()
        }

    def __call__(self, wanted: Body, duration: float) -> Body:
        """Return the body to show now.

        Args:
            wanted: the requested body.
            duration: since the last body was shown, s, more than 0.
        """
        if len(wanted.pose) < len(self._default):
            wanted = Body(wanted.skeleton, {**self._default, **wanted.pose}, wanted.root)
        turns = _held_back(self._shown.pose, wanted.pose, duration) | self._braking(wanted, duration)
        root = self._root(wanted.root, duration)
        # Nothing is held back in most frames: then the same body is shown, with the transforms that it knows.
        body = wanted.posed(turns, root) if turns or root is not wanted.root else wanted
        # The wrists share the trunk, so slowing one may change the other: repeat until both are within their limits.
        while (hasty := self._hasty(body, wanted, duration)) is not None:
            wrist, fraction = hasty
            body = body.posed(
                {j: slerp(self._shown.rotation(j), body.rotation(j), fraction) for j in self._arms[wrist]}
            )
        for side, wrist in zip(SIDES, _WRISTS, strict=True):
            body = self._carried_on(side, wrist, body, duration)
        body = self._on_its_feet(body, wanted, duration)
        places = {wrist: _from_root(wrist, body) for wrist in _WRISTS}
        self._velocities = {w: scale(subtract(at, self._places[w]), 1.0 / duration) for w, at in places.items()}
        self._courses = {joint: self._course(joint, body, duration) for joint in self._courses}
        self._places, self._shown, self._goal = places, body, wanted
        return body

    def _course(self, joint: str, body: Body, duration: float) -> tuple[Vec3, Vec3]:
        """Return the position of a joint in the figure's frame, m, and its velocity, m/s."""
        place, (before, _) = body.transform(joint).position, self._courses[joint]
        return place, scale(subtract(place, before), 1.0 / duration)

    def _swerve(self, joint: str, body: Body, duration: float) -> Vec3:
        """Return how far a joint is from where its velocity would have taken it, m."""
        before, velocity = self._courses[joint]
        return subtract(body.transform(joint).position, add(before, scale(velocity, duration)))

    def _braking(self, wanted: Body, duration: float) -> dict[str, Quat]:
        """Return rotations of the joints that have fallen behind, and would stop abruptly where they are wanted."""
        if self._shown is self._goal:
            return {}
        turns, shown, goals = {}, self._shown.pose, self._goal.pose
        for joint in self._upper:
            start, before, goal = shown.get(joint, IDENTITY), goals.get(joint, IDENTITY), wanted.rotation(joint)
            if start is before or start is goal:
                continue
            gap = angle(difference(start, goal))
            reach = _catching_up(gap, angle(difference(before, goal)), _JOINT_BRAKE, duration)
            if gap > (furthest := min(reach, fastest(joint) * duration)):
                turns[joint] = slerp(start, goal, furthest / gap)
        return turns

    def _hasty(self, body: Body, wanted: Body, duration: float) -> tuple[str, float] | None:
        """Return a wrist that would move too far, and the factor for the turns of the joints above it."""
        # As far as it may go in any direction, from rest too, if it has not fallen behind.
        at_least = min(WRIST_SPEED, WRIST_ACCELERATION * duration) * duration
        for wrist in _WRISTS:
            way = subtract(_from_root(wrist, body), self._places[wrist])
            moved = length(way)
            if moved == 0.0 or (self._shown is self._goal and moved <= at_least):
                continue
            direction = scale(way, 1.0 / moved)
            reach = min(
                self._speed(wrist, direction, duration) * duration, self._braked(wrist, direction, wanted, duration)
            )
            if moved > reach:
                # A little less than in proportion: the path is an arc. This converges after a step or two.
                return wrist, 0.995 * reach / moved
        return None

    def _carried_on(self, side: str, wrist: str, body: Body, duration: float) -> Body:
        """Return a body with one wrist as near to where it would be as the change of its velocity allows.

        So an arm takes up what the pelvis does in walking. A root that jumps carries it along.
        """
        shoulder, elbow, carrier = f"{side}_shoulder", f"{side}_elbow", self._arms[wrist][-3]
        most, aside = WRIST_SWERVE * duration * duration, self._swerve(wrist, body, duration)
        if length(jump := self._swerve(ROOT, body, duration)) > most:
            aside = subtract(aside, jump)
        off = length(aside)
        if off <= most:
            return body
        start, above = body.transform(shoulder).position, body.transform(carrier).rotation
        goal = subtract(body.transform(wrist).position, scale(aside, 1.0 - most / off))
        bones = body.skeleton.offset(elbow), body.skeleton.offset(wrist)
        turns = brought(
            bones,
            (body.rotation(shoulder), body.rotation(elbow)),
            rotate(conjugate(above), subtract(goal, start)),
        )
        return body.posed(dict(zip((shoulder, elbow), turns, strict=True)))

    def _speed(self, wrist: str, direction: Vec3, duration: float) -> float:
        """Return the speed limit of a wrist in a direction (a unit vector), m/s; a reversing wrist starts from rest."""
        before = max(0.0, dot(self._velocities[wrist], direction))
        return min(WRIST_SPEED, before + WRIST_ACCELERATION * duration)

    def _braked(self, wrist: str, direction: Vec3, wanted: Body, duration: float) -> float:
        """Return how far a wrist may go in a direction (a unit vector), m; any distance if it has not fallen behind."""
        if self._shown is self._goal:
            return math.inf
        before, goal, place = _from_root(wrist, self._goal), _from_root(wrist, wanted), self._places[wrist]
        if distance(before, place) < _BEHIND:
            return math.inf
        step = max(0.0, dot(subtract(goal, before), direction))
        return _catching_up(distance(goal, place), step, WRIST_BRAKE, duration)

    def _on_its_feet(self, body: Body, wanted: Body, duration: float) -> Body:
        """Return the body with its feet in place as far as possible, and no deeper below the ground than requested."""
        if body is wanted:
            return body
        if body.root is wanted.root and all(body.rotation(joint) is wanted.rotation(joint) for joint in LOWER_BODY):
            return body
        if self._walks:
            body = body.posed(self._legs(body, wanted, duration))
        sunk = depth(body, self._soles) - depth(wanted, self._soles)
        return body.posed({}, self._root(add(body.root, scale(UP, sunk)), duration)) if sunk > 0.0 else body

    def _legs(self, body: Body, wanted: Body, duration: float) -> dict[str, Quat]:
        """Return rotations of both legs that compensate for a pelvis that was slowed."""
        carried = wanted.posed({ROOT: body.rotation(ROOT)}, body.root)
        places = drawn(carried, feet(wanted), subtract(body.root, wanted.root))
        left, right = (
            self._as_one(leg(carried, side, foot), duration) for side, foot in zip(SIDES, places, strict=True)
        )
        return left | right

    def _as_one(self, goals: dict[str, Quat], duration: float) -> dict[str, Quat]:
        """Return rotations of a leg that is slowed as a whole; the foot would swing if only its knee were slowed."""
        furthest = max(angle(difference(self._shown.rotation(joint), goal)) for joint, goal in goals.items())
        reach = _LIMB * duration
        if furthest <= reach:
            return goals
        return {joint: slerp(self._shown.rotation(joint), goal, reach / furthest) for joint, goal in goals.items()}

    def _root(self, wanted: Vec3, duration: float) -> Vec3:
        way, furthest = subtract(wanted, self._shown.root), ROOT_SPEED * duration
        moved = length(way)
        return wanted if moved <= furthest else add(self._shown.root, scale(way, furthest / moved))


def _catching_up(gap: float, step: float, brake: float, duration: float) -> float:
    """Return how far something that has fallen behind may go in a frame, so that it can brake until it arrives.

    Args:
        gap: from it to its goal, at the end of the frame.
        step: of the goal in the frame.
        brake: deceleration, in units of the gap.
        duration: of the frame, s.
    """
    most = brake * duration * duration
    return step + math.sqrt(most * most + 2.0 * most * max(0.0, gap - step)) - most


def _from_root(wrist: str, body: Body) -> Vec3:
    """Return the position of a wrist relative to the root, m."""
    return subtract(body.transform(wrist).position, body.root)


def _toward(start: Quat, goal: Quat, furthest: float) -> Quat:
    return slerp(start, goal, furthest / angle(difference(start, goal)))
