"""What a motion shows when it lies over a body."""

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import Quat, slerp
from reactive_realizer.engines.animation.motion_unit import Moment


def shown(unit, phase: float, body: Body, below: Body | None = None) -> dict[str, Quat]:
    """The rotations of its joints at a phase, over what lies below: the body itself, if nothing else is said."""
    below = below or body
    posed = unit.pose(Moment(phase, phase * unit.preferred_duration, body))
    return {joint: slerp(below.rotation(joint), goal, posed.weight) for joint, goal in posed.rotations.items()}
