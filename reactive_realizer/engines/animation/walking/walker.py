"""Carries a figure over the ground on two feet."""

from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Transform
from reactive_realizer.embodiment.feet import reach, walks
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.place import Footprint, Place, PlannedSteps, between_headings
from reactive_realizer.embodiment.quaternion import conjugate, multiply
from reactive_realizer.embodiment.vector import Vec3, distance
from reactive_realizer.engines.animation.easing import share
from reactive_realizer.engines.animation.walking.footfall import (
    is_worth_a_step,
    landing,
    share_ahead,
    share_aside,
    time_in_reach,
)
from reactive_realizer.engines.animation.walking.progression import Goal, Progression
from reactive_realizer.engines.animation.walking.walking_foot import FootShape, WalkingFoot

_STEP = 0.02
"""Longest step of time from one look at the feet to the next, s."""

_STRIKE = -0.3
"""Pitch of a foot that touches the ground in walking ahead, rad: its heel comes first."""

_BACKWARD = 0.3
"""Speed of a figure that goes backward and does not roll off, m/s."""

_SHIFTING = 0.06
"""Time in which a figure shifts its weight before its first step, s, beside the usual double support."""

_SHORTEST_STEP, _LONGEST_STEP = 0.34, 0.75
"""Bounds of the time from step to step, s, where a figure has to arrive in time."""

_HOME, _HOME_TURN = 0.002, 0.01
"""A foot nearer than this to where it stands at rest is there, m and rad."""


class FootPose(NamedTuple):
    """A foot in a frame.

    Attributes:
        ankle: its transform in the figure's frame.
        pitch: turn that lifts the heel, rad.
        bears: how much the pelvis goes down for it, 0 to 1.
    """

    ankle: Transform
    pitch: float
    bears: float


class Walker:
    """The place of a figure, and its feet, from frame to frame.

    Prints are chosen when a foot leaves the ground, from where the frame will be while it stands there. Of the last
    steps, each foot makes one to its place at rest, and the second one ends with the progression. A goal that moves on
    the way moves the prints of the steps that follow, and their times.

    Attributes:
        progression: of the figure's frame.
        feet: left first; empty while the figure stands at rest.
    """

    def __init__(self, place: Place) -> None:
        """Stand at a place."""
        self.progression = Progression(place)
        self.feet: tuple[WalkingFoot, ...] = ()
        self._now = GlobalTime(0.0)
        self._last: int | None = None
        self._period = 0.5
        self._pursued: Goal | None = None
        self._set_out_at = GlobalTime(0.0)

    @property
    def active(self) -> bool:
        """Whether the figure is on its way, or its feet are not at rest yet."""
        return bool(self.feet)

    def advance(self, now: GlobalTime, goal: Goal | None, rest: Body) -> None:
        """Move on to a time, s.

        Args:
            now: s; the same time again changes nothing.
            goal: where the figure goes; without one it comes to rest.
            rest: the body at rest, on whose feet it stands in the end.
        """
        since, self._now = self._now, now
        if goal is not None:
            if not self.feet and walks(rest.skeleton):
                self._set_out(rest)
            self._pursue(goal)
        elif self._pursued is not None:
            ended, self._pursued = self._pursued, None
            if now < ended.end:
                self.progression.brake(since, ended.manner)
        if not self.feet:
            return
        while since < now - 1e-9:
            time = GlobalTime(min(now, since + _STEP))
            self.progression.advance(since, time)
            self._step(time)
            since = time

    def _set_out(self, rest: Body) -> None:
        self.feet = tuple(WalkingFoot(FootShape.of(rest, side), self.progression.place) for side in SIDES)
        self._last, self._set_out_at = None, self._now

    def _pursue(self, goal: Goal) -> None:
        if goal != self._pursued:
            self._pursued = goal
            self.progression.pursue(goal)

    @property
    def arrived(self) -> bool:
        """Whether the figure has come to rest on both feet; it stays active until `rest`."""
        goal = self.progression.goal
        return (
            goal is not None
            and self._pursued is None
            and self._now >= goal.end - 1e-9
            and all(foot.flat() and self._is_home(foot, goal.place) for foot in self.feet)
        )

    def rest(self) -> None:
        """End the walk of a figure that has arrived."""
        self.progression, self.feet = Progression(self.progression.place), ()

    def planned_steps(self) -> PlannedSteps:
        """Return the path ahead of the figure, and its footprints."""
        prints = tuple(Footprint(foot.goal, foot.swing is None) for foot in self.feet)
        return PlannedSteps(self.progression.path if self.feet else (), prints)

    def over_ground(self) -> tuple[Vec3, ...]:
        """Return where the feet are in the figure's frame, without their height, m; left first."""
        place = self.progression.place
        return tuple(place.to_own(foot.over_ground(self._now).position) for foot in self.feet)

    def poses(self, body: Body) -> tuple[FootPose, ...]:
        """Return the feet of a figure that is active, left first.

        Args:
            body: with the pelvis in its place.
        """
        place = self.progression.place
        return tuple(self._pose(side, foot, place, body) for side, foot in zip(SIDES, self.feet, strict=True))

    def _pose(self, side: str, foot: WalkingFoot, place: Place, body: Body) -> FootPose:
        hip = place.to_world(body.transform(f"{side}_hip").position)
        rolls = share(self.progression.forward[0], -_BACKWARD, 0.0)
        ankle = foot.at(self._now, place, hip, reach(body.skeleton, side), rolls)
        own = Transform(place.to_own(ankle.position), multiply(conjugate(place.turn), ankle.rotation))
        return FootPose(own, foot.pitch, foot.bears(self._now))

    @property
    def bearing(self) -> int | None:
        """The foot that bears the figure, or is about to: 0 is left, 1 is right; None if both do."""
        goal = self.progression.goal
        stepping = [number for number, foot in enumerate(self.feet) if foot.swing is not None]
        if len(stepping) == 1:
            return 1 - stepping[0]
        following = None if goal is None or stepping or not self.feet else self._next_foot(goal, self._now)
        return None if following is None else 1 - following

    # --- steps

    def _step(self, now: GlobalTime) -> None:
        for foot in self.feet:
            if foot.swing is not None and foot.swing.until <= now + 1e-9:
                foot.touch_down()
        goal = self.progression.goal
        if goal is None:
            return
        number = self._next_foot(goal, now)
        if number is None:
            return
        foot, other = self.feet[number], self.feet[1 - number]
        busy = max(other.landed, self._set_out_at + _SHIFTING) if other.swing is None else other.swing.until
        speed = self.progression.speed
        support = goal.manner.double_support(speed)
        period = self._period if support > 0.0 else goal.manner.period(speed)
        if foot.swing is None and now + 0.5 * _STEP >= busy + support * period:
            self._lift_off(number, goal, now)

    def _next_foot(self, goal: Goal, now: GlobalTime) -> int | None:
        """Return the foot that steps next, if one has to."""
        away = [number for number in (0, 1) if not self._is_home(self.feet[number], goal.place)]
        if now >= goal.end - 1e-9 or not away:
            return away[0] if away and now >= goal.end else (self._alternate() if self._moves(goal, now) else None)
        if len(away) == 1 and self._steps_left(goal, now) == 1:
            return away[0]
        return self._alternate()

    def _moves(self, goal: Goal, now: GlobalTime) -> bool:
        place = self.progression.place
        way = distance(place.position, goal.place.position)
        turn = between_headings(place.heading, goal.place.heading)
        return now < goal.end and (way > _HOME or abs(turn) > _HOME_TURN)

    def _alternate(self) -> int:
        if self._last is not None:
            return 1 - self._last
        aside = share_aside(self.progression, self._now, 0.5)
        if abs(aside) > 0.5:
            return 0 if aside > 0.0 else 1
        left, right = (self.progression.place.to_own(foot.print.position)[2] for foot in self.feet)
        return 0 if left < right - 0.01 else 1

    def _is_home(self, foot: WalkingFoot, place: Place) -> bool:
        home = self._home(foot, place)
        near = distance(foot.goal.position, home.position) < _HOME
        return near and abs(between_headings(foot.goal.heading, home.heading)) < _HOME_TURN

    @staticmethod
    def _home(foot: WalkingFoot, place: Place) -> Place:
        return Place(place.to_world(foot.shape.place), place.heading)

    def _steps_left(self, goal: Goal, now: GlobalTime) -> int:
        return max(1, round((goal.end - now) / goal.manner.period(self.progression.speed)))

    def _lift_off(self, number: int, goal: Goal, now: GlobalTime) -> None:
        foot, other = self.feet[number], self.feet[1 - number]
        manner, left = goal.manner, goal.end - now
        soon = self.progression.ahead(now, GlobalTime(now + 0.3))
        period = manner.period(max(self.progression.speed, soon.speed))
        count = max(1, round(left / period))
        if count == 1 and left > 1.6 * _SHORTEST_STEP and not self._is_home(other, goal.place):
            count = 2
        if left < 4.0 * period:
            period = min(_LONGEST_STEP, max(_SHORTEST_STEP, left / count))
        support = manner.double_support(soon.speed)
        flies, usual = support < 0.0, period
        last = count <= 2 or left <= 0.0
        if count == 1:
            swing = max(0.8 * _SHORTEST_STEP, left)
        else:
            period = time_in_reach(self.progression, other, now, usual, flies=flies)
            last = last and period == usual
            swing = period * (1.0 - support)
        until = GlobalTime(now + swing)
        # In running, a print for a short stance would make the next step short, and so on.
        stance = usual if flies else period
        if last:
            target = self._home(foot, goal.place)
        else:
            target = landing(self.progression, foot.shape, now, until, stance, support)
            if not is_worth_a_step(foot, target):
                return
        foot.lift_off(target, now, until, 0.0 if last else _STRIKE * share_ahead(soon))
        self._last, self._period = number, period
