"""The preferred timing of a behavior: its sync points in order and the phases between them."""

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from math import inf

from reactive_realizer.errors import SchedulingFault

SHORTEST = 1e-5
"""A behavior shorter than a thousandth of a tick (s) cannot be played."""


OPEN = ("relax", "end")
"""The points of a persistent behavior that are unknown until it is ended."""


class PhaseKind(Enum):
    """The ways in which a phase may be stretched."""

    RIGID = "rigid"
    ELASTIC = "elastic"
    HOLD = "hold"
    """Stretched first, so that the phases around it keep their durations."""
    FREE = "free"
    """Without a preference: its two points determine its duration."""


@dataclass(frozen=True, slots=True)
class Phase:
    """The time between a sync point and the next one.

    Attributes:
        duration: preferred, s.
        kind: how it may be stretched.
        minimum: authored limit, s; it is relaxed before any constraint is.
        maximum: authored limit, s; likewise.
        shortest: duration that the body needs for it, s, at most ``duration``; it is never relaxed.
    """

    duration: float
    kind: PhaseKind = PhaseKind.ELASTIC
    minimum: float = 0.0
    maximum: float = inf
    shortest: float = 0.0

    @property
    def authored(self) -> bool:
        """Whether it has limits."""
        return self.minimum > 0 or self.maximum < inf


@dataclass(frozen=True, slots=True)
class Timing:
    """The preferred timing of a behavior.

    Attributes:
        points: sync ids in order, from start to end; two or more.
        phases: one between each two points.
        instant: whether all its points have one time; other behaviors have a duration (thesis 7.14).
        persistent: whether it continues until it is ended, and its relax and end are unknown until then (thesis 6.3.1).
        waits: whether its end comes with another point; then only its start is planned.
        rigid: whether all its phases are rigid.
        free: whether all its phases are free: it takes the time that other behaviors leave, and does not move them.
        limited: indices of the phases with authored limits that have an effect.
    """

    points: tuple[str, ...]
    phases: tuple[Phase, ...]
    instant: bool = False
    persistent: bool = False
    waits: bool = False
    rigid: bool = field(init=False, repr=False, compare=False)
    free: bool = field(init=False, repr=False, compare=False)
    limited: frozenset[int] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        if len(self.phases) != len(self.points) - 1:
            raise ValueError(f"{len(self.points)} points need {len(self.points) - 1} phases, not {len(self.phases)}")
        if any(phase.shortest > phase.duration for phase in self.phases):
            raise ValueError("a phase cannot prefer less time than it needs")
        object.__setattr__(self, "rigid", all(phase.kind is PhaseKind.RIGID for phase in self.phases))
        object.__setattr__(self, "free", all(phase.kind is PhaseKind.FREE for phase in self.phases))
        limited = (k for k, phase in enumerate(self.phases) if phase.authored and phase.kind is not PhaseKind.RIGID)
        object.__setattr__(self, "limited", frozenset(limited))

    @property
    def closed(self) -> "Timing":
        """The part that can be timed: the part before its relax if it is persistent, and no time if it waits.

        It is an instant if it has one point alone.
        """
        if self.waits:
            return Timing(self.points, tuple(Phase(0.0, PhaseKind.RIGID) for _ in self.phases), instant=True)
        if not self.persistent:
            return self
        count = len([point for point in self.points if point not in OPEN])
        return Timing(self.points[:count], self.phases[: count - 1], self.instant or count == 1)

    @property
    def limits(self) -> tuple[float, float]:
        """Authored limits of the whole behavior, s, of which its phases have their shares, and holds have none.

        0 and infinity if there are none, or if they concern only a part of the behavior.
        """
        phases = self.phases
        held = (k for k, each in enumerate(phases) if each.kind is PhaseKind.HOLD or each.duration == 0.0)
        if not self.limited or len(self.limited.union(held)) < len(phases):
            return 0.0, inf
        limited, preferred = [phases[k] for k in self.limited], self.offsets[-1]
        share = sum(phase.duration for phase in limited) / preferred if preferred > 0.0 else 1.0
        return sum(phase.minimum for phase in limited) / share, sum(phase.maximum for phase in limited) / share

    @property
    def offsets(self) -> tuple[float, ...]:
        """Preferred time (s) of each point after the first."""
        times = [0.0]
        for phase in self.phases:
            times.append(times[-1] + phase.duration)
        return tuple(times)


def stretched(phases: Sequence[Phase], total: float) -> list[float]:
    """The durations of consecutive phases that take a total time (s) together.

    All are stretched alike, except for those that would become shorter than their shortest duration.
    """
    durations = [phase.duration for phase in phases]
    held: set[int] = set()
    while True:
        left = total - sum(phases[k].shortest for k in held)
        preferred = sum(duration for k, duration in enumerate(durations) if k not in held)
        ratio = max(left, 0.0) / preferred if preferred > 0 else 0.0
        short = {k for k, phase in enumerate(phases) if k not in held and ratio * phase.duration < phase.shortest}
        if not short:
            return [phase.shortest if k in held else ratio * durations[k] for k, phase in enumerate(phases)]
        held |= short


def timing_at(offsets: Mapping[str, float], kind: PhaseKind = PhaseKind.ELASTIC) -> Timing:
    """A timing from the times (s) of its points after the start, in order, all phases of one kind."""
    times = list(offsets.values())
    return Timing(tuple(offsets), tuple(Phase(b - a, kind) for a, b in itertools.pairwise(times)))


class Overtaken(SchedulingFault):
    """Sync points whose times, in s, lost their order (thesis 7.15)."""

    code = "overtaken"
    template = "its sync points lost their order when they moved: {sync} is at {time} s, {later} at {late} s"
    compared = ("time", "late")
    sync: str
    time: float
    later: str
    late: float


class TooShort(SchedulingFault):
    """A behavior without duration (thesis 7.14)."""

    code = "too-short"
    template = "no time is left between its start and its end"
