"""The motions that could play a behavior, and the selection of one of them."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from math import inf

from reactive_realizer.bml.expressivity import HURRIED
from reactive_realizer.engines.animation.motion_unit import AMOUNT, AMOUNT_RANGE, MotionUnit
from reactive_realizer.errors import Fault
from reactive_realizer.planunit.parameter import Range

_ALIKE = 1.01
"""Factor between durations that makes no difference, such as between those of two arms of about the same length."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """A motion that could play a behavior.

    Attributes:
        motion: not started yet.
        names: name of a parameter in BML -> its name in the motion, for parameters that may change.
        group: the replacement group that the behavior or the binding names; None for the motion's own.
        yields: whether others of its group may replace it while it plays.
        notes: faults of the behavior or of the motion that do not prevent playing.
    """

    motion: MotionUnit
    names: Mapping[str, str] = field(default_factory=dict)
    group: str | None = None
    yields: bool = False
    notes: tuple[Fault, ...] = ()

    def range(self, name: str) -> Range:
        """Return the valid values of a parameter, by its name in BML; an amount is always from 0 to 1."""
        return AMOUNT_RANGE if name == AMOUNT else self.motion.ranges[self.names[name]]


class Candidates:
    """The motions that could play a behavior, best first. Each is created when it is first needed.

    Args:
        made: creates one or more candidates.

    Attributes:
        planned: the best one.

    Raises:
        RealizerError: the best one cannot be created.
    """

    def __init__(self, made: Iterator[Candidate]) -> None:
        self.planned = next(made)
        self._known = [self.planned]
        self._others = made

    def __iter__(self) -> Iterator[Candidate]:
        yield from self._known
        for candidate in self._others:
            self._known.append(candidate)
            yield candidate


def select(candidates: Iterable[Candidate], taken: frozenset[str], time: float | None) -> Candidate:
    """Select the candidate to play: the first free one that has enough time, or else the shortest free one.

    Of those that are about as short, the first is selected. Thesis 8.17 names both as uses of a binding with several
    motions for one behavior.

    Args:
        candidates: one or more, best first.
        taken: resources that other units own. If no candidate is free, the first is returned and its conflict is
            reported.
        time: from start to end, s; None if unknown.
    """
    tried: list[Candidate] = []
    for candidate in candidates:
        tried.append(candidate)
        if not candidate.motion.resources & taken and (time is None or not _hurried(candidate.motion, time)):
            return candidate
    free = [candidate for candidate in tried if not candidate.motion.resources & taken]
    if not free:
        return tried[0]
    enough = _ALIKE * min(candidate.motion.preferred_duration for candidate in free)
    return next(candidate for candidate in free if candidate.motion.preferred_duration <= enough)


def _hurried(motion: MotionUnit, time: float) -> bool:
    least, _ = motion.stretch or (0.0, inf)
    return time < max(least, HURRIED) * motion.preferred_duration
