"""Parameters of idle animation that behaviors change."""

import math

from reactive_realizer.bml.idle_change import IdleChange
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engines.animation.easing import share
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Phase, Timing

_TAKES = 1.0
"""Preferred duration of a change, s."""

_RESET = 0.5
"""Duration of the return to the first value, s."""


class IdleCourse:
    """A value that changes evenly now and then, and its integral over time, which recurring movements advance by."""

    def __init__(self, value: float) -> None:
        """Keep a value from time 0 on."""
        self._first = value
        self._since, self._sum = 0.0, 0.0
        self._value = self._goal = value
        self._until = 0.0
        self._owner: object = None

    def begin(self, time: float, goal: float, until: float, owner: object = None) -> None:
        """Change from now on, instead of any other change.

        Args:
            time: s.
            goal: the value to go to.
            until: when it is there, s.
            owner: of the change.
        """
        self._value, self._sum, self._since = self.value(time), self.integral(time), time
        self._goal, self._until, self._owner = goal, max(until, time), owner

    def move_end(self, until: float, owner: object) -> None:
        """Let the change of an owner end at another time, s; nothing if it is no longer the one that goes on."""
        if self._owner is owner:
            self._until = max(until, self._since)

    def settle(self, time: float, owner: object) -> None:
        """Keep the value that the change of an owner has reached; nothing if it is no longer the one that goes on."""
        if self._owner is owner:
            self.begin(time, self.value(time), time)

    def reset(self, time: float) -> None:
        """Go back to the first value."""
        if self._goal != self._first:
            self.begin(time, self._first, time + _RESET)

    def value(self, time: float) -> float:
        """Return the value at a time since the last change began, s."""
        if self._value == self._goal:
            return self._goal
        return self._value + (self._goal - self._value) * share(time, self._since, self._until)

    def integral(self, time: float) -> float:
        """Return the integral from time 0 to a time since the last change began."""
        if self._value == self._goal:
            return self._sum + self._goal * (time - self._since)
        changing = min(time, self._until) - self._since
        mean = 0.5 * (self._value + self.value(self._since + changing))
        return self._sum + mean * changing + self._goal * max(0.0, time - self._until)

    def reaches(self, amount: float) -> float:
        """Return when the integral reaches an amount, s, not before the last change began; infinity if it never does.

        The value must not be below 0.
        """
        missing = amount - self._sum
        if missing <= 0.0:
            return self._since
        if self._value == self._goal:
            return self._since + missing / self._goal if self._goal > 0.0 else math.inf
        lasts = self._until - self._since
        changing = 0.5 * (self._value + self._goal) * lasts
        if missing > changing:
            return self._until + (missing - changing) / self._goal if self._goal > 0.0 else math.inf
        slope = (self._goal - self._value) / lasts
        reached = math.sqrt(max(0.0, self._value * self._value + 2.0 * slope * missing))
        return self._since + 2.0 * missing / (self._value + reached)


class IdleChangeUnit(PlanUnit):
    """Changes a parameter of idle animation."""

    def __init__(self, block: BlockKey, behavior: IdleChange, course: IdleCourse, goal: float) -> None:
        """Plan a change.

        Args:
            block: of the behavior.
            behavior: with the change.
            course: of the parameter.
            goal: value to go to, in the unit of the course.
        """
        super().__init__(block, behavior, Timing(("start", "end"), (Phase(_TAKES),)))
        self._course, self._goal = course, goal

    def on_start(self, time: GlobalTime) -> None:
        """Begin to change."""
        self._course.begin(time, self._goal, self._end(time), self)

    def follow(self, now: GlobalTime) -> None:
        """Follow its end, which may have moved."""
        self._course.move_end(self._end(now), self)

    def on_finish(self, time: GlobalTime) -> None:
        """Keep the value."""
        self._course.settle(time, self)

    def _end(self, now: GlobalTime) -> float:
        end = self.points[-1].peg.value
        return now if end is None else end
