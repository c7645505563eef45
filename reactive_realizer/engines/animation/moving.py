"""How a body moves."""

from collections.abc import Mapping
from typing import NamedTuple

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import (
    difference,
    from_rotation_vector,
    multiply,
    rotation_vector,
)
from reactive_realizer.embodiment.vector import ZERO, Vec3, scale


class Moving(NamedTuple):
    """A body, and how its joints turn.

    Attributes:
        body: at one time.
        velocities: of the joints that turn, rad/s, in the axes of the joint.
    """

    body: Body
    velocities: Mapping[str, Vec3]

    @classmethod
    def between(cls, before: Body, after: Body, passed: float) -> "Moving":
        """A body that is as the later one of two, so many seconds apart, and goes on as they do."""
        pairs = ((joint, before.rotation(joint), now) for joint, now in after.pose.items())
        turns = {joint: difference(old, now) for joint, old, now in pairs if old != now}
        return cls(after, {joint: scale(rotation_vector(turn), 1.0 / passed) for joint, turn in turns.items()})

    def after(self, seconds: float) -> "Moving":
        """The same some time later."""
        turned = {
            joint: multiply(self.body.rotation(joint), from_rotation_vector(scale(velocity, seconds)))
            for joint, velocity in self.velocities.items()
        }
        return Moving(self.body.posed(turned), self.velocities)

    def velocity(self, joint: str) -> Vec3:
        """How a joint turns, rad/s, in its own axes."""
        return self.velocities.get(joint, ZERO)
