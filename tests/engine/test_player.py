"""Start of units: a resource is taken over only from a unit that retracts."""

import weakref

import pytest

from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.clock.ticker import RATE, Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.effects import EndUnit
from reactive_realizer.engine.player import Player
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.planunit.timing import timing_at
from reactive_realizer.reactive.graph import Graph


def arm(id_: str, tied: tuple[str, ...] = (), **times: float) -> PlanUnit:
    """A unit that moves an arm, with its points at those times."""
    behavior = Wait(id=id_, namespace=BML, name="wait", location=Location(1, 1), order=0)
    unit = PlanUnit(BlockKey("alice", "b"), behavior, timing_at(times), frozenset({"arm"}))
    graph = Graph()
    pegs = {
        sync: OffsetPeg(graph, sync, AnticipatorPeg(graph, sync, GlobalTime(time)), 0.0) for sync, time in times.items()
    }
    unit.points = [SyncPoint(sync, peg, sync in tied) for sync, peg in pegs.items()]
    unit.release()
    return unit


@pytest.fixture
def player() -> Player:
    return Player()


def play(player: Player, now: float) -> list[str]:
    tick = Tick(round(now * RATE), GlobalTime(now - 0.3))
    return [f"{each.unit.behavior.id}:{each.point.id}" for each in player.play(tick)]


def interrupt(unit: PlanUnit, time: float) -> None:
    with unit.points[0].peg.graph.transaction("interrupt"):
        unit.interrupt(GlobalTime(time))


def test_a_unit_past_its_relax_ends_when_the_next_begins_one_round_later(player: Player) -> None:
    first, second = arm("first", start=0.0, relax=1.0, end=2.0), arm("second", start=1.25, end=3.0)
    player.add(first)
    player.add(second)
    play(player, 1.0)
    assert play(player, 1.3) == []
    assert player.take_ending() == (EndUnit(first, GlobalTime(1.25)),)
    assert player.take_ending() == ()
    interrupt(first, 1.25)
    assert play(player, 1.3) == ["second:start"]
    assert player.take_dropped() == ()


def test_the_relax_and_the_next_start_may_be_due_in_one_tick(player: Player) -> None:
    first, second = arm("first", start=0.0, relax=1.001, end=2.0), arm("second", start=1.004, end=3.0)
    player.add(first)
    player.add(second)
    play(player, 0.0)
    assert play(player, 1.01) == ["first:relax"]
    assert player.take_ending() == (EndUnit(first, GlobalTime(1.004)),)


@pytest.mark.parametrize(
    "first",
    [
        arm("first", start=0.0, relax=1.5, end=2.0),
        arm("first", ("end",), start=0.0, relax=1.0, end=2.0),
        arm("first", start=0.0, end=2.0),
    ],
    ids=["it is not that far", "BML says when it ends", "it has no way back"],
)
def test_a_unit_before_its_relax_keeps_its_resource(player: Player, first: PlanUnit) -> None:
    second = arm("second", start=1.25, end=3.0)
    player.add(first)
    player.add(second)
    play(player, 1.0)
    play(player, 1.3)
    assert [(each.unit, each.fault.code) for each in player.take_dropped()] == [(second, "resource-taken")]
    assert player.take_ending() == ()
    assert first.live


def test_a_relax_that_comes_after_the_start_of_the_next_within_a_tick_is_too_late(player: Player) -> None:
    first, second = arm("first", start=0.0, relax=1.004, end=2.0), arm("second", start=1.001, end=3.0)
    player.add(first)
    player.add(second)
    play(player, 0.0)
    play(player, 1.01)
    assert [each.unit for each in player.take_dropped()] == [second]


@pytest.mark.parametrize("interrupted", [None, 1.25])
def test_a_unit_that_ended_in_a_late_tick_still_had_its_resource_before(
    player: Player, interrupted: float | None
) -> None:
    first, second = arm("first", start=0.0, end=1.25), arm("second", start=1.2, end=3.0)
    player.add(first)
    play(player, 1.0)
    if interrupted is not None:
        interrupt(first, interrupted)
        player.remove(first)
    play(player, 1.3)
    player.add(second)  # in a later round
    play(player, 1.3)
    assert [(each.unit, each.fault.code) for each in player.take_dropped()] == [(second, "resource-taken")]


def test_a_resource_given_away_before_the_end_is_free(player: Player) -> None:
    first, second = arm("first", start=0.0, relax=1.0, end=1.25), arm("second", start=1.2, end=3.0)
    player.add(first)
    player.add(second)
    play(player, 0.9)
    assert play(player, 1.3) == ["first:relax", "first:end", "second:start"]


def test_a_unit_that_ended_before_the_last_tick_is_forgotten(player: Player) -> None:
    unit = arm("first", start=0.0, end=1.0)
    forgotten = weakref.ref(unit)
    player.add(unit)
    for now in (1.0, 1.3, 1.6):
        play(player, now)
    del unit
    assert forgotten() is None


def test_a_unit_that_joins_late_competes_with_those_that_play_now(player: Player) -> None:
    first, second = arm("first", start=0.0, end=1.25), arm("second", start=0.5, relax=1.3, end=3.0)
    third = arm("third", start=0.9, end=3.0)
    player.add(first)
    play(player, 1.0)
    play(player, 1.3)
    player.add(second)
    assert play(player, 1.3) == ["second:start", "second:relax"]
    player.add(third)
    assert play(player, 1.3) == []
    assert player.take_ending() == (EndUnit(second, GlobalTime(1.3)),)
