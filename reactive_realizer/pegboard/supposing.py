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
        path = [peg]
        while path:
            last = path[-1]
            missing = [cell for cell in last.dependencies if cell not in self._known]
            if last in self._known or not missing:
                path.pop()
                self._known.setdefault(last, self._time(last))
            else:
                path += missing
        return self._known[peg]

    def _time(self, peg: TimeCell) -> Time:
        if isinstance(peg, TimePeg) and peg.dependencies:
            time: Time = peg.formula(*(self._known[cell] for cell in peg.dependencies))
            return time
        return peg.value
