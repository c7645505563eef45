"""Tracks of a procedural animation: formulas of phase and parameters for joints."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import NamedTuple, Protocol, Self

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import ROOT, other_side
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, conjugate, from_euler, multiply
from reactive_realizer.embodiment.spine import folded_spine
from reactive_realizer.embodiment.vector import Vec3, subtract
from reactive_realizer.engines.animation.expression.compiler import fold
from reactive_realizer.engines.animation.expression.syntax import Constant, Formula, Negation

Formulas = tuple[Formula, ...]


class TrackPose(NamedTuple):
    """The pose of a track at a phase.

    Attributes:
        rotations: of its joints, local to their parents.
        missed: the joint that does not reach its goal, and its distance from there, m; None if that is not visible.
    """

    rotations: Mapping[str, Quat]
    missed: tuple[str, float] | None = None


class Track(Protocol):
    """Turns some joints of an animation."""

    @property
    def formulas(self) -> Formulas:
        """The formulas whose values it needs."""

    @property
    def joints(self) -> frozenset[str]:
        """The joints that it turns."""

    @property
    def independent(self) -> bool:
        """Whether its pose does not depend on the rest of the body."""

    def evaluate(self, values: Sequence[float], phase: float, body: Callable[[], Body]) -> TrackPose:
        """Return its pose, as near to the goal as possible.

        Args:
            values: of its formulas.
            phase: 0 to 1.
            body: returns the body with the tracks so far.

        Raises:
            ArithmeticError: there is no such rotation.
        """

    def mirrored(self) -> Self:
        """Return the track with left and right exchanged."""

    def restricted_to(self, joints: frozenset[str]) -> Self | None:
        """Return the part of the track for these joints, None if there is none."""

    def fitted_to(self, skeleton: Skeleton) -> Self | None:
        """Return the part of the track that a figure can perform, None if there is none."""


@dataclass(frozen=True, slots=True)
class JointTrack:
    """Turns one joint.

    Attributes:
        joint: H-Anim name.
    """

    joint: str

    @property
    def joints(self) -> frozenset[str]:
        """See `Track`."""
        return frozenset({self.joint})

    def restricted_to(self, joints: frozenset[str]) -> Self | None:
        """See `Track`."""
        return self if self.joint in joints else None

    def fitted_to(self, skeleton: Skeleton) -> Self | None:
        """See `Track`."""
        return self if self.joint in skeleton else None


@dataclass(frozen=True, slots=True)
class RotationTrack(JointTrack):
    """Rotates a joint.

    Attributes:
        local: whether the rotation is local to the parent; otherwise it is in the figure's axes.
        formulas: of x, y and z, rad, as for `from_euler`.
    """

    local: bool
    formulas: Formulas

    @property
    def independent(self) -> bool:
        """See `Track`."""
        return self.local

    @property
    def constant(self) -> Quat | None:
        """The rotation, if it never changes."""
        match tuple(map(fold, self.formulas)):
            case Constant(x), Constant(y), Constant(z) if self.local and isfinite(x + y + z):
                return from_euler(x, y, z)
        return None

    def evaluate(self, values: Sequence[float], phase: float, body: Callable[[], Body]) -> TrackPose:
        """See `Track`."""
        x, y, z = values
        rotation = from_euler(x, y, z)
        local = rotation if self.local else multiply(conjugate(parent_rotation(self.joint, body())), rotation)
        return TrackPose({self.joint: local})

    def mirrored(self) -> "RotationTrack":
        """See `Track`."""
        return RotationTrack(other_side(self.joint), self.local, negated(self.formulas, 1, 2))


@dataclass(frozen=True, slots=True)
class FoldedTrack(JointTrack):
    """Turns a vertebra for those that a figure lacks, too (`folded_spine`).

    Attributes:
        parts: the tracks of all of them, from the lowest up.
    """

    parts: tuple[Track, ...]

    @property
    def formulas(self) -> Formulas:
        """See `Track`."""
        return tuple(formula for part in self.parts for formula in part.formulas)

    @property
    def independent(self) -> bool:
        """See `Track`."""
        return all(part.independent for part in self.parts)

    def evaluate(self, values: Sequence[float], phase: float, body: Callable[[], Body]) -> TrackPose:
        """See `Track`."""
        turned, first = IDENTITY, 0
        for part in self.parts:
            last = first + len(part.formulas)
            for rotation in part.evaluate(values[first:last], phase, body).rotations.values():
                turned = multiply(turned, rotation)
            first = last
        return TrackPose({self.joint: turned})

    def mirrored(self) -> "FoldedTrack":
        """See `Track`."""
        return FoldedTrack(self.joint, tuple(part.mirrored() for part in self.parts))


def fold_spine(tracks: Sequence[Track], skeleton: Skeleton) -> list[Track]:
    """Return tracks for a figure: those of vertebrae that it lacks are played by others, if they are local."""
    single = {track.joint: track for track in tracks if isinstance(track, JointTrack)}
    able = [joint for joint, track in single.items() if joint in skeleton or track.independent]
    groups = {joint: own for joint, own in folded_spine(able, skeleton.joints).items() if own != (joint,)}
    folded = [FoldedTrack(joint, tuple(single[each] for each in own)) for joint, own in groups.items()]
    gone = [single[each] for own in groups.values() for each in own]
    return [*(track for track in tracks if track not in gone), *folded]


@dataclass(frozen=True, slots=True)
class RootTrack:
    """Moves HumanoidRoot.

    Attributes:
        local: whether formulas give the displacement from the default pose; otherwise they give the position in the
            figure's frame, whose origin is on the ground between the feet.
        formulas: of x, y and z, m.
    """

    local: bool
    formulas: Formulas

    def moved(self, values: Sequence[float], skeleton: Skeleton) -> Vec3:
        """Return the displacement from the default pose, m."""
        x, y, z = values
        return (x, y, z) if self.local else subtract((x, y, z), skeleton.offset(ROOT))

    def mirrored(self) -> "RootTrack":
        """Return the track with left and right exchanged."""
        return RootTrack(self.local, negated(self.formulas, 0))


def parent_rotation(joint: str, body: Body) -> Quat:
    """Return the rotation of a joint's parent, from its axes to the figure's."""
    parent = body.skeleton.parent(joint)
    return IDENTITY if parent is None else body.transform(parent).rotation


def negated(formulas: Formulas, *which: int) -> Formulas:
    """Return formulas with the sign of some changed."""
    return tuple(Negation(node) if i in which else node for i, node in enumerate(formulas))
