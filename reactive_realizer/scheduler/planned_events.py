"""Predicts events from the plans of the behaviors that emit them."""

from collections.abc import Iterable, Sequence

from reactive_realizer.bml.extensions import Emit
from reactive_realizer.bml.names import EVENTS
from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.pegboard.peg_key import anticipator_key
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import AnticipatorPeg
from reactive_realizer.planunit.plan_unit import PlanUnit


class PlannedEvents:
    """Writes the prediction of each event: the earliest time at which a behavior is planned to emit it.

    A behavior that itself waits for the event does not count. When an event is due, it is unknown until it is emitted,
    because the behavior may still be dropped.
    """

    def __init__(self, board: PegBoard) -> None:
        self._board = board
        self._emits: dict[str, list[PlanUnit]] = {}

    def add(self, units: Iterable[PlanUnit]) -> None:
        """Add the behaviors of a plan."""
        for unit in units:
            if isinstance(unit.behavior, Emit):
                self._emits.setdefault(unit.behavior.event, []).append(unit)

    def predict(self, now: GlobalTime) -> None:
        """Write the predictions that have changed."""
        for name, units in list(self._emits.items()):
            ahead = [unit for unit in units if unit.live]
            self._emits[name] = ahead
            if not ahead:
                del self._emits[name]
            peg = self._board.get(anticipator_key(EVENTS, name))
            if isinstance(peg, AnticipatorPeg):
                self._predict(peg, ahead, now)

    def _predict(self, peg: AnticipatorPeg, units: Sequence[PlanUnit], now: GlobalTime) -> None:
        time = _earliest(units, now)
        if time != peg.value:
            time = _earliest([unit for unit in units if not unit.points[0].peg.depends_on(peg)], now)
        if time != peg.value:
            with self._board.graph.transaction(f"predict {peg.name}"):
                peg.set(time)


def _earliest(units: Sequence[PlanUnit], now: GlobalTime) -> Time:
    times = (unit.points[0].peg.value for unit in units)
    return min((time for time in times if time is not None and not is_due(time, now)), default=None)
