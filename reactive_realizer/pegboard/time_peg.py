"""Time pegs: points in time that follow what they hang on (thesis 7.3.2, 7.3.3).

A peg is one cell; its value is a global time in seconds, None while unknown. A sync point placed at a local time of its
block is an `OffsetPeg` on the `BMLBlockPeg`: moved with the block, read back as a block time by subtraction.
"""

from abc import abstractmethod
from collections.abc import Callable, Iterable, Sequence

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.reactive.cell import Cell, Derived, Source
from reactive_realizer.reactive.graph import Graph

Time = GlobalTime | None
TimeCell = Cell[Time]
Bound = tuple[TimeCell, float]
"""A peg and a distance (s) from it."""


class TimePeg(Derived[Time]):
    """A point in time that hangs on others until it is pinned."""

    __slots__ = ()

    @property
    def pinned(self) -> bool:
        """Whether it has got its last value: its point was reached, cut, or never hung on anything."""
        return not self.dependencies

    def apart(self, name: str, time: GlobalTime) -> "TimePeg":
        """Within a transaction: a new peg, pinned at a time, for one of the points that shared this one."""
        peg = OffsetPeg(self.graph, name, self, 0.0)
        peg.pin(time)
        return peg

    @abstractmethod
    def describe(self) -> str:
        """What it hangs on and how, for people."""


class OffsetPeg(TimePeg):
    """A fixed distance (s) from another peg."""

    __slots__ = ("offset",)

    def __init__(self, graph: Graph, name: str, link: TimeCell, offset: float) -> None:
        self.offset = offset
        super().__init__(graph, name, (link,), _shifted_by(offset))

    def describe(self) -> str:
        """``link + offset``."""
        return f"{self.dependencies[0].name} {self.offset:+g} s" if self.dependencies else "pinned"


class RatioPeg(TimePeg):
    """A fixed fraction of the way between two other pegs: retimed, it keeps order and stretches uniformly."""

    __slots__ = ("ratio",)

    def __init__(self, graph: Graph, name: str, before: TimeCell, after: TimeCell, ratio: float) -> None:
        self.ratio = ratio
        super().__init__(graph, name, (before, after), _between(ratio))

    def describe(self) -> str:
        """``ratio of the way before .. after``."""
        if not self.dependencies:
            return "pinned"
        before, after = self.dependencies
        return f"{self.ratio:.3g} of the way {before.name} .. {after.name}"


class AfterPeg(TimePeg):
    """Where another peg is, but not before any of its bounds, each a peg and a distance (s): a live `after`.

    A bound that is unknown is waited for. Whoever moves a bound pushes this peg (thesis 7.4.1).
    """

    __slots__ = ("bounds",)

    def __init__(self, graph: Graph, name: str, natural: TimeCell, bounds: Sequence[Bound]) -> None:
        self.bounds = tuple(distance for _, distance in bounds)
        super().__init__(graph, name, (natural, *(cell for cell, _ in bounds)), _not_before(self.bounds))

    def describe(self) -> str:
        """``natural, not before ...``."""
        return _bounded(self, "before")


class BeforePeg(TimePeg):
    """Where another peg is, but not after any of its bounds, each a peg and a distance (s): a live `before`.

    A bound that is unknown binds nothing.
    """

    __slots__ = ("bounds",)

    def __init__(self, graph: Graph, name: str, natural: TimeCell, bounds: Sequence[Bound]) -> None:
        self.bounds = tuple(distance for _, distance in bounds)
        super().__init__(graph, name, (natural, *(cell for cell, _ in bounds)), _not_after(self.bounds))

    def describe(self) -> str:
        """``natural, not after ...``."""
        return _bounded(self, "after")


class LatestPeg(TimePeg):
    """The latest of some pegs, and not before ``floor``; unknown as long as one of them is."""

    __slots__ = ("floor",)

    def __init__(self, graph: Graph, name: str, floor: GlobalTime, links: Sequence[TimeCell]) -> None:
        self.floor = floor
        super().__init__(graph, name, tuple(links), _latest(floor))

    def wait_for(self, floor: GlobalTime, links: Sequence[TimeCell]) -> None:
        """Within a transaction, hang on other pegs."""
        self.floor = floor
        self.rebind(tuple(links), _latest(floor))

    def describe(self) -> str:
        """``latest of ...``."""
        return "latest of " + ", ".join([f"{self.floor:g} s", *(link.name for link in self.dependencies)])


class BMLBlockPeg(LatestPeg):
    """The start of a BML block: predicted from what the block waits for, pinned when it starts."""

    __slots__ = ()


class AnticipatorPeg(Source[Time]):
    """A predicted point: absolute, written by its anticipator alone."""

    __slots__ = ()


def followers_of(peg: TimeCell) -> set[TimeCell]:
    """The pegs that move with a peg; starts and ends of blocks, and what hangs on those alone, are not among them."""
    followers: set[TimeCell] = set()
    waiting = [peg]
    while waiting:
        for cell in waiting.pop().dependents:
            if cell not in followers and not isinstance(cell, LatestPeg):
                followers.add(cell)
                waiting.append(cell)
    return followers


def hangs_on(peg: TimeCell, other: TimeCell) -> bool:
    """Whether a peg moves with another one."""
    seen = {peg}
    waiting = [peg]
    while waiting:
        cell = waiting.pop()
        if cell is other:
            return True
        new = [each for each in getattr(cell, "dependencies", ()) if each not in seen and each.rank >= other.rank]
        seen.update(new)
        waiting += new
    return False


def unknown_sources(pegs: Iterable[TimeCell]) -> list[str]:
    """Names of the unknown points, outside of any formula, that some pegs hang on."""
    seen: dict[TimeCell, None] = dict.fromkeys(pegs)
    waiting = list(seen)
    while waiting:
        for cell in getattr(waiting.pop(), "dependencies", ()):
            if cell not in seen:
                seen[cell] = None
                waiting.append(cell)
    return [cell.name for cell in seen if cell.value is None and not getattr(cell, "dependencies", ())]


def _shifted_by(offset: float) -> Callable[[Time], Time]:
    def shifted(link: Time) -> Time:
        return None if link is None else GlobalTime(link + offset)

    return shifted


def _between(ratio: float) -> Callable[[Time, Time], Time]:
    def between(before: Time, after: Time) -> Time:
        if before is None or after is None:
            return None
        return GlobalTime(before + ratio * (after - before))

    return between


def _not_before(distances: tuple[float, ...]) -> Callable[..., Time]:
    def not_before(natural: Time, *bounds: Time) -> Time:
        known = [b + d for b, d in zip(bounds, distances, strict=True) if b is not None]
        return None if natural is None or len(known) < len(bounds) else GlobalTime(max(natural, *known))

    return not_before


def _not_after(distances: tuple[float, ...]) -> Callable[..., Time]:
    def not_after(natural: Time, *bounds: Time) -> Time:
        if natural is None:
            return None
        return GlobalTime(min([natural, *(b + d for b, d in zip(bounds, distances, strict=True) if b is not None)]))

    return not_after


def _bounded(peg: AfterPeg | BeforePeg, side: str) -> str:
    if not peg.dependencies:
        return "pinned"
    natural, *cells = peg.dependencies
    bounds = ", ".join(f"{cell.name} {distance:+g} s" for cell, distance in zip(cells, peg.bounds, strict=True))
    return f"{natural.name}, not {side} {bounds}"


def _latest(floor: GlobalTime) -> Callable[..., Time]:
    def latest(*times: Time) -> Time:
        known = [time for time in times if time is not None]
        return max([floor, *known]) if len(known) == len(times) else None

    return latest
