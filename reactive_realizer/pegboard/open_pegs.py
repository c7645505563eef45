"""Ends that are not known yet: of behaviors that persist, and of those that wait for another point."""

from collections.abc import Mapping, Sequence
from typing import ClassVar

from reactive_realizer.clock.units import Time
from reactive_realizer.pegboard.formulas import shifted_by, until
from reactive_realizer.pegboard.time_peg import Link, TimeCell, TimePeg, time_of
from reactive_realizer.reactive.cell import Source
from reactive_realizer.reactive.graph import Graph


class OpenPeg(TimePeg):
    """The end of a behavior that persists until it is ended: unknown until it is pinned."""

    __slots__ = ()

    kind = "open"
    what: ClassVar[str] = "the end of the persistent behavior"

    def __init__(self, graph: Graph, name: str) -> None:
        super().__init__(graph, name, (Source[Time](graph, f"{self.what}, {name}", None),), shifted_by(0.0))

    @property
    def parameters(self) -> Mapping[str, object]:
        """None."""
        return {}

    def _rule(self, links: Sequence[Link]) -> str:
        """A constant."""
        return "until it is ended"


class WaitPeg(OpenPeg):
    """The end of a wait for another point: a distance (s) from that point, but not before the wait starts.

    It is not later than the start by more than a limit (s), if there is one. Until `follow` is called, it is unknown.
    """

    __slots__ = ("_unknown", "limit", "offset")

    kind = "wait"
    what = "the end of the wait"

    def __init__(self, graph: Graph, name: str, offset: float, limit: float | None) -> None:
        self.offset = offset
        self.limit = limit
        super().__init__(graph, name)
        (self._unknown,) = self.dependencies

    def follow(self, start: TimeCell, awaited: TimeCell | None) -> None:
        """Within a transaction, depend on the start of the wait and on the awaited point.

        One that does not exist, or depends on this peg itself, never has a time here.
        """
        links = (self._unknown if link is None or link.depends_on(self) else link for link in (start, awaited))
        self.rebind(tuple(links), until(self.offset, self.limit))

    @property
    def parameters(self) -> Mapping[str, object]:
        """``offset`` from the awaited point, s, and ``limit``, s, None for no limit."""
        return {"offset": self.offset, "limit": self.limit}

    def _deciding(self) -> tuple[Link, ...]:
        """The awaited point if it gives the time, or else the start; of an unknown time those that are unknown."""
        links, time = self._split_links[0], time_of(self)
        if time is None or len(links) < 2:
            return tuple(link for link in links if link.time is None)
        start, awaited = links
        return (awaited,) if awaited.time is not None and awaited.time + self.offset == time else (start,)

    def _rule(self, links: Sequence[Link]) -> str:
        """``awaited + offset, not before start and not later than start + limit``."""
        if len(links) < 2:
            return super()._rule(links)
        start, awaited = links
        latest = "" if self.limit is None else f" and not after {start.name} {self.limit:+g} s"
        return f"{awaited.name} {self.offset:+g} s, not before {start.name}{latest}"
