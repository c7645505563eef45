"""Time pegs: points in time that follow the pegs they depend on (thesis 7.3.2, 7.3.3).

A peg is one cell; its value is a global time in seconds, None while unknown. A sync point placed at a local time of its
block is an `OffsetPeg` on the `BMLBlockPeg`: moved with the block, read back as a block time by subtraction.
"""

import weakref
from abc import abstractmethod
from collections.abc import Callable, Mapping, Sequence
from typing import ClassVar, NamedTuple

from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.pegboard.formulas import (
    Later,
    between,
    not_after_next,
    not_before_previous,
    not_earlier,
    shifted_by,
)
from reactive_realizer.reactive.cell import Derived, Source
from reactive_realizer.reactive.errors import Failure
from reactive_realizer.reactive.graph import Cell, Graph, Stamp

TimeCell = Cell[Time]

_tuple = tuple.__new__


class Link(NamedTuple):
    """A dependency of a peg, as data; a pinned peg keeps those that it was cut from, as they were then.

    Attributes:
        name: of the other peg.
        kind: of the other peg.
        time: s, global; None while unknown.
        stamp: of the commit that gave it this time.
        peg: the other peg, for as long as something else refers to it.
    """

    name: str
    kind: str
    time: Time
    stamp: Stamp | None
    peg: weakref.ref[TimeCell]


class Neighbor(NamedTuple):
    """A peg before which another one is kept, or behind it.

    Attributes:
        distance: from it, s.
        later: whether the other one does not come later than that; if not, it does not come earlier.
    """

    distance: float
    later: bool


class TimePeg(Derived[Time]):
    """A point in time that depends on others until it is pinned.

    Attributes:
        kind: name of its kind.
        why: text of the BML constraint that it was made for; None if there is none.
        neighbors: what its last dependencies are to it: they only keep it before them, or behind them.
        earliest: time before which it does not come, whatever it depends on; None if there is none.
    """

    __slots__ = ("_cut_from", "earliest", "neighbors", "why")

    kind: ClassVar[str]

    def __init__(
        self, graph: Graph, name: str, dependencies: tuple[TimeCell, ...], formula: Callable[..., Time]
    ) -> None:
        super().__init__(graph, name, dependencies, formula)
        self.why: str | None = None
        self.neighbors: tuple[Neighbor, ...] = ()
        self.earliest: Time = None
        self._cut_from: tuple[Link, ...] = ()

    @property
    def pinned(self) -> bool:
        """Whether it has its last value: its point was reached or cut, or has never depended on anything."""
        return not self.dependencies

    @property
    def links(self) -> tuple[Link, ...]:
        """Its dependencies; once pinned, those that it was cut from."""
        self.graph.settle()
        return tuple([_link(cell) for cell in self.dependencies]) or self._cut_from

    @property
    def deciding(self) -> tuple[Link, ...]:
        """The links that determine its time, or for which it waits."""
        time = time_of(self)
        if time is not None and time == self.earliest:
            return ()
        neighbors = zip(self._split_links[1], self.neighbors, strict=True)
        kept_by = [link for link, each in neighbors if link.time is not None and link.time + each.distance == time]
        return tuple(kept_by[:1]) or self._deciding()

    def keep_before(self, successor: "TimePeg", distance: float = 0.0) -> None:
        """Within a transaction, keep this peg from coming later than at a distance (s) from another one from now on.

        If the other peg depends on this one, this one is pinned at the latest time that is not too late instead.
        """
        if self.pinned or successor.depends_on(self):
            self._pin_before(successor, distance)
        else:
            self.rebind((*self.dependencies, successor), not_after_next(self.formula, distance))
            self.neighbors += (Neighbor(distance, later=True),)

    def keep_behind(self, previous: "TimePeg", distance: float) -> None:
        """Within a transaction, keep this peg from coming earlier than at a distance (s) from another one from now on.

        The other one must not depend on this one. A pinned peg keeps its time.
        """
        if not self.pinned:
            self.rebind((*self.dependencies, previous), not_before_previous(self.formula, distance))
            self.neighbors += (Neighbor(distance, later=False),)

    def keep_after(self, time: GlobalTime) -> None:
        """Within a transaction, keep this peg from coming before a time from now on, unless it is pinned."""
        if not self.pinned:
            self.rebind(self.dependencies, not_earlier(self.formula, time))
            self.earliest = time

    def shift(self, seconds: float) -> None:
        """Within a transaction, come later than its dependencies say from now on, or earlier."""
        shifted = self.formula
        later = shifted.later(seconds) if isinstance(shifted, Later) else Later(shifted, seconds)
        self.rebind(self.dependencies, later)

    def pin(self, value: Time) -> None:
        """Within a transaction, cut it from its dependencies, which are noted, and give it its last time."""
        if self.dependencies or value != self._value:  # many points may share it and be reached together
            links = self.links
            super().pin(value)
            self._cut_from = links

    def detached(self, name: str, time: GlobalTime) -> "TimePeg":
        """A new peg, pinned at a time within a transaction, for one of the points that shared this one."""
        peg = OffsetPeg(self.graph, name, self, 0.0)
        peg.pin(time)
        return peg

    def _pin_before(self, successor: "TimePeg", distance: float) -> None:
        """Pin it at a distance (s) from another peg, which may come earlier because of that, but by less."""
        before, aim = self.value, successor.value
        latest = None if aim is None else GlobalTime(aim + distance)
        self.pin(latest)
        aim = successor.value
        if before is None or latest is None or aim is None:
            return
        step, left = latest - before, aim + distance - latest
        if step < left < 0.0:  # each step leaves the same share of it to the next: the sum of a geometric series
            self.pin(GlobalTime(before + step / (1.0 - left / step)))

    @property
    @abstractmethod
    def parameters(self) -> Mapping[str, object]:
        """The numbers of its formula, by name."""

    def describe(self) -> str:
        """The rule by which its time follows from its links, for people."""
        own, neighbors = self._split_links
        rule, formula = self._rule(own), self.formula
        if isinstance(formula, Later):
            rule += f" {formula.seconds:+g} s of drift"
        for link, (distance, later) in zip(neighbors, self.neighbors, strict=True):
            rule += f", not {'after' if later else 'before'} {link.name}" + (f" {distance:+g} s" if distance else "")
        return rule if self.earliest is None else f"{rule}, not before {self.earliest:g} s"

    @abstractmethod
    def _rule(self, links: Sequence[Link]) -> str:
        """The rule without the neighbors."""

    def _deciding(self) -> tuple[Link, ...]:
        """The deciding links among those that are no neighbors."""
        return self._split_links[0]

    def _reached(self, distances: Sequence[float]) -> tuple[Link, ...]:
        """The first link that gives it its time, at a distance (s); of an unknown time those that are unknown."""
        time, links = time_of(self), self.links[: len(distances)]  # stops decide nothing
        if time is None:
            return tuple(link for link in links if link.time is None)
        pairs = zip(links, distances, strict=True)
        return tuple(link for link, distance in pairs if link.time is not None and link.time + distance == time)[:1]

    @property
    def _split_links(self) -> tuple[tuple[Link, ...], tuple[Link, ...]]:
        """The links without the neighbors, and the neighbors."""
        links = self.links
        count = len(links) - len(self.neighbors)
        return links[:count], links[count:]


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

    def _rule(self, links: Sequence[Link]) -> str:
        """``link + offset``."""
        return f"{links[0].name} {self.offset:+g} s"


class RatioPeg(TimePeg):
    """A fixed fraction of the way between two other pegs: when they move, order is kept and phases scale evenly."""

    __slots__ = ("ratio",)

    kind = "ratio"

    def __init__(self, graph: Graph, name: str, before: TimeCell, after: TimeCell, ratio: float) -> None:
        self.ratio = ratio
        super().__init__(graph, name, (before, after), between(ratio))

    @property
    def parameters(self) -> Mapping[str, object]:
        """``ratio``, 0 at the first and 1 at the second."""
        return {"ratio": self.ratio}

    def _rule(self, links: Sequence[Link]) -> str:
        """``ratio of the way before .. after``."""
        before, after = links
        return f"{self.ratio:.3g} of the way {before.name} .. {after.name}"


class AnticipatorPeg(Source[Time]):
    """A predicted point: absolute, written by its anticipator alone."""

    __slots__ = ()


def kind_of(peg: TimeCell) -> str:
    """The kind of a peg: offset, ratio, after, before, late, latest, block, open, wait or predicted."""
    kind: str = getattr(peg, "kind", "predicted")
    return kind


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
    """The dependency on a peg that is not stale."""
    # Equivalent to `Link(...)`, in half the time: this runs for every point that is reached.
    time = peg._value
    if type(time) is Failure:
        time = None
    return _tuple(Link, (peg.name, getattr(peg, "kind", "predicted"), time, peg.stamp, weakref.ref(peg)))
