"""The ways of a joint from one rotation to another, by the names that BML has for them."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

from reactive_realizer.embodiment.quaternion import Quat, slerp
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.easing import minimum_jerk
from reactive_realizer.engines.animation.transition.hermite_curve import HermiteCurve

Curve = Callable[[float], Quat]
"""The rotation at a phase, 0 to 1."""

CurveKind = Callable[[Quat, Quat, Vec3, Vec3], Curve]
"""A curve from a rotation to another, with the velocities at its ends, rad per unit of phase, in the joint's axes."""


def slerped(start: Quat, goal: Quat, leaving: Vec3, arriving: Vec3) -> Curve:
    """Along the shortest arc, from rest to rest: the velocities at the ends do not count."""
    return lambda phase: slerp(start, goal, minimum_jerk(phase))


CURVES: Mapping[str, CurveKind] = MappingProxyType(
    {
        "SlerpTransition": slerped,
        "SlerpTransitionMU": slerped,
        "SlerpTransitionToPoseMU": slerped,
        "TransitionMU": slerped,
        "HermiteTransition": HermiteCurve,
        "HermiteTransitionMU": HermiteCurve,
    }
)
"""By class: those of the thesis (4.2.4), and AsapRealizer's names for them."""
