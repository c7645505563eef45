"""What a procedural animation says of joints: formulas of phase and parameters."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite
from typing import NamedTuple, Protocol, Self

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import ROOT, other_side
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, conjugate, from_euler, multiply, slerp
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import Vec3, subtract
from reactive_realizer.engines.animation.expression.compiler import fold
from reactive_realizer.engines.animation.expression.nodes import Negation, Node, Number
from reactive_realizer.engines.animation.procedural.encodings import Encoding

Formulas = tuple[Node, ...]


class Turned(NamedTuple):
    """What a track does at a moment.

    Attributes:
        rotations: of its joints, local to their parents.
        missed: the joint that does not come to where it is wanted, and how far from there it stays, m; None where
            that is nothing to see.
    """

    rotations: Mapping[str, Quat]
    missed: tuple[str, float] | None = None


class Track(Protocol):
    """What turns some joints of an animation."""

    @property
    def formulas(self) -> Formulas:
        """Of which it wants the values."""

    @property
    def joints(self) -> frozenset[str]:
        """Which it turns."""

    @property
    def alone(self) -> bool:
        """Whether it does so in the same way whatever the rest of the body does."""

    def turned(self, values: Sequence[float], phase: float, body: Callable[[], Body]) -> Turned:
        """What it does, as nearly as it can.

        Args:
            values: of its formulas.
            phase: 0 to 1.
            body: as it is turned so far.

        Raises:
            ArithmeticError: there is no such rotation.
        """

    def mirrored(self) -> Self:
        """The same in a mirror."""

    def of(self, joints: frozenset[str]) -> Self | None:
        """What of it is about these joints, None if nothing."""

    def on(self, skeleton: Skeleton) -> Self | None:
        """What of it a figure can do, None if nothing."""


@dataclass(frozen=True, slots=True)
class JointTrack:
    """What turns one joint.

    Attributes:
        joint: H-Anim name.
    """

    joint: str

    @property
    def joints(self) -> frozenset[str]:
        """As every track."""
        return frozenset({self.joint})

    def of(self, joints: frozenset[str]) -> Self | None:
        """As every track."""
        return self if self.joint in joints else None

    def on(self, skeleton: Skeleton) -> Self | None:
        """As every track."""
        return self if self.joint in skeleton else None


@dataclass(frozen=True, slots=True)
class RotationTrack(JointTrack):
    """A joint's rotation.

    Attributes:
        local: to the parent; else in the figure's axes.
        formulas: of x, y and z, rad, as `from_euler` takes them.
    """

    local: bool
    formulas: Formulas

    @property
    def alone(self) -> bool:
        """As every track."""
        return self.local

    @property
    def held(self) -> Quat | None:
        """Its rotation, if that never changes."""
        match tuple(map(fold, self.formulas)):
            case Number(x), Number(y), Number(z) if self.local and isfinite(x + y + z):
                return from_euler(x, y, z)
        return None

    def turned(self, values: Sequence[float], phase: float, body: Callable[[], Body]) -> Turned:
        """As every track."""
        x, y, z = values
        rotation = from_euler(x, y, z)
        local = rotation if self.local else multiply(conjugate(above(self.joint, body())), rotation)
        return Turned({self.joint: local})

    def mirrored(self) -> "RotationTrack":
        """As every track."""
        return RotationTrack(other_side(self.joint), self.local, negated(self.formulas, 1, 2))


@dataclass(frozen=True, slots=True)
class Keyframe:
    """A rotation at a phase.

    Attributes:
        phase: 0 to 1.
        local: to the parent; else in the figure's axes.
        rotation: formulas of its numbers.
    """

    phase: float
    local: bool
    rotation: Formulas


@dataclass(frozen=True, slots=True)
class KeyframeTrack(JointTrack):
    """A joint's rotation through keyframes, along the shortest arcs between them.

    Attributes:
        encoding: of its rotations.
        keyframes: one or more, in order of phase.
    """

    encoding: Encoding
    keyframes: tuple[Keyframe, ...]

    @property
    def formulas(self) -> Formulas:
        """As every track."""
        return tuple(formula for key in self.keyframes for formula in key.rotation)

    @property
    def alone(self) -> bool:
        """As every track."""
        return all(key.local for key in self.keyframes)

    def turned(self, values: Sequence[float], phase: float, body: Callable[[], Body]) -> Turned:
        """As every track."""
        after = next((i for i, key in enumerate(self.keyframes) if key.phase >= phase), len(self.keyframes) - 1)
        before = max(0, after - 1)
        begin, end = self.keyframes[before].phase, self.keyframes[after].phase
        goal = self._rotation(after, values, body)
        if end <= begin or phase >= end:
            return Turned({self.joint: goal})
        start = self._rotation(before, values, body)
        return Turned({self.joint: slerp(start, goal, max(0.0, phase - begin) / (end - begin))})

    def _rotation(self, i: int, values: Sequence[float], body: Callable[[], Body]) -> Quat:
        size = self.encoding.size
        rotation = self.encoding.rotation(values[i * size : (i + 1) * size])
        return rotation if self.keyframes[i].local else multiply(conjugate(above(self.joint, body())), rotation)

    def mirrored(self) -> "KeyframeTrack":
        """As every track."""
        turned = self.encoding.mirrored
        keyframes = (replace(key, rotation=negated(key.rotation, *turned)) for key in self.keyframes)
        return KeyframeTrack(other_side(self.joint), self.encoding, tuple(keyframes))


@dataclass(frozen=True, slots=True)
class RootTrack:
    """Where HumanoidRoot is.

    Attributes:
        local: formulas say how far it is moved from its place in the default pose; else its place in the figure's
            frame, from the ground between the feet.
        formulas: of x, y and z, m.
    """

    local: bool
    formulas: Formulas

    def moved(self, values: Sequence[float], skeleton: Skeleton) -> Vec3:
        """How far it is from its place in the default pose, m."""
        x, y, z = values
        return (x, y, z) if self.local else subtract((x, y, z), skeleton.offset(ROOT))

    def mirrored(self) -> "RootTrack":
        """The same in a mirror."""
        return RootTrack(self.local, negated(self.formulas, 0))


def above(joint: str, body: Body) -> Quat:
    """The rotation of a joint's parent, from its axes to the figure's."""
    parent = body.skeleton.parent(joint)
    return IDENTITY if parent is None else body.place(parent).rotation


def negated(formulas: Formulas, *which: int) -> Formulas:
    """Some formulas with their sign changed."""
    return tuple(Negation(node) if i in which else node for i, node in enumerate(formulas))
