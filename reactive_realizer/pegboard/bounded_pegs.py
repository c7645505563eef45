"""Pegs that follow another one within bounds, which other pegs set: live `after` and `before`."""

from collections.abc import Callable, Iterable, Mapping, Sequence

from reactive_realizer.clock.units import Time
from reactive_realizer.pegboard.formulas import not_after, not_before
from reactive_realizer.pegboard.time_peg import Link, TimeCell, TimePeg
from reactive_realizer.reactive.graph import Graph

Bound = tuple[TimeCell, float]
"""A peg and a distance (s) from it."""


class BoundedPeg(TimePeg):
    """A peg that follows another one, the natural peg, within bounds; each bound is a peg and a distance (s).

    A bound beyond one of the stops has no effect: it can no longer be satisfied.
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

    def _deciding(self) -> tuple[Link, ...]:
        """The natural peg, or the bound that overrides it."""
        return self._reached((0.0, *self.bounds))

    def _described(self, links: Sequence[Link], side: str, beyond: str) -> str:
        natural, *others = links
        stops = _shifted(others[len(self.bounds) :], self.stops)
        bounds = _shifted(others[: len(self.bounds)], self.bounds)
        return f"{natural.name}, not {side} {bounds}" + (f", unless that is {beyond} {stops}" if stops else "")


class AfterPeg(BoundedPeg):
    """A peg that follows another one, but does not come before any of its bounds: a live `after`.

    It is unknown while a bound is. A bound that moves pushes it (thesis 7.4.1), but not past a ceiling.
    """

    __slots__ = ()

    kind = "after"

    def __init__(
        self, graph: Graph, name: str, natural: TimeCell, bounds: Sequence[Bound], ceilings: Sequence[Bound] = ()
    ) -> None:
        super().__init__(graph, name, natural, bounds, ceilings, not_before)

    def _rule(self, links: Sequence[Link]) -> str:
        """``natural, not before ...``."""
        return self._described(links, "before", "after")


class BeforePeg(BoundedPeg):
    """A peg that follows another one, but does not come after any of its bounds: a live `before`.

    An unknown bound has no effect, and neither has one before a floor.
    """

    __slots__ = ()

    kind = "before"

    def __init__(
        self, graph: Graph, name: str, natural: TimeCell, bounds: Sequence[Bound], floors: Sequence[Bound] = ()
    ) -> None:
        super().__init__(graph, name, natural, bounds, floors, not_after)

    def _rule(self, links: Sequence[Link]) -> str:
        """``natural, not after ...``."""
        return self._described(links, "after", "before")


def _shifted(links: Iterable[Link], distances: Iterable[float]) -> str:
    return ", ".join(f"{link.name} {distance:+g} s" for link, distance in zip(links, distances, strict=True))
