"""A behavior that ends when another point comes."""

from collections.abc import Mapping

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.clock.units import RESOLUTION, GlobalTime
from reactive_realizer.pegboard.open_pegs import WaitPeg
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Phase, Timing
from reactive_realizer.reactive.graph import Graph

_ENDED = "ended"
LIMIT = "max-wait"
"""Reported as what ended a wait that reached its limit."""


class WaitUnit(PlanUnit):
    """Waits until a point comes, and not longer than a limit.

    Its end is not planned: it is the time of that point, but not before the start and not after the limit. It is
    planned like a point from outside, on which other behaviors may depend.

    Args:
        until: reference to the point.
        limit: s; None for no limit.
        reason: reported as what ended it, if the point came in time.
    """

    def __init__(self, block: BlockKey, behavior: Behavior, until: SyncRef, limit: float | None, reason: str) -> None:
        super().__init__(block, behavior, Timing(("start", "end"), (Phase(0.0),), waits=True))
        self.until = until
        self._limit = limit
        self._reason = reason
        self._awaited: TimeCell | None = None

    def make_end(self, graph: Graph) -> WaitPeg:
        """The peg of its end, which is unknown until `follow` is called."""
        return WaitPeg(graph, str(self.key("end")), self.until.offset, self._limit)

    def follow(self, awaited: TimeCell | None) -> None:
        """Within a transaction, wait for a peg; None for a point that will never come."""
        self._awaited = awaited
        end = self.open["end"]
        if isinstance(end, WaitPeg) and not end.pinned:
            end.follow(self.points[0].peg, awaited)

    def rename(self, replaced: Mapping[TimeCell, TimeCell]) -> None:
        """Within a transaction, wait for the new peg if the peg that it waits for is replaced."""
        if self._awaited is not None and self._awaited in replaced:
            self.follow(replaced[self._awaited])

    def details(self, sync: str, time: GlobalTime) -> Mapping[str, str]:
        """At the end, what ended it: the point, or the limit; nothing if it was interrupted."""
        if sync != "end" or self._awaited is None:
            return {}
        start, came = self.points[0].peg.value, self._awaited.value
        if came is not None and came + self.until.offset <= time + RESOLUTION:
            return {_ENDED: self._reason}
        reached = self._limit is not None and start is not None and start + self._limit <= time + RESOLUTION
        return {_ENDED: LIMIT} if reached else {}
