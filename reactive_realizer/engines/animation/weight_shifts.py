"""Weight shifts of a standing figure, at random intervals and when a behavior asks for one."""

from bisect import bisect_right
from collections import deque
from operator import attrgetter
from random import Random
from typing import Final, NamedTuple, Self

from reactive_realizer.bml.weight_shift import WeightShift
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engines.animation.idle_course import IdleCourse
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Phase, Timing

_PAUSE: Final = (10.0, 30.0)
"""Shortest and longest time between weight shifts, s."""

USUAL_WEIGHT_SHIFTS: Final = 60.0 / (0.5 * (_PAUSE[0] + _PAUSE[1]))
"""Weight shifts per minute, on average."""

_TAKES: Final = 1.8
"""Duration of a weight shift, s."""

_SHORTEST: Final = 0.8
"""Shortest duration of one that a behavior asks for, s."""

_STOPS: Final = 0.5
"""Duration in which one stops that is interrupted, s."""

_KEPT: Final = 128
"""Number of shifts back to which times may be asked for."""


class _Way(NamedTuple):
    """A way of the weight to a side, where it rests.

    Attributes:
        since: its begin, s.
        takes: its duration, s.
        factors: of the polynomial in the share of its time, from the constant on.
    """

    since: float
    takes: float
    factors: tuple[float, ...]

    @classmethod
    def to(cls, side: float, since: float, takes: float, state: tuple[float, float, float]) -> Self:
        """Return the way of least jerk from a state: a side, its speed (1/s) and its acceleration (1/s^2)."""
        here, speed, pull = state[0], state[1] * takes, state[2] * takes * takes
        far = side - here
        third = 10.0 * far - 6.0 * speed - 1.5 * pull
        fourth = -15.0 * far + 8.0 * speed + 1.5 * pull
        return cls(since, takes, (here, speed, 0.5 * pull, third, fourth, 6.0 * far - 3.0 * speed - 0.5 * pull))

    def state(self, time: float) -> tuple[float, float, float]:
        """Return the side at a time, its speed and its acceleration."""
        done = (time - self.since) / self.takes
        if done >= 1.0:
            return sum(self.factors), 0.0, 0.0
        first = tuple(power * factor for power, factor in enumerate(self.factors))[1:]
        second = tuple(power * factor for power, factor in enumerate(first))[1:]
        place, speed, pull = (_polynomial(factors, done) for factors in (self.factors, first, second))
        return place, speed / self.takes, pull / (self.takes * self.takes)

    def at(self, time: float) -> float:
        """Return the side at a time."""
        return _polynomial(self.factors, min(1.0, (time - self.since) / self.takes))


def _polynomial(factors: tuple[float, ...], x: float) -> float:
    value = 0.0
    for factor in reversed(factors):
        value = value * x + factor
    return value


class WeightShifts:
    """Weight shifts of a standing figure: it moves its weight to the other foot at once, and stays there for a while.

    After M. Duarte and V. M. Zatsiorsky, "Patterns of center of pressure migration during prolonged unconstrained
    standing" (Motor Control 3, 1999): of their three patterns, this is the one called shifting. Distance and rate are
    our choice; theirs occurred every 199 s to the side, but an observer should see one within a minute.
    """

    def __init__(self, random: Random, rate: IdleCourse) -> None:
        """Draw from a generator that must not be shared.

        Args:
            random: the generator.
            rate: of the shifts at random intervals, relative to the usual one.
        """
        self._random, self._rate = random, rate
        self._ways = deque([_Way(0.0, _TAKES, (random.uniform(-0.4, 0.4),))], _KEPT)
        self._side = random.choice((-1.0, 1.0))
        self._pause = self._depth = 0.0
        self._owner: object = None
        self._until = 0.0
        self._due = self._drawn(0.0)

    def at(self, time: float) -> float:
        """Return the supporting foot at a time, -1 (right) to 1 (left)."""
        while self._owner is None and (begin := self._rate.reaches(self._due)) <= time:
            self._side = -self._side
            self._go(max(begin, self._ways[-1].since), self._side * self._depth, _TAKES)
            self._due = self._drawn(self._due)
        if self._ways[-1].since <= time:  # as in nearly all frames
            return self._ways[-1].at(time)
        return self._ways[max(0, bisect_right(self._ways, time, key=attrgetter("since")) - 1)].at(time)

    def begin(self, time: float, side: float, until: float, owner: object) -> None:
        """Shift the weight from now on, instead of any other shift; there are no others until it ends.

        Args:
            time: s.
            side: to go to.
            until: when the weight is there, s.
            owner: of the shift.
        """
        self.at(time)
        self._owner, self._until = owner, until
        self._side = 1.0 if side > 0.0 else -1.0
        self._go(time, side, until - time)

    def move_end(self, time: float, side: float, until: float, owner: object) -> None:
        """Let the shift of an owner end at another time, s; nothing if it is no longer the one that goes on."""
        if self._owner is owner and until != self._until:
            self.begin(time, side, until, owner)

    def settle(self, time: float, owner: object) -> None:
        """Let the weight rest, and shift it at random again; nothing if another shift goes on."""
        if self._owner is not owner:
            return
        place, speed, _ = self._ways[-1].state(time)
        if speed:
            self._go(time, place + 0.5 * _STOPS * speed, _STOPS)
        self._owner = None
        self._due = self._rate.integral(time) + self._pause

    def _go(self, time: float, side: float, takes: float) -> None:
        self._ways.append(_Way.to(side, time, max(_SHORTEST, takes), self._ways[-1].state(time)))

    def _drawn(self, due: float) -> float:
        """Return when the next shift is due after another one, as the rate counts; its depth is drawn too."""
        self._pause, self._depth = self._random.uniform(*_PAUSE), self._random.uniform(0.4, 1.0)
        return due + self._pause


class WeightShiftUnit(PlanUnit):
    """Shifts the weight of a figure."""

    def __init__(self, block: BlockKey, behavior: WeightShift, shifts: WeightShifts) -> None:
        """Plan a shift.

        Args:
            block: of the behavior.
            behavior: with the shift.
            shifts: of the figure.
        """
        super().__init__(block, behavior, Timing(("start", "end"), (Phase(_TAKES, shortest=_SHORTEST),)))
        self._shifts, self._side = shifts, behavior.side

    def on_start(self, time: GlobalTime) -> None:
        """Begin to shift."""
        self._shifts.begin(time, self._side, self._end(time), self)

    def follow(self, now: GlobalTime) -> None:
        """Follow its end, which may have moved."""
        self._shifts.move_end(now, self._side, self._end(now), self)

    def on_finish(self, time: GlobalTime) -> None:
        """Leave the weight where it is."""
        self._shifts.settle(time, self)

    def _end(self, now: GlobalTime) -> float:
        end = self.points[-1].peg.value
        return now if end is None else end
