"""How one figure stands when it does nothing."""

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.skeleton import Pose, Skeleton
from reactive_realizer.engines.animation.posture.rest_pose import REST_POSE


class Rest:
    """The figure at rest: where gestures come from and return to, if nothing else is known.

    Attributes:
        pose: of its joints; those left out are in the default pose.
        body: in that pose. Preferred durations follow from it, whatever is shown: a plan does not depend on who is
            looking.
    """

    def __init__(self, skeleton: Skeleton) -> None:
        self.pose: Pose = REST_POSE
        self.body = Body(skeleton, dict(REST_POSE))
