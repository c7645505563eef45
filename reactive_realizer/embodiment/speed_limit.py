"""The last safety net under all motion: whatever was asked for, nothing on the figure jumps."""

import math

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.feet import drawn, feet, leg, walks
from reactive_realizer.embodiment.ground import depth, soles
from reactive_realizer.embodiment.joints import EYES, HEAD, LOWER_BODY, ROOT, SIDES, TRUNK
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, angle, difference, slerp
from reactive_realizer.embodiment.skeleton import Pose
from reactive_realizer.embodiment.vector import UP, ZERO, Vec3, add, dot, length, scale, subtract

WRIST_SPEED = 2.4
"""m/s, of each wrist as seen from the root: less than 5 cm in 20 ms. Conversational gestures stay below 2 m/s."""

WRIST_ACCELERATION = 37.5
"""m/s^2, of each wrist that sets out or turns back: 1.5 cm more in each 20 ms than in those before."""

ROOT_SPEED = 2.0
"""m/s: a brisk walk; who sits down or stands up stays below 1 m/s."""

# Peak velocities, rad/s: the trunk in a lively turn; the neck in a fast voluntary one; the eye in a saccade 9 to 12
# (the thesis, 4.2.2, has a plateau of 8.7 rad/s); an elbow in a throw above 20, in conversation far below. A wrist
# could turn as fast, but swings the fingertips on top of what the arm does: at its limit they move 3 cm in 20 ms.
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
    """How fast a joint turns at most, rad/s."""
    return _SPEEDS.get(joint, _LIMB)


def slowed(shown: Pose, wanted: Pose, duration: float) -> dict[str, Quat]:
    """Rotations of joints that turn no faster than they can.

    Args:
        shown: the pose shown last.
        wanted: what some of its joints are asked for now.
        duration: between the two, s, more than 0.
    """
    within = {speed: math.cos(0.5 * speed * duration) for speed in _ALL_SPEEDS}
    hasty = {
        joint: _toward(start, goal, fastest(joint) * duration)
        for joint, goal in wanted.items()
        # Most joints are left where they are, by the same tuple.
        if (start := shown.get(joint, IDENTITY)) is not goal
        and abs(start[0] * goal[0] + start[1] * goal[1] + start[2] * goal[2] + start[3] * goal[3])
        < within[_SPEEDS.get(joint, _LIMB)]
    }
    return {**wanted, **hasty}


class SpeedLimit:
    """Keeps what is shown within a distance of what was shown before.

    No joint turns faster than its limit, then no wrist moves faster than `WRIST_SPEED`, nor much faster than before,
    and the root no faster than `ROOT_SPEED`. A pose that asks for more is followed as fast as that allows, which
    ordinary motion never notices. How soon a wrist stops is not limited: so it never goes past where it is wanted.

    Legs and root, each held back for itself, would take the feet elsewhere, and into the ground. So knees bend, or
    stretch, for a root that is late; what legs cannot make up for either raises the figure, within the root's limit.
    """

    def __init__(self, shown: Body) -> None:
        """Begins with a body as it is shown first."""
        self._shown = shown
        self._default = dict.fromkeys(shown.skeleton.joints, IDENTITY)
        self._arms = {wrist: shown.skeleton.chain(wrist)[:-1] for wrist in _WRISTS}
        self._places = {wrist: _from_root(wrist, shown) for wrist in _WRISTS}
        self._velocities: dict[str, Vec3] = dict.fromkeys(_WRISTS, ZERO)
        self._soles = soles(shown.skeleton)
        self._walks = walks(shown.skeleton)

    def __call__(self, wanted: Body, duration: float) -> Body:
        """The body to show now.

        Args:
            wanted: the one asked for now.
            duration: since the last one was shown, s, more than 0.
        """
        pose = slowed(self._shown.pose, {**self._default, **wanted.pose}, duration)
        body = Body(wanted.skeleton, pose, self._root(wanted.root, duration))
        # The wrists share the trunk: holding one back may set the other free, so it goes on until both are content.
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
        """A wrist that would move too far, with the share of their turns that the joints above it may make."""
        for wrist in _WRISTS:
            way = subtract(_from_root(wrist, body), self._places[wrist])
            moved = length(way)
            if moved == 0.0:
                continue
            reach = self._speed(wrist, scale(way, 1.0 / moved), duration) * duration
            if moved > reach:
                # A little less than in proportion: the way is an arc, so this comes to rest after a step or two.
                return wrist, 0.98 * reach / moved
        return None

    def _speed(self, wrist: str, direction: Vec3, duration: float) -> float:
        """How fast a wrist may go in a direction (a unit vector), m/s: for one that went the other way, from rest."""
        before = max(0.0, dot(self._velocities[wrist], direction))
        return min(WRIST_SPEED, before + WRIST_ACCELERATION * duration)

    def _on_its_feet(self, body: Body, wanted: Body, duration: float) -> Body:
        """The body with its feet where they are wanted, as far as that can be, and no further under the ground."""
        if body.root is wanted.root and all(body.rotation(joint) is wanted.rotation(joint) for joint in LOWER_BODY):
            return body
        if self._walks:
            body = body.posed(self._legs(body, wanted, duration))
        sunk = depth(body, self._soles) - depth(wanted, self._soles)
        return body.posed({}, self._root(add(body.root, scale(UP, sunk)), duration)) if sunk > 0.0 else body

    def _legs(self, body: Body, wanted: Body, duration: float) -> dict[str, Quat]:
        """Rotations of both legs, which make up for a pelvis that has been held back."""
        carried = wanted.posed({ROOT: body.rotation(ROOT)}, body.root)
        places = drawn(carried, feet(wanted), subtract(body.root, wanted.root))
        left, right = (
            self._as_one(leg(carried, side, foot), duration) for side, foot in zip(SIDES, places, strict=True)
        )
        return left | right

    def _as_one(self, goals: dict[str, Quat], duration: float) -> dict[str, Quat]:
        """Rotations of a leg that is slowed down as a whole: a foot would swing if only its knee were late."""
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
    """Where a wrist is as seen from the root, m."""
    return subtract(body.place(wrist).position, body.root)


def _toward(start: Quat, goal: Quat, furthest: float) -> Quat:
    return slerp(start, goal, furthest / angle(difference(start, goal)))
