"""Engines sleep until something is due, their effects have a fixed order, and failures are isolated."""

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable

import pytest

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange
from reactive_realizer.engine.effects import Play
from reactive_realizer.engine.engine import DefaultEngine, Engine
from reactive_realizer.engine.engine_task import EngineTasks
from reactive_realizer.engine.guarded_engine import GuardedEngine
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.planunit.timing import timing_at
from reactive_realizer.reactive.graph import Graph


def unit(name: str, start: float, end: float, *resources: str) -> PlanUnit:
    behavior = Wait(id=name, namespace=BML, name="wait", location=Location(1, 1), order=0)
    made = PlanUnit(BlockKey("alice", "b"), behavior, timing_at({"start": 0.0, "end": 1.0}), frozenset(resources))
    graph = Graph()
    times = {"start": start, "end": end}
    made.points = [
        SyncPoint(sync, OffsetPeg(graph, sync, AnticipatorPeg(graph, sync, GlobalTime(times[sync])), 0.0))
        for sync in times
    ]
    made.release()
    return made


class FinishedUnits(DefaultEngine):
    """Plays units that were made elsewhere."""

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        raise AssertionError("its units are made elsewhere")


PlayEngines = Callable[..., Awaitable[list[Play]]]


def engine(name: str, *units: PlanUnit) -> FinishedUnits:
    made = FinishedUnits(name)
    for each in units:
        made.add(each)
    return made


@pytest.fixture
async def play() -> AsyncIterator[PlayEngines]:
    running: list[asyncio.Future[None]] = []

    async def play_engines(number: int, *engines: Engine) -> list[Play]:
        tasks = EngineTasks(map(GuardedEngine, engines))
        running.extend(asyncio.ensure_future(task.run()) for task in tasks.tasks)
        return await tasks.play(Tick(number, GlobalTime(0.0)))

    yield play_engines
    for task in running:
        task.cancel()


def reached(play: Play) -> list[tuple[str, str, float]]:
    return [(each.unit.behavior.id, each.point.id, each.time) for each in play.reached]


def dropped(play: Play) -> list[tuple[str, str]]:
    return [(each.unit.behavior.id, each.fault.code) for each in play.dropped]


async def test_effects_come_in_the_order_of_the_engines(play: PlayEngines) -> None:
    plays = await play(100, engine("one", unit("a", 0.0, 2.0)), engine("two", unit("b", 0.5, 0.7)))
    assert [reached(each) for each in plays] == [[("a", "start", 0.0)], [("b", "start", 0.5), ("b", "end", 0.7)]]


async def test_a_playing_unit_keeps_its_resource_and_the_newer_one_is_dropped(play: PlayEngines) -> None:
    arms = engine("arms", unit("late", 0.5, 2.0, "arm"), unit("early", 0.0, 2.0, "arm"), unit("other", 0.5, 2.0, "leg"))
    (played,) = await play(100, arms)
    assert dropped(played) == [("late", "resource-taken")]
    assert [each.behavior.id for each in arms.player.playing] == ["early", "other"]


async def test_a_unit_that_ends_frees_its_resource_for_one_that_starts_in_the_same_tick(
    play: PlayEngines,
) -> None:
    arms = engine("arms", unit("first", 0.0, 0.9, "arm"))
    await play(10, arms)
    arms.add(unit("second", 0.9, 2.0, "arm"))
    (played,) = await play(100, arms)
    assert reached(played) == [("first", "end", 0.9), ("second", "start", 0.9)]


async def test_an_engine_that_raises_drops_its_units_and_the_others_play(play: PlayEngines) -> None:
    class Broken(FinishedUnits):
        def play(self, tick: Tick) -> Play:
            raise ZeroDivisionError

    broken = Broken("alice/broken")
    broken.add(unit("a", 0.0, 2.0))
    broken.add(unit("b", 5.0, 6.0))
    first, second = await play(100, broken, engine("fine", unit("c", 0.0, 2.0)))
    assert dropped(first) == [("a", "engine-failed"), ("b", "engine-failed")]
    assert broken.player.units == ()
    assert reached(second) == [("c", "start", 0.0)]


async def test_an_engine_that_fails_after_firing_reports_the_points_reached(play: PlayEngines) -> None:
    class Broken(FinishedUnits):
        def audio(self, tick: Tick) -> tuple[AudioChange, ...]:
            raise ZeroDivisionError

    arms = Broken("alice/broken")
    for each in (unit("a", 0.0, 2.0, "arm"), unit("b", 0.0, 2.0, "arm"), unit("c", 0.0, 0.5)):
        arms.add(each)
    (played,) = await play(100, arms)
    assert reached(played) == [("a", "start", 0.0), ("c", "start", 0.0), ("c", "end", 0.5)]
    assert dropped(played) == [("b", "resource-taken"), ("a", "engine-failed")]
    assert arms.fail(GlobalTime(1.0), played.dropped[0].fault) == Play()


async def test_engines_go_on_after_a_cancelled_round() -> None:
    one, two = engine("one", unit("a", 0.0, 0.01)), engine("two", unit("b", 0.0, 0.01))
    tasks = EngineTasks([one, two])
    running = [asyncio.ensure_future(task.run()) for task in tasks.tasks]
    given_up = asyncio.ensure_future(tasks.play(Tick(0, GlobalTime(0.0))))
    await asyncio.sleep(0)
    given_up.cancel()
    await asyncio.gather(given_up, return_exceptions=True)
    assert [reached(each) for each in await tasks.play(Tick(1, GlobalTime(0.0)))] == [
        [("a", "end", 0.01)],
        [("b", "end", 0.01)],
    ]
    for task in running:
        task.cancel()


class Played(FinishedUnits):
    """Notes the ticks that it plays."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.ticks: list[int] = []

    def play(self, tick: Tick) -> Play:
        self.ticks.append(tick.number)
        return super().play(tick)


async def test_an_engine_plays_only_when_something_is_due_or_has_changed() -> None:
    waiting = Played("waiting")
    tasks = EngineTasks([waiting])
    running = [asyncio.ensure_future(task.run()) for task in tasks.tasks]

    async def play(*numbers: int) -> list[int]:
        for number in numbers:
            await tasks.play(Tick(number, GlobalTime(0.01 * (number - 1))))
        ticks, waiting.ticks = waiting.ticks, []
        return ticks

    assert await play(0, 1) == []
    made = unit("a", 1.0, 2.0)
    waiting.add(made)
    assert await play(*range(300)) == [0, 100, 200]
    one, two = unit("b", 4.0, 5.0), unit("c", 4.0, 5.0)
    waiting.add(one)
    waiting.add(two)
    assert await play(300, 301) == [300]
    with one.points[0].peg.graph.transaction("move"):
        one.points[0].peg.pin(GlobalTime(3.02))
    assert await play(301, 302, 303) == [301, 302]
    waiting.remove(two)
    assert await play(303, 304, 400) == [303]
    for task in running:
        task.cancel()
