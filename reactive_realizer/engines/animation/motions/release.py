"""Hands that let go of what they carry or hold on to, as motions that move nothing."""

from collections.abc import Sequence

from reactive_realizer.bml.release import Release
from reactive_realizer.bml.vocabulary import Mode
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.world import World
from reactive_realizer.engines.animation.faults import NoJoints, WrongElement
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_unit import Moment, MotionPose, MotionUnit, arms_used
from reactive_realizer.engines.animation.motions.touching_arm import TouchingArm
from reactive_realizer.errors import RealizerError

_SIDES = {Mode.LEFT_HAND: "l", Mode.RIGHT_HAND: "r", Mode.BOTH_HANDS: "lr"}


class ReleaseMotionUnit(MotionUnit):
    """Lets go of what some joints carry when it starts.

    Attributes:
        released: the arms, as resources.
    """

    kind = LayerKind.ADDITIVE
    joints = frozenset()
    preferred_duration = 0.1

    def __init__(self, world: World, holders: Sequence[str], released: frozenset[str]) -> None:
        """Plan a release.

        Args:
            world: with what is carried.
            holders: the joints that carry it, ``alice:r_middle3``.
            released: the arms, as resources.
        """
        self.parameters = {}
        self.released = released
        self._world = world
        self._holders = holders

    def start(self, body: Body) -> None:
        """Leave what is carried where it is."""
        for joint in self._holders:
            self._world.let_go(joint)

    def pose(self, moment: Moment) -> MotionPose:
        """Return no rotations."""
        return MotionPose({})


class ReleaseMaker:
    """Makes releases."""

    def __init__(self, context: MakerContext) -> None:
        self._context = context

    def __call__(self, request: MotionRequest) -> ReleaseMotionUnit:
        """Make a motion."""
        behavior, skeleton = request.behavior, self._context.humanoid.avatar.skeleton
        if not isinstance(behavior, Release):
            raise RealizerError(WrongElement(unit="release", element=behavior.name))
        arms = [TouchingArm(skeleton, side) for side in _SIDES[behavior.mode]]
        if missing := [joint for arm in arms for joint in arm.missing]:
            raise RealizerError(NoJoints(element=behavior.name, joints=tuple(missing)))
        holders = [f"{self._context.character}:{arm.holder}" for arm in arms]
        return ReleaseMotionUnit(
            self._context.world, holders, arms_used(frozenset().union(*(arm.joints for arm in arms)))
        )
