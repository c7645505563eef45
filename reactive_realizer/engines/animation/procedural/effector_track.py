"""End effectors: hands and feet that follow formulas, with inverse kinematics for their limbs."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import atan2

from reactive_realizer.embodiment.arm_anatomy import ArmAnatomy, ArmRotations
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import CARRYING, other_side
from reactive_realizer.embodiment.quaternion import (
    IDENTITY,
    Quat,
    conjugate,
    difference,
    from_axis_angle,
    multiply,
    rotate,
)
from reactive_realizer.embodiment.shoulder_rhythm import raised
from reactive_realizer.embodiment.two_bone_ik import Arm, Leg
from reactive_realizer.embodiment.vector import UP, Vec3, add, length, scale, subtract
from reactive_realizer.engines.animation.procedural.tracks import Formulas, TrackPose, negated, parent_rotation

EFFECTORS: Mapping[str, tuple[type[Arm] | type[Leg], str]] = {
    "l_wrist": (Arm, "l"),
    "r_wrist": (Arm, "r"),
    "l_ankle": (Leg, "l"),
    "r_ankle": (Leg, "r"),
}
"""Joint -> the limb that ends in it, and its side."""

# Distance from which on a hand visibly misses its goal in the figure's frame, m.
_MISSED = 0.01

# The same for goals relative to a shoulder, as a share of the arm's reach. They were measured on another arm, and this
# one performs the same motion at its own size. Published files are for arms that are up to half as long again.
_STRETCHED = 0.5

# Reach of the arms that perform a local motion as its file says, m: those of the package's avatars, on whose chests the
# hands lie as in the file. Shorter and longer arms perform it at their own size.
_USUAL_REACH = (0.43, 0.52)

# A shorter bone has no direction, m.
_NO_BONE = 1e-4


@dataclass(frozen=True, slots=True)
class EffectorTrack:
    """Places a wrist or an ankle; the two joints above follow by inverse kinematics.

    A foot stays parallel to the ground with its toes in the direction of the knee, unless the animation turns the ankle
    too.

    Attributes:
        limb: an arm or a leg.
        side: "l" or "r".
        local: whether the goal is relative to the limb's first joint, in the axes of its parent, which move with the
            trunk; otherwise it is in the figure's frame, whose origin is on the ground between the feet.
        formulas: of x, y, z, m, and of the swivel of elbow or knee, rad (`Limb.solve`).
    """

    limb: type[Arm] | type[Leg]
    side: str
    local: bool
    formulas: Formulas

    @property
    def chain(self) -> tuple[str, str, str]:
        """The joints of the limb, from its first joint to its end."""
        first, middle, end = self.limb.JOINTS
        return f"{self.side}_{first}", f"{self.side}_{middle}", f"{self.side}_{end}"

    @property
    def reaches(self) -> bool:
        """Whether it brings a hand to a goal that does not move with the trunk."""
        return self.limb is Arm and not self.local

    @property
    def controlled(self) -> frozenset[str]:
        """The joints that no other track may turn."""
        return frozenset(self.chain[:2])

    @property
    def joints(self) -> frozenset[str]:
        """See `Track`."""
        return frozenset(self.chain) if self.limb is Leg else self.controlled

    @property
    def independent(self) -> bool:
        """See `Track`. The pose of a foot depends on the body: it stays parallel to the ground."""
        return self.local and self.limb is Arm

    def evaluate(self, values: Sequence[float], phase: float, body: Callable[[], Body]) -> TrackPose:
        """See `Track`."""
        first, middle, end = self.chain
        now = body()
        x, y, z, swivel = values
        limb = self.limb.of(now.skeleton, self.side)
        size = _size(limb) if self.independent else 1.0
        goal = scale((x, y, z), size) if self.local else _seen_from(first, (x, y, z), now)
        upper, lower = limb.solve(goal, swivel)
        missing = limb.missed(goal)
        missed = (end, missing) if missing > (_STRETCHED * limb.reach if self.local else _MISSED) else None
        if self.limb is Arm:
            return TrackPose({first: upper, middle: lower}, missed)
        shank = multiply(parent_rotation(first, now), multiply(upper, lower))
        return TrackPose({first: upper, middle: lower, end: _flat(shank)}, missed)

    def mirrored(self) -> "EffectorTrack":
        """See `Track`."""
        return EffectorTrack(self.limb, other_side(self.side), self.local, negated(self.formulas, 0, 3))

    def restricted_to(self, joints: frozenset[str]) -> "EffectorTrack | None":
        """Return the track if it turns one of the joints; a part of a limb would reach nothing."""
        return self if self.joints & joints else None

    def fitted_to(self, skeleton: Skeleton) -> "EffectorTrack | None":
        """See `Track`."""
        _, middle, end = self.chain
        whole = all(joint in skeleton for joint in self.chain)
        return self if whole and min(length(skeleton.offset(joint)) for joint in (middle, end)) > _NO_BONE else None


def _size(arm: Arm | Leg) -> float:
    """Return the size at which an arm performs a local motion."""
    shortest, longest = _USUAL_REACH
    return arm.reach / min(max(arm.reach, shortest), longest)


def _seen_from(joint: str, place: Vec3, body: Body) -> Vec3:
    """Convert a point of the figure's frame to one relative to a joint, in the axes of the joint's parent."""
    return rotate(conjugate(parent_rotation(joint, body)), subtract(place, body.transform(joint).position))


def carried_as_shown(body: Body, steady: Body, shown: Body) -> Body:
    """Return a body whose trunk carries the arms as shown. Additive motion moves the hands as well.

    Args:
        body: as a motion asks for it.
        steady: as shown last, without additive motion.
        shown: as shown last.
    """
    carrying = (joint for joint in CARRYING if joint in body.skeleton)
    added = ((joint, difference(steady.rotation(joint), shown.rotation(joint))) for joint in carrying)
    turned = {joint: multiply(body.rotation(joint), turn) for joint, turn in added}
    return body.posed(turned, add(body.root, subtract(shown.root, steady.root)))


def _flat(shank: Quat) -> Quat:
    """Return the rotation of an ankle that keeps its foot parallel to the ground.

    Args:
        shank: rotation from the knee's axes to the figure's.
    """
    x, _, z = rotate(shank, (1.0, 0.0, 0.0))
    return multiply(conjugate(shank), from_axis_angle(UP, atan2(-z, x)))


def natural_arm(side: str, turned: Mapping[str, Quat], skeleton: Skeleton) -> Mapping[str, Quat]:
    """Return rotations of an arm whose forearm and hand keep within their limits; none if its hand is not turned.

    A shoulder girdle that is turned to its rest pose takes its share of the elevation of the arm (`shoulder_rhythm`).
    """
    shoulder, elbow, wrist = (f"{side}_{joint}" for joint in Arm.JOINTS)
    if wrist not in turned:
        return {}
    arm, girdle = ArmRotations(turned[shoulder], turned[elbow], turned[wrist]), girdle_of(side)
    carried: dict[str, Quat] = {}
    if turned.get(girdle) == IDENTITY:
        carried[girdle], arm = raised(arm, skeleton, side)
    fitted = ArmAnatomy.of(skeleton, side).fitted(arm)
    return {**carried, shoulder: fitted.shoulder, elbow: fitted.elbow, wrist: fitted.wrist}


def girdle_of(side: str) -> str:
    """Return the joint of the shoulder girdle of a side."""
    return f"{side}_sternoclavicular"
