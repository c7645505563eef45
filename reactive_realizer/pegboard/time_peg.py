"""Time pegs: points in time that follow what they hang on (thesis 7.3.2, 7.3.3).

A peg is one cell; its value is a global time in seconds, None while unknown. A sync point placed at a local time of its
block is an `OffsetPeg` on the `BMLBlockPeg`: moved with the block, read back as a block time by subtraction.
"""

import weakref
from abc import abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import ClassVar, NamedTuple

from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.pegboard.formulas import between, latest, not_after, not_before, shifted_by
from reactive_realizer.reactive.cell import Cell, Derived, Source
from reactive_realizer.reactive.commit import Stamp
from reactive_realizer.reactive.failure import Failure
from reactive_realizer.reactive.graph import Graph

TimeCell = Cell[Time]
Bound = tuple[TimeCell, float]
"""A peg and a distance (s) from it."""

_MOST_NAMES = 5


class Link(NamedTuple):
    """What a peg hangs on, as data; a pinned peg keeps those that it was cut from, as they were then.

    Attributes:
        name: of the other peg.
        kind: of the other peg.
        time: s, global; None while unknown.
        stamp: of the commit that gave it this time.
        peg: the other peg, as long as anybody else has it.
    """

    name: str
    kind: str
    time: Time
    stamp: Stamp | None
    peg: weakref.ref[TimeCell]


class TimePeg(Derived[Time]):
    """A point in time that hangs on others until it is pinned.

    Attributes:
        kind: a word for what it is.
        why: text of the BML constraint that made it; None if none did.
    """

    __slots__ = ("_cut_from", "why")

    kind: ClassVar[str]

    def __init__(
        self, graph: Graph, name: str, dependencies: tuple[TimeCell, ...], formula: Callable[..., Time]
    ) -> None:
        super().__init__(graph, name, dependencies, formula)
        self.why: str | None = None
        self._cut_from: tuple[Link, ...] = ()

    @property
    def pinned(self) -> bool:
        """Whether it has got its last value: its point was reached, cut, or never hung on anything."""
        return not self.dependencies

    @property
    def links(self) -> tuple[Link, ...]:
        """What it hangs on; once pinned, what it hung on."""
        return tuple(_link(cell) for cell in self.dependencies) or self._cut_from

    @property
    def deciding(self) -> tuple[Link, ...]:
        """Those of its links that set its time, or on which it waits."""
        return self.links

    def pin(self, value: Time) -> None:
        """Within a transaction, cut it from what it hangs on and give it its last time; what it hung on is noted."""
        links = self.links
        super().pin(value)
        self._cut_from = links

    def apart(self, name: str, time: GlobalTime) -> "TimePeg":
        """Within a transaction: a new peg, pinned at a time, for one of the points that shared this one."""
        peg = OffsetPeg(self.graph, name, self, 0.0)
        peg.pin(time)
        return peg

    @property
    @abstractmethod
    def parameters(self) -> Mapping[str, object]:
        """The numbers of its formula, by name."""

    @abstractmethod
    def describe(self) -> str:
        """What it hangs on and how, for people; once pinned, what it hung on."""


class OffsetPeg(TimePeg):
    """A fixed distance (s) from another peg."""

    __slots__ = ("offset",)

    kind = "offset"

    def __init__(self, graph: Graph, name: str, link: TimeCell, offset: float) -> None:
        self.offset = offset
        super().__init__(graph, name, (link,), shifted_by(offset))

    @property
    def parameters(self) -> Mapping[str, object]:
        """``offset``, s."""
        return {"offset": self.offset}

    def describe(self) -> str:
        """``link + offset``."""
        return f"{self.links[0].name} {self.offset:+g} s"


class RatioPeg(TimePeg):
    """A fixed fraction of the way between two other pegs: retimed, it keeps order and stretches uniformly."""

    __slots__ = ("ratio",)

    kind = "ratio"

    def __init__(self, graph: Graph, name: str, before: TimeCell, after: TimeCell, ratio: float) -> None:
        self.ratio = ratio
        super().__init__(graph, name, (before, after), between(ratio))

    @property
    def parameters(self) -> Mapping[str, object]:
        """``ratio``, 0 at the first and 1 at the second."""
        return {"ratio": self.ratio}

    def describe(self) -> str:
        """``ratio of the way before .. after``."""
        before, after = self.links
        return f"{self.ratio:.3g} of the way {before.name} .. {after.name}"


class BoundedPeg(TimePeg):
    """Where another peg is by nature, as far as its bounds let it, each of which is a peg and a distance (s).

    A bound beyond one of its stops binds nothing: it cannot be kept any more.
    """

    __slots__ = ("bounds", "stops")

    def __init__(
        self,
        graph: Graph,
        name: str,
        natural: TimeCell,
        bounds: Sequence[Bound],
        stops: Sequence[Bound],
        formula: Callable[[tuple[float, ...], tuple[float, ...]], Callable[..., Time]],
    ) -> None:
        self.bounds = tuple(distance for _, distance in bounds)
        self.stops = tuple(distance for _, distance in stops)
        cells = (natural, *(cell for cell, _ in (*bounds, *stops)))
        super().__init__(graph, name, cells, formula(self.bounds, self.stops))

    @property
    def parameters(self) -> Mapping[str, object]:
        """``bounds`` and ``stops``, the distance (s) from each peg after the first."""
        return {"bounds": list(self.bounds), "stops": list(self.stops)}

    @property
    def deciding(self) -> tuple[Link, ...]:
        """The natural peg, or the bound that holds it elsewhere."""
        return _reached(self, (0.0, *self.bounds))

    def _described(self, side: str, beyond: str) -> str:
        natural, *others = self.links
        stops = _shifted(others[len(self.bounds) :], self.stops)
        bounds = _shifted(others[: len(self.bounds)], self.bounds)
        return f"{natural.name}, not {side} {bounds}" + (f", unless that is {beyond} {stops}" if stops else "")


class AfterPeg(BoundedPeg):
    """Where another peg is, but not before any of its bounds: a live `after`.

    A bound that is unknown is waited for. Whoever moves a bound pushes this peg (thesis 7.4.1), but not past a ceiling.
    """

    __slots__ = ()

    kind = "after"

    def __init__(
        self, graph: Graph, name: str, natural: TimeCell, bounds: Sequence[Bound], ceilings: Sequence[Bound] = ()
    ) -> None:
        super().__init__(graph, name, natural, bounds, ceilings, not_before)

    def describe(self) -> str:
        """``natural, not before ...``."""
        return self._described("before", "after")


class BeforePeg(BoundedPeg):
    """Where another peg is, but not after any of its bounds: a live `before`.

    A bound that is unknown binds nothing, and neither does one in front of a floor.
    """

    __slots__ = ()

    kind = "before"

    def __init__(
        self, graph: Graph, name: str, natural: TimeCell, bounds: Sequence[Bound], floors: Sequence[Bound] = ()
    ) -> None:
        super().__init__(graph, name, natural, bounds, floors, not_after)

    def describe(self) -> str:
        """``natural, not after ...``."""
        return self._described("after", "before")


class LatestPeg(TimePeg):
    """The latest of some pegs, and not before ``floor``; unknown as long as one of them is."""

    __slots__ = ("floor",)

    kind = "latest"

    def __init__(self, graph: Graph, name: str, floor: GlobalTime, links: Sequence[TimeCell]) -> None:
        self.floor = floor
        super().__init__(graph, name, tuple(links), latest(floor))

    def wait_for(self, floor: GlobalTime, links: Sequence[TimeCell]) -> None:
        """Within a transaction, hang on other pegs."""
        self.floor = floor
        self.rebind(tuple(links), latest(floor))

    @property
    def parameters(self) -> Mapping[str, object]:
        """``floor``, s, global."""
        return {"floor": self.floor}

    @property
    def deciding(self) -> tuple[Link, ...]:
        """The latest; none where that is the floor."""
        return _reached(self, (0.0,) * len(self.links))

    def describe(self) -> str:
        """``latest of ...``, the first few by name."""
        names = [link.name for link in self.links]
        more = [f"{len(names) - _MOST_NAMES} more"] if len(names) > _MOST_NAMES else []
        return "latest of " + ", ".join([f"{self.floor:g} s", *names[:_MOST_NAMES], *more])


class BMLBlockPeg(LatestPeg):
    """The start of a BML block: predicted from what the block waits for, pinned when it starts."""

    __slots__ = ()

    kind = "block"


class OpenPeg(TimePeg):
    """The end of what goes on until somebody ends it: unknown until it is pinned."""

    __slots__ = ()

    kind = "open"

    def __init__(self, graph: Graph, name: str) -> None:
        super().__init__(
            graph, name, (Source[Time](graph, f"the end of what persists, {name}", None),), shifted_by(0.0)
        )

    @property
    def parameters(self) -> Mapping[str, object]:
        """None."""
        return {}

    def describe(self) -> str:
        """That nobody knows."""
        return "until it is ended"


class AnticipatorPeg(Source[Time]):
    """A predicted point: absolute, written by its anticipator alone."""

    __slots__ = ()


def kind_of(peg: TimeCell) -> str:
    """A word for what a peg is: offset, ratio, after, before, latest, block, open, predicted."""
    return peg.kind if isinstance(peg, TimePeg) else "predicted"


def time_of(peg: TimeCell) -> Time:
    """The time of a peg, s, global; None while it is unknown or cannot be computed."""
    time = peg.result
    return None if isinstance(time, Failure) else time


def state_of(peg: TimeCell) -> str:
    """``pinned``, ``moving``, or ``unknown``."""
    if time_of(peg) is None:
        return "unknown"
    return "pinned" if isinstance(peg, TimePeg) and peg.pinned else "moving"


def _link(peg: TimeCell) -> Link:
    return Link(peg.name, kind_of(peg), time_of(peg), peg.stamp, weakref.ref(peg))


def _shifted(links: Iterable[Link], distances: Iterable[float]) -> str:
    return ", ".join(f"{link.name} {distance:+g} s" for link, distance in zip(links, distances, strict=True))


def _reached(peg: TimePeg, distances: Sequence[float]) -> tuple[Link, ...]:
    """The first link that gives a peg its time at a distance (s) from it; of an unknown time those that are unknown."""
    time, links = time_of(peg), peg.links[: len(distances)]  # stops decide nothing
    if time is None:
        return tuple(link for link in links if link.time is None)
    pairs = zip(links, distances, strict=True)
    return tuple(link for link, distance in pairs if link.time is not None and link.time + distance == time)[:1]
