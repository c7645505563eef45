"""The last safety net under all motion: whatever was asked for, nothing on the figure jumps."""

from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, angle, conjugate, multiply, slerp
from reactive_realizer.embodiment.skeleton import Pose, Skeleton
from reactive_realizer.embodiment.vector import ZERO, Vec3, dot, length, scale, subtract

WRIST_SPEED = 2.4
"""m/s, of each wrist in the figure's frame: less than 5 cm in 20 ms. Conversational gestures stay below 2 m/s."""

WRIST_ACCELERATION = 37.5
"""m/s^2, of each wrist that sets out or turns back: 1.5 cm more in each 20 ms than in those before."""

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
    **dict.fromkeys(("HumanoidRoot", "vl5", "vt10", "vt6"), _TRUNK),
    **dict.fromkeys(("vc4", "skullbase"), _NECK),
    **dict.fromkeys(("l_eyeball_joint", "r_eyeball_joint"), _EYE),
    **dict.fromkeys(_WRISTS, _WRIST),
}


class SpeedLimit:
    """Keeps what is shown within a distance of what was shown before.

    No joint turns faster than its limit, then no wrist moves faster than `WRIST_SPEED`, nor much faster than before. A
    pose that asks for more is followed as fast as that allows, which ordinary motion never notices. How soon a wrist
    stops is not limited: so it never goes past where it is wanted.
    """

    def __init__(self, skeleton: Skeleton) -> None:
        self._skeleton = skeleton
        self._speeds = {joint: _SPEEDS.get(joint, _LIMB) for joint in skeleton.joints}
        self._arms = {wrist: skeleton.chain(wrist)[:-1] for wrist in _WRISTS}
        self._velocities: dict[str, Vec3] = dict.fromkeys(_WRISTS, ZERO)

    def __call__(self, shown: Pose, wanted: Pose, duration: float) -> dict[str, Quat]:
        """The pose to show now.

        Args:
            shown: the pose shown last.
            wanted: the pose asked for now.
            duration: between the two, s, more than 0.
        """
        pose = {
            joint: _toward(shown.get(joint, IDENTITY), wanted.get(joint, IDENTITY), speed * duration)
            for joint, speed in self._speeds.items()
        }
        starts = {wrist: self._skeleton.place(shown, wrist).position for wrist in _WRISTS}
        # The wrists share the trunk: holding one back may set the other free, so it goes on until both are content.
        while any(self._hold_back(wrist, starts[wrist], shown, pose, duration) for wrist in _WRISTS):
            pass
        self._velocities = {wrist: scale(self._way(wrist, starts[wrist], pose), 1.0 / duration) for wrist in _WRISTS}
        return pose

    def _hold_back(self, wrist: str, start: Vec3, shown: Pose, pose: dict[str, Quat], duration: float) -> bool:
        """Where a wrist would move too far, lets the joints above it turn less; whether it had to."""
        way = self._way(wrist, start, pose)
        moved = length(way)
        if moved == 0.0:
            return False
        reach = self._speed(wrist, scale(way, 1.0 / moved), duration) * duration
        if not moved > reach:
            return False
        # A little less than in proportion: the way is an arc, so this comes to rest after a step or two.
        fraction = 0.98 * reach / moved
        for joint in self._arms[wrist]:
            pose[joint] = slerp(shown.get(joint, IDENTITY), pose[joint], fraction)
        return True

    def _speed(self, wrist: str, direction: Vec3, duration: float) -> float:
        """How fast a wrist may go in a direction (a unit vector), m/s: for one that went the other way, from rest."""
        before = max(0.0, dot(self._velocities[wrist], direction))
        return min(WRIST_SPEED, before + WRIST_ACCELERATION * duration)

    def _way(self, wrist: str, start: Vec3, pose: Pose) -> Vec3:
        return subtract(self._skeleton.place(pose, wrist).position, start)


def _toward(start: Quat, goal: Quat, furthest: float) -> Quat:
    way = angle(multiply(conjugate(start), goal))
    return goal if way <= furthest else slerp(start, goal, furthest / way)
