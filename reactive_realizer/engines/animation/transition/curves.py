"""The ways of a joint from one rotation to another, by the names that BML has for them."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

from reactive_realizer.embodiment.quaternion import Quat, slerp
from reactive_realizer.engines.animation.easing import minimum_jerk
from reactive_realizer.engines.animation.transition.hermite_curve import End, HermiteCurve

Curve = Callable[[float], Quat]
"""The rotation at a phase, 0 to 1."""

CurveKind = Callable[[End, End], Curve]
"""A curve from one end to another."""


def slerped(start: End, goal: End) -> Curve:
    """Along the shortest arc, from rest to rest: how the joint moves at the ends does not count."""
    return lambda phase: slerp(start.rotation, goal.rotation, minimum_jerk(phase))


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
