"""Pegs of blocks: their starts and ends, and times from outside to which their behaviors may be late."""

from collections.abc import Mapping, Sequence

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.formulas import latest, shifted_by, unless_late
from reactive_realizer.pegboard.time_peg import Link, TimeCell, TimePeg
from reactive_realizer.reactive.graph import Graph

_MOST_NAMES = 5


class LateTiePeg(TimePeg):
    """A peg that follows a time from outside while a block that waits can meet the ties to it.

    If it comes less than ``least`` (s) after the start of the block, the ties are late: they are met ``earliest`` (s)
    after the start. Once the block has started, the peg has the time from outside.
    """

    __slots__ = ("earliest_met", "least")

    kind = "late"

    def __init__(
        self, graph: Graph, name: str, outside: TimeCell, start: TimeCell, least: float, earliest: float
    ) -> None:
        self.least, self.earliest_met = least, earliest
        super().__init__(graph, name, (outside, start), unless_late(least, earliest))

    def start(self) -> None:
        """Within a transaction, have the time from outside from now on."""
        if not self.pinned:
            self.rebind(self.dependencies[:1], shifted_by(0.0))

    @property
    def parameters(self) -> Mapping[str, object]:
        """``least`` and ``earliest``, s after the start of the block."""
        return {"least": self.least, "earliest": self.earliest_met}

    def _deciding(self) -> tuple[Link, ...]:
        """The start of the block if the ties are late, otherwise the time from outside."""
        outside, *start = self.links
        return (outside,) if outside.time == self.value else tuple(start)

    def _rule(self, links: Sequence[Link]) -> str:
        """``outside``, and, until the block starts, ``or start + earliest if it is before start + least``."""
        outside, *others = links
        if not others:
            return outside.name
        (start,) = others
        return (
            f"{outside.name}, or {start.name} {self.earliest_met:+g} s if it is before {start.name} {self.least:+g} s"
        )


class LatestPeg(TimePeg):
    """The latest of several pegs, and not before ``floor``; unknown while one of them is."""

    __slots__ = ("floor",)

    kind = "latest"

    def __init__(self, graph: Graph, name: str, floor: GlobalTime, links: Sequence[TimeCell]) -> None:
        self.floor = floor
        super().__init__(graph, name, tuple(links), latest(floor))

    def wait_for(self, floor: GlobalTime, links: Sequence[TimeCell]) -> None:
        """Within a transaction, depend on other pegs."""
        self.floor = floor
        self.rebind(tuple(links), latest(floor))

    @property
    def parameters(self) -> Mapping[str, object]:
        """``floor``, s, global."""
        return {"floor": self.floor}

    def _deciding(self) -> tuple[Link, ...]:
        """The latest; none if that is the floor."""
        return self._reached((0.0,) * len(self.links))

    def _rule(self, links: Sequence[Link]) -> str:
        """``latest of ...``, the first few by name."""
        names = [link.name for link in links]
        more = [f"{len(names) - _MOST_NAMES} more"] if len(names) > _MOST_NAMES else []
        return "latest of " + ", ".join([f"{self.floor:g} s", *names[:_MOST_NAMES], *more])


class BMLBlockPeg(LatestPeg):
    """The start of a BML block: predicted from the pegs that the block waits for, pinned when it starts."""

    __slots__ = ()

    kind = "block"
