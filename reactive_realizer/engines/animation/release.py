"""The way back to rest of a motion that was cut: the engine's own, it blocks nothing."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import inf
from operator import itemgetter

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.vector import Vec3, distance
from reactive_realizer.engines.animation.drift import Drift
from reactive_realizer.engines.animation.easing import minimum_jerk, share

DURATION = 0.6
"""s; at this pace a hand that is let go at shoulder height stays below 2 m/s."""

_A_METER = 2.8
"""s that a pelvis takes for a meter; getting up from a chair takes near two seconds."""

_LONGEST = 3.0
"""s; who has gone further than one gets in that time at this pace comes back faster."""

_WALK = 1.0
"""s that it takes for each meter, at least: so the pelvis stays below 2 m/s."""

_OUTRUN = 0.5
"""m; a figure that is further behind a motion has not kept up with it."""

LOWEST = (-inf, -inf)
"""The height of what lies below all others."""

_NOTICEABLE = 1e-3
"""A motion that has eased out by itself is let go with less."""

_WHOLE = 0.99
"""The weight from which on a layer hides what is below it: a shift need not have been shown at its very end."""


@dataclass(frozen=True, slots=True)
class Release:
    """A layer that leaves.

    Attributes:
        layer: as it was shown last.
        since: when it began to leave.
        duration: until nothing is left of it, s.
        height: where the motion that it is of lay among others: what was below stays below.
        drift: how it goes on; None if it was at rest.
        under: the weight of what leaves above it at the same time and is the same as what has come below it. It leaves
            so that the two together go straight from what was shown to what has come.
    """

    layer: Layer
    since: GlobalTime
    duration: float = DURATION
    height: tuple[float, float] = LOWEST
    drift: Drift | None = None
    under: float = 0.0

    def over(self, now: GlobalTime) -> bool:
        """Whether nothing of it is left."""
        return now >= self.since + self.duration or self.layer.weight * (1.0 - self.under) < _NOTICEABLE

    def at(self, now: GlobalTime) -> Layer:
        """What is left of it."""
        layer = self.layer if self.drift is None else self.drift(self.layer, now)
        left = 1.0 - minimum_jerk(share(now, self.since, self.since + self.duration))
        return replace(layer, weight=layer.weight * left * (1.0 - self.under) / (1.0 - self.under * left))


def stacked(
    releases: Iterable[Release], playing: Iterable[tuple[tuple[float, float], Layer]], now: GlobalTime
) -> list[Layer]:
    """Layers that leave and layers that play, the lowest first.

    Args:
        releases: what leaves.
        playing: layers with their heights, in order.
        now: time of the frame.
    """
    heights = [*((release.height, release.at(now)) for release in releases), *playing]
    return [layer for _, layer in sorted(heights, key=itemgetter(0))]


def caught(layer: Layer, root: Vec3) -> Layer:
    """A layer that is to leave: from where the figure is, where it has been asked to be elsewhere too soon.

    Args:
        layer: as it was asked for.
        root: where HumanoidRoot has come to, as a displacement from its default place, m.
    """
    leads = layer.kind is not LayerKind.ADDITIVE and layer.weight_of(ROOT) == 1.0
    outrun = layer.root is not None and distance(layer.root, root) > _OUTRUN
    return replace(layer, root=root) if leads and outrun else layer


def uncovered(release: Release, layer: Layer, height: tuple[float, float]) -> Release:
    """What of a release is seen again below a posture that stays.

    Args:
        release: what leaves.
        layer: the posture, as it was shown last.
        height: where it lay among others.
    """
    leaves = release.layer
    below = (leaves.kind, release.height) < (layer.kind, height)
    if layer.weight < _WHOLE or not below:
        return release
    rotations = {joint: turn for joint, turn in leaves.rotations.items() if joint not in layer.rotations}
    root = leaves.root if layer.root is None else None
    return replace(release, layer=replace(leaves, rotations=rotations, root=root))


def release_duration(layer: Layer, roots: Iterable[Vec3]) -> float:
    """How long a layer takes to leave, s: where the whole figure has to move, longer.

    Args:
        layer: that leaves.
        roots: where HumanoidRoot may be without it, as displacements from its default place, m.
    """
    place = layer.root
    moved = 0.0 if place is None else layer.weight * max(distance(place, root) for root in roots)
    return max(DURATION, min(_A_METER * moved, _LONGEST), _WALK * moved)
