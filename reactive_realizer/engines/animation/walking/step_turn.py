"""Step turns: the feet turn a figure toward what its joints do not reach.

As SmartBody's figures do: A. Shapiro, "Building a character animation system" (Motion in Games, 2011).
"""

import math
from collections.abc import Callable, Sequence
from math import inf

from reactive_realizer.clock.units import RESOLUTION, GlobalTime
from reactive_realizer.embodiment.place import Place, between_headings
from reactive_realizer.engines.animation.animation_unit import AnimationUnit
from reactive_realizer.engines.animation.walking.manner import WALK, stepping_time
from reactive_realizer.engines.animation.walking.progression import Goal

_LOOKS_EVERY = 0.1
"""Time from one look at targets to the next, s."""

_ANOTHER = math.radians(10.0)
"""A heading that differs by less from that of the present turn is none of its own, rad."""


class StepTurns:
    """Decides where the feet turn a figure to, from the motions that play.

    A motion that goes at its end turns the figure back when it relaxes, or is interrupted.
    """

    def __init__(self) -> None:
        """Begin without a turn."""
        self._home: Place | None = None
        self._goal: Goal | None = None
        self._owner: AnimationUnit | None = None
        self._looked = GlobalTime(-inf)

    def forget(self) -> None:
        """Leave the figure where it is: it walks, or no longer stands."""
        self._home = self._goal = self._owner = None

    def goal(self, now: GlobalTime, place: Place, playing: Callable[[], Sequence[AnimationUnit]]) -> Goal | None:
        """Return where to turn; None if nothing asks for a turn, or it is done.

        Args:
            now: s.
            place: of the figure.
            playing: returns the units that play, the latest last.
        """
        if now < self._looked + _LOOKS_EVERY - RESOLUTION:
            return self._pending(now)
        self._looked, units = now, playing()
        turns = [(unit, turn) for unit in units if (turn := unit.motion.step_turn(unit.phase)) is not None]
        # The uppermost that has turned the figure, or wants to: others would turn it away from its target.
        unit, turn = next(((unit, turn) for unit, turn in reversed(turns) if turn or unit is self._owner), (None, 0.0))
        if unit is not None and turn:
            self._turn(now, place, unit, turn)
        elif unit is None and self._home is not None:
            self._return(now, place, units)
        return self._pending(now)

    def _turn(self, now: GlobalTime, place: Place, unit: AnimationUnit, turn: float) -> None:
        """Turn toward the target of a unit."""
        if self._home is None:
            self._home = place
        if unit.motion.persists_as is not None:
            self._home = None
        self._owner = unit
        heading = place.heading + turn
        if self._goal is None or abs(between_headings(self._goal.place.heading, heading)) > _ANOTHER:
            ready = unit.time("ready" if "ready" in unit.timing.points else "end")
            self._set_goal(now, place, heading, ready)

    def _return(self, now: GlobalTime, place: Place, units: Sequence[AnimationUnit]) -> None:
        """Turn back; whether a motion lets the figure have the time that is left to its end."""
        home, self._home = self._home, None
        if home is not None:
            ends = [unit.time("end") for unit in units if unit is self._owner]
            self._set_goal(now, place, home.heading, ends[-1] if ends else None)
        self._owner = None

    def _set_goal(self, now: GlobalTime, place: Place, heading: float, end: GlobalTime | None) -> None:
        turn = between_headings(place.heading, heading)
        time = stepping_time(turn)
        arrives = now + time.preferred if end is None else max(end, now + time.shortest)
        self._goal = Goal(Place(place.position, place.heading + turn), WALK, GlobalTime(arrives))

    def _pending(self, now: GlobalTime) -> Goal | None:
        return self._goal if self._goal is not None and now < self._goal.end else None
