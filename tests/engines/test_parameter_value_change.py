"""A parameter value change between pegs that may move, and the built-in trajectories."""

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.assembly.registry import load, names
from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.bml.extensions import ParameterValueChange, Trajectory
from reactive_realizer.bml.names import BMLA, BMLT, Location
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.effects import EndUnit, FollowCell, SetParameter
from reactive_realizer.engines.parameter_value_change import ParameterValueChangeUnit, ease_in_ease_out, instant, linear
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg
from reactive_realizer.planunit.parameter import Parameter, Range
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.planunit.timing import timing_at
from reactive_realizer.reactive.cell import Source
from reactive_realizer.reactive.graph import Graph

BLOCK = BlockKey("alice", "b")
PLACE = Location(1, 1)


class Bench:
    """A change from 0 s to 1 s, and its parameter, whose range is 0 to 100 and whose value is 40."""

    def __init__(
        self,
        trajectory: Callable[[float], float] = linear,
        target: float = 80.0,
        initial: float | None = None,
        namespace: str = BMLA,
    ) -> None:
        self.graph = Graph()
        said = Trajectory(type="any", target_value=target, initial_value=initial)
        change = ParameterValueChange(
            id="p",
            namespace=namespace,
            name="parametervaluechange",
            location=PLACE,
            order=0,
            target="b:s",
            parameter="volume",
            trajectory=said,
        )
        self.requested: list[object] = []
        self.carried_out = 0
        self.time = Source(self.graph, "time", GlobalTime(0.0))
        self.unit = ParameterValueChangeUnit(BLOCK, change, trajectory, self.time, self.requested.append)
        self.times = {
            sync: AnticipatorPeg(self.graph, sync, GlobalTime(float(sync != "start")))
            for sync in self.unit.timing.points
        }
        self.unit.points = [SyncPoint(s, OffsetPeg(self.graph, s, peg, 0.0)) for s, peg in self.times.items()]
        self.unit.release()
        wait = Wait(id="s", namespace=BMLA, name="wait", location=PLACE, order=0)
        self.target = PlanUnit(BLOCK, wait, timing_at({"start": 0.0, "end": 9.0}))
        self.target.points = [
            SyncPoint("end", OffsetPeg(self.graph, "e", AnticipatorPeg(self.graph, "e", GlobalTime(9.0)), 0.0))
        ]
        self.parameter = Parameter(self.graph, "volume", 40.0, Range(0.0, 100.0))

    def bind(self) -> None:
        self.unit.bind(self.target, self.parameter)

    def play(self, *times: float) -> list[float]:
        """The values of the parameter at some times."""
        return [self._play(time) for time in times]

    def _play(self, time: float) -> float:
        with self.graph.transaction("time"):
            self.time.set(GlobalTime(time))
        if self.unit.due(GlobalTime(time)):
            self.unit.begin()
        if self.unit.state is UnitState.IN_EXEC:
            self.unit.fire(self.unit.due_points(GlobalTime(time)), GlobalTime(time))
            self.unit.check(GlobalTime(time))
        for each in self.requested[self.carried_out :]:
            if isinstance(each, SetParameter):
                self.parameter.set(each.value)
            elif isinstance(each, FollowCell):
                self.parameter.follow(each.cell)
        self.carried_out = len(self.requested)
        return self.parameter.value

    def move(self, sync: str, time: float | None) -> None:
        with self.graph.transaction("move"):
            self.times[sync].set(None if time is None else GlobalTime(time))


def test_a_change_starts_only_once_its_parameter_is_bound() -> None:
    bench = Bench()
    assert not bench.unit.wants_parameter(GlobalTime(-0.01))
    assert bench.unit.wants_parameter(GlobalTime(0.0))
    assert not bench.unit.due(GlobalTime(0.0))
    bench.bind()
    assert not bench.unit.wants_parameter(GlobalTime(0.0))
    assert bench.unit.due(GlobalTime(0.0))


def test_a_change_goes_from_the_present_value_to_exactly_the_target_value() -> None:
    bench = Bench(target=0.1 + 0.2)
    bench.bind()
    assert bench.play(0.0, 0.5) == pytest.approx([40.0, 20.15])
    assert bench.play(1.0) == [0.1 + 0.2]
    assert not bench.unit.live


def test_a_change_with_an_initial_value_starts_there() -> None:
    bench = Bench(initial=0.0)
    bench.bind()
    assert bench.play(0.0, 0.25, 1.0) == pytest.approx([0.0, 20.0, 80.0])


def test_moving_the_end_changes_the_speed_from_now_on_but_not_the_present_value() -> None:
    bench = Bench()
    bench.bind()
    assert bench.play(0.0, 0.5) == pytest.approx([40.0, 60.0])
    bench.move("end", 2.5)
    assert bench.play(0.5, 1.5, 2.0, 2.5) == pytest.approx([60.0, 70.0, 75.0, 80.0])


def test_the_value_stays_while_the_end_is_unknown() -> None:
    bench = Bench()
    bench.bind()
    bench.play(0.0, 0.5)
    bench.move("end", None)
    assert bench.play(0.75, 9.0) == pytest.approx([60.0, 60.0])


@pytest.mark.parametrize("trajectory", [instant, linear, ease_in_ease_out])
def test_a_late_tick_sets_the_target_value(trajectory: Callable[[float], float]) -> None:
    bench = Bench(trajectory)
    bench.bind()
    assert bench.play(3.0) == [80.0]
    assert not bench.unit.live


def test_the_target_value_is_reached_at_a_stroke_before_the_end() -> None:
    bench = Bench(namespace=BMLT)
    bench.move("stroke", 0.5)
    bench.bind()
    assert bench.play(0.0, 0.25, 0.5, 0.75, 1.0) == pytest.approx([40.0, 60.0, 80.0, 80.0, 80.0])


@pytest.mark.parametrize(
    ("ended", "told"), [(0.6, 0.6), (-0.1, 0.0)], ids=["during the change", "just before the change"]
)
def test_a_change_requests_its_end_when_its_target_has_ended(ended: float, told: float) -> None:
    bench = Bench()
    bench.bind()
    bench.play(0.0)
    with bench.graph.transaction("end"):
        bench.target.points[-1].peg.pin(GlobalTime(ended))
    bench.target.points[-1].fired = True
    bench.target.state = UnitState.DONE
    bench.play(0.61)
    assert bench.requested[-1] == EndUnit(bench.unit, GlobalTime(told))


def test_a_change_ends_now_when_its_target_was_dropped() -> None:
    bench = Bench()
    bench.bind()
    bench.play(0.0)
    bench.target.state = UnitState.DROPPED
    bench.play(0.61)
    assert bench.requested[-1] == EndUnit(bench.unit, GlobalTime(0.61))


@pytest.mark.parametrize("value", [100.1, -0.1, float("nan"), float("inf"), -float("inf")])
def test_a_value_outside_the_range_is_refused(value: float) -> None:
    for bench in (Bench(target=value), Bench(initial=value)):
        with pytest.raises(RealizerError, match="volume of 's' must be between 0 and 100"):
            bench.bind()


def test_the_value_of_a_trajectory_that_overshoots_stays_in_the_range() -> None:
    bench = Bench(lambda share: 3.0 * share, target=100.0)
    bench.bind()
    assert bench.play(0.5) == [100.0]


def test_the_sync_points_and_the_preferred_duration_follow_from_namespace_and_trajectory() -> None:
    assert Bench().unit.timing.points == ("start", "end")
    assert Bench(namespace=BMLT).unit.timing.points == ("start", "stroke", "end")
    assert Bench().unit.timing.offsets == (0.0, 0.5)
    assert Bench(namespace=BMLT).unit.timing.offsets == (0.0, 0.5, 0.5)
    assert Bench().unit.timing.free
    assert not Bench().unit.timing.instant
    at_once = Bench(instant).unit.timing
    assert at_once.instant
    assert at_once.offsets == (0.0, 0.0)


# --- trajectories

BUILT_IN = ["ease-in-ease-out", "instant", "linear"]


def test_the_built_in_trajectories_are_entry_points() -> None:
    assert names("trajectories") == BUILT_IN


def test_every_trajectory_ends_at_1() -> None:
    assert {name: load("trajectories", name)(1.0) for name in BUILT_IN} == dict.fromkeys(BUILT_IN, 1.0)


@pytest.mark.parametrize("name", BUILT_IN)
@given(early=st.floats(0, 1), late=st.floats(0, 1))
def test_every_trajectory_is_monotonic_and_stays_between_0_and_1(name: str, early: float, late: float) -> None:
    trajectory = load("trajectories", name)
    early, late = sorted((early, late))
    assert 0.0 <= trajectory(early) <= trajectory(late) + 1e-15 <= 1.0 + 1e-15


def test_instant_starts_at_1_and_the_others_start_at_0() -> None:
    assert {name: load("trajectories", name)(0.0) for name in BUILT_IN} == dict(zip(BUILT_IN, (0, 1, 0), strict=True))


def test_easing_is_slow_at_both_ends_and_symmetric() -> None:
    ease = load("trajectories", "ease-in-ease-out")
    assert ease(0.01) < 0.001
    assert ease(0.5) == 0.5
    assert 1.0 - ease(0.99) < 0.001
    assert ease(0.3) + ease(0.7) == pytest.approx(1.0)
