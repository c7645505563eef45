"""Looking at something: the part that trunk, neck and head have in it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Self

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import Quat, slerp
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.gaze.aim import Aim
from reactive_realizer.engines.animation.gaze.influence import EYES, JOINTS, WEIGHTS
from reactive_realizer.engines.animation.gaze.settling import Settling
from reactive_realizer.engines.animation.gaze.turning import Turn, turn_toward
from reactive_realizer.engines.animation.motion_unit import START_TO_END, Moment, MotionUnit, Posed, Resource
from reactive_realizer.engines.animation.posture.rest import Rest
from reactive_realizer.errors import Fault


@dataclass(frozen=True, slots=True)
class Course:
    """How a kind of gaze comes and goes.

    Attributes:
        key_positions: of its points; without a ready it is there at its end, without a relax it stays.
        duration: from start to end, where nothing else is asked for, s.
        group: its replacement group.
        lasts: the name under which it stays.
        resources: what it owns.
    """

    key_positions: Mapping[str, float]
    duration: float
    group: str
    lasts: str | None = None
    resources: frozenset[str] = frozenset()


LOOK = Course(
    MappingProxyType({"start": 0.0, "ready": 0.25, "relax": 0.75, "end": 1.0}),
    2.0,
    "gaze",
    resources=frozenset({Resource.HEAD}),
)
"""A gaze: a quarter to turn, half to look, a quarter to turn back."""

GAZE_SHIFT = Course(START_TO_END, 0.5, "gaze", lasts="gaze", resources=frozenset({Resource.HEAD}))
"""A gaze that stays, until another one does."""

HEAD_SHIFT = Course(START_TO_END, 0.5, "head direction", lasts="head direction")
"""A head that is turned, and stays so; it may be turned elsewhere than the eyes look."""

_NEARLY = 0.8
"""The share of the time to its ready from which on it is judged whether it gets there: at first the trunk may still be
turned elsewhere."""

_NOTICED = math.radians(3.0)
"""What hardly anybody notices who is looked at. It is our choice: how fine that sense is depends on how one asks
(L. Linke and G. Horstmann, "New task - new results?", Attention, Perception, & Psychophysics 86, 2024)."""


class GazeMotionUnit(MotionUnit):
    """Turns trunk, neck and head toward what is looked at, and stays turned to it until it relaxes.

    The eyes are not among its joints: they look from the head as it is shown in the end, nods and breath included. What
    they do with all gazes of a figure is up to `Looking`.
    """

    kind = LayerKind.GAZE
    joints = frozenset(joint for joints in JOINTS.values() for joint in joints)

    def __init__(self, aim: Aim, weights: Mapping[str, float], rest: Rest, course: Course = LOOK) -> None:
        """Plans a gaze.

        Args:
            aim: where to look.
            weights: group of joints -> its part (`WEIGHTS`); one without eyes is about the head alone.
            rest: what trunk, neck and head do without it.
            course: how it comes and goes.
        """
        self.parameters = dict(weights)
        self.ranges = {group: WEIGHTS[group] for group in weights}
        self.group = course.group
        self.lasts = course.lasts
        self.resources = course.resources
        self._aim = aim
        self._rest = rest
        self.key_positions = course.key_positions
        self.preferred_duration = course.duration
        self._ready = course.key_positions.get("ready", 1.0)
        self._relax = course.key_positions.get("relax", math.inf)
        self._settling = Settling()
        self._begin = rest.body
        self._late = False

    def start(self, body: Body) -> None:
        """The head turns from where it is now, which may be another gaze."""
        self._begin = body

    def pose(self, moment: Moment) -> Posed:
        """Rotations of trunk, neck and head; they leave for whatever lies below."""
        body, phase = moment.body, moment.phase
        turn = self._turn(body)
        if self.fault is None and _NEARLY * self._ready <= phase <= self._relax:
            self._judge(turn, body)
        return Posed(
            self._come(turn.rotations, moment),
            1.0 - minimum_jerk(share(phase, self._relax, 1.0)) if phase > self._relax else 1.0,
        )

    def _come(self, goal: Mapping[str, Quat], moment: Moment) -> Mapping[str, Quat]:
        """As much of a turn as there is at a moment; one that joins late goes at its own pace, whatever the phase."""
        if self.joined is not None and not self._late:
            self._late = True
            self._settling.leave({joint: self._begin.rotation(joint) for joint in goal}, self.joined)
        there = self._settling(goal, moment.time)
        done = minimum_jerk(share(moment.phase, 0.0, self._ready))
        if done == 1.0 or self._late:
            return there
        return {joint: slerp(self._begin.rotation(joint), turn, done) for joint, turn in there.items()}

    def _turn(self, body: Body) -> Turn:
        return turn_toward(body, self._rest.pose, self.point, self.parameters)

    def _judge(self, turn: Turn, body: Body) -> None:
        """Whether it gets there."""
        if self.lasts is not None:
            # The shift in whose place it comes goes when this one has ended, with what that does to the trunk.
            turn = self._turn(body.posed({joint: self._rest.body.rotation(joint) for joint in self.joints}))
        if turn.missing is None:
            self.fault = Fault("gaze-near")
        elif turn.missing > _NOTICED:
            self.fault = Fault("gaze-short", {"angle": math.degrees(turn.missing)})

    def gaze(self, phase: float) -> Self | None:
        """Itself, as long as the eyes are its own."""
        return self if self.looks(phase) else None

    @property
    def eyes(self) -> float:
        """The part that the eyes go of the way to what is looked at, 0 to 1."""
        return self.parameters.get(EYES, 0.0)

    def looks(self, phase: float) -> bool:
        """Whether the eyes are its own at a phase: they go there first, and leave first."""
        return phase < self._relax

    def point(self, eyes: Vec3) -> Vec3:
        """Where it looks from between the eyes, both in the figure's frame, m."""
        return self._aim.point(eyes)
