"""When the positions of an utterance are heard or read."""

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Final, NamedTuple

import numpy as np

from reactive_realizer.clock.units import RESOLUTION

REACH: Final = 0.03
"""How much earlier than its course says a sound may be heard, s: half a frame of a `TimeScale` and its tolerance."""


class Course(NamedTuple):
    """When some positions of an utterance come, in order; linear between them, and at the pace of the voice after them.

    Attributes:
        times: s.
        positions: s from the start of the utterance.
    """

    times: Sequence[float]
    positions: Sequence[float]

    def position(self, time: float) -> float:
        """The position at a time, s."""
        return float(np.interp(time, self.times, self.positions)) + max(0.0, time - self.times[-1])

    def time(self, position: float) -> float:
        """The time of a position, s; of one at which the course waits, the time at which it goes on."""
        later = [k for k, each in enumerate(self.positions) if each <= position + RESOLUTION]
        if not later or later[-1] == len(self.positions) - 1:
            return self.times[-1 if later else 0] + max(0.0, position - self.positions[-1])
        span = slice(later[-1], later[-1] + 2)
        return float(np.interp(position, self.positions[span], self.times[span]))

    def waits(self, time: float) -> bool:
        """Whether it stays at a position at a time, s."""
        spans = zip(pairwise(self.times), pairwise(self.positions), strict=True)
        return any(one < time < other and high - low < RESOLUTION for (one, other), (low, high) in spans)

    def until(self, time: float) -> "Course":
        """The part of it up to a time, s."""
        kept = [k for k, each in enumerate(self.times) if each < time - RESOLUTION]
        times, positions = ([each[k] for k in kept] for each in self)
        return Course([*times, time], [*positions, self.position(time)])

    def held(self, until: float) -> "Course":
        """This course, which stays where it ends until a time, s."""
        waits = len(self.times) > 1 and self.positions[-1] - self.positions[-2] < RESOLUTION
        times = self.times[:-1] if waits else self.times
        positions = self.positions[:-1] if waits else self.positions
        return Course([*times, until], [*positions, positions[-1]])

    def then(self, other: "Course") -> "Course":
        """This course, and another one that begins where it ends."""
        return Course([*self.times, *other.times[1:]], [*self.positions, *other.positions[1:]])


class StretchLimits(NamedTuple):
    """How a speech can be stretched.

    Attributes:
        least: the shortest duration of a part of it, as a factor.
        most: the longest one; if it has more time than that, it pauses.
        pauses: the middles of its pauses, s from its start.
    """

    least: float
    most: float
    pauses: Sequence[float]

    def course(self, time: float, position: float, goals: Iterable[tuple[float, float]]) -> Course:
        """The course from a time and a position that reaches some positions on time, as far as it can.

        A part that lasts too long is spoken as slowly as can be, and its pauses, or else one at its end, take the rest.

        Args:
            time: of the start of the course, s.
            position: at that time, s from the start of the utterance.
            goals: times and positions, in order, s.
        """
        knots = [(time, position)]
        for goal, there in goals:
            (now, here), span = knots[-1], there - knots[-1][1]
            if span < RESOLUTION and goal < now + RESOLUTION:
                continue
            lasts = max(goal - now, self.least * span)
            rest = lasts - self.most * span
            if rest > RESOLUTION:
                pauses = [each for each in self.pauses if here - RESOLUTION < each < there]
                borders = pauses or [max(here, there - REACH)]
                for border in borders:
                    begin, before = knots[-1]
                    until = begin + self.most * (border - before)
                    knots += [(until, border), (until + rest / len(borders), border)]
                if borders[-1] < there:
                    knots.append((now + lasts, there))
            else:
                knots.append((now + lasts, there))
        return Course([at for at, _ in knots], [place for _, place in knots])
