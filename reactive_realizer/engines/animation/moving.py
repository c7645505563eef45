"""How a body moves."""

from collections.abc import Mapping
from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import (
    difference,
    from_rotation_vector,
    multiply,
    rotation_vector,
)
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, scale, subtract


class Seen(NamedTuple):
    """A body at a time, s."""

    time: GlobalTime
    body: Body


class Moving(NamedTuple):
    """A body, and how its joints turn, in the axes of each joint.

    Attributes:
        body: at one time.
        velocities: of the joints that turn, rad/s.
        accelerations: of the joints whose velocity is known to change, rad/s².
    """

    body: Body
    velocities: Mapping[str, Vec3]
    accelerations: Mapping[str, Vec3]

    @classmethod
    def along(cls, before: Seen, last: Seen) -> "Moving":
        """A body as it is at the last of two times, whose joints turn evenly."""
        return cls(last.body, _velocities(before, last), {})

    @classmethod
    def through(cls, first: Seen, second: Seen, last: Seen) -> "Moving":
        """A body as it is at the last of three times, whose joints speed up evenly.

        The times may also lead back: then it is about what comes after the last.
        """
        sooner, later = _velocities(first, second), _velocities(second, last)
        # A mean velocity is that of the middle of its time.
        between, left = 0.5 * (last.time - first.time), 0.5 * (last.time - second.time)
        changes = {joint: subtract(later.get(joint, ZERO), sooner.get(joint, ZERO)) for joint in sooner | later}
        accelerations = {joint: scale(change, 1.0 / between) for joint, change in changes.items()}
        velocities = {joint: add(later.get(joint, ZERO), scale(a, left)) for joint, a in accelerations.items()}
        return cls(last.body, velocities, accelerations)

    def after(self, seconds: float) -> Body:
        """Where the body is some time later, if it goes on as fast."""
        ways = {joint: from_rotation_vector(scale(velocity, seconds)) for joint, velocity in self.velocities.items()}
        return self.body.posed({joint: multiply(self.body.rotation(joint), way) for joint, way in ways.items()})

    def velocity(self, joint: str) -> Vec3:
        """How fast a joint turns, rad/s, in its own axes."""
        return self.velocities.get(joint, ZERO)

    def acceleration(self, joint: str) -> Vec3:
        """How its velocity changes, rad/s²."""
        return self.accelerations.get(joint, ZERO)


def _velocities(before: Seen, after: Seen) -> dict[str, Vec3]:
    """Mean velocities of the joints that have turned."""
    pairs = ((joint, before.body.rotation(joint), now) for joint, now in after.body.pose.items())
    turns = {joint: difference(old, now) for joint, old, now in pairs if old != now}
    return {joint: scale(rotation_vector(turn), 1.0 / (after.time - before.time)) for joint, turn in turns.items()}
