"""What a procedural animation says of each joint and each wrist: formulas of phase and parameters."""

from dataclasses import dataclass, replace

from reactive_realizer.engines.animation.expression.nodes import Negation, Node

Formulas = tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class RotationTrack:
    """A joint's rotation, local to its parent.

    Attributes:
        joint: H-Anim name.
        angles: formulas of x, y and z, rad, as `from_euler` takes them.
    """

    joint: str
    angles: Formulas

    def mirrored(self) -> "RotationTrack":
        """The same in a mirror."""
        return RotationTrack(_other(self.joint), _negated(self.angles, 1, 2))


@dataclass(frozen=True, slots=True)
class EffectorTrack:
    """Where a wrist is; shoulder and elbow follow by inverse kinematics.

    Attributes:
        side: "l" or "r".
        local: the place is from the shoulder, in the axes of the joint above it, which lean and turn with the trunk;
            else it is in the figure's frame, from the ground between the feet.
        path: formulas of x, y, z, m, and of the elbow's swivel, rad (`Arm.solve`).
    """

    side: str
    local: bool
    path: Formulas

    def mirrored(self) -> "EffectorTrack":
        """The same in a mirror."""
        return EffectorTrack(_other(self.side), self.local, _negated(self.path, 0, 3))


@dataclass(frozen=True, slots=True)
class Keyframe:
    """A rotation at a phase.

    Attributes:
        phase: 0 to 1.
        local: to the parent; else in the figure's axes.
        rotation: formulas of w, x, y and z.
    """

    phase: float
    local: bool
    rotation: Formulas


@dataclass(frozen=True, slots=True)
class KeyframeTrack:
    """A joint's rotation through keyframes, along the shortest arcs between them.

    Attributes:
        joint: H-Anim name.
        keyframes: one or more, in order of phase.
    """

    joint: str
    keyframes: tuple[Keyframe, ...]

    def mirrored(self) -> "KeyframeTrack":
        """The same in a mirror."""
        keyframes = (replace(key, rotation=_negated(key.rotation, 2, 3)) for key in self.keyframes)
        return KeyframeTrack(_other(self.joint), tuple(keyframes))


def _other(name: str) -> str:
    """The side or the joint on the other side; a joint of the middle itself."""
    side, underscore, joint = name.partition("_")
    return {"l": "r", "r": "l"}.get(side, side) + underscore + joint


def _negated(formulas: Formulas, *which: int) -> Formulas:
    return tuple(Negation(node) if i in which else node for i, node in enumerate(formulas))
