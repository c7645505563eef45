"""Coasting: joints that are no longer driven slow down instead of stopping dead."""

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
from reactive_realizer.engines.animation.inertialization import inertialized

_DURATION = 0.2
"""Time in which a speed decays, s, as 3(1-t)^2 with t from 0 to 1: an elbow brakes about as hard as it accelerates."""

_LONGEST = 0.07
"""Samples older than this say nothing about the current speed, s."""


class LayerSample(NamedTuple):
    """A layer as shown at a time, s."""

    time: GlobalTime
    layer: Layer


@dataclass(frozen=True, slots=True)
class Coasting:
    """The motion of a layer that no motion drives any more.

    Attributes:
        since: time when it was driven last, s.
        turns: joint -> remaining turn, in its own axes.
        weight: remaining change of the layer's weight.
    """

    since: GlobalTime
    turns: Mapping[str, Quat]
    weight: float

    @classmethod
    def from_samples(cls, samples: Sequence[LayerSample], time: GlobalTime) -> Self | None:
        """Estimate coasting from the last two samples of a layer; None if its speed is unknown.

        Legs and root do not coast: the feet stay in place. Nor does a joint that turned faster than its limit: it was
        set, not moved.

        Args:
            samples: the last two, in order of time.
            time: when the layer is no longer driven, s.
        """
        if len(samples) < 2 or time - samples[0].time > _LONGEST:
            return None
        before, last = samples
        passed = last.time - before.time
        # With this decay a joint travels a third of the distance of constant speed.
        ahead = _DURATION / 3.0 / passed
        ways = _ways(before.layer, last.layer)
        turns = {j: from_rotation_vector(scale(way, ahead)) for j, way in ways if length(way) <= fastest(j) * passed}
        return cls(last.time, turns, ahead * (last.layer.weight - before.layer.weight))

    def __call__(self, layer: Layer, now: GlobalTime) -> Layer:
        """Return the layer at a time, from the layer shown last."""
        gone = 1.0 - (1.0 - share(now, self.since, self.since + _DURATION)) ** 3
        weight = min(1.0, max(0.0, layer.weight + gone * self.weight))
        return replace(layer, rotations=inertialized(layer.rotations, self.turns, gone), weight=weight)


def _ways(before: Layer, last: Layer) -> list[tuple[str, Vec3]]:
    """Return the turns of joints as rotation vectors, rad, in their own axes."""
    pairs = ((joint, before.rotations.get(joint, now), now) for joint, now in last.rotations.items())
    turned = ((joint, old, now) for joint, old, now in pairs if old != now and joint not in LOWER_BODY)
    return [(joint, rotation_vector(difference(old, now))) for joint, old, now in turned]
