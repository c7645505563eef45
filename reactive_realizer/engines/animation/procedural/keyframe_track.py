"""Keyframes inside procedural animations."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import other_side
from reactive_realizer.embodiment.quaternion import (
    IDENTITY,
    Quat,
    conjugate,
    from_axis_angle,
    from_euler,
    multiply,
    normalize,
    slerp,
)
from reactive_realizer.embodiment.vector import unit
from reactive_realizer.engines.animation.keyframe.clip import Clip
from reactive_realizer.engines.animation.procedural.tracks import (
    Formulas,
    JointTrack,
    TrackPose,
    negated,
    parent_rotation,
)


@dataclass(frozen=True, slots=True)
class Encoding:
    """A way to write a rotation as numbers.

    Attributes:
        size: number of numbers.
        mirrored: indices of numbers that change sign when mirrored.
        rotation: converts the numbers; raises ArithmeticError if they do not define a rotation.
    """

    size: int
    mirrored: tuple[int, ...]
    rotation: Callable[[Sequence[float]], Quat]


def _quaternion(values: Sequence[float]) -> Quat:
    w, x, y, z = values
    return normalize((w, x, y, z))


def _axis_angle(values: Sequence[float]) -> Quat:
    x, y, z, angle = values
    return from_axis_angle(unit((x, y, z)), angle) if angle else IDENTITY


def _euler(values: Sequence[float]) -> Quat:
    x, y, z = values
    return from_euler(x, y, z)


ENCODINGS: Mapping[str, Encoding] = MappingProxyType(
    {
        "quaternion": Encoding(4, (2, 3), _quaternion),
        "axisangles": Encoding(4, (1, 2), _axis_angle),
        "euler": Encoding(3, (1, 2), _euler),
    }
)
"""Encodings by AsapRealizer's names: w;x;y;z, or the axis x;y;z and the right-handed angle about it, or the angles of
`from_euler`; rad.
"""


@dataclass(frozen=True, slots=True)
class RotationKey:
    """A rotation at a phase.

    Attributes:
        phase: 0 to 1.
        local: whether the rotation is local to the parent; otherwise it is in the figure's axes.
        rotation: formulas of its numbers.
    """

    phase: float
    local: bool
    rotation: Formulas


@dataclass(frozen=True, slots=True)
class KeyframeTrack(JointTrack):
    """Rotates a joint through keyframes, along the shortest arcs between them.

    Attributes:
        encoding: of its rotations.
        keyframes: one or more, in order of phase.
    """

    encoding: Encoding
    keyframes: tuple[RotationKey, ...]

    @property
    def formulas(self) -> Formulas:
        """See `Track`."""
        return tuple(formula for key in self.keyframes for formula in key.rotation)

    @property
    def independent(self) -> bool:
        """See `Track`."""
        return all(key.local for key in self.keyframes)

    def evaluate(self, values: Sequence[float], phase: float, body: Callable[[], Body]) -> TrackPose:
        """See `Track`."""
        after = next((i for i, key in enumerate(self.keyframes) if key.phase >= phase), len(self.keyframes) - 1)
        before = max(0, after - 1)
        begin, end = self.keyframes[before].phase, self.keyframes[after].phase
        goal = self._rotation(after, values, body)
        if end <= begin or phase >= end:
            return TrackPose({self.joint: goal})
        start = self._rotation(before, values, body)
        return TrackPose({self.joint: slerp(start, goal, max(0.0, phase - begin) / (end - begin))})

    def _rotation(self, i: int, values: Sequence[float], body: Callable[[], Body]) -> Quat:
        size = self.encoding.size
        rotation = self.encoding.rotation(values[i * size : (i + 1) * size])
        return (
            rotation if self.keyframes[i].local else multiply(conjugate(parent_rotation(self.joint, body())), rotation)
        )

    def mirrored(self) -> "KeyframeTrack":
        """See `Track`."""
        turned = self.encoding.mirrored
        keyframes = (replace(key, rotation=negated(key.rotation, *turned)) for key in self.keyframes)
        return KeyframeTrack(other_side(self.joint), self.encoding, tuple(keyframes))


@dataclass(frozen=True, slots=True)
class ClipTrack:
    """Plays a clip, stretched to the duration of the animation."""

    clip: Clip

    @property
    def formulas(self) -> Formulas:
        """See `Track`."""
        return ()

    @property
    def joints(self) -> frozenset[str]:
        """See `Track`."""
        return frozenset(self.clip.joints)

    @property
    def independent(self) -> bool:
        """See `Track`."""
        return True

    def evaluate(self, values: Sequence[float], phase: float, body: Callable[[], Body]) -> TrackPose:
        """See `Track`."""
        return TrackPose(self.clip.rotations_at(self.clip.times[0] + phase * self.clip.duration))

    def mirrored(self) -> "ClipTrack":
        """See `Track`."""
        return ClipTrack(self.clip.mirrored())

    def restricted_to(self, joints: frozenset[str]) -> "ClipTrack | None":
        """See `Track`."""
        return ClipTrack(self.clip.only(joints)) if self.joints & joints else None

    def fitted_to(self, skeleton: Skeleton) -> "ClipTrack | None":
        """See `Track`."""
        return ClipTrack(self.clip.folded(skeleton.joints)).restricted_to(frozenset(skeleton.joints))
