"""Shifts the wrist of a posed arm, by the smallest turns of elbow and shoulder; the hand keeps its direction."""

import math
from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import NamedTuple

from reactive_realizer.embodiment.arm_anatomy import ArmAnatomy, ArmRotations
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.quaternion import (
    IDENTITY,
    Quat,
    between,
    conjugate,
    from_axis_angle,
    multiply,
    rotate,
    twist,
)
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, cross, dot, length, scale, subtract, unit

_STRAIGHT = 1e-6
"""Product of the bones of an arm, m^2, below which it has no plane."""

_SOFT = 0.85
"""Share of the reach of an arm from which on a shift stretches it less than asked (ours)."""

_STILL = 1e-9
"""A shorter shift is none, m."""


class CarriedArm(NamedTuple):
    """An arm of a skeleton with the shoulder girdle that carries it.

    Places and shifts are in the axes of the joint that carries the girdle, from that joint, m, and move with the trunk.

    Attributes:
        side: "l" or "r".
        limb: its bones.
        girdle: from the carrying joint to the girdle, m; None if the figure has none, and that joint carries the arm.
        shoulder: from there to the shoulder, m.
        anatomy: its limits.
    """

    side: str
    limb: Arm
    girdle: Vec3 | None
    shoulder: Vec3
    anatomy: ArmAnatomy

    @classmethod
    @lru_cache
    def of(cls, skeleton: Skeleton, side: str) -> "CarriedArm":
        """Return the left ("l") or right ("r") arm of a skeleton that has it."""
        limb, anatomy = Arm.of(skeleton, side), ArmAnatomy.of(skeleton, side)
        girdle, shoulder = f"{side}_sternoclavicular", skeleton.offset(f"{side}_shoulder")
        carried = skeleton.parent(f"{side}_shoulder") == girdle
        return cls(side, limb, skeleton.offset(girdle) if carried else None, shoulder, anatomy)

    def place(self, rotations: Mapping[str, Quat], body: Body) -> Vec3:
        """Return the place of the wrist.

        Args:
            rotations: of a motion.
            body: has the rotations of joints that the motion does not turn.
        """
        girdle, shoulder, elbow, _ = self._rotations(rotations, body)
        arm = rotate(shoulder, add(self.limb.upper, rotate(elbow, self.limb.lower)))
        return add(self.girdle or ZERO, rotate(girdle, add(self.shoulder, arm)))

    def shifted(self, rotations: Mapping[str, Quat], body: Body, shift: Vec3) -> Mapping[str, Quat]:
        """Return rotations with the wrist shifted, as far as it reaches and its joints allow.

        Args:
            rotations: of a motion that turns shoulder and elbow; a wrist that it does not turn is carried along.
            body: as for `place`.
            shift: m.
        """
        if length(shift) < _STILL:
            return rotations
        girdle, shoulder, elbow, wrist = self._rotations(rotations, body)
        lower = rotate(elbow, self.limb.lower)
        goal = add(rotate(shoulder, add(self.limb.upper, lower)), rotate(conjugate(girdle), shift))
        bend = self._bend(lower, self._reachable(length(add(self.limb.upper, lower)), length(goal)))
        arm = add(self.limb.upper, rotate(bend, lower))
        raised = multiply(between(unit(rotate(shoulder, arm)), unit(goal)), shoulder)
        # Forearm and hand share the turn between them; here the elbow only bends.
        about = twist(elbow, unit(self.limb.lower))
        bent = multiply(bend, multiply(elbow, conjugate(about)))
        first, middle, end = (f"{self.side}_{joint}" for joint in Arm.JOINTS)
        if end not in rotations:
            return {**rotations, first: raised, middle: multiply(bent, about)}
        hand = multiply(shoulder, multiply(elbow, wrist))
        turned = multiply(conjugate(multiply(raised, bent)), hand)
        fitted = self.anatomy.fitted(ArmRotations(raised, bent, turned))
        return {**rotations, first: fitted.shoulder, middle: fitted.elbow, end: fitted.wrist}

    def _rotations(self, rotations: Mapping[str, Quat], body: Body) -> tuple[Quat, Quat, Quat, Quat]:
        """Return the rotations of girdle, shoulder, elbow and wrist."""

        def rotation(joint: str) -> Quat:
            name = f"{self.side}_{joint}"
            return rotations[name] if name in rotations else body.rotation(name)

        girdle = IDENTITY if self.girdle is None else rotation("sternoclavicular")
        return girdle, rotation("shoulder"), rotation("elbow"), rotation("wrist")

    def _reachable(self, now: float, wanted: float) -> float:
        """Return the distance from the shoulder to which a shift brings the wrist, for the present and the wanted one.

        Toward its full extension, an arm stretches ever less: it would look stiff, and its elbow would snap.
        """
        soft = max(now, _SOFT * self.limb.reach)
        if wanted <= soft:
            return wanted
        room = self.limb.reach - soft
        return soft if room <= 0.0 else soft + room * (1.0 - math.exp((soft - wanted) / room))

    def _bend(self, lower: Vec3, far: float) -> Quat:
        """Return the turn of the forearm, in the axes of the upper arm, after which the wrist is at a distance, m."""
        upper = self.limb.upper
        across = cross(upper, lower)
        axis = unit(across) if length(across) > _STRAIGHT else Arm.HINGE
        bones = length(upper) * length(lower)
        cosine = (far * far - dot(upper, upper) - dot(lower, lower)) / (2.0 * bones)
        now = math.atan2(length(across), dot(upper, lower))
        return from_axis_angle(axis, math.acos(max(-1.0, min(1.0, cosine))) - now)


class Way(NamedTuple):
    """The part of a way that is done.

    Attributes:
        begin: rotations where it begins.
        goal: rotations where it ends.
        done: the completed share.
        curvature: factor of the deviation of the hands from the straight way: 0 makes it straight.
        ahead: how much further the hands are, as a share of the way.
    """

    begin: Mapping[str, Quat]
    goal: Mapping[str, Quat]
    done: float
    curvature: float
    ahead: float = 0.0


def on_way(arms: Iterable[CarriedArm], rotations: Mapping[str, Quat], way: Way, body: Body) -> Mapping[str, Quat]:
    """Return rotations on a way with another curvature, and further ahead.

    Args:
        arms: that carry the hands.
        rotations: on the way; arms whose shoulder they do not turn stay.
        way: so far.
        body: with the rotations of all other joints.
    """
    for arm in arms:
        if f"{arm.side}_shoulder" in rotations:
            here, begin, goal = (arm.place(each, body) for each in (rotations, way.begin, way.goal))
            whole = subtract(goal, begin)
            aside = subtract(here, add(begin, scale(whole, way.done)))
            shift = add(scale(aside, way.curvature - 1.0), scale(whole, way.ahead))
            rotations = arm.shifted(rotations, body, shift)
    return rotations
