"""Eyes that no gaze directs look at the viewer, as far as that is comfortable without the head."""

import math

from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, angle, power
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.easing import share, smoothstep
from reactive_realizer.engines.animation.gaze.eyes import direction_between, listing

VIEWER = "camera"
"""The target at which they look: the page moves it with its camera."""

_COMFORTABLE, _FURTHEST = math.radians(15.0), math.radians(30.0)
"""Turn of an eye up to which it looks at the viewer, and from which on it looks straight ahead, rad (ours)."""


def toward_viewer(head: Quat, eye: Vec3, viewer: Vec3) -> Quat:
    """Return the rotation of an eye in the head.

    Args:
        head: its rotation in the figure's frame.
        eye: its position there, m.
        viewer: likewise.
    """
    direction = direction_between(eye, viewer)
    if direction is None:
        return IDENTITY
    turn = listing(head, direction)
    return power(turn, 1.0 - smoothstep(share(angle(turn), _COMFORTABLE, _FURTHEST)))
