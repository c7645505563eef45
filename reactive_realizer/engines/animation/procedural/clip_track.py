"""Keyed motion inside of a procedural animation."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.engines.animation.keyframe.clip import Clip
from reactive_realizer.engines.animation.procedural.tracks import Formulas, Turned


@dataclass(frozen=True, slots=True)
class ClipTrack:
    """Joints that turn as they were keyed; the clip takes as long as the animation."""

    clip: Clip

    @property
    def formulas(self) -> Formulas:
        """As every track."""
        return ()

    @property
    def joints(self) -> frozenset[str]:
        """As every track."""
        return frozenset(self.clip.joints)

    @property
    def alone(self) -> bool:
        """As every track."""
        return True

    def turned(self, values: Sequence[float], phase: float, body: Callable[[], Body]) -> Turned:
        """As every track."""
        return Turned(self.clip.rotations_at(self.clip.times[0] + phase * self.clip.duration))

    def mirrored(self) -> "ClipTrack":
        """As every track."""
        return ClipTrack(self.clip.mirrored())

    def of(self, joints: frozenset[str]) -> "ClipTrack | None":
        """As every track."""
        return ClipTrack(self.clip.only(joints)) if self.joints & joints else None

    def on(self, skeleton: Skeleton) -> "ClipTrack | None":
        """As every track."""
        return self.of(frozenset(skeleton.joints))
