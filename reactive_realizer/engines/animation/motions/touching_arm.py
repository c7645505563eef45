"""An arm whose fingertips go to a target, and the grip with which its hand turns with the target."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, reduce

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, conjugate, multiply, rotate
from reactive_realizer.embodiment.vector import FORWARD, ZERO, Vec3, add, scale, subtract
from reactive_realizer.engines.animation.key_poses.arm_pose import ArmGoals, SolvedArm
from reactive_realizer.engines.animation.key_poses.direction import Direction
from reactive_realizer.engines.animation.motions.pointing_arm import ArmPose, hand_of
from reactive_realizer.engines.animation.spine_ik import HandGoal

_NEEDED = ("shoulder", "elbow", "wrist")
_FINGERS = ("index", "middle", "ring", "pinky")
_MIDDLE_FINGER = ("middle1", "middle2", "middle3")
_ROUNDS, _DAMPING = 6, 0.6
_DOWN: Vec3 = (0.0, -1.0, 0.0)
"""The fingers of a hanging hand."""
_NEAR = 0.02
"""Distance up to which a target is touched, m."""


@dataclass(frozen=True)
class TouchingArm:
    """An arm of a skeleton, for touching; the hand stays as straight as it is at rest.

    Attributes:
        skeleton: with the proportions of the figure.
        side: "l" or "r".
    """

    skeleton: Skeleton
    side: str

    @property
    def hand(self) -> str:
        """Name of the hand, for messages."""
        return hand_of(self.side)

    @property
    def missing(self) -> list[str]:
        """Joints needed for touching that the skeleton lacks; if there are any, other members must not be used."""
        return [joint for name in _NEEDED if (joint := f"{self.side}_{name}") not in self.skeleton]

    @property
    def holder(self) -> str:
        """The joint that what it carries follows: the one nearest to the fingertips."""
        names = (f"{self.side}_{name}" for name in reversed(("wrist", *_MIDDLE_FINGER)))
        return next(joint for joint in names if joint in self.skeleton)

    @cached_property
    def joints(self) -> frozenset[str]:
        """The joints that touching turns."""
        return frozenset((*(f"{self.side}_{name}" for name in _NEEDED), *self._fingers))

    def aim(self, body: Body, target: Vec3, extent: float = 0.0, turn: Quat | None = None) -> ArmPose:
        """Bring the fingertips to a target, or as near as possible.

        Args:
            body: with the current trunk.
            target: in the figure's frame, m.
            extent: has no effect, because the place of the hand is given.
            turn: rotation of the hand from its axes to the figure's, as far as forearm and wrist allow; None for a hand
                in line with the forearm.
        """
        goal, hand = subtract(target, body.transform(body.skeleton.joints[0]).position), ZERO
        solved = self._with_wrist_at(goal, body, turn)
        for _ in range(_ROUNDS):  # how the hand turns depends on where the wrist is
            turned = subtract(rotate(self.hand_turn(body.posed(solved.rotations)), self._tip), hand)
            hand = add(hand, scale(turned, _DAMPING))
            solved = self._with_wrist_at(subtract(goal, hand), body, turn)
        fault = f"it is {solved.missing:.2f} m too far away" if solved.missing > _NEAR else None
        return ArmPose({**solved.rotations, **self._fingers}, fault)

    def goal(self, target: Vec3) -> HandGoal:
        """Return the goal of the hand for a target in the figure's frame, m."""
        return HandGoal(self.side, target, ArmGoals(self.side, None, self._tip).hand_length(self.skeleton, IDENTITY))

    def hand_turn(self, body: Body) -> Quat:
        """Return the rotation of the hand from its axes to the figure's."""
        return body.transform(f"{self.side}_wrist").rotation

    def _with_wrist_at(self, place: Vec3, body: Body, turn: Quat | None) -> SolvedArm:
        ways = () if turn is None else tuple(Direction(axis, rotate(turn, axis)) for axis in (_DOWN, FORWARD))
        return ArmGoals(self.side, place, directions=ways).solve(body, IDENTITY)

    @cached_property
    def _fingers(self) -> dict[str, Quat]:
        """The rotations of the fingers of a flat hand: those of the default pose."""
        names = (f"{self.side}_{finger}{number}" for finger in _FINGERS for number in (1, 2, 3))
        return {joint: IDENTITY for joint in names if joint in self.skeleton}

    @cached_property
    def _tip(self) -> Vec3:
        """From the wrist to the tip of the stretched middle finger, m; the last bone counts twice, up to its end."""
        bones = [
            self.skeleton.offset(joint) for name in _MIDDLE_FINGER if (joint := f"{self.side}_{name}") in self.skeleton
        ]
        return reduce(add, [*bones, *bones[-1:]], ZERO)


class Grip:
    """The rotations of hands relative to a target: each keeps the one with which it has arrived.

    A target that gets its orientation later is held from then on.

    Args:
        target: returns the orientation of the target in the figure's frame; None if it has none.
    """

    def __init__(self, target: Callable[[], Quat | None]) -> None:
        self._target = target
        self._hands: dict[str, Quat] = {}

    def hold(self, side: str, hand: Quat) -> None:
        """Note the rotation of a hand that is at the target, unless that is known.

        Args:
            side: "l" or "r".
            hand: from its axes to those of the figure.
        """
        target = self._target()
        if target is not None and side not in self._hands:
            self._hands[side] = multiply(conjugate(target), hand)

    def turn(self, side: str) -> Quat | None:
        """Return the rotation of a hand, from its axes to those of the figure; None if it turns with no target."""
        target = self._target()
        return None if target is None or side not in self._hands else multiply(target, self._hands[side])
