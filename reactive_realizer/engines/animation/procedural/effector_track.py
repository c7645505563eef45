"""Where hands and feet are: what the joints of a limb have to do for it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import atan2

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import SIDES, TRUNK, other_side
from reactive_realizer.embodiment.quaternion import (
    Quat,
    conjugate,
    difference,
    from_axis_angle,
    multiply,
    power,
    rotate,
    twist,
)
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.two_bone_ik import Arm, Leg
from reactive_realizer.embodiment.vector import UP, Vec3, add, length, subtract, unit
from reactive_realizer.engines.animation.procedural.tracks import Formulas, Turned, above, negated

EFFECTORS: Mapping[str, tuple[type[Arm] | type[Leg], str]] = {
    "l_wrist": (Arm, "l"),
    "r_wrist": (Arm, "r"),
    "l_ankle": (Leg, "l"),
    "r_ankle": (Leg, "r"),
}
"""Joint -> the limb that ends in it, and its side."""

_CARRYING = (*TRUNK, *(f"{side}_sternoclavicular" for side in SIDES))

# m; a hand that is so far from its place in the figure's frame does not seem to be there.
_MISSED = 0.01

# Places seen from a shoulder were measured on another arm; however long that is, this one makes the same motion at its
# own size. The published files are for arms up to half as long again.
_STRETCHED = 0.5

# A bone as short as this, m, has no direction.
_NO_BONE = 1e-4


@dataclass(frozen=True, slots=True)
class EffectorTrack:
    """Where a wrist or an ankle is; the two joints above follow by inverse kinematics.

    A foot stays parallel to the ground, its toes where the knee points, unless the animation turns the ankle too.

    Attributes:
        limb: an arm or a leg.
        side: "l" or "r".
        local: the place is from the limb's first joint, in the axes of the joint above it, which lean and turn with the
            trunk; else it is in the figure's frame, from the ground between the feet.
        formulas: of x, y, z, m, and of the swivel of elbow or knee, rad (`Limb.solve`).
    """

    limb: type[Arm] | type[Leg]
    side: str
    local: bool
    formulas: Formulas

    @property
    def chain(self) -> tuple[str, str, str]:
        """The joints of the limb from its first to its end."""
        first, middle, end = self.limb.JOINTS
        return f"{self.side}_{first}", f"{self.side}_{middle}", f"{self.side}_{end}"

    @property
    def reaches(self) -> bool:
        """Whether it brings a hand to a place that does not move with the trunk."""
        return self.limb is Arm and not self.local

    @property
    def led(self) -> frozenset[str]:
        """The joints that nothing else may turn."""
        return frozenset(self.chain[:2])

    @property
    def joints(self) -> frozenset[str]:
        """As every track."""
        return frozenset(self.chain) if self.limb is Leg else self.led

    @property
    def alone(self) -> bool:
        """As every track; a foot is kept parallel to the ground."""
        return self.local and self.limb is Arm

    def turned(self, values: Sequence[float], phase: float, body: Callable[[], Body]) -> Turned:
        """As every track."""
        first, middle, end = self.chain
        now = body()
        x, y, z, swivel = values
        goal = (x, y, z) if self.local else _seen_from(first, (x, y, z), now)
        limb = self.limb.of(now.skeleton, self.side)
        upper, lower = limb.solve(goal, swivel)
        missing = limb.missed(goal)
        missed = (end, missing) if missing > (_STRETCHED * limb.reach if self.local else _MISSED) else None
        if self.limb is Arm:
            return Turned({first: upper, middle: lower}, missed)
        shank = multiply(above(first, now), multiply(upper, lower))
        return Turned({first: upper, middle: lower, end: _flat(shank)}, missed)

    def mirrored(self) -> "EffectorTrack":
        """As every track."""
        return EffectorTrack(self.limb, other_side(self.side), self.local, negated(self.formulas, 0, 3))

    def of(self, joints: frozenset[str]) -> "EffectorTrack | None":
        """As every track; half a limb would reach nothing, so it is all or nothing."""
        return self if self.joints & joints else None

    def on(self, skeleton: Skeleton) -> "EffectorTrack | None":
        """As every track."""
        _, middle, end = self.chain
        whole = all(joint in skeleton for joint in self.chain)
        return self if whole and min(length(skeleton.offset(joint)) for joint in (middle, end)) > _NO_BONE else None


def _seen_from(joint: str, place: Vec3, body: Body) -> Vec3:
    """A place of the figure's frame from a joint, in the axes of the joint above it."""
    return rotate(conjugate(above(joint, body)), subtract(place, body.place(joint).position))


def as_carried(body: Body, steady: Body, shown: Body) -> Body:
    """A body whose trunk carries the arms where it was shown: what is added to a motion moves hands, too.

    Args:
        body: as a motion wants it.
        steady: as shown last, without additive motion.
        shown: as shown last.
    """
    carrying = (joint for joint in _CARRYING if joint in body.skeleton)
    added = ((joint, difference(steady.rotation(joint), shown.rotation(joint))) for joint in carrying)
    turned = {joint: multiply(body.rotation(joint), turn) for joint, turn in added}
    return body.posed(turned, add(body.root, subtract(shown.root, steady.root)))


def _flat(shank: Quat) -> Quat:
    """The rotation of an ankle with which its foot is parallel to the ground.

    Args:
        shank: from the knee's axes to the figure's.
    """
    x, _, z = rotate(shank, (1.0, 0.0, 0.0))
    return multiply(conjugate(shank), from_axis_angle(UP, atan2(-z, x)))


def share_twist(side: str, turned: Mapping[str, Quat], skeleton: Skeleton) -> Mapping[str, Quat]:
    """Rotations with half of a wrist's twist made by the forearm, as a radius and an ulna do; the hand stays as it is.

    All of it in the wrist would wring the skin there like a towel.
    """
    elbow, wrist = f"{side}_elbow", f"{side}_wrist"
    if wrist not in turned:
        return {}
    half = power(twist(turned[wrist], unit(skeleton.offset(wrist))), 0.5)
    return {elbow: multiply(turned[elbow], half), wrist: multiply(conjugate(half), turned[wrist])}
