"""Fades out the layers of motions of legs or root that have ended or were cut. It blocks no resources."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import inf
from operator import itemgetter

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.inertialization import CARRIED, carried, remaining
from reactive_realizer.embodiment.joints import LOWER_BODY, ROOT
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.vector import Vec3, distance
from reactive_realizer.engines.animation.easing import share

DURATION = 0.6
"""s; a hand released at shoulder height then stays below 2 m/s."""

_DURATION_PER_METER = 2.8
"""Duration for each meter that the pelvis moves, s; getting up from a chair takes almost two seconds."""

_LONGEST = 3.0
"""Limit of the duration, s; longer distances are covered faster."""

_MIN_DURATION_PER_METER = 1.0
"""Minimum duration for each meter, s: the pelvis stays below 2 m/s."""

_LAG = 0.5
"""A figure further behind its motion than this has not kept up with it, m."""

LOWEST = (-inf, -inf)
"""Stacking height below all others."""

_NOTICEABLE = 1e-3
"""Layers with less weight are dropped: they have already eased out."""

_WHOLE = 0.99
"""From this weight on a layer hides those below it; the very last frame of a shift may not have been shown."""


@dataclass(frozen=True, slots=True)
class FadeOut:
    """A layer that fades out.

    Attributes:
        layer: as shown last.
        since: time when it started to fade out, s.
        duration: until it is gone, s.
        height: stacking position of its motion.
        speed: of its weight at that time, 1/s; the weight goes on with it at first.
        under: weight of a layer above it that fades out at the same time and equals the new layer below. The weights
            are chosen such that both together go straight from the old pose to the new one.
    """

    layer: Layer
    since: GlobalTime
    duration: float = DURATION
    height: tuple[float, float] = LOWEST
    speed: float = 0.0
    under: float = 0.0

    def finished(self, now: GlobalTime) -> bool:
        """Return whether the layer is gone."""
        visible = max(self.layer.weight * (1.0 - self.under), CARRIED * self.speed)
        return now >= self.since + self.duration or visible < _NOTICEABLE

    def at(self, now: GlobalTime) -> Layer:
        """Return the layer at a time."""
        left = remaining(share(now, self.since, self.since + self.duration))
        weight = self.layer.weight * left * (1.0 - self.under) / (1.0 - self.under * left)
        carry = min(CARRIED, self.duration)
        further = self.speed * carry * carried(share(now, self.since, self.since + carry))
        return replace(self.layer, weight=min(1.0, max(0.0, weight + further)))


class FadeOuts:
    """The layers of a figure that fade out."""

    def __init__(self) -> None:
        self._layers: list[FadeOut] = []

    def start(self, fade_out: FadeOut) -> None:
        """Have another layer fade out; a former rest posture is below everything else."""
        lowest = fade_out.layer.kind is LayerKind.BASE
        layers = (fade_out, *self._layers) if lowest else (*self._layers, fade_out)
        self._layers = [other for other in layers if not other.finished(fade_out.since)]

    def start_frame(self, now: GlobalTime) -> None:
        """Drop what is gone."""
        self._layers = [layer for layer in self._layers if not layer.finished(now)]

    def hide(self, layer: Layer, height: tuple[float, float]) -> None:
        """Drop what a posture that stays hides.

        Args:
            layer: the posture, as shown last.
            height: its stacking position.
        """
        self._layers = [_visible_part(fade_out, layer, height) for fade_out in self._layers]

    def with_playing(self, playing: Iterable[tuple[tuple[float, float], Layer]], now: GlobalTime) -> list[Layer]:
        """Merge fading and playing layers, lowest first.

        Args:
            playing: layers with their heights, in order.
            now: time of the frame, s.
        """
        if not self._layers:
            return [layer for _, layer in playing]
        heights = [*((fade_out.height, fade_out.at(now)) for fade_out in self._layers), *playing]
        return [layer for _, layer in sorted(heights, key=itemgetter(0))]


def moves_lower_body(layer: Layer) -> bool:
    """Return whether a layer moves legs or root, so that feet have to follow: they can only blend layers."""
    return layer.root is not None or not LOWER_BODY.isdisjoint(layer.rotations)


def with_reached_root(layer: Layer, root: Vec3) -> Layer:
    """Return a layer that starts to fade out, from where the root really is if the figure was too slow to follow.

    Args:
        layer: as the motion requested it.
        root: displacement of HumanoidRoot as shown, m.
    """
    leads = layer.kind is not LayerKind.ADDITIVE and layer.weight_of(ROOT) == 1.0
    outrun = layer.root is not None and distance(layer.root, root) > _LAG
    return replace(layer, root=root) if leads and outrun else layer


def fade_out_duration(layer: Layer, roots: Iterable[Vec3]) -> float:
    """Return the time in which a layer fades out, s: longer if the whole figure moves.

    Args:
        layer: that fades out.
        roots: possible displacements of HumanoidRoot without it, m.
    """
    place = layer.root
    moved = 0.0 if place is None else layer.weight * max(distance(place, root) for root in roots)
    return max(DURATION, min(_DURATION_PER_METER * moved, _LONGEST), _MIN_DURATION_PER_METER * moved)


def _visible_part(fade_out: FadeOut, layer: Layer, height: tuple[float, float]) -> FadeOut:
    leaves = fade_out.layer
    below = (leaves.kind, fade_out.height) < (layer.kind, height)
    if layer.weight < _WHOLE or not below:
        return fade_out
    rotations = {joint: turn for joint, turn in leaves.rotations.items() if joint not in layer.rotations}
    root = leaves.root if layer.root is None else None
    return replace(fade_out, layer=replace(leaves, rotations=rotations, root=root))
