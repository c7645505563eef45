"""A transition as a motion (thesis 4.2.4)."""

from collections.abc import Mapping

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.vector import scale
from reactive_realizer.engines.animation.motion_unit import Moment, Posed, owned
from reactive_realizer.engines.animation.moving import Moving
from reactive_realizer.engines.animation.transition.curves import Curve, CurveKind
from reactive_realizer.planunit.parameter import Range


class TransitionMotionUnit:
    """Leads joints from how they move when it begins to how others will move them when it ends.

    Until somebody says where to (`lead`), they stay where they are.
    """

    kind = LayerKind.GESTURE
    group: str | None = None
    lasts: str | None = None
    limits: tuple[float, float] | None = None
    key_positions: Mapping[str, float] = {"start": 0.0, "end": 1.0}
    preferred_duration = 0.6

    def __init__(self, joints: frozenset[str], curve: CurveKind) -> None:
        """Prepares a transition of some joints along curves of one kind."""
        self.parameters: dict[str, float] = {}
        self.ranges: Mapping[str, Range] = {}
        self.joints = joints
        self.resources = owned(joints)
        self._kind = curve
        self._body: Body | None = None
        self._curves: Mapping[str, Curve] = {}

    def start(self, body: Body) -> None:
        """It begins from here."""
        self._body = body

    def lead(self, begin: Moving, goal: Moving, duration: float) -> None:
        """Where to.

        Args:
            begin: how the body moves at phase 0.
            goal: how it will move at phase 1.
            duration: s between the two.
        """
        self._curves = {
            joint: self._kind(
                begin.body.rotation(joint),
                goal.body.rotation(joint),
                scale(begin.velocity(joint), duration),
                scale(goal.velocity(joint), duration),
            )
            for joint in self.joints
        }

    def pose(self, moment: Moment) -> Posed:
        """Each joint on its curve."""
        body = self._body or moment.body
        here = {joint: body.rotation(joint) for joint in self.joints}
        return Posed({**here, **{joint: curve(moment.phase) for joint, curve in self._curves.items()}})
