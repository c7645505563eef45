"""Joints of the spine that go from point to point, by an amount."""

from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import other_side
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, from_euler, multiply, slerp
from reactive_realizer.embodiment.vector import ZERO, Vec3
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.expression.syntax import Formula
from reactive_realizer.engines.animation.procedural.tracks import Formulas, JointTrack, TrackPose


class SpineKey(NamedTuple):
    """The rotation of a joint at a phase.

    Attributes:
        phase: 0 to 1.
        least: at the amount 0, rad, as for `from_euler`.
        most: at the amount 1.
        turn: another rotation after it, whatever the amount.
    """

    phase: float
    least: Vec3 = ZERO
    most: Vec3 = ZERO
    turn: Quat = IDENTITY

    def at(self, amount: float) -> Quat:
        """Return the rotation at an amount."""
        x, y, z = (a + amount * (b - a) for a, b in zip(self.least, self.most, strict=True))
        return multiply(self.turn, from_euler(x, y, z))


@dataclass(frozen=True, slots=True)
class SpineTrack(JointTrack):
    """Rotates a joint through keys, and stops at each.

    Attributes:
        amount: a formula.
        keys: two or more, in order of phase.
    """

    amount: Formula
    keys: tuple[SpineKey, ...]

    @property
    def formulas(self) -> Formulas:
        """See `Track`."""
        return (self.amount,)

    @property
    def independent(self) -> bool:
        """See `Track`."""
        return True

    def evaluate(self, values: Sequence[float], phase: float, body: Callable[[], Body]) -> TrackPose:
        """See `Track`."""
        after = min(bisect_right(self.keys, phase, key=lambda key: key.phase), len(self.keys) - 1)
        start, goal = self.keys[max(0, after - 1)], self.keys[after]
        done = minimum_jerk(share(phase, start.phase, goal.phase))
        return TrackPose({self.joint: slerp(start.at(values[0]), goal.at(values[0]), done)})

    def mirrored(self) -> "SpineTrack":
        """See `Track`."""
        return replace(self, joint=other_side(self.joint), keys=tuple(map(_mirrored, self.keys)))


def _mirrored(key: SpineKey) -> SpineKey:
    w, x, y, z = key.turn
    least, most = ((bend[0], -bend[1], -bend[2]) for bend in (key.least, key.most))
    return SpineKey(key.phase, least, most, (w, x, -y, -z))
