"""What is shown goes on from where it was, toward a goal that has jumped."""

from collections.abc import Mapping

from reactive_realizer.embodiment.quaternion import Quat, multiply, power


def faded(goal: Mapping[str, Quat], offsets: Mapping[str, Quat], left: float) -> dict[str, Quat]:
    """A goal in full, and on top of it what is left of what lay between it and what was shown.

    D. Bollo, "Inertialization: high-performance animation transitions in Gears of War" (GDC 2018): nothing is blended
    with what was; the goal plays in full from the start, and only the offset goes to 0.

    Args:
        goal: joint -> rotation local to the parent.
        offsets: joint -> turn from its goal to what was shown, when the goal jumped.
        left: how much of that is there, 0 to 1.
    """
    return {
        joint: multiply(turn, power(offsets[joint], left)) if joint in offsets else turn for joint, turn in goal.items()
    }
