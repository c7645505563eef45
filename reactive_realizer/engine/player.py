"""The player of a unimodal plan: it begins and fires units, and resolves conflicts between them."""

import logging
from collections.abc import Callable
from functools import partial
from math import inf
from typing import TypeVar

from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.engine.effects import Dropped, EndUnit, Reached
from reactive_realizer.engine.faults import ResourceTaken, UnitFailed
from reactive_realizer.engine.owners import Owners
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.pegboard.agenda import Agenda
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState, sleep

logger = logging.getLogger(__name__)

U = TypeVar("U", bound=PlanUnit)
T = TypeVar("T")


class Player:
    """A unimodal plan and its playing.

    Conflicts over a resource, such as an arm, the voice or the mouth, are judged for the time at which a unit starts,
    not when it is planned: an interrupt may come between. The unit that plays keeps the resource, and the newer one is
    dropped with one warning (in BML, MERGE keeps running behaviors). Only a return to rest may be taken over: the
    playing unit ends, and the newer one begins (co-articulation; S. Kopp and I. Wachsmuth, "Synthesizing multimodal
    utterances for conversational agents", 2004; thesis 12.1.3).
    """

    def __init__(self) -> None:
        self._units: dict[PlanUnit, int] = {}
        self._begun: dict[PlanUnit, int] = {}
        self._added = 0
        self._agenda: Agenda[PlanUnit] = Agenda(lambda unit: unit.next_due(), lambda unit: unit.awaited())
        self._ended: dict[PlanUnit, None] = {}
        self._owners = Owners()
        self._touched: list[PlanUnit] = []
        """The units that may have ended: those that have changed."""
        self._dropped: list[Dropped] = []
        self._ending: list[EndUnit] = []
        self._watching: Callable[[PlanUnit], object] = lambda _: None

    @property
    def units(self) -> tuple[PlanUnit, ...]:
        """The plan, in order of planning."""
        return tuple(self._units)

    @property
    def playing(self) -> tuple[PlanUnit, ...]:
        """The units that play now."""
        playing = [unit for unit in self._begun if unit.state is UnitState.IN_EXEC]
        return tuple(sorted(playing, key=self._begun.__getitem__) if len(playing) > 1 else playing)

    def listen(self, wake: Callable[[], None]) -> None:
        """Call ``wake()`` when units enter, leave or change."""
        self._agenda.wake = wake

    def watch(self, note: Callable[[PlanUnit], object]) -> None:
        """Call ``note(unit)`` whenever a unit enters, leaves, changes or is due."""
        self._watching = note

    @property
    def next_due(self) -> Time:
        """A time before which no unit begins or reaches a point; None while no such time is known."""
        return self._agenda.next_due

    def add(self, unit: PlanUnit) -> None:
        """Plan a unit."""
        self._added += 1
        self._units[unit] = self._added
        unit.wake = partial(self.note, unit)
        self._watching(unit)
        self._follow(unit)

    def note(self, unit: PlanUnit) -> None:
        """Note that a unit has changed."""
        self._touch(unit)
        if unit in self._units:
            self._follow(unit)

    def remove(self, unit: PlanUnit) -> None:
        """Remove a unit from the plan, if it is in the plan."""
        if unit in self._units:
            self._watching(unit)
            self._note_end(unit)
            self._forget(unit)
            self._agenda.wake()

    def play(self, tick: Tick) -> tuple[Reached, ...]:
        """Begin the units and fire the sync points that are due; forget units that have ended."""
        for unit in [unit for unit in self._ended if is_due(unit.points[-1].peg.value, tick.previous)]:
            del self._ended[unit]
            self._owners.remove(unit)
        reached: list[Reached] = []
        now, previous = tick.time, tick.previous
        due, starting = self._due(now)
        for unit in due:
            self._fire(unit, now, reached)
        for unit in starting:
            if not self._held(unit, now, previous):
                unit.begin()
                self._note_begin(unit)
                self._fire(unit, now, reached)
        self._forget_ended()
        return tuple(reached)

    def show(self, kind: type[U], show: Callable[[U], T], now: GlobalTime) -> list[T]:
        """The result of ``show`` for every playing unit of a kind, in the order of `stacked`.

        A unit for which it raises is dropped; the others continue.
        """
        shown: list[T] = []
        for unit in self.stacked(kind):
            try:
                shown.append(show(unit))
            except Exception as failure:
                self._fail(unit, failure, now)
        return shown

    def stacked(self, kind: type[U]) -> list[U]:
        """The playing units of a kind, from the lowest to the uppermost (thesis 8.7.5).

        A unit that started later is above; of those that started together, the one that ends first.
        """
        return [unit for unit in sorted(self.playing, key=height) if isinstance(unit, kind)]

    def take_ending(self) -> tuple[EndUnit, ...]:
        """The units that must end because others take over from them, since the last call."""
        ending, self._ending = tuple(self._ending), []
        return ending

    def take_dropped(self) -> tuple[Dropped, ...]:
        """The units that were dropped since the last call."""
        if not self._dropped:
            return ()
        dropped, self._dropped = tuple(self._dropped), []
        self._forget_ended()
        return dropped

    def _follow(self, unit: PlanUnit) -> None:
        """Have a unit on the agenda that has changed; most have no time there before their blocks start."""
        if unit.state is UnitState.PENDING and not unit.awaited():
            self._agenda.wake()
            return
        if unit.state is UnitState.IN_EXEC:
            self._note_begin(unit)
        self._agenda.add(unit)

    def _due(self, now: GlobalTime) -> tuple[list[PlanUnit], list[PlanUnit]]:
        """The playing units with due points, and those that begin, in a unique order.

        They begin by start and then by id; those that accompany others come last.
        """
        due = dict.fromkeys(self._agenda.take_due(now))
        if not due:
            return [], []
        for unit in due:
            self._watching(unit)
        starting = sorted((unit for unit in due if unit.due(now)), key=_rank)
        playing = (unit for unit in due if unit in self._begun and unit.state is UnitState.IN_EXEC)
        return sorted(playing, key=self._begun.__getitem__), starting

    def _held(self, unit: PlanUnit, now: GlobalTime, previous: GlobalTime) -> bool:
        """Whether a due unit cannot begin now: it is dropped, or others have to end first in this round."""
        start = unit.points[0].peg.value
        if start is None or unit.state is not UnitState.LURKING:
            return True
        if (fault := unit.refusal()) is not None:
            self._drop(unit, fault, now)
            return True
        begin = now if is_due(start, previous) else start  # a unit that joins late begins now
        unit.settle(self._owners.kept_from(unit, begin))
        staying, leaving = self._owners.excluded_by(unit, begin)
        if staying:
            self._drop(unit, _taken(unit, staying[0]), now)
        else:
            self._ending += [EndUnit(owner, begin) for owner in leaving]
        return bool(staying or leaving)

    def _fire(self, unit: PlanUnit, now: GlobalTime, reached: list[Reached]) -> None:
        due = unit.due_points(now)
        try:
            unit.fire(due, now)
        except Exception as failure:
            self._fail(unit, failure, now)
        self._touch(unit)
        for point, time in due:
            if point.fired:
                reached.append(Reached(unit, point, time))
        self._note_end(unit)

    def _touch(self, unit: PlanUnit) -> None:
        self._touched.append(unit)
        self._watching(unit)

    def _forget_ended(self) -> None:
        for unit in self._touched:
            if unit in self._units and not unit.live:
                self._forget(unit)
        self._touched.clear()

    def _forget(self, unit: PlanUnit) -> None:
        del self._units[unit]
        self._begun.pop(unit, None)
        if unit not in self._ended:
            self._owners.remove(unit)
        self._agenda.remove(unit)
        unit.wake = sleep

    def _note_begin(self, unit: PlanUnit) -> None:
        self._begun[unit] = self._units[unit]
        self._owners.add(unit)

    def _note_end(self, unit: PlanUnit) -> None:
        if unit.state is UnitState.DONE:
            self._ended[unit] = None

    def _fail(self, unit: PlanUnit, failure: Exception, now: GlobalTime) -> None:
        # The sentence explains a fault of a file; an internal error needs the traceback.
        trace = None if isinstance(failure, RealizerError) else failure
        logger.error("%s/%s:%s failed while playing: %s", *unit.block, unit.behavior.id, failure, exc_info=trace)
        self._drop(unit, UnitFailed(reason=str(failure)), now)

    def _drop(self, unit: PlanUnit, fault: Fault, now: GlobalTime) -> None:
        unit.drop(now)
        self._touch(unit)
        self._dropped.append(Dropped(unit, fault))


def height(unit: PlanUnit) -> tuple[float, float]:
    """Sort key for the height of a unit among others: the uppermost unit has the greatest."""
    start, end = unit.start_and_end
    return (inf if start is None else start, -inf if end is None else -end)


def _rank(unit: PlanUnit) -> tuple[Time, bool, str]:
    """Sort key for units that begin in one tick."""
    return unit.points[0].peg.value, unit.accompanies, unit.behavior.id


def _taken(unit: PlanUnit, owner: PlanUnit) -> Fault:
    what = ", ".join(sorted(owner.resources & unit.resources)) or f"replacement group {unit.group}"
    behavior, other = (f"{each.block.block}:{each.behavior.id}" for each in (unit, owner))
    return ResourceTaken(behavior=behavior, other=other, resource=what)
