"""Locomotion: going to a target, or some way in a direction."""

import math
from collections.abc import Iterator
from dataclasses import replace
from math import inf

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Locomotion
from reactive_realizer.bml.vocabulary import StanceType
from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.feet import LEG_JOINTS, walks
from reactive_realizer.embodiment.place import Place, between_headings
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.world import Ground
from reactive_realizer.engine.effects import MovePoints
from reactive_realizer.engines.animation.animation_unit import AnimationUnit, MotionContext
from reactive_realizer.engines.animation.candidates import Candidates
from reactive_realizer.engines.animation.faults import (
    NoJoints,
    NoManner,
    NotStanding,
    NotWalkable,
    PlaceNotReached,
    WrongElement,
)
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_parameters import parameter_values
from reactive_realizer.engines.animation.motion_unit import START_TO_END, Moment, MotionPose, MotionUnit, Resource
from reactive_realizer.engines.animation.walking.destination import (
    DIRECTION,
    DISTANCE,
    FACING,
    WAY,
    Destination,
    Way,
    WayBlocked,
    destination,
    ground_of,
)
from reactive_realizer.engines.animation.walking.manner import FASTEST, MANNERS, SLOWEST, Manner, is_at
from reactive_realizer.engines.animation.walking.progression import ASIDE, Goal
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Range, spelled
from reactive_realizer.planunit.plan_unit import UnitState

SPEED = "speed"
"""Parameter: the speed of the figure when it has got up to it, m/s."""

SPEEDS = Range(SLOWEST, FASTEST)
"""Valid values of it."""

_LOOKS_EVERY = 0.1
"""Time from one look at the target to the next, s."""

_MOVED = 0.02
"""A target that has moved less than this has not moved, m."""

_EARLIER = 0.05
"""Difference of an expected end that is worth moving it, s."""

_LATE = 0.15
"""The same for one that comes later because the figure went another way before, s."""

_SHORT = 0.3
"""A figure that stops farther than this from where it should be says so, m."""


class LocomotionMotionUnit(MotionUnit):
    """Goes to a destination. Its legs, and all that moves with them, are those of the `Walker` of the figure.

    Attributes:
        manner: in which it goes.
        place: where it is expected to end.
        corners: of the way there.
    """

    kind = LayerKind.FULL_BODY
    joints = frozenset[str]()
    resources = frozenset({Resource.STANCE})
    fixed = frozenset({DISTANCE, FACING, DIRECTION, WAY})
    key_positions = START_TO_END

    def __init__(self, leads: Destination, manner: Manner, speed: float, start: Place) -> None:
        """Plan a way.

        Args:
            leads: where to.
            manner: in which to go.
            speed: m/s.
            start: where the figure is expected to start.

        Raises:
            WayBlocked: obstacles are on all ways.
        """
        self.parameters = {SPEED: speed}
        self.ranges = {SPEED: SPEEDS}
        self.manner, self._leads = manner, leads
        way = leads.way_from(start) or Way(start, (), start)
        self.place, self.corners = way.place, way.corners
        self.preferred_duration = max(self.duration(start), 0.1)
        self.shortest = {"end": min(self.preferred_duration, self._shortest(start))}

    @property
    def top(self) -> Manner:
        """The manner, with the speed that was asked for as the least top speed."""
        speed = self.parameters[SPEED]
        return self.manner if speed <= self.manner.top else replace(self.manner, top=speed)

    def look(self, place: Place) -> bool:
        """Look where the target and obstacles are now, from a place on the way; one that is blocked now stays.

        Returns:
            Whether the target, or what is to be faced there, has moved. The heading with which a figure comes changes
            with the way that it takes, until it is near.
        """
        try:
            new = self._leads.way_from(place)
        except WayBlocked:
            return False
        if new is None:
            return False
        self.corners = new.corners
        turned = abs(between_headings(self.place.heading, new.place.heading)) > _MOVED
        faces = self._leads.facing(ground_of(new.place)) is not None
        moved = _way(self.place, new.place) > _MOVED or (faces and turned)
        if moved or (turned and new.length > ASIDE):
            self.place = new.place
        return moved

    def duration(self, start: Place, velocity: Ground = (0.0, 0.0)) -> float:
        """Return the preferred duration from a place, s.

        Args:
            start: the place.
            velocity: of the figure there in the world, x and z, m/s. One that already goes that way needs no time to
                start, and one that goes another way needs more.
        """
        way, turns = self._turns(start)
        if is_at(way, sum(map(abs, turns))):
            return 0.0
        speed = max(SLOWEST, self.parameters[SPEED])
        direction, _ = Way(start, self.corners, self.place).directions
        gone = velocity[0] * math.sin(direction) + velocity[1] * math.cos(direction)
        return self.top.duration(way, speed, turns, gone)

    def _shortest(self, start: Place) -> float:
        way, turns = self._turns(start)
        return 0.0 if is_at(way, sum(map(abs, turns))) else self.top.shortest(way, turns)

    def misses(self, place: Place, left: float) -> bool:
        """Return whether a figure at a place cannot arrive in the time that is left, s."""
        return _way(place, self.place) > max(_SHORT, 1.2 * self.top.top * max(0.0, left))

    def _turns(self, start: Place) -> tuple[float, tuple[float, float]]:
        """Return the way to go from a place, m, and the turns at its beginning and at its end, rad."""
        way = Way(start, self.corners, self.place)
        if not self.manner.ahead or way.length < ASIDE:
            return way.length, (0.0, between_headings(start.heading, self.place.heading))
        first, last = way.directions
        return way.length, (between_headings(start.heading, first), between_headings(last, self.place.heading))

    def start(self, body: Body) -> None:
        """Start; the walker moves the body."""

    def pose(self, moment: Moment) -> MotionPose:
        """Return no rotations: the walker gives them."""
        return MotionPose({})


def _way(a: Place, b: Place) -> float:
    return math.hypot(a.position[0] - b.position[0], a.position[2] - b.position[2])


class LocomotionUnit(AnimationUnit):
    """A locomotion between pegs. Without a tie, its end comes when the figure arrives."""

    motion: LocomotionMotionUnit

    def __init__(self, block: BlockKey, behavior: Behavior, candidates: Candidates, context: MotionContext) -> None:
        """Plan a locomotion."""
        super().__init__(block, behavior, candidates, context)
        self._tied = "end" in behavior.syncs
        self._looked = GlobalTime(-inf)
        self._speed: float | None = None
        self._corners: tuple[Ground, ...] = ()
        self._end: Time = None

    def next_due(self) -> Time:
        """As `PlanUnit.next_due`, or when it is to look at its target again."""
        due = super().next_due()
        if self.state is not UnitState.IN_EXEC or not self.begun:
            return due
        look = GlobalTime(self._looked + _LOOKS_EVERY)
        return look if due is None else min(due, look)

    def look(self, now: GlobalTime, place: Place, velocity: Ground) -> Iterator[MovePoints]:
        """Look at the target; yield the move of the end to when the figure will arrive, if that has changed.

        Args:
            now: s.
            place: of the figure.
            velocity: of the figure in the world, x and z, m/s.
        """
        if not self.begun or now < self._looked + _LOOKS_EVERY - RESOLUTION:
            return
        self._looked = now
        moved, speed, corners = self.motion.look(place), self.motion.parameters[SPEED], self.motion.corners
        passed = len(self._corners) - len(corners)
        another = passed < 0 or self._corners[passed:] != corners
        self._corners = corners
        end = self.time("end")
        arrives = GlobalTime(now + self.motion.duration(place, velocity))
        if another or moved or speed != self._speed or self._late(now, arrives):
            self._speed, self._end = speed, arrives
            if not self._tied and end is not None and abs(end - self._end) > _EARLIER:
                yield MovePoints(self, {"end": self._end}, now)
        if end is not None and self.motion.misses(place, end - now):
            self.motion.fault = PlaceNotReached(way=_way(place, self.motion.place))

    def _late(self, now: GlobalTime, arrives: GlobalTime) -> bool:
        """Return whether a figure that is not about to arrive yet will arrive later than was expected."""
        end = self._end
        return end is None or (end - now > self.motion.manner.braking and arrives - end > _LATE)

    def goal(self) -> Goal | None:
        """Return where it goes now, and when it arrives."""
        end = self.time("end")
        arrives = self._end if end is None else end
        return None if arrives is None else Goal(self.motion.place, self.motion.top, arrives, self.motion.corners)


class LocomotionMaker:
    """Makes locomotion. The manner is WALK, RUN or STRAFE; the parameter `speed` changes its speed."""

    def __init__(self, context: MakerContext) -> None:
        self._context = context

    def __call__(self, request: MotionRequest) -> LocomotionMotionUnit:
        """Make a locomotion."""
        behavior, context = request.behavior, self._context
        if not isinstance(behavior, Locomotion):
            raise RealizerError(WrongElement(unit="locomotion", element=behavior.name))
        skeleton = context.humanoid.avatar.skeleton
        if not walks(skeleton):
            missing = tuple(sorted(joint for joint in LEG_JOINTS if joint not in skeleton)) or ("two legs",)
            raise RealizerError(NoJoints(element=behavior.name, joints=missing))
        if (stance := context.rest.expected.stance) is not StanceType.STANDING:
            raise RealizerError(NotStanding(stance=stance.value))
        name = spelled(behavior.manner, MANNERS)
        if name not in MANNERS:
            raise RealizerError(NoManner(manner=behavior.manner, known=tuple(MANNERS)))
        manner, start = MANNERS[name], context.place()
        leads = destination(
            context.world, context.character, start, behavior.target, request.parameters, turns=manner.ahead
        )
        speed = parameter_values(request.parameters, {SPEED: SPEEDS}).get(SPEED, manner.speed)
        try:
            return LocomotionMotionUnit(leads, manner, speed, start)
        except WayBlocked as problem:
            raise RealizerError(NotWalkable(target=behavior.target, reason="obstacles are on all ways")) from problem
