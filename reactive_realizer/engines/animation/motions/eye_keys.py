"""Key poses of the eyes as motions: saccades from one place to the next, which end at the times of the poses."""

import math
from bisect import bisect_right
from collections.abc import Iterable, Sequence
from itertools import accumulate
from typing import Final, NamedTuple

from reactive_realizer.bml.key_poses import KeyPose, KeyPoses, LookAtGoal, OrientationGoal
from reactive_realizer.bml.names import Location
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import angle, between, conjugate, rotate
from reactive_realizer.embodiment.vector import FORWARD, Vec3, add, scale, unit
from reactive_realizer.engines.animation.faults import GazeShort
from reactive_realizer.engines.animation.gaze.eye_controller import saccade_duration
from reactive_realizer.engines.animation.gaze.eyes import EyeSockets, direction_between, eye_range
from reactive_realizer.engines.animation.key_poses.direction import FAR
from reactive_realizer.engines.animation.motion_unit import Moment, MotionPose, MotionUnit, ordered

_WORK: Final = 16
"""Work of making it, beside that for each key pose, as the limit `planning_per_tick` counts."""

_SHORTEST: Final = 0.001
"""Duration of a motion whose only pose is reached at once, s."""

_TOLERANCE: Final = math.radians(3.0)
"""Deviation that is not reported, rad, as of gazes."""


class EyeKey(NamedTuple):
    """A key pose of the eyes.

    Attributes:
        reached: when they are there, s after the start of the motion.
        left: when its hold ends, s.
        place: to look at, from the pelvis, in the figure's axes, m; None for a direction.
        way: to look in, in the figure's axes, a unit vector; None for a place.
        location: of its element.
    """

    reached: float
    left: float
    place: Vec3 | None
    way: Vec3 | None
    location: Location

    @classmethod
    def of(cls, pose: KeyPose, goal: LookAtGoal | OrientationGoal) -> "EyeKey":
        """Return the key of a goal."""
        left = pose.time + pose.hold
        if isinstance(goal, LookAtGoal):
            return cls(pose.time, left, goal.target, None, pose.location)
        return cls(pose.time, left, None, unit(goal.direction), pose.location)

    def point(self, pelvis: Vec3, eyes: Vec3) -> Vec3:
        """Return the point to look at, in the figure's frame, m.

        Args:
            pelvis: its position in the figure's frame, m.
            eyes: the midpoint between the eyes, likewise.
        """
        if self.place is not None:
            return add(pelvis, self.place)
        return add(eyes, scale(self.way or FORWARD, FAR))


class _Look:
    """Directs the eyes for one key pose."""

    eyes = 1.0

    def __init__(self, motion: "EyeKeysMotionUnit", key: EyeKey) -> None:
        self._motion, self._key = motion, key
        self.directed = motion.directed

    def point(self, eyes: Vec3) -> Vec3:
        """Return the point to look at."""
        return self._key.point(self._motion.pelvis, eyes)


class EyeKeysMotionUnit(MotionUnit):
    """Directs the eyes while it plays; `EyeController` moves them there, and back at its relax, by saccades.

    Attributes:
        directed: joints of the eyes.
        pelvis: its position in the figure's frame, as last shown, m.
    """

    kind = LayerKind.ADDITIVE
    joints = frozenset()

    def __init__(self, behavior: KeyPoses, keys: Sequence[EyeKey], directed: frozenset[str], rest: Body) -> None:
        """Plan a motion.

        Args:
            behavior: with the points and the fades; eyes do not fade, they are back soon after relax.
            keys: one or more, in order.
            directed: joints of the eyes.
            rest: the body without it, from which the durations of saccades are estimated.
        """
        self.parameters = {}
        self.planning_work = _WORK + len(keys)
        self.directed = directed
        self.pelvis = rest.transform(ROOT).position
        self._keys = keys
        self._looks: Sequence[_Look] = ()
        self._begins = list(accumulate(_begins(keys, rest), max))
        self._relaxes = max(keys[-1].left, _SHORTEST)
        self.preferred_duration = self._relaxes + behavior.fade_out
        points = {pose.id: min(pose.time, self._relaxes) for pose in behavior.poses if pose.id}
        positions = {sync: time / self.preferred_duration for sync, time in points.items()}
        self.key_positions = ordered({**positions, "relax": self._relaxes / self.preferred_duration})

    def start(self, body: Body) -> None:
        """Take its keys for its own: it may be a copy."""
        self._looks = [_Look(self, key) for key in self._keys]

    def pose(self, moment: Moment) -> MotionPose:
        """Return no rotations: the eyes move after all joints."""
        if moment.shown is not None:
            self.pelvis = moment.shown.transform(ROOT).position
            self._check(moment.phase * self.preferred_duration, moment.shown)
        return MotionPose({})

    def gaze(self, phase: float) -> _Look | None:
        """Return what directs the eyes: nothing before the first saccade and after relax."""
        number = self._number(phase * self.preferred_duration)
        return self._looks[number] if self._looks and number >= 0 and phase < self.key_positions["relax"] else None

    def _number(self, time: float) -> int:
        return bisect_right(self._begins, time) - 1

    def _check(self, time: float, body: Body) -> None:
        """Set a fault if the eyes cannot look where they should by now."""
        number = self._number(time)
        if self.fault is not None or number < 0 or not self._keys[number].reached <= time < self._relaxes:
            return
        key, sockets = self._keys[number], EyeSockets.of(body)
        way = direction_between(sockets.middle, key.point(self.pelvis, sockets.middle))
        if way is not None:
            turn = between(FORWARD, rotate(conjugate(sockets.rotation), way))
            missing = angle(turn) - eye_range(turn)
            if missing > _TOLERANCE:
                fault = GazeShort(angle=math.degrees(missing))
                self.fault = fault.located(key.location.line, key.location.column)


def _begins(keys: Iterable[EyeKey], rest: Body) -> Iterable[float]:
    """Yield when the saccades to key poses begin, s, so that they end at their times."""
    sockets, pelvis = EyeSockets.of(rest), rest.transform(ROOT).position
    before, left = rotate(sockets.rotation, FORWARD), 0.0
    for key in keys:
        way = direction_between(sockets.middle, key.point(pelvis, sockets.middle)) or before
        yield max(left, key.reached - saccade_duration(angle(between(before, way))))
        before, left = way, key.left
