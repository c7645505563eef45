"""Temporal extent that changes while a motion plays: the phases ahead get other durations."""

from collections.abc import Callable, Mapping, Sequence

from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.engines.animation.motion_unit import GESTURE_POINTS, MotionUnit
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.reactive.graph import Cell

TEMPORAL_EXTENT = "temporalExtent"
"""Name of the parameter."""


class LiveExtent:
    """Follows the temporal extent of one motion.

    The points after the last one that a constraint names move: nothing else fixes their times. What is before it keeps
    its times, because that point does.
    """

    def __init__(self, motion: MotionUnit, cell: Cell[float] | None) -> None:
        """Follow a parameter.

        Args:
            motion: to be played; its parameters have the values with which it is planned.
            cell: of the parameter; None if the motion has none.
        """
        self._motion, self._cell = motion, cell
        self._extent = motion.parameters.get(TEMPORAL_EXTENT, 0.0)

    def listen(self, wake: Callable[[], None]) -> None:
        """Call ``wake()`` when the extent changes."""
        if self._cell is not None:
            self._cell.observe(lambda change: wake())

    def times(
        self, points: Sequence[SyncPoint], keys: Mapping[str, float], now: GlobalTime, until: Callable[[], Time]
    ) -> dict[str, GlobalTime]:
        """Return the new times of points ahead after a change since the last call.

        Args:
            points: of a unit that has begun.
            keys: the phase of each of its points.
            now: s.
            until: returns the time by which the motion relaxes, because another one waits for its limbs; None if none
                does.
        """
        if self._cell is None or self._cell.value == self._extent:
            return {}
        before, self._extent = self._extent, self._cell.value
        factors = self._motion.slowed(before, self._extent)
        fixed = next((number for number in range(len(points) - 1, -1, -1) if _fixed(points[number])), 0)
        last = points[fixed].peg.value
        if last is None or not factors:
            return {}
        begin = old = time = GlobalTime(max(last, now))
        times: dict[str, GlobalTime] = {}
        for point in points[fixed + 1 :]:
            planned = point.peg.value
            if planned is None:
                break
            time = GlobalTime(time + (planned - old) * factors.get(_phase(keys[point.id], keys), 1.0))
            old, times[point.id] = planned, time
        return _relaxed(times, begin, until())


def _relaxed(times: Mapping[str, GlobalTime], begin: GlobalTime, until: Time) -> dict[str, GlobalTime]:
    """Return times of points with less time before the relax, if that would be too late; what follows comes earlier."""
    relax = times.get("relax")
    if relax is None or until is None or relax <= until or relax <= begin:
        return dict(times)
    share = max(0.0, until - begin) / (relax - begin)
    return {
        sync: GlobalTime(begin + share * (time - begin) if time <= relax else until + time - relax)
        for sync, time in times.items()
    }


def _fixed(point: SyncPoint) -> bool:
    return point.fired or point.tied


def _phase(key: float, keys: Mapping[str, float]) -> str:
    """Return the point at which the phase of a gesture ends in which another point lies."""
    return next((name for name in GESTURE_POINTS if name in keys and keys[name] >= key), GESTURE_POINTS[-1])
