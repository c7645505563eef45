"""What breaks off while it moves comes to rest, and does not stop dead."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, Self

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.joints import LOWER_BODY
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.embodiment.quaternion import Quat, difference, from_rotation_vector, rotation_vector
from reactive_realizer.embodiment.speed_limit import fastest
from reactive_realizer.embodiment.vector import Vec3, length, scale
from reactive_realizer.engines.animation.easing import share
from reactive_realizer.engines.animation.inertia import faded

_DURATION = 0.2
"""s in which a speed decays, as 3(1-t)^2 with t from 0 to 1: an elbow brakes about as hard as it speeds up."""

_LONGEST = 0.07
"""s; what was seen longer ago tells nothing of how a layer moves now."""


class Shown(NamedTuple):
    """A layer as it was shown at a time, s."""

    time: GlobalTime
    layer: Layer


@dataclass(frozen=True, slots=True)
class Drift:
    """How a layer goes on that nobody leads any more.

    Attributes:
        since: when it was led last, s.
        turns: joint -> the turn that it still makes, in its own axes.
        weight: what is still added to the layer's.
    """

    since: GlobalTime
    turns: Mapping[str, Quat]
    weight: float

    @classmethod
    def after(cls, seen: Sequence[Shown], time: GlobalTime) -> Self | None:
        """As a layer moved between the last two times at which it was shown; None if that is not known.

        Legs and root do not go on: the feet stay where they are. Nor does a joint that turned faster than it can: it
        was put where it is.

        Args:
            seen: the two, the later one last.
            time: when nobody leads it any more, s.
        """
        if len(seen) < 2 or time - seen[0].time > _LONGEST:
            return None
        before, last = seen
        passed = last.time - before.time
        # A speed that decays so makes a third of the way that it would make undiminished.
        ahead = _DURATION / 3.0 / passed
        ways = _ways(before.layer, last.layer)
        turns = {j: from_rotation_vector(scale(way, ahead)) for j, way in ways if length(way) <= fastest(j) * passed}
        return cls(last.time, turns, ahead * (last.layer.weight - before.layer.weight))

    def __call__(self, layer: Layer, now: GlobalTime) -> Layer:
        """The layer as it has gone on from how it was shown last."""
        gone = 1.0 - (1.0 - share(now, self.since, self.since + _DURATION)) ** 3
        weight = min(1.0, max(0.0, layer.weight + gone * self.weight))
        return replace(layer, rotations=faded(layer.rotations, self.turns, gone), weight=weight)


def _ways(before: Layer, last: Layer) -> list[tuple[str, Vec3]]:
    """How far joints have turned, rad, in their own axes."""
    pairs = ((joint, before.rotations.get(joint, now), now) for joint, now in last.rotations.items())
    turned = ((joint, old, now) for joint, old, now in pairs if old != now and joint not in LOWER_BODY)
    return [(joint, rotation_vector(difference(old, now))) for joint, old, now in turned]
