"""A change of a parameter between pegs that may move."""

import pytest

from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.bml.continuous import ParameterValueChange, Trajectory
from reactive_realizer.bml.names import BMLA, BMLT, Location
from reactive_realizer.engine.effects import EndUnit, SetParameter
from reactive_realizer.engines.parameter_value_change.parameter_value_change_unit import ParameterValueChangeUnit
from reactive_realizer.engines.parameter_value_change.trajectories import ease_in_ease_out, instant, linear
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg
from reactive_realizer.planunit.parameter import Parameter, Range
from reactive_realizer.planunit.plan_unit import PlanUnit, SyncPoint, UnitState
from reactive_realizer.planunit.timing import timing_at
from reactive_realizer.reactive.cell import Source
from reactive_realizer.reactive.graph import Graph

BLOCK = BlockKey("alice", "b")
PLACE = {"location": Location(1, 1), "order": 0}


class Stand:
    """A change from 0 s to 1 s, and the parameter it asks for, from 0 to 100 and now 40."""

    def __init__(self, trajectory=linear, target=80.0, initial=None, namespace=BMLA, **syncs) -> None:
        self.graph = Graph()
        said = Trajectory(type="any", target_value=target, initial_value=initial)
        names = {"id": "p", "namespace": namespace, "name": "parametervaluechange", "syncs": syncs}
        change = ParameterValueChange(target="b:s", parameter="volume", trajectory=said, **names, **PLACE)
        self.asked: list[object] = []
        self.unit = ParameterValueChangeUnit(BLOCK, change, trajectory, self.asked.append)
        self.times = {
            sync: AnticipatorPeg(self.graph, sync, float(sync != "start")) for sync in self.unit.timing.points
        }
        self.unit.points = [SyncPoint(s, OffsetPeg(self.graph, s, peg, 0.0)) for s, peg in self.times.items()]
        self.unit.release()
        wait = Wait(id="s", namespace=BMLA, name="wait", **PLACE)
        self.target = PlanUnit(BLOCK, wait, timing_at({"start": 0.0, "end": 9.0}))
        self.target.points = [SyncPoint("end", OffsetPeg(self.graph, "e", AnticipatorPeg(self.graph, "e", 9.0), 0.0))]
        self.parameter = Parameter(self.target, Source(self.graph, "volume", 40.0), Range(0.0, 100.0))

    def bind(self):
        self.unit.bind(self.parameter)

    def play(self, *times):
        """The values at some times."""
        return [self._play(time) for time in times]

    def _play(self, time):
        if self.unit.due(time):
            self.unit.begin()
        if self.unit.state is UnitState.IN_EXEC:
            self.unit.fire(time)
            self.unit.follow(time)
        for each in self.asked:
            if isinstance(each, SetParameter):
                self.parameter.set(each.value)
        return self.parameter.value

    def move(self, sync, time):
        with self.graph.transaction("move"):
            self.times[sync].set(time)


def test_it_waits_for_its_parameter() -> None:
    stand = Stand()
    assert not stand.unit.wants_parameter(-0.01)
    assert stand.unit.wants_parameter(0.0)
    assert not stand.unit.due(0.0)
    stand.bind()
    assert not stand.unit.wants_parameter(0.0)
    assert stand.unit.due(0.0)


def test_it_goes_from_the_value_that_is_there_to_its_target_and_reaches_that_exactly() -> None:
    stand = Stand(target=0.1 + 0.2)
    stand.bind()
    assert stand.play(0.0, 0.5) == pytest.approx([40.0, 20.15])
    assert stand.play(1.0) == [0.1 + 0.2]
    assert not stand.unit.live


def test_it_begins_at_its_initial_value_if_it_has_one() -> None:
    stand = Stand(initial=0.0)
    stand.bind()
    assert stand.play(0.0, 0.25, 1.0) == pytest.approx([0.0, 20.0, 80.0])


def test_an_end_that_moves_changes_the_pace_from_here_and_not_the_value_that_is_reached() -> None:
    stand = Stand()
    stand.bind()
    assert stand.play(0.0, 0.5) == pytest.approx([40.0, 60.0])
    stand.move("end", 2.5)
    assert stand.play(0.5, 1.5, 2.0, 2.5) == pytest.approx([60.0, 70.0, 75.0, 80.0])


def test_it_waits_at_its_value_while_its_end_is_unknown() -> None:
    stand = Stand()
    stand.bind()
    stand.play(0.0, 0.5)
    stand.move("end", None)
    assert stand.play(0.75, 9.0) == pytest.approx([60.0, 60.0])


@pytest.mark.parametrize("trajectory", [instant, linear, ease_in_ease_out])
def test_a_tick_that_comes_after_its_end_finds_the_target(trajectory) -> None:
    stand = Stand(trajectory)
    stand.bind()
    assert stand.play(3.0) == [80.0]
    assert not stand.unit.live


def test_with_a_stroke_before_its_end_the_value_is_reached_there_and_stays() -> None:
    stand = Stand(namespace=BMLT)
    stand.move("stroke", 0.5)
    stand.bind()
    assert stand.play(0.0, 0.25, 0.5, 0.75, 1.0) == pytest.approx([40.0, 60.0, 80.0, 80.0, 80.0])


@pytest.mark.parametrize(
    ("ended", "told"), [(0.6, 0.6), (-0.1, 0.0)], ids=["while it goes on", "just before its start"]
)
def test_when_its_target_has_ended_it_asks_for_its_own_end(ended, told) -> None:
    stand = Stand()
    stand.bind()
    stand.play(0.0)
    stand.target.points[-1].fired = ended
    stand.target.state = UnitState.DONE
    stand.play(0.61)
    assert stand.asked[-1] == EndUnit(stand.unit, told)


def test_when_its_target_was_dropped_it_ends_now() -> None:
    stand = Stand()
    stand.bind()
    stand.play(0.0)
    stand.target.state = UnitState.DROPPED
    stand.play(0.61)
    assert stand.asked[-1] == EndUnit(stand.unit, 0.61)


@pytest.mark.parametrize("value", [100.1, -0.1, float("nan"), float("inf"), -float("inf")])
def test_a_value_out_of_range_is_refused(value) -> None:
    for stand in (Stand(target=value), Stand(initial=value)):
        with pytest.raises(RealizerError, match="volume of 's' is from 0 to 100"):
            stand.bind()


def test_a_trajectory_that_overshoots_stays_within_the_range() -> None:
    stand = Stand(lambda share: 3.0 * share, target=100.0)
    stand.bind()
    assert stand.play(0.5) == [100.0]


def test_its_points_and_its_preference_are_those_of_the_form_in_which_it_is_written() -> None:
    assert Stand().unit.timing.points == ("start", "end")
    assert Stand(namespace=BMLT).unit.timing.points == ("start", "stroke", "end")
    assert Stand().unit.timing.offsets == (0.0, 0.5)
    assert Stand(namespace=BMLT).unit.timing.offsets == (0.0, 0.5, 0.5)
    assert Stand().unit.timing.free
    assert not Stand().unit.timing.instant
    at_once = Stand(instant).unit.timing
    assert at_once.instant
    assert at_once.offsets == (0.0, 0.0)
