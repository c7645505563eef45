"""Postures as motions: taking a posture, and leaving it."""

import math
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path
from types import MappingProxyType

from reactive_realizer.bml.behaviors import Pose, Posture, PostureShift
from reactive_realizer.bml.vocabulary import PosePart, StanceType
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.pose import Layer, LayerKind, over
from reactive_realizer.embodiment.speed_limit import ROOT_SPEED
from reactive_realizer.embodiment.vector import Vec3, distance, scale
from reactive_realizer.engines.animation.animation_unit import AnimationUnit
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.faults import WrongElement
from reactive_realizer.engines.animation.keyframe.clip_files import preload_clip
from reactive_realizer.engines.animation.kinematics import path_length
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_timing import motion_timing
from reactive_realizer.engines.animation.motion_unit import (
    START_TO_END,
    Moment,
    MotionPose,
    MotionUnit,
    Predictability,
    Resource,
)
from reactive_realizer.engines.animation.posture.detour import SWING, Detour, find_detour
from reactive_realizer.engines.animation.posture.posture_library import PART_JOINTS, BodyPosture
from reactive_realizer.engines.animation.posture.rest_posture import RestPosture
from reactive_realizer.engines.animation.shortest import from_rest, lag, moving_time
from reactive_realizer.errors import RealizerError

_BOW = {"vl5": (0.6, 0.0, 0.0), "vt10": (0.3, 0.0, 0.0)}
"""Bow of the trunk while the pelvis sinks or rises by half a meter, Euler angles, rad.

Without it the figure would fall.

M. Schenkman et al., "Whole-body movements during rising to standing from sitting" (Physical Therapy 70, 1990): the
trunk is bent most when it leaves the seat.
"""

_BODY = 450
"""Further work of each body in a posture that was not known before: files may have to be read for it."""

_MIDWAY = (0.25, 0.5, 0.75)
"""Shares of the way at which a detour is measured."""

_THERE_AND_BACK = MappingProxyType({"start": 0.0, "ready": 0.25, "relax": 0.75, "end": 1.0})
"""A quarter to come, half to stay, a quarter to go."""


class PostureMotionUnit(MotionUnit):
    """Moves to a posture from start to ready, stays until relax, and leaves it for the layers below until end.

    The posture is the base posture with the given stance and poses. A shift has only start and end: it stays and
    becomes the base posture.

    Attributes:
        change: the given stance and poses.
    """

    kind = LayerKind.POSTURE
    planning_work = 150
    resources = frozenset({Resource.STANCE})
    group = "posture"
    predictability = Predictability.ONCE_STARTED

    def __init__(
        self,
        rest: RestPosture,
        stance: StanceType | None,
        poses: Iterable[Pose],
        *,
        shift: bool = False,
    ) -> None:
        """Plan a posture.

        Args:
            rest: the base posture, now and at the start.
            stance: None for that of the base posture.
            poses: of parts of the body.
            shift: whether the posture becomes the base posture.

        Raises:
            RealizerError: "no-posture": there is no such pose.
        """
        self.parameters = {}
        self.persists_as = "posture" if shift else None
        self._rest = rest
        self.change = (stance, tuple(poses))
        self.key_positions = START_TO_END if shift else _THERE_AND_BACK
        self._ready, self._relax = (self.key_positions.get(sync, 1.0) for sync in ("ready", "relax"))
        rest.check(BodyPosture(stance or rest.expected.stance, self.change[1]))
        found = rest.found
        self._update_goal(rest.expected)
        self.planning_work += _BODY * (rest.found - found)
        self._take(Detour(self._bends(self._from)).limited(self._from, self.body))

    def find_detour(self) -> Iterator[int]:
        """Find the way of the arms around the body from the base posture, in steps (`PlanUnit.finish_planning`)."""
        if self.joints.isdisjoint(SWING):
            return
        begin, goal, remembered = self._from, self.body.posed(self._goal, self._root), self._rest.detours
        detour = remembered.get((begin, goal))
        if detour is None:
            detour = yield from find_detour(begin, goal, self._rest.clear, self._detour)
            remembered.add((begin, goal), detour, 1)
        self._take(detour)

    def _take(self, detour: Detour) -> None:
        """Go to the goal by a detour, in the time that it takes."""
        self._detour = detour
        # If only the arms move, other postures of the body make no difference.
        starts = (self._from,) if self._root is None else (self._from, *self._rest.possible_bodies)
        self.fade_in = max(map(self._duration_from, starts))
        self.preferred_duration = self.fade_in / self._ready
        self.shortest = {"end" if self.persists_as else "ready": self._shortest()}

    def _shortest(self) -> float:
        """Return the shortest duration of the change, s."""
        goal = self.body.posed({}, self._from.root)
        limbs = moving_time((self._from, *self._midway(self._from), goal), self.joints)
        pelvis = 0.0 if self._root is None else distance(self._from.root, self._root) / ROOT_SPEED
        return min(self.fade_in or 0.0, from_rest(lag(minimum_jerk) * max(limbs, pelvis), self.joints))

    def _update_goal(self, base: BodyPosture) -> None:
        """Determine the goal from a base posture."""
        self._base = base
        self._from = self._rest.in_posture(base)
        self.posture: BodyPosture = base.changed(*self.change)
        self.body: Body = self._rest.in_posture(self.posture)
        moved = {joint for joint, turn in self.body.pose.items() if turn != self._from.rotation(joint)}
        turned = (moved | self._named_joints() | _BOW.keys()) & self.body.pose.keys()
        self.joints = frozenset(turned)
        self._goal = {joint: self.body.rotation(joint) for joint in turned}
        self._root = None if turned.isdisjoint(PART_JOINTS[PosePart.LEGS]) else self.body.root

    def _bends(self, begin: Body) -> dict[str, Vec3]:
        """Return how the trunk bows and the arms swing midway from a body, Euler angles, rad."""
        if self._root is None:
            return {}
        bow = 2.0 * abs(self._root[1] - begin.root[1])
        return {joint: scale(angles, bow) for joint, angles in (_BOW | SWING).items() if joint in self._goal}

    def _named_joints(self) -> frozenset[str]:
        """Return the joints that the behavior names; postures that play below do not show through them."""
        stance, poses = self.change
        parts = [PosePart.WHOLEBODY] if stance else [pose.part for pose in poses]
        return frozenset().union(*(PART_JOINTS[part] for part in parts))

    def _duration_from(self, begin: Body) -> float:
        """Return the duration of the change, s: less than a second for the arms alone, almost two for sitting down."""
        hands = path_length("wrist", SIDES, (begin, *self._midway(begin), self.body))
        feet = path_length("ankle", SIDES, (begin, self.body))
        pelvis = distance(begin.root, self.body.root)
        # For feet, lifting and setting them down in turn matters more than distance.
        return max(0.5, 0.3 + 1.0 * hands, 0.4 + 1.7 * math.sqrt(feet), 0.5 + 2.2 * pelvis)

    def _midway(self, begin: Body) -> list[Body]:
        """Return bodies on the way from a body, with its root, if the arms make a detour."""
        arms = self._detour._replace(bends={})
        layers = (Layer(self.kind, arms.turned(self._goal, weight), weight) for weight in _MIDWAY if arms.turns)
        return [over(begin, layer) for layer in layers]

    def start(self, body: Body) -> None:
        """Start. The base posture may differ from the expected one, and another posture may still play."""
        if self._rest.posture != self._base:
            self._update_goal(self._rest.posture)
        # A search from there would hold up the tick. Each frame keeps the arms clear of what this way leaves.
        self._detour = self._detour._replace(bends=self._bends(body)).limited(self._from, self.body)

    def pose(self, moment: Moment) -> MotionPose:
        """Return the posture, weighted by the phase."""
        phase = moment.phase
        arrived = minimum_jerk(share(phase, 0.0, self._ready))
        left = minimum_jerk(share(phase, self._relax, 1.0)) if phase > self._relax else 0.0
        weight = arrived * (1.0 - left)
        return MotionPose(self._detour.turned(self._goal, weight), weight, self._root)

    def becomes_rest(self) -> bool:
        """A shift becomes the rest posture."""
        self._rest.adopt(self.posture, self.body)
        return True


class PostureUnit(AnimationUnit):
    """A posture between pegs, whose duration is known once the way of the arms is found."""

    motion: PostureMotionUnit

    def finish_planning(self) -> Iterator[int]:
        """Find the way of the arms, and take the time that it needs."""
        yield from self.motion.find_detour()
        self.loosen(motion_timing(self.behavior, self.motion, self.keys))


class PostureMaker:
    """Makes postures, and shifts of posture."""

    def __init__(self, context: MakerContext) -> None:
        self._rest = context.rest
        self._skeleton = context.humanoid.avatar.skeleton

    def __call__(self, request: MotionRequest) -> PostureMotionUnit:
        """Make a motion."""
        behavior = request.behavior
        if not isinstance(behavior, Posture):
            raise RealizerError(WrongElement(unit="posture", element=behavior.name))
        shift = isinstance(behavior, PostureShift)
        return PostureMotionUnit(self._rest, behavior.stance, behavior.poses, shift=shift)

    def preload(self, request: MotionRequest) -> Callable[[], object] | None:
        """Return the work of reading captures with poses of the posture; None if there are none."""
        behavior = request.behavior
        files = self._rest.captures(behavior.stance, behavior.poses) if isinstance(behavior, Posture) else []
        return partial(self._load, files) if files else None

    def _load(self, files: Iterable[Path]) -> None:
        for file in files:
            preload_clip(file, self._skeleton, 0.0)


def posture_after(posture: BodyPosture, motions: Iterable[MotionUnit]) -> BodyPosture:
    """Return the posture after motions, of which shifts change it."""
    for motion in motions:
        if motion.persists_as is not None and isinstance(motion, PostureMotionUnit):
            posture = posture.changed(*motion.change)
    return posture


def temporary_bodies(motions: Iterable[MotionUnit]) -> Iterator[Body]:
    """Yield the bodies of postures that do not persist."""
    for motion in motions:
        if isinstance(motion, PostureMotionUnit) and motion.persists_as is None:
            yield motion.body
