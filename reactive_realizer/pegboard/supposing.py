"""What times would be if one of them were known."""

from collections.abc import Mapping

from reactive_realizer.clock.units import Time
from reactive_realizer.pegboard.time_peg import TimeCell, TimePeg


class Supposed:
    """Times of pegs as if some had other times; the board stays as it is.

    Args:
        given: the pegs that are supposed to have a time, and that time.
    """

    def __init__(self, given: Mapping[TimeCell, Time]) -> None:
        self._known = dict(given)

    def __call__(self, peg: TimeCell) -> Time:
        """The time that a peg would have; a long chain is no deeper a call than a short one."""
        known = self._known
        path = [] if peg in known else [peg]
        while path:
            last = path[-1]
            missing = [cell for cell in last.dependencies if cell not in known]
            if missing and last not in known:
                path += missing
            elif path.pop() not in known:
                known[last] = self._time(last)
        return known[peg]

    def _time(self, peg: TimeCell) -> Time:
        if peg.dependencies and isinstance(peg, TimePeg):
            time: Time = peg.formula(*[self._known[cell] for cell in peg.dependencies])
            return time
        return peg.value
