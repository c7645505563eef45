"""Kinematic state of a body: its joints' velocities and accelerations, estimated from samples; and path lengths."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import (
    difference,
    from_rotation_vector,
    multiply,
    rotation_vector,
)
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, distance, length, scale, subtract


class BodySample(NamedTuple):
    """A body at a time, s."""

    time: GlobalTime
    body: Body


class KinematicState(NamedTuple):
    """A body and the motion of its joints, in the axes of each joint.

    Attributes:
        body: at one time.
        velocities: of turning joints, rad/s.
        accelerations: of joints with a known change of velocity, rad/s².
    """

    body: Body
    velocities: Mapping[str, Vec3]
    accelerations: Mapping[str, Vec3]

    @classmethod
    def first_order(cls, before: BodySample, last: BodySample) -> "KinematicState":
        """Estimate the state at the last of two samples, with constant velocities."""
        return cls(last.body, _velocities(before, last), {})

    @classmethod
    def second_order(cls, first: BodySample, second: BodySample, last: BodySample) -> "KinematicState":
        """Estimate the state at the last of three samples, with constant accelerations.

        If the times run backward, the state is the one just after the last sample.
        """
        sooner, later = _velocities(first, second), _velocities(second, last)
        # A mean velocity is the velocity at the middle of its interval.
        between, left = 0.5 * (last.time - first.time), 0.5 * (last.time - second.time)
        changes = {joint: subtract(later.get(joint, ZERO), sooner.get(joint, ZERO)) for joint in sooner | later}
        accelerations = {joint: scale(change, 1.0 / between) for joint, change in changes.items()}
        velocities = {joint: add(later.get(joint, ZERO), scale(a, left)) for joint, a in accelerations.items()}
        return cls(last.body, velocities, accelerations)

    def extrapolated(self, seconds: float) -> Body:
        """Return the body some time later, s, at constant velocities."""
        ways = {joint: from_rotation_vector(scale(velocity, seconds)) for joint, velocity in self.velocities.items()}
        return self.body.posed({joint: multiply(self.body.rotation(joint), way) for joint, way in ways.items()})

    def velocity(self, joint: str) -> Vec3:
        """Return the velocity of a joint in its own axes, rad/s."""
        return self.velocities.get(joint, ZERO)

    def acceleration(self, joint: str) -> Vec3:
        """Return the acceleration of a joint in its own axes, rad/s²."""
        return self.accelerations.get(joint, ZERO)


def _velocities(before: BodySample, after: BodySample) -> dict[str, Vec3]:
    """Return the mean velocities of the joints that turned."""
    pairs = ((joint, before.body.rotation(joint), now) for joint, now in after.body.pose.items())
    turns = {joint: difference(old, now) for joint, old, now in pairs if old != now}
    return {joint: scale(rotation_vector(turn), 1.0 / (after.time - before.time)) for joint, turn in turns.items()}


_LONGEST = 0.05
"""Samples older than this say nothing about the current velocity, s."""
_FASTEST = 20.0
"""A joint that turned faster was set, not moved, and does not continue, rad/s."""


class MotionHistory:
    """The bodies of the last two frames. Without frames, only the current pose is known."""

    def __init__(self, body: Callable[[], Body]) -> None:
        """Record a body.

        Args:
            body: returns the body of the last frame.
        """
        self._body = body
        self._frame: GlobalTime | None = None
        self._samples: list[BodySample] = []

    def start_frame(self, now: GlobalTime) -> None:
        """Record the body of the last frame, before a new frame is composed."""
        self._samples = self._recent()
        self._frame = now

    def latest(self, time: GlobalTime) -> BodySample | None:
        """Return the body of the last frame before a time; None if there was none recently."""
        samples = self._recent()
        return samples[-1] if samples and 0.0 <= time - samples[-1].time <= _LONGEST else None

    def state_at(self, time: GlobalTime) -> KinematicState:
        """Return the state at a time, extrapolated from the last frames."""
        samples, last = self._recent(), self.latest(time)
        if last is None or len(samples) < 2 or samples[0].time == last.time or last.time - samples[0].time > _LONGEST:
            return KinematicState(self._body(), {}, {})
        velocities = KinematicState.first_order(samples[0], last).velocities.items()
        going_on = {joint: velocity for joint, velocity in velocities if length(velocity) < _FASTEST}
        return KinematicState(KinematicState(last.body, going_on, {}).extrapolated(time - last.time), going_on, {})

    def _recent(self) -> list[BodySample]:
        body = self._body()
        if self._frame is None or (self._samples and self._samples[-1].body is body):
            return self._samples
        return [*self._samples, BodySample(self._frame, body)][-2:]


def path_length(joint: str, sides: Iterable[str], bodies: Sequence[Body]) -> float:
    """Return the longer of the paths of a left and a right joint through several bodies, m.

    0 if there is neither joint.

    Args:
        joint: its name without the side.
        sides: to consider, "l" or "r".
        bodies: one or more.
    """
    names = [name for side in sides if (name := f"{side}_{joint}") in bodies[0].skeleton]
    paths = [[body.transform(name).position for body in bodies] for name in names]
    return max((sum(distance(a, b) for a, b in pairwise(path)) for path in paths), default=0.0)
