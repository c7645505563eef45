"""A unit that fails is dropped, an engine that fails drops its units; everything else goes on."""

import asyncio
from collections.abc import AsyncGenerator, AsyncIterator
from contextlib import asynccontextmanager

import pytest

from reactive_realizer.assembly.scene import Scene, SceneOptions, open_scene
from reactive_realizer.bml.behavior import Behavior, ForeignBehavior
from reactive_realizer.clock.ticker import Tick, tick_time
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.embodiment.world import World
from reactive_realizer.engine.effects import Play
from reactive_realizer.engine.engine import DefaultEngine, Part, SlowWork
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import timing_at
from reactive_realizer.reactive.cell import Source
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.realizer.character import Character
from reactive_realizer.realizer.inputs import BmlText
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.scheduler.problem import SchedulingProblem
from reactive_realizer.scheduler.smartbody.smartbody_strategy import SmartBodyStrategy
from reactive_realizer.testing.pilot import RealizerPilot, block

TESTS = "urn:tests"


def said(behavior: Behavior, name: str) -> str | None:
    assert isinstance(behavior, ForeignBehavior)
    return behavior.attributes.get(name)


class FailingUnit(PlanUnit):
    """Fails where its behavior says."""

    def _fail_at(self, moment: str) -> None:
        if moment in (said(self.behavior, "fail") or "").split():
            raise ValueError(f"\x00{moment}")

    def on_start(self, time: GlobalTime) -> None:
        self._fail_at("on_start")

    def on_sync(self, sync: str, time: GlobalTime) -> None:
        self._fail_at(sync)

    def on_finish(self, time: GlobalTime) -> None:
        self._fail_at("on_finish")

    def details(self, sync: str, time: GlobalTime) -> dict[str, str]:
        self._fail_at(f"details-of-{sync}")
        return {}


class FailingEngine(DefaultEngine):
    """Plays behaviors of the tests' own namespace, and fails where they say."""

    extensions = frozenset()

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.played: list[int] = []
        self.closed = 0

    def supports(self, behavior: Behavior) -> bool:
        return isinstance(behavior, ForeignBehavior) and behavior.namespace == TESTS

    def prepare(self, behavior: Behavior) -> SlowWork | None:
        fail = said(behavior, "fail")
        if fail == "prepare":
            raise ValueError("prepare")
        if parts := said(behavior, "parts"):
            return self._work_in_parts(int(parts))
        takes = said(behavior, "takes")
        return None if takes is None else self._work(float(takes), fail)

    async def _work(self, takes: float, fail: str | None) -> float:
        for _ in range(int(takes)):
            await asyncio.sleep(0)
        if fail == "work":
            raise ValueError("work")
        return takes

    async def _work_in_parts(self, count: int) -> AsyncGenerator[Part, None]:
        try:
            for part in range(count):
                yield Part(None, last=part == count - 1)
        finally:
            self.closed += 1

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> FailingUnit:
        if said(behavior, "fail") == "plan":
            raise ValueError("plan")
        offsets = {"start": 0.0, "stroke": 0.5, "end": 1.0}
        if takes := said(behavior, "takes"):
            assert prepared == float(takes)
        return FailingUnit(block, behavior, timing_at(offsets))

    def play(self, tick: Tick) -> Play:
        if any(unit.begun and said(unit.behavior, "fail") == "engine" for unit in self.player.units):
            raise ValueError("engine")
        self.played.append(tick.number)
        return super().play(tick)


@pytest.fixture
def failing() -> FailingEngine:
    return FailingEngine("alice/failing")


@asynccontextmanager
async def opened(failing: FailingEngine) -> AsyncIterator[RealizerPilot]:
    """Alice, with an engine of the tests beside her own."""
    async with open_scene(SceneOptions(voice="text")) as scene:
        alice = scene.realizer.characters["alice"]
        engines = (failing, *alice.engines)
        character = Character("alice", alice.humanoid, engines)
        time = Source(Graph(), "time", GlobalTime(0.0))
        async with Realizer(
            [character], World({}), lambda context: [], SmartBodyStrategy(), Limits(), time
        ) as realizer:
            yield RealizerPilot(Scene(realizer, scene.specification, scene.assets, scene.tts))


def own(fail: str, id_: str = "x", **attributes: int) -> str:
    more = "".join(f' {name}="{value}"' for name, value in attributes.items())
    return f'<thing xmlns="{TESTS}" id="{id_}" fail="{fail}"{more}/>'


@pytest.fixture
async def pilot(failing: FailingEngine) -> AsyncIterator[RealizerPilot]:
    async with opened(failing) as pilot:
        yield pilot


WAIT = '<wait id="w" duration="2"/>'


@pytest.mark.parametrize(
    ("fail", "reached"),
    [
        ("on_start", ["start", "end"]),
        ("stroke", ["start", "stroke", "end"]),
        ("end", ["start", "stroke", "end"]),
        ("on_finish", ["start", "stroke", "end"]),
        ("stroke on_finish", ["start", "stroke", "end"]),
    ],
)
async def test_a_unit_that_fails_ends_with_a_warning_and_leaves_the_rest_alone(
    pilot: RealizerPilot, fail: str, reached: list[str]
) -> None:
    pilot.block("b", own(fail) + WAIT + own("", "fine"))
    await pilot.advance(3)
    told = pilot.feedback
    assert told.warnings == [("b:x", "EXECUTION_FAILURE")]
    assert [id_ for id_ in told.progress if id_.startswith("b:x")] == [f"b:x:{sync}" for sync in reached]
    assert told.reached("b:fine:end")
    assert told.time("b:end") == 2.0
    assert told.status("b") == "DONE"


@pytest.mark.parametrize("fail", ["details-of-end", "on_finish"])
async def test_a_unit_that_fails_at_its_interruption_ends_nevertheless(pilot: RealizerPilot, fail: str) -> None:
    pilot.block("b", own(fail) + WAIT)
    await pilot.advance(0.2)
    pilot.block("new", composition="REPLACE")
    await pilot.advance(3)
    told = pilot.feedback
    assert told.warnings == [("b:x", "EXECUTION_FAILURE")]
    assert told.time("b:w:end") == told.time("b:end") == 0.2
    assert told.status("new") == "DONE"


@pytest.mark.parametrize("fail", ["prepare", "work", "plan"])
async def test_a_behavior_that_cannot_be_made_is_left_out_with_a_warning(pilot: RealizerPilot, fail: str) -> None:
    pilot.block("b", own(fail, takes=1) + WAIT)
    await pilot.advance(3)
    assert pilot.feedback.warnings == [("b:x", "CANNOT_CREATE_BEHAVIOR")]
    assert fail in pilot.feedback.of("warningFeedback")[0].text
    assert pilot.feedback.reached("b:w:end")


async def test_an_engine_that_fails_drops_its_units_with_feedback_and_the_others_go_on(pilot: RealizerPilot) -> None:
    pilot.block("b", own("engine") + WAIT + own("", "y"))
    pilot.block("c", own("", "z"))
    await pilot.advance(3)
    told = pilot.feedback
    assert sorted(told.warnings) == [(f"{name}", "EXECUTION_FAILURE") for name in ("b:x", "b:y", "c:z")]
    assert told.time("b:w:end") == 2.0
    assert told.reached("c:end")
    pilot.block("d", own("", "again"))
    await pilot.advance(2)
    assert told.reached("d:again:end")


async def test_what_hangs_on_behaviors_of_an_engine_that_fails_is_lost_with_them_before_its_block_began(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", own("engine", start=1) + '<wait id="w" start="x:end" duration="1"/>')
    pilot.block("c", own("", "z") + '<wait id="v" start="z:end" duration="1"/>', composition="APPEND")
    await pilot.advance(5)
    told = {line.id: line.text for line in pilot.feedback.of("warningFeedback")}
    assert set(told) == {"b:x", "b:w", "c:z", "c:v"}
    assert "the behavior of b:x:end is dropped; this behavior keeps the last predicted time" in told["b:w"]
    assert "it is dropped: it depends on c:z:end, which will never come" in told["c:v"]
    assert pilot.feedback.time("b:w:start") == 2.0
    assert pilot.feedback.status("c") == "DONE"


async def test_results_of_background_work_enter_in_order_of_request(pilot: RealizerPilot) -> None:
    pilot.block("slow", own("", takes=50))
    pilot.block("quick", own("", takes=1))
    await pilot.tick()
    assert pilot.feedback.progress == []
    assert [line.id for line in pilot.feedback.of("predictionFeedback")] == ["slow", "quick"]
    await pilot.tick()
    assert pilot.feedback.progress[:4] == ["slow:start", "slow:x:start", "quick:start", "quick:x:start"]
    assert pilot.feedback.time("slow:start") == pilot.feedback.time("quick:start") == 0.01


async def test_a_block_appended_to_one_in_preparation_waits_for_it(pilot: RealizerPilot) -> None:
    pilot.block("slow", own("", takes=5))
    pilot.block("next", WAIT, composition="APPEND")
    await pilot.advance(4)
    assert pilot.feedback.time("next:start") == pilot.feedback.time("slow:end") == 1.01
    assert pilot.feedback.status("next") == "DONE"


@pytest.mark.parametrize("order", [1, -1])
async def test_a_block_that_names_points_of_one_in_preparation_waits_for_its_plan(
    pilot: RealizerPilot, order: int
) -> None:
    both = {"slow": own("", takes=5), "next": '<wait id="w" start="slow:x:stroke" duration="1"/>'}
    for name in list(both)[::order]:
        pilot.block(name, both[name])
    pilot.block("beside", WAIT)
    await pilot.advance(4)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("beside:start") == 0.0
    assert pilot.feedback.time("next:w:start") == pilot.feedback.time("slow:x:stroke")


async def test_background_work_for_a_block_that_is_replaced_is_cancelled(pilot: RealizerPilot) -> None:
    pilot.block("slow", own("", takes=1_000_000))
    await pilot.realizer.step(_tick(0))
    pilot.block("new", composition="REPLACE")
    await pilot.realizer.step(_tick(1))
    assert not pilot.realizer.busy
    assert pilot.feedback.progress == ["slow:end", "new:start", "new:end"]
    assert pilot.feedback.status("slow") == "REVOKED"


async def test_work_in_parts_is_closed_when_its_last_part_is_made(pilot: RealizerPilot, failing: FailingEngine) -> None:
    pilot.block("slow", own("", parts=3))
    await pilot.advance(0.1)
    assert (failing.closed, pilot.realizer.busy) == (1, False)


async def test_work_in_parts_is_closed_when_its_behavior_ends_between_two_of_them(
    pilot: RealizerPilot, failing: FailingEngine
) -> None:
    pilot.block("slow", own("", parts=1_000_000))
    for number in range(10):
        await pilot.realizer.step(_tick(number))
        await asyncio.sleep(0)
    pilot.block("new", composition="REPLACE")
    await pilot.realizer.step(_tick(10))
    await pilot.realizer.step(_tick(11))
    assert (failing.closed, pilot.realizer.busy) == (1, False)


async def test_work_in_parts_is_closed_with_the_session(failing: FailingEngine) -> None:
    async with opened(failing) as pilot:
        pilot.block("slow", own("", parts=1_000_000))
        for number in range(10):
            await pilot.realizer.step(_tick(number))
            await asyncio.sleep(0)
        assert failing.closed == 0
    assert failing.closed == 1


async def test_inputs_of_a_tick_enter_by_time_and_then_in_the_order_in_which_they_were_put(
    pilot: RealizerPilot,
) -> None:
    for name, at in [("c", 0.02), ("a", 0.01), ("d", 0.02), ("b", 0.01), ("late", 5.0)]:
        pilot.realizer.put(BmlText(block(name)), GlobalTime(at))
    await pilot.realizer.step(_tick(2))
    assert [id_ for id_ in pilot.feedback.progress if id_.endswith("start")] == [f"{n}:start" for n in "abcd"]
    assert pilot.realizer.busy


async def test_no_frame_is_composed_without_a_listener(pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []

    def layers(tick: Tick) -> tuple[Layer, ...]:
        asked.append(tick.number)
        return ()

    monkeypatch.setattr(pilot.realizer.characters["alice"].engines[0], "layers", layers)
    await pilot.advance(0.05)
    assert asked == []
    stop = pilot.realizer.watch(lambda frames: None)
    await pilot.advance(0.05)
    assert asked == [6, 8]
    stop()
    await pilot.advance(0.05)
    assert asked == [6, 8]


def _tick(number: int) -> Tick:
    return Tick(number, tick_time(number - 1))


@pytest.mark.parametrize("number", [1, 60])
async def test_a_strategy_that_raises_fails_the_block_that_it_was_to_plan(
    pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch, number: int
) -> None:
    def fail(problem: SchedulingProblem) -> None:
        raise StopIteration("a test")

    pilot.block("one", '<wait id="w" duration="1"/>')
    await pilot.tick()
    monkeypatch.setattr(pilot.realizer._strategy, "solve", fail)
    pilot.block("two", "".join(f'<wait id="w{i}" duration="0.1"/>' for i in range(number)))
    await pilot.advance(2)
    assert (pilot.feedback.status("one"), pilot.feedback.status("two")) == ("DONE", "FAILED")
    assert pilot.feedback.warnings == [("two", "CANNOT_CREATE_BEHAVIOR")]
