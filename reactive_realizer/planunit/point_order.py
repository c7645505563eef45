"""The order of the sync points of a unit: each comes in time for later ones (thesis 7.15)."""

import itertools
from collections.abc import Callable, Sequence
from math import inf
from typing import NamedTuple

from reactive_realizer.clock.units import RESOLUTION, GlobalTime
from reactive_realizer.pegboard.time_peg import TimePeg
from reactive_realizer.planunit.sync_point import SyncPoint


def overtaken(points: Sequence[SyncPoint]) -> tuple[tuple[str, GlobalTime], tuple[str, GlobalTime]] | None:
    """Two points of a unit, with their times, that are out of order, if there are any; tied ones first."""
    known = [(point, time) for point in points if (time := point.peg.value) is not None]
    for some in ([each for each in known if each[0].tied], known):
        for (earlier, time), (later, late) in itertools.pairwise(some):
            if time > late + RESOLUTION:
                return (earlier.id, time), (later.id, late)
    return None


def keep_order(points: Sequence[SyncPoint], needs: Sequence[float], part: Callable[[SyncPoint], None]) -> bool:
    """Within a transaction, keep each point that has not fired in time for later ones; whether any was not.

    A point that a later one overtook, or left less time than the body needs, moves with that, for as long as it is
    so early. But later points that only follow it, because no constraint names them, wait for it.

    Args:
        points: of a unit, in order.
        needs: the shortest duration of the phase after each, s.
        part: called with each point before its peg is changed.
    """
    moved = False
    later: list[_Later] = []
    soonest = inf  # of all of these: a speech may have hundreds of points
    bound = inf  # the soonest of those that are fixed
    for index in range(len(points) - 1, -1, -1):
        point, need = points[index], needs[index]
        if point.fired:
            break
        if need > 0.0:
            later = [each.ahead(need) for each in later]
            soonest = min((each.latest for each in later), default=inf)
        time = point.peg.value
        if time is None:
            continue
        if time > soonest + RESOLUTION:
            overtaking = [each for each in later if time > each.latest + RESOLUTION]
            firm = [each for each in overtaking if not each.yields_to(point.peg)]
            if not firm:
                for each in {each.point.peg: each for each in overtaking}.values():
                    part(each.point)
                    each.point.peg.keep_behind(point.peg, -each.distance)
                return True
            # Points between the two may depend on both; only one that does not depend on this one can hold it.
            independent = [each for each in firm if not each.point.peg.depends_on(point.peg)]
            successor = min(independent or firm, key=lambda each: each.latest)
            part(point)
            point.peg.keep_before(successor.point.peg, successor.distance)
            time, moved = successor.latest, True
        fixed = point.peg.pinned or time > bound - RESOLUTION
        if fixed:
            bound = min(bound, time)
        later.append(_Later(time, point, 0.0, fixed))
        soonest = min(soonest, time)
    return moved


def needs_after(points: Sequence[SyncPoint], shortest: Sequence[float]) -> list[float]:
    """The shortest duration of the phase after each point, s; no time can pass between points that share a peg.

    Args:
        points: of a unit, in order.
        shortest: duration that the body needs for each phase, s.
    """
    needs, together = [0.0] * len(points), 0
    if not any(shortest):
        return needs
    last = {point.peg: index for index, point in enumerate(points)}
    for index, (point, least) in enumerate(zip(points, shortest, strict=False)):
        together = max(together, last[point.peg])
        needs[index] = 0.0 if index < together else least
    return needs


class _Later(NamedTuple):
    """A later point, as earlier ones see it: they come no later than at a distance (s) from it.

    A fixed one cannot wait: it is pinned, or comes with one that is.
    """

    latest: GlobalTime
    point: SyncPoint
    distance: float
    fixed: bool

    def ahead(self, need: float) -> "_Later":
        """The same point, as seen from before a phase that needs some time (s); a fixed one cannot wait for that."""
        if self.fixed or not need:
            return self
        return self._replace(latest=GlobalTime(self.latest - need), distance=self.distance - need)

    def yields_to(self, peg: TimePeg) -> bool:
        """Whether it can wait for a peg: it moves with that, and no constraint names it."""
        return not self.point.tied and self.point.peg.depends_on(peg)
