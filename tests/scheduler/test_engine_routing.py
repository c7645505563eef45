"""Engine routing: an engine plays while it has units, and once more after it lost one."""

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, LatestPeg, OffsetPeg
from reactive_realizer.planunit.plan_unit import PlanUnit, SyncPoint
from reactive_realizer.planunit.timing import timing_at
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.scheduler.engine_routing import EngineRouting


class IdleEngine(DefaultEngine):
    """Plays units that were made elsewhere."""

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        raise NotImplementedError


def unit() -> PlanUnit:
    behavior = Wait(id="w", namespace=BML, name="wait", location=Location(1, 1), order=0)
    return PlanUnit(BlockKey("alice", "b"), behavior, timing_at({"start": 0.0, "end": 1.0}))


class WaitEngine(IdleEngine):
    """Plays waits."""

    behaviors = frozenset({Wait})


def active(routing: EngineRouting) -> list[str]:
    return [engine.name for engine in routing.engines if routing.take_active(engine)]


def test_an_engine_is_active_while_it_has_units_and_once_after_it_lost_one() -> None:
    one, two = IdleEngine("one"), WaitEngine("two")
    routing = EngineRouting({"alice": [one, two]})
    assert active(routing) == ["one", "two"]  # each plays once at the beginning
    assert active(routing) == []
    first, second = unit(), unit()
    routing.assign(first)
    routing.assign(second)
    assert active(routing) == active(routing) == ["two"]
    routing.unassign(first)
    routing.unassign(second)
    routing.unassign(second)
    assert active(routing) == ["two"]
    assert active(routing) == []


def test_an_engine_that_has_played_in_a_tick_plays_again_when_a_point_has_become_due() -> None:
    one = WaitEngine("one")
    routing = EngineRouting({"alice": [one]})
    assert active(routing) == ["one"]
    playing, graph = unit(), Graph()
    playing.points = [
        SyncPoint("start", LatestPeg(graph, "start", GlobalTime(1.0), ())),
        SyncPoint("end", OffsetPeg(graph, "end", AnticipatorPeg(graph, "unknown", None), 0.0)),
    ]
    routing.assign(playing)
    assert [routing.take_due(one, GlobalTime(now)) for now in (0.9, 1.0, 1.1)] == [False, True, True]
    playing.points[0].fired = True
    assert not routing.take_due(one, GlobalTime(1.1))
    routing.unassign(playing)
    assert [routing.take_due(one, GlobalTime(1.1)), routing.take_due(one, GlobalTime(1.1))] == [True, False]


def test_engines_that_are_reset_are_active() -> None:
    alice, bob = IdleEngine("alice"), IdleEngine("bob")
    routing = EngineRouting({"alice": [alice], "bob": [bob]})
    assert active(routing) == ["alice", "bob"]
    routing.reset("bob", GlobalTime(1.0))
    assert active(routing) == ["bob"]
