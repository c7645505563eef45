"""From a binding to a transition."""

from reactive_realizer.embodiment.joints import EYES
from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.transition.curves import CURVES
from reactive_realizer.engines.animation.transition.transition_motion_unit import CLASS, TransitionMotionUnit
from reactive_realizer.errors import error
from reactive_realizer.planunit.parameter import spelled


class TransitionMaker:
    """Makes transitions of the kind that the parameter `class` names, of the `joints`, else of the whole figure."""

    def __init__(self, actor: Actor) -> None:
        self._joints = frozenset(actor.humanoid.avatar.skeleton.joints).difference(EYES)

    def __call__(self, wanted: Wanted) -> TransitionMotionUnit:
        """As every maker."""
        kind = spelled(wanted.parameters.get(CLASS, "").rpartition(".")[2], CURVES)
        if kind not in CURVES:
            raise error("no-transition", kind=kind, known=", ".join(CURVES))
        joints = self._joints & wanted.joints if wanted.joints else self._joints
        if not joints:
            raise error("no-joints", joints=", ".join(sorted(wanted.joints)), element=wanted.behavior.name)
        return TransitionMotionUnit(joints, CURVES[kind])
