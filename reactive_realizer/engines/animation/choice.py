"""The motions that could play a behavior, and which of them does."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from math import inf

from reactive_realizer.engines.animation.motion_unit import AMOUNT, AMOUNT_RANGE, MotionUnit
from reactive_realizer.errors import Fault
from reactive_realizer.planunit.parameter import Range

_SHORT = 0.6
"""Below this share of its preferred duration a motion looks hurried."""


@dataclass(frozen=True, slots=True)
class Choice:
    """One motion that could play a behavior; the binding may know several.

    Attributes:
        motion: not begun.
        names: name of a parameter in BML -> the motion's own, of those that may be changed.
        group: the replacement group that the behavior or the binding names, None for the motion's own.
        yields: whether others of its group may take its place while it plays.
        notes: what is wrong with what the behavior says, or with what plays it, though it is played.
    """

    motion: MotionUnit
    names: Mapping[str, str] = field(default_factory=dict)
    group: str | None = None
    yields: bool = False
    notes: tuple[Fault, ...] = ()

    def range(self, name: str) -> Range:
        """The values that mean something of a parameter, by its name in BML: an amount is one, whatever it scales."""
        return AMOUNT_RANGE if name == AMOUNT else self.motion.ranges[self.names[name]]


class Choices:
    """The motions that could play a behavior, the best first; each is made when it is first asked for.

    Args:
        made: one or more.

    Attributes:
        planned: the best one.

    Raises:
        RealizerError: whatever making the best one raises.
    """

    def __init__(self, made: Iterator[Choice]) -> None:
        self.planned = next(made)
        self._known = [self.planned]
        self._others = made

    def __iter__(self) -> Iterator[Choice]:
        yield from self._known
        for choice in self._others:
            self._known.append(choice)
            yield choice


def choose(choices: Iterable[Choice], taken: frozenset[str], time: float | None) -> Choice:
    """The choice that is to be played: of those that are free the first that has time enough, else the shortest.

    Thesis 8.17 names both as what a binding with several motions for one behavior is good for.

    Args:
        choices: one or more, the best first.
        taken: resources that others own; where no choice is free it is the first, whose conflict is then told.
        time: from start to end, s; None where that is unknown.
    """
    tried: list[Choice] = []
    for choice in choices:
        tried.append(choice)
        if not choice.motion.resources & taken and (time is None or not _hurried(choice.motion, time)):
            return choice
    free = [choice for choice in tried if not choice.motion.resources & taken]
    return min(free, key=lambda choice: choice.motion.preferred_duration) if free else tried[0]


def _hurried(motion: MotionUnit, time: float) -> bool:
    shortest, _ = motion.limits or (0.0, inf)
    return time < max(shortest, _SHORT * motion.preferred_duration)
