"""The progression of a figure over the ground: its speed eases in and out, whatever happens to the goal on the way."""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple, Self

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.place import Place, between_headings, heading_of
from reactive_realizer.embodiment.world import Ground
from reactive_realizer.engines.animation.walking.manner import TURNING, Manner, turning_time
from reactive_realizer.engines.animation.walking.route import length_of

_STEP = 0.02
"""Longest step of time in which a progression is followed, s."""

_AGILITY = 5.0
"""How fast a speed approaches the intended one, 1/s: most of it within half a second, or one step."""

_YAW_AGILITY = 8.0
_YAW_GAIN = 2.5
"""The same for the speed of a turn, and that speed per angle that is left, 1/s."""

ASIDE = 0.6
"""A figure does not turn into a way that is shorter, m: it steps aside or back."""

_SETTLING, _GENTLE, _GENTLE_TURN = 0.3, 4.0, 8.0
"""A little way or turn that is left, also if the figure ends at once, takes up to this time, s, with accelerations up
to these, m/s^2 and rad/s^2."""

_HARDEST = 10.0 / math.sqrt(3.0)
"""Highest acceleration of a way with the least jerk, relative to the way over the square of its time."""

_PEAK = 1.875
"""Highest speed of such a way, relative to the mean."""

_PASSED = 0.1
"""A figure that is nearer to a corner of its way turns into the next leg, m."""


class Axis(NamedTuple):
    """The motion along one coordinate: position, velocity and acceleration, in m or rad, and s."""

    at: float
    speed: float = 0.0
    change: float = 0.0

    def arriving(self, goal: float, left: float, passed: float) -> "Axis":
        """Return the motion some time later, on the way to rest at a goal with the least jerk.

        T. Flash and N. Hogan, "The coordination of arm movements" (Journal of Neuroscience 5, 1985), from any state.

        Args:
            goal: where it comes to rest.
            left: time until then, s.
            passed: time later, s.
        """
        if passed >= left:
            return Axis(goal)
        way, v, a = goal - self.at, self.speed * left, self.change * left * left
        c3, c4, c5 = 10.0 * way - 6.0 * v - 1.5 * a, -15.0 * way + 8.0 * v + 1.5 * a, 6.0 * way - 3.0 * v - 0.5 * a
        t = passed / left
        return Axis(
            self.at + t * (v + t * (0.5 * a + t * (c3 + t * (c4 + t * c5)))),
            (v + t * (a + t * (3.0 * c3 + t * (4.0 * c4 + t * 5.0 * c5)))) / left,
            (a + t * (6.0 * c3 + t * (12.0 * c4 + t * 20.0 * c5))) / (left * left),
        )

    def driven(self, speed: float, agility: float, passed: float) -> "Axis":
        """Return the motion some time later, when its speed approaches another one, critically damped."""
        off = self.speed - speed
        rise = self.change + agility * off
        decay = math.exp(-agility * passed)
        after = speed + (off + rise * passed) * decay
        return Axis(
            self.at + 0.5 * (self.speed + after) * passed, after, (self.change - agility * rise * passed) * decay
        )


@dataclass(frozen=True, slots=True)
class Goal:
    """Where a figure goes.

    Attributes:
        place: in the end.
        manner: in which it goes.
        end: time at which it stands there, s.
        corners: of the way there.
    """

    place: Place
    manner: Manner
    end: GlobalTime
    corners: tuple[Ground, ...] = ()


class Progression:
    """Follows a goal.

    Far from the goal, the velocity approaches one with which the figure arrives in time; near it, the rest of the way
    is the one with the least jerk. So neither the place nor the velocity ever jumps, when the goal or its time does.

    Attributes:
        x, z, heading: the motion of the figure's frame in the world.
        goal: the present one. Its end is later than that which was asked for if the figure cannot arrive in time.
    """

    def __init__(self, place: Place) -> None:
        """Stand at a place."""
        (x, self._height, z), heading = place.position, place.heading
        self.x, self.z, self.heading = Axis(x), Axis(z), Axis(heading)
        self.goal: Goal | None = None
        self._corners: tuple[Ground, ...] = ()
        self._arriving = False

    @property
    def place(self) -> Place:
        """Where the frame is now."""
        return Place((self.x.at, self._height, self.z.at), self.heading.at)

    @property
    def path(self) -> tuple[Ground, ...]:
        """The points from where the frame is to its goal; none if it goes nowhere."""
        if self.goal is None:
            return ()
        x, _, z = self.goal.place.position
        return ((self.x.at, self.z.at), *self._corners, (x, z))

    @property
    def velocity(self) -> Ground:
        """Over the ground, x and z in the world, m/s."""
        return self.x.speed, self.z.speed

    @property
    def speed(self) -> float:
        """Over the ground, m/s."""
        return math.hypot(*self.velocity)

    @property
    def forward(self) -> tuple[float, float]:
        """Speed, m/s, and acceleration, m/s^2, in the direction that the figure faces."""
        sine, cosine = math.sin(self.heading.at), math.cos(self.heading.at)
        return (
            self.x.speed * sine + self.z.speed * cosine,
            self.x.change * sine + self.z.change * cosine,
        )

    def pursue(self, goal: Goal) -> None:
        """Go to another goal from now on."""
        self.goal, self._corners, self._arriving = goal, goal.corners, False

    def brake(self, now: GlobalTime, manner: Manner) -> None:
        """Come to rest on the way, as soon as it looks natural."""
        time = 0.5 + 0.4 * max(self.speed, abs(self.heading.speed))
        ahead = 0.45 * time
        x, z, heading = (each.at + ahead * each.speed for each in (self.x, self.z, self.heading))
        place = Place((x, self._height, z), heading)
        self.pursue(Goal(place, manner, GlobalTime(now + max(0.8, time))))

    def advance(self, since: GlobalTime, now: GlobalTime) -> None:
        """Follow the goal from one time to another, s."""
        if self.goal is None:
            return
        count = max(1, math.ceil((now - since) / _STEP - 1e-9))
        passed = (now - since) / count
        for number in range(count):
            self._follow(self.goal, GlobalTime(since + number * passed), passed)

    def ahead(self, now: GlobalTime, time: GlobalTime) -> Self:
        """Return the progression as it is expected to be at a later time, s."""
        other = object.__new__(type(self))
        other.__dict__.update(self.__dict__)
        other.advance(now, max(now, time))
        return other

    def _follow(self, goal: Goal, now: GlobalTime, passed: float) -> None:
        (goal_x, _, goal_z), manner = goal.place.position, goal.manner
        points = self._points_ahead((goal_x, goal_z))
        way, direction, last = length_of(points), _heading(*points[:2]), _heading(*points[-2:])
        faces = manner.ahead and way > ASIDE
        tail = turning_time(between_headings(last, goal.place.heading)) if faces else 0.0
        left = goal.end - tail - now
        arrives = left <= manner.braking and not self._corners
        if arrives and not self._arriving:
            if (needed := self._arrival_time(goal, way)) > left:
                left, goal = needed, replace(goal, end=GlobalTime(now + needed + tail))
                self.goal = goal
            self._arriving = arrives = left <= manner.braking
        if arrives:
            self.x = self.x.arriving(goal_x, left, passed)
            self.z = self.z.arriving(goal_z, left, passed)
        else:
            speed = min(manner.top, way / max(left - 0.5 * manner.braking, 0.3))
            if faces:
                speed *= max(0.0, math.cos(between_headings(self.heading.at, direction))) ** 2
            self.x = self.x.driven(speed * math.sin(direction), _AGILITY, passed)
            self.z = self.z.driven(speed * math.cos(direction), _AGILITY, passed)
        self._turn(goal, now, passed, direction if faces and not arrives else None)

    def _arrival_time(self, goal: Goal, way: float) -> float:
        """Return the least time in which the figure comes to rest at its goal, over the way that is left, m; s."""
        turn, manner = abs(between_headings(self.heading.at, goal.place.heading)), goal.manner
        settling = math.sqrt(_HARDEST * max(way / _GENTLE, turn / _GENTLE_TURN))
        fastest = _PEAK * way / manner.top
        if fastest > manner.braking:
            fastest = way / manner.top + 0.5 * manner.braking
        return max(fastest, min(_SETTLING, settling))

    def _points_ahead(self, goal: Ground) -> tuple[Ground, ...]:
        """Return the present point, and the corners that lie ahead with the goal."""
        here = (self.x.at, self.z.at)
        while self._corners:
            (x, z), (next_x, next_z) = (*self._corners, goal)[:2]
            passed = (here[0] - x) * (next_x - x) + (here[1] - z) * (next_z - z) > 0.0
            if not passed and math.dist(here, (x, z)) > _PASSED:
                break
            self._corners = self._corners[1:]
        return (here, *self._corners, goal)

    def _turn(self, goal: Goal, now: GlobalTime, passed: float, direction: float | None) -> None:
        """Turn into a direction, rad; None for that of the goal."""
        aim = goal.place.heading if direction is None else direction
        turn = between_headings(self.heading.at, aim)
        left = goal.end - now
        if direction is None and (left <= goal.manner.braking or abs(turn) > TURNING * (left - goal.manner.braking)):
            self.heading = self.heading.arriving(self.heading.at + turn, left, passed)
        else:
            speed = min(TURNING, max(-TURNING, _YAW_GAIN * turn))
            self.heading = self.heading.driven(speed, _YAW_AGILITY, passed)


def _heading(start: Ground, end: Ground) -> float:
    return heading_of(end[0] - start[0], end[1] - start[1])
