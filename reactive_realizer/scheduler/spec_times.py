"""Descriptions of pegs as times, without a board."""

from collections.abc import Mapping, Sequence

from reactive_realizer.pegboard.formulas import not_after, not_before
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.reactive.cell import Cell
from reactive_realizer.scheduler.problem import AtBlock, AtLeast, AtMost, AtOffset, AtRatio, PegSpec


class SpecTimes:
    """The time (s after the block's start) at which each peg of a solution comes to lie, None while unknown.

    Each is worked out once, and a long chain is no deeper a call than a short one.

    Args:
        outer: times of the pegs of the outside, s after the block's start.
    """

    def __init__(self, outer: Mapping[TimeCell, float | None]) -> None:
        self._outer = outer
        self._known: dict[PegSpec, float | None] = {}

    def __call__(self, spec: PegSpec) -> float | None:
        """The time of a peg.

        Raises:
            ValueError: it hangs on itself.
        """
        path = {spec: None}
        while path:
            last = next(reversed(path))
            links = (link for link in last.links if not isinstance(link, Cell))
            missing = next((link for link in links if link not in self._known), None)
            if missing is None:
                self._known[last] = self._work_out(last)
                del path[last]
            elif missing in path:
                raise ValueError(f"{missing} hangs on itself")
            else:
                path[missing] = None
        return self._known[spec]

    def _work_out(self, spec: PegSpec) -> float | None:
        match spec:
            case AtBlock(anchor, offset):
                return anchor.time + offset
            case AtOffset(link, offset):
                return _shifted(self._time(link), offset)
            case AtRatio(before, after, ratio):
                low, high = self._time(before), self._time(after)
                return None if low is None or high is None else low + ratio * (high - low)
            case AtLeast(_, bounds, ceilings):
                return not_before(_distances(bounds), _distances(ceilings))(*map(self._time, spec.links))
            case AtMost(_, bounds, floors):
                return not_after(_distances(bounds), _distances(floors))(*map(self._time, spec.links))

    def _time(self, link: PegSpec | TimeCell) -> float | None:
        return self._outer[link] if isinstance(link, Cell) else self._known[link]


def _distances(bounds: Sequence[tuple[PegSpec | TimeCell, float]]) -> tuple[float, ...]:
    return tuple(distance for _, distance in bounds)


def _shifted(time: float | None, offset: float) -> float | None:
    return None if time is None else time + offset
