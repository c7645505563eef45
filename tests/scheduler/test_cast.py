"""Who plays: an engine is woken when it has something to play, and once more when something was taken from it."""

from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import AnticipatorPeg
from reactive_realizer.planunit.plan_unit import PlanUnit, SyncPoint
from reactive_realizer.planunit.timing import timing_at
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.scheduler.cast import Cast


def unit():
    behavior = Wait(id="w", namespace=BML, name="wait", location=Location(1, 1), order=0)
    return PlanUnit(BlockKey("alice", "b"), behavior, timing_at({"start": 0.0, "end": 1.0}))


def awake(cast):
    return [engine.name for engine in cast.engines if cast.awake(engine)]


def test_an_engine_is_awake_while_it_has_units_and_once_after_it_lost_one() -> None:
    one, two = DefaultEngine("one"), DefaultEngine("two")
    cast = Cast({"alice": [one, two]})
    assert awake(cast) == ["one", "two"]  # nobody knows what they begin with
    assert awake(cast) == []
    first, second = unit(), unit()
    cast.give(first, two)
    cast.give(second, two)
    assert awake(cast) == awake(cast) == ["two"]
    cast.take(first)
    cast.take(second)
    cast.take(second)
    assert awake(cast) == ["two"]
    assert awake(cast) == []


def test_who_has_played_in_a_tick_is_called_again_for_what_has_become_due() -> None:
    one = DefaultEngine("one")
    cast = Cast({"alice": [one]})
    assert awake(cast) == ["one"]
    playing, graph = unit(), Graph()
    playing.points = [
        SyncPoint("start", AnticipatorPeg(graph, "start", 1.0)),
        SyncPoint("end", AnticipatorPeg(graph, "end", None)),
    ]
    cast.give(playing, one)
    assert [cast.called(one, now) for now in (0.9, 1.0, 1.1)] == [False, True, True]
    playing.points[0].fired = 1.0
    assert not cast.called(one, 1.1)
    cast.take(playing)
    assert [cast.called(one, 1.1), cast.called(one, 1.1)] == [True, False]


def test_engines_that_are_reset_wake() -> None:
    alice, bob = DefaultEngine("alice"), DefaultEngine("bob")
    cast = Cast({"alice": [alice], "bob": [bob]})
    assert awake(cast) == ["alice", "bob"]
    cast.reset("bob", 1.0)
    assert awake(cast) == ["bob"]
