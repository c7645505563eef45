"""A transition as a motion (thesis 4.2.4)."""

from collections.abc import Mapping

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.vector import scale
from reactive_realizer.engines.animation.motion_unit import JOINTS, Foreseen, Moment, MotionUnit, Posed, owned
from reactive_realizer.engines.animation.moving import Moving
from reactive_realizer.engines.animation.transition.curves import Curve, CurveKind
from reactive_realizer.engines.animation.transition.hermite_curve import End

CLASS = "class"
"""The parameter that says along which curve."""


class TransitionMotionUnit(MotionUnit):
    """Leads joints from how they move when it begins to how others will move them when it ends.

    Until somebody says where to (`lead`), they stay where they are.
    """

    kind = LayerKind.GESTURE
    fixed = frozenset({CLASS, JOINTS})
    preferred_duration = 0.6
    foreseen = Foreseen.ONCE_BEGUN
    led = True

    def __init__(self, joints: frozenset[str], curve: CurveKind) -> None:
        """Prepares a transition of some joints along curves of one kind."""
        self.parameters = {}
        self.joints = joints
        self.resources = owned(joints)
        self._kind = curve
        self._body: Body | None = None
        self._curves: Mapping[str, Curve] = {}

    def start(self, body: Body) -> None:
        """It begins from here."""
        self._body = body

    def lead(self, begin: Moving, goal: Moving, duration: float) -> None:
        """Each joint leaves as it moves, and arrives as it will move."""
        self._curves = {
            joint: self._kind(_end(begin, joint, duration), _end(goal, joint, duration)) for joint in self.joints
        }

    def pose(self, moment: Moment) -> Posed:
        """Each joint on its curve."""
        body = self._body or moment.body
        here = {joint: body.rotation(joint) for joint in self.joints}
        return Posed({**here, **{joint: curve(moment.phase) for joint, curve in self._curves.items()}})


def _end(moving: Moving, joint: str, duration: float) -> End:
    """How a joint is at an end of a curve that takes so many seconds."""
    velocity, acceleration = moving.velocity(joint), moving.acceleration(joint)
    return End(moving.body.rotation(joint), scale(velocity, duration), scale(acceleration, duration * duration))
