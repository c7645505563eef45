"""Limits how fast the figure moves, as a last safeguard against jumps."""

import math
from collections.abc import Collection

from reactive_realizer.embodiment.body import Body, JointRotations
from reactive_realizer.embodiment.feet import depth, drawn, feet, leg, soles, walks
from reactive_realizer.embodiment.joints import EYES, HEAD, LOWER_BODY, ROOT, SIDES, TRUNK
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, angle, difference, slerp
from reactive_realizer.embodiment.vector import UP, ZERO, Vec3, add, dot, length, scale, subtract

WRIST_SPEED = 2.4
"""Limit for each wrist relative to the root, m/s: less than 5 cm in 20 ms. Conversational gestures stay below 2 m/s."""

WRIST_ACCELERATION = 37.5
"""Limit for each wrist that starts or turns back, m/s^2: 1.5 cm more in each 20 ms than in the 20 ms before."""

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
_ALL_SPEEDS = frozenset((_LIMB, *_SPEEDS.values()))


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
    within = {speed: math.cos(0.5 * speed * duration) for speed in _ALL_SPEEDS}
    hasty = {
        joint: _toward(start, goal, fastest(joint) * duration)
        for joint, goal in wanted.items()
        # Most joints stay as they are, as the same tuple.
        if (start := shown.get(joint, IDENTITY)) is not goal
        and abs(start[0] * goal[0] + start[1] * goal[1] + start[2] * goal[2] + start[3] * goal[3])
        < within[_SPEEDS.get(joint, _LIMB)]
    }
    return {**wanted, **hasty}


class SpeedLimit:
    """Keeps each shown body within reach of the one before.

    No joint turns faster than its limit, no wrist moves faster than `WRIST_SPEED` or accelerates more than
    `WRIST_ACCELERATION`, and the root moves no faster than `ROOT_SPEED`. A faster pose is followed as fast as that
    allows; ordinary motion is not affected. Deceleration of wrists is not limited, so they never overshoot.

    If legs and root were limited separately, the feet would leave their places and go below the ground. So the knees
    bend or stretch for a root that lags behind; what they cannot compensate raises the figure, within the limit of the
    root.
    """

    def __init__(self, shown: Body) -> None:
        """Start with the first body that is shown."""
        self._shown = shown
        self._default = dict.fromkeys(shown.skeleton.joints, IDENTITY)
        self._arms = {wrist: shown.skeleton.chain(wrist)[:-1] for wrist in _WRISTS}
        self._places = {wrist: _from_root(wrist, shown) for wrist in _WRISTS}
        self._velocities: dict[str, Vec3] = dict.fromkeys(_WRISTS, ZERO)
        self._soles = soles(shown.skeleton)
        self._walks = walks(shown.skeleton)

    def release(self, wanted: Body, joints: Collection[str]) -> None:
        """Let joints, and the root if it is one of them, be at once where they are wanted, when they are shown next."""
        root = wanted.root if ROOT in joints else self._shown.root
        self._shown = self._shown.posed({joint: wanted.rotation(joint) for joint in joints}, root)
        self._places = {wrist: _from_root(wrist, self._shown) for wrist in _WRISTS}

    def __call__(self, wanted: Body, duration: float) -> Body:
        """Return the body to show now.

        Args:
            wanted: the requested body.
            duration: since the last body was shown, s, more than 0.
        """
        pose = slowed(self._shown.pose, {**self._default, **wanted.pose}, duration)
        body = Body(wanted.skeleton, pose, self._root(wanted.root, duration))
        # The wrists share the trunk, so slowing one may change the other: repeat until both are within their limits.
        while (hasty := self._hasty(body, duration)) is not None:
            wrist, fraction = hasty
            body = body.posed(
                {j: slerp(self._shown.rotation(j), body.rotation(j), fraction) for j in self._arms[wrist]}
            )
        body = self._on_its_feet(body, wanted, duration)
        places = {wrist: _from_root(wrist, body) for wrist in _WRISTS}
        self._velocities = {w: scale(subtract(at, self._places[w]), 1.0 / duration) for w, at in places.items()}
        self._places, self._shown = places, body
        return body

    def _hasty(self, body: Body, duration: float) -> tuple[str, float] | None:
        """Return a wrist that would move too far, and the factor for the turns of the joints above it."""
        for wrist in _WRISTS:
            way = subtract(_from_root(wrist, body), self._places[wrist])
            moved = length(way)
            if moved == 0.0:
                continue
            reach = self._speed(wrist, scale(way, 1.0 / moved), duration) * duration
            if moved > reach:
                # A little less than in proportion: the path is an arc. This converges after a step or two.
                return wrist, 0.995 * reach / moved
        return None

    def _speed(self, wrist: str, direction: Vec3, duration: float) -> float:
        """Return the speed limit of a wrist in a direction (a unit vector), m/s; a reversing wrist starts from rest."""
        before = max(0.0, dot(self._velocities[wrist], direction))
        return min(WRIST_SPEED, before + WRIST_ACCELERATION * duration)

    def _on_its_feet(self, body: Body, wanted: Body, duration: float) -> Body:
        """Return the body with its feet in place as far as possible, and no deeper below the ground than requested."""
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


def _from_root(wrist: str, body: Body) -> Vec3:
    """Return the position of a wrist relative to the root, m."""
    return subtract(body.transform(wrist).position, body.root)


def _toward(start: Quat, goal: Quat, furthest: float) -> Quat:
    return slerp(start, goal, furthest / angle(difference(start, goal)))
