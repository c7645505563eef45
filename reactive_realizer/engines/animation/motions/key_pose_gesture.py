"""Gestures whose strokes are key poses, as MURML and EMBOTS describe them."""

from collections.abc import Mapping, Sequence

from reactive_realizer.embodiment.body import Body
from reactive_realizer.engines.animation.key_poses.solved_pose import JointPose
from reactive_realizer.engines.animation.motion_unit import (
    FILE_PARAMETERS,
    PhaseDuration,
    arms_used,
    with_gesture_points,
)
from reactive_realizer.engines.animation.motions.key_poses import Key, KeyPosesMotionUnit
from reactive_realizer.engines.animation.motions.reaching import reach


class KeyPoseGesture(KeyPosesMotionUnit):
    """Prepares from the current pose, plays key poses, and retracts to the rest pose."""

    fixed = FILE_PARAMETERS

    def __init__(
        self, name: str, keys: Sequence[Key], rest: Body, points: Mapping[str, float], fade_out: float
    ) -> None:
        """Plan a gesture.

        Args:
            name: for messages.
            keys: one or more, in order.
            rest: the expected body at the start and at the end.
            points: sync id -> time, s: of the values with an id.
            fade_out: duration of the retraction, s.
        """
        stroke = {"ready": keys[0].reached, "strokeEnd": keys[-1].reached if len(keys) > 1 else keys[0].left}
        super().__init__(name, keys, rest, {**stroke, **points}, (0.0, fade_out))
        self.key_positions = with_gesture_points(self.key_positions)
        self.resources = arms_used(self.joints)

    def preparation(self, body: Body) -> PhaseDuration | None:
        """Return the duration of the way from a body to the first key pose; none is needed if that is shown at once."""
        first = self._keys[0]
        if first.reached == 0.0:
            return None
        return reach(body, posed(body, first.pose), self.joints)


def posed(body: Body, pose: JointPose) -> Body:
    """Return a body in a pose."""
    return body.posed(pose.solve(body, {joint: body.rotation(joint) for joint in pose.joints}).rotations)
