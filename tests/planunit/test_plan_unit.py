"""Sync points fire once, in order, with the time of their peg, also in late ticks."""

import numpy as np
import pytest

from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.bounded_pegs import BeforePeg
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg
from reactive_realizer.planunit.phase_clock import PhaseClock
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState
from reactive_realizer.planunit.point_order import overtaken
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing, timing_at
from reactive_realizer.reactive.graph import Graph


class Told(PlanUnit):
    """A unit that records its callbacks."""

    def __init__(self, **times: float | None) -> None:
        behavior = Wait(id="w", namespace=BML, name="wait", location=Location(1, 1), order=0)
        known = {sync: float(i) for i, sync in enumerate(times)}
        super().__init__(BlockKey("alice", "b"), behavior, timing_at(known))
        self.told: list[tuple[str, float]] = []
        self.graph = Graph()
        self.sources = {
            sync: AnticipatorPeg(self.graph, sync, None if time is None else GlobalTime(time))
            for sync, time in times.items()
        }
        self.points = [SyncPoint(sync, OffsetPeg(self.graph, sync, peg, 0.0)) for sync, peg in self.sources.items()]
        self.release()

    def on_start(self, time: GlobalTime) -> None:
        self.told.append(("begins", time))

    def on_sync(self, sync: str, time: GlobalTime) -> None:
        self.told.append((sync, time))

    def on_finish(self, time: GlobalTime) -> None:
        self.told.append(("finished", time))

    def move(self, sync: str, time: float) -> None:
        with self.graph.transaction("move"):
            self.sources[sync].set(GlobalTime(time))
            self.keep_order()

    def fired(self, now: float) -> list[tuple[str, float]]:
        due = self.due_points(GlobalTime(now))
        self.fire(due, GlobalTime(now))
        with self.graph.transaction("reached"):
            for point, time in due:
                point.peg.pin(time)
        return [(point.id, time) for point, time in due]

    def cut(self, now: float) -> list[tuple[str, float | None]]:
        with self.graph.transaction("interrupt"):
            return [(point.id, point.peg.value) for point in self.interrupt(GlobalTime(now))]


def test_a_unit_begins_when_its_block_plays_and_its_start_is_due() -> None:
    unit = Told(start=1.0, end=2.0)
    unit.state = UnitState.PENDING
    assert not unit.due(GlobalTime(1.0))
    unit.release()
    assert not unit.due(GlobalTime(0.99))
    assert unit.due(GlobalTime(1.0))


def test_points_fire_with_the_time_of_their_peg_and_only_once() -> None:
    unit = Told(start=1.0, stroke=1.234, end=2.0)
    unit.begin()
    assert unit.fired(1.24) == [("start", 1.0), ("stroke", 1.234)]
    assert unit.fired(1.25) == []
    assert unit.fired(9.0) == [("end", 2.0)]
    assert unit.told == [("begins", 1.0), ("start", 1.0), ("stroke", 1.234), ("end", 2.0), ("finished", 2.0)]
    assert unit.state is UnitState.DONE


def test_a_point_that_its_successor_overtakes_moves_and_fires_with_it() -> None:
    unit = Told(start=1.0, stroke=2.0, end=5.0)
    unit.begin()
    unit.fired(1.0)
    unit.move("end", 1.5)
    assert (unit.time("stroke"), unit.time("end")) == (1.5, 1.5)
    unit.move("end", 1.75)
    assert unit.fired(1.8) == [("stroke", 1.75), ("end", 1.75)]


def test_a_point_that_was_overtaken_returns_when_its_successor_is_late_again() -> None:
    unit = Told(start=1.0, stroke=2.0, relax=3.0, end=5.0)
    unit.move("end", 1.5)
    unit.move("end", 4.0)
    assert [unit.time(sync) for sync in ("stroke", "relax", "end")] == [2.0, 3.0, 4.0]


def test_no_time_is_kept_between_points_that_share_a_peg() -> None:
    unit = Told(start=1.0, stroke=2.0, end=3.0)
    unit.points[2].peg = unit.points[1].peg
    unit.shortest = [0.5, 0.5]
    unit.fired(1.0)
    unit.move("stroke", 1.8)
    assert (unit.time("stroke"), unit.time("end")) == (1.8, 1.8)


def test_a_point_is_overtaken_by_one_that_depends_on_it_too() -> None:
    unit = Told(start=1.0, stroke=2.0, end=9.0)
    limit = AnticipatorPeg(unit.graph, "limit", GlobalTime(8.0))
    natural = OffsetPeg(unit.graph, "natural", unit.point("stroke").peg, 1.0)
    unit.point("end").peg = BeforePeg(unit.graph, "end", natural, [(limit, 0.0)])
    unit.point("end").tied = True
    unit.sources["limit"] = limit
    unit.move("limit", 1.5)
    assert (unit.time("stroke"), unit.time("end")) == (1.5, 1.5)


def test_an_unknown_point_waits_unless_its_successor_is_due() -> None:
    unit = Told(start=1.0, stroke=None, end=3.0)
    unit.begin()
    assert unit.fired(2.0) == [("start", 1.0)]
    assert unit.fired(3.0) == [("stroke", 3.0), ("end", 3.0)]


def test_an_interrupted_unit_reports_only_relax_and_end() -> None:
    unit = Told(start=0.0, ready=1.0, stroke=2.0, relax=3.0, end=4.0)
    unit.begin()
    unit.fired(1.5)
    assert unit.cut(1.5) == [("relax", 1.5), ("end", 1.5)]
    assert unit.told[-1] == ("finished", 1.5)
    assert [point.id for point in unit.points] == ["start", "ready", "relax", "end"]


def test_a_unit_interrupted_after_its_relax_reports_only_its_end() -> None:
    unit = Told(start=0.0, relax=3.0, end=4.0)
    unit.begin()
    unit.fired(3.5)
    assert unit.cut(3.6) == [("end", 3.6)]


def test_a_unit_is_finished_when_it_is_dropped_only_if_it_plays() -> None:
    playing, waiting = Told(start=0.0, end=4.0), Told(start=0.0, end=4.0)
    playing.begin()
    playing.drop(GlobalTime(1.0))
    waiting.drop(GlobalTime(1.0))
    assert playing.told == [("finished", 1.0)]
    assert waiting.told == []
    assert not playing.live


def test_a_unit_is_dropped_even_if_on_finish_raises() -> None:
    class Failing(Told):
        def on_finish(self, time: GlobalTime) -> None:
            raise ZeroDivisionError

    unit = Failing(start=0.0, end=4.0)
    unit.begin()
    unit.drop(GlobalTime(1.0))
    assert unit.state is UnitState.DROPPED


def test_order_is_checked_among_known_times() -> None:
    assert overtaken(Told(start=0.0, stroke=None, end=1.0).points) is None
    assert overtaken(Told(start=2.0, stroke=None, end=1.0).points) == (("start", 2.0), ("end", 1.0))


def test_an_unknown_point_of_a_unit_is_a_key_error() -> None:
    with pytest.raises(KeyError):
        Told(start=0.0, end=1.0).time("stroke")


def test_a_timing_knows_its_offsets_and_whether_it_can_be_stretched() -> None:
    timing = timing_at({"start": 0.0, "mark": 0.4, "end": 1.5}, PhaseKind.RIGID)
    assert timing.offsets == (0.0, 0.4, 1.5)
    assert timing.rigid
    assert not Timing(("start", "stroke", "end"), (Phase(1.0, PhaseKind.RIGID), Phase(1.0))).rigid
    with pytest.raises(ValueError, match="2 points need 1 phases"):
        Timing(("start", "end"), ())


def phases(unit: Told, clock: PhaseClock, *times: float) -> object:
    return pytest.approx([clock.advance(unit, GlobalTime(time)) for time in times])


def test_the_phase_walks_evenly_from_key_to_key() -> None:
    unit = Told(start=0.0, stroke=1.0, end=3.0)
    clock = PhaseClock({"start": 0.0, "stroke": 0.5, "end": 1.0})
    unit.begin()
    assert phases(unit, clock, 0.0, 0.5, 1.0, 2.0, 3.0, 4.0) == [0.0, 0.25, 0.5, 0.75, 1.0, 1.0]


@pytest.mark.parametrize("moved", [1.2, 0.8, 5.0])
def test_a_key_that_moves_changes_the_rate_smoothly_and_never_the_phase(moved: float) -> None:
    unit = Told(start=0.0, stroke=1.0, end=9.0)
    clock = PhaseClock({"start": 0.0, "stroke": 0.5, "end": 1.0})
    unit.begin()
    assert clock.advance(unit, GlobalTime(0.5)) == pytest.approx(0.25)
    unit.move("stroke", moved)
    times = np.arange(0.5, moved, 0.01)
    way = [clock.advance(unit, GlobalTime(time)) for time in times]
    assert way[0] == pytest.approx(0.25)
    assert way[1] - way[0] == pytest.approx(0.005, rel=0.25)
    assert way == sorted(way)
    assert clock.advance(unit, GlobalTime(moved)) == pytest.approx(0.5)
    assert 0.5 - way[-1] < 0.03


def test_the_phase_stands_still_while_the_next_key_is_unknown() -> None:
    unit = Told(start=0.0, stroke=None, end=None)
    clock = PhaseClock({"start": 0.0, "stroke": 0.5, "end": 1.0})
    unit.begin()
    assert phases(unit, clock, 0.0, 1.0) == [0.0, 0.0]
    unit.move("stroke", 2.0)
    assert phases(unit, clock, 1.5, 2.0) == [0.25, 0.5]


def test_the_phase_does_not_pass_an_unknown_stroke_on_its_way_to_a_known_end() -> None:
    unit = Told(start=0.0, ready=None, stroke=None, end=2.0)
    clock = PhaseClock({"start": 0.0, "ready": 0.2, "stroke": 0.4, "end": 1.0})
    unit.begin()
    assert phases(unit, clock, 0.5, 1.0, 1.5) == [0.1, 0.2, 0.3]
    unit.move("stroke", 1.75)
    assert phases(unit, clock, 1.75, 2.0) == [0.4, 1.0]


def test_the_phase_passes_an_unknown_ready_on_its_way_to_a_known_stroke() -> None:
    unit = Told(start=0.0, ready=None, stroke=1.0, end=2.0)
    clock = PhaseClock({"start": 0.0, "ready": 0.2, "stroke": 0.4, "end": 1.0})
    unit.begin()
    assert phases(unit, clock, 0.5, 0.75, 1.0) == [0.2, 0.3, 0.4]


def test_a_unit_that_joins_late_is_at_the_phase_of_now() -> None:
    unit = Told(start=0.0, end=4.0)
    clock = PhaseClock({"start": 0.0, "end": 1.0})
    unit.begin()
    assert phases(unit, clock, 3.0, 3.5) == [0.75, 0.875]
