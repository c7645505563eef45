"""Streams of anticipators run beside the ticks, and their predictions enter with them."""

import asyncio
import math
from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly import scene
from reactive_realizer.assembly.registry import load
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.clock.clock import ManualClock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.anticipator import Anticipator, Counted, Predictions
from reactive_realizer.realizer.inputs import Prediction, TickInputs
from reactive_realizer.realizer.session import replay, run_until_done
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

Open = Callable[..., AbstractAsyncContextManager[RealizerPilot]]
NOD = '<head id="h" lexeme="NOD" start="anticipators:{}"/>'


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Open:
    """Opens a scene with anticipators of some classes, each with its kind as its id."""

    @asynccontextmanager
    async def open_with(*kinds: type[Anticipator]) -> AsyncIterator[RealizerPilot]:
        known = {kind.kind: kind for kind in kinds}
        monkeypatch.setattr(scene, "load", lambda group, name, *kind: known.get(name) or load(group, name, *kind))
        human = tmp_path / "human.toml"
        human.write_text("[character.alice]\n" + "".join(f'[anticipator.{kind}]\nkind = "{kind}"\n' for kind in known))
        async with open_pilot(SceneOptions(human, "text")) as pilot:
            yield pilot

    return open_with


class Ticking(Anticipator):
    """Half a second after each round time, predicts the next."""

    kind = "ticking"
    points = ("tock",)

    async def predictions(self) -> Predictions:
        for round_time in (0.0, 1.0, 2.0):
            await self.clock.wait_until(round_time + 0.5)
            yield "tock", round_time + 1.0


async def test_a_prediction_at_a_time_of_the_clock_enters_in_the_tick_of_that_time(opened: Open) -> None:
    async with opened(Ticking) as pilot:
        pilot.block("b", NOD.format("ticking:tock"))
        await pilot.advance(0.5)
        assert pilot.feedback.predictions("b")[-1].time == 0.0
        await pilot.advance(1.5)
        assert pilot.feedback.predictions("b")[1].time == 0.5
        assert pilot.feedback.time("b:h:start") == 1.0


class Relaying(Anticipator):
    """Passes its events through a task and a queue."""

    kind = "relaying"
    events = ("hit",)
    points = ("hit",)

    async def predictions(self) -> Predictions:
        queue: asyncio.Queue[float] = asyncio.Queue()

        async def relay() -> None:
            async for event in self.inputs:
                await queue.put(event.time)

        async with asyncio.TaskGroup() as group:
            group.create_task(relay())
            while True:
                yield "hit", await queue.get()


async def test_a_reaction_that_passes_a_task_and_a_queue_enters_in_the_same_tick(opened: Open) -> None:
    async with opened(Relaying) as pilot:
        pilot.block("b", NOD.format("relaying:hit"))
        await pilot.advance(0.5)
        pilot.event("relaying", "hit")
        await pilot.advance(1)
        assert pilot.feedback.time("b:h:start") == 0.5


class Fed(Anticipator):
    """Predicts what a queue of the test contains; ``ended`` lists what has closed."""

    kind = "fed"
    points = ("hit",)
    queue: asyncio.Queue[float]
    ended: list[str]

    async def predictions(self) -> Predictions:
        try:
            while True:
                yield "hit", await self.queue.get()
        finally:
            self.ended.append(self.id)


@pytest.fixture(autouse=True)
def fed() -> type[Fed]:
    Fed.queue, Fed.ended = asyncio.Queue(), []
    return Fed


async def test_a_prediction_that_comes_between_two_ticks_enters_in_the_next_one_and_is_replayed(opened: Open) -> None:
    session: list[TickInputs] = []
    async with opened(Fed) as pilot:
        pilot.realizer.record(session.append)
        pilot.block("b", NOD.format("fed:hit"))
        await pilot.advance(0.5)
        Fed.queue.put_nowait(0.8)
        await asyncio.sleep(0)
        await pilot.advance(1)
        assert pilot.feedback.predictions("b")[1].time == 0.5
        assert pilot.feedback.time("b:h:start") == 0.8
    Fed.queue.put_nowait(0.3)
    async with opened(Fed) as again:
        await replay(again.realizer, session)
        assert again.feedback.time("b:h:start") == 0.8
    assert not Fed.queue.empty()


async def test_streams_end_with_the_session(opened: Open) -> None:
    async with opened(Fed) as pilot:
        await pilot.tick()
        assert Fed.ended == []
    assert Fed.ended == ["fed"]


class Busy(Anticipator):
    """Waits for the present again and again."""

    kind = "busy"
    points = ("hit",)
    turns = 0

    async def predictions(self) -> Predictions:
        while True:
            await self.clock.wait_until(self.clock.now())
            type(self).turns += 1
            yield "hit", self.clock.now() + 1.0


async def test_a_stream_that_waits_for_the_present_acts_once_a_tick(opened: Open) -> None:
    async with opened(Busy) as pilot:
        await pilot.advance(0.1)
        assert Busy.turns == 9


class Throughout(Anticipator):
    """Waits for an event, but at most until a time."""

    kind = "throughout"
    events = ("go",)
    points = ("hit",)

    async def predictions(self) -> Predictions:
        while True:
            event = await self.next_input(until=self.clock.now() + 0.5)
            yield "hit", self.clock.now() + (0.3 if event is None else 0.1)


async def test_a_stream_waits_for_an_event_or_for_a_time(opened: Open) -> None:
    async with opened(Throughout) as pilot:
        pilot.block("b", NOD.format("throughout:hit"))
        await pilot.advance(0.51)
        assert pilot.feedback.predicted("b:h:start") == pytest.approx(0.8)
        await pilot.advance(0.09)
        pilot.event("throughout", "go")
        await pilot.tick()
        assert pilot.feedback.predicted("b:h:start") == pytest.approx(0.7)
        await pilot.advance(1)
        assert pilot.feedback.time("b:h:start") == pytest.approx(0.7)


@pytest.mark.parametrize(("kind", "waits"), [(Ticking, True), (Fed, True), (Relaying, False)])
async def test_a_session_that_runs_until_it_is_done_waits_for_a_stream_that_may_predict(
    opened: Open, kind: type[Anticipator], waits: bool
) -> None:
    async with opened(kind) as pilot:
        pilot.block("b", NOD.format("other:hit"))
        await run_until_done(pilot.realizer, ManualClock(), GlobalTime(0.3))
        assert (pilot.realizer.time == 0.3) is waits
        assert bool(pilot.feedback.warnings) is not waits


class Fragile(Anticipator):
    """Fails when it is asked."""

    kind = "fragile"
    points = (Counted("turn"),)

    async def predictions(self) -> Predictions:
        yield "turn1", 0.5

    def forecast(self, point: str) -> GlobalTime:
        return GlobalTime(1 / int(point == "turn1"))


async def test_a_forecast_that_fails_leaves_its_point_unknown(opened: Open, caplog: pytest.LogCaptureFixture) -> None:
    async with opened(Fragile) as pilot:
        pilot.block("b", NOD.format("fragile:turn2"))
        pilot.block("c", NOD.format("fragile:turn1"))
        await pilot.advance(1)
        assert not pilot.feedback.reached("b:h:start")
        assert pilot.feedback.time("c:h:start") == 0.5
    assert "the anticipator 'fragile' has no forecast of 'turn2'" in caplog.text


@pytest.mark.parametrize(
    "answer",
    [ValueError("no"), SystemExit(3), asyncio.CancelledError(), "soon", 10**400, math.nan, np.array([1.0, 2.0])],
)
async def test_a_forecast_that_is_no_time_leaves_its_point_unknown_and_everything_else_as_it_is(
    opened: Open, monkeypatch: pytest.MonkeyPatch, answer: object
) -> None:
    def forecast(self: Anticipator, point: str) -> object:
        if isinstance(answer, BaseException):
            raise answer
        return answer

    monkeypatch.setattr(Fragile, "forecast", forecast)
    async with opened(Fragile) as pilot:
        pilot.block("b", NOD.format("fragile:turn2"))
        pilot.block("c", NOD.format("fragile:turn1"))
        await pilot.advance(1)
        assert not pilot.feedback.reached("b:h:start")
        assert pilot.feedback.time("c:h:start") == 0.5


async def test_a_forecast_may_be_any_kind_of_number(opened: Open, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Fragile, "forecast", lambda self, point: np.float32(0.75))
    async with opened(Fragile) as pilot:
        pilot.block("b", NOD.format("fragile:turn2"))
        await pilot.advance(1)
        assert pilot.feedback.time("b:h:start") == 0.75


class Picky(Anticipator):
    """Fails when it checks an event."""

    kind = "picky"
    events = ("go",)
    points = ("hit",)

    async def predictions(self) -> Predictions:
        async for event in self.inputs:
            yield "hit", event.time

    def check(self, name: str, value: float | None) -> None:
        if value is None:
            raise SystemExit(3)


async def test_an_event_that_an_anticipator_cannot_check_is_skipped(opened: Open) -> None:
    async with opened(Picky) as pilot:
        pilot.block("b", NOD.format("picky:hit"))
        pilot.event("picky", "go")
        await pilot.advance(0.5)
        pilot.event("picky", "go", 1.0)
        await pilot.advance(1)
        assert pilot.feedback.time("b:h:start") == 0.5


class FailsAtItsEnd(Anticipator):
    """Cannot close what it has opened."""

    kind = "fails_at_its_end"
    points = ("hit",)

    async def predictions(self) -> Predictions:
        try:
            yield "hit", 0.5
            await asyncio.Event().wait()
        finally:
            raise ValueError("already closed")


async def test_a_stream_that_fails_while_it_closes_does_not_fail_the_session(
    opened: Open, caplog: pytest.LogCaptureFixture
) -> None:
    async with opened(FailsAtItsEnd, Fed) as pilot:
        pilot.block("b", NOD.format("fails_at_its_end:hit"))
        await pilot.advance(1)
        assert pilot.feedback.time("b:h:start") == 0.5
    assert Fed.ended == ["fed"]
    assert "already closed" in caplog.text


async def test_a_replay_without_a_forecast_that_it_needs_says_so(opened: Open) -> None:
    session: list[TickInputs] = []
    async with opened(Fragile) as pilot:
        pilot.realizer.record(session.append)
        await pilot.tick()
        pilot.block("b", NOD.format("fragile:turn2"))
        await pilot.advance(0.1)
    async with opened(Fragile) as again:
        with pytest.raises(RealizerError, match="at 0 s: it needs the time of fragile:turn1"):
            await replay(again.realizer, session)


class Canceled(Anticipator):
    """Waits for something that is cancelled."""

    kind = "canceled"
    points = ("hit",)

    async def predictions(self) -> Predictions:
        yield "hit", 1.0
        future = asyncio.get_running_loop().create_future()
        future.cancel()
        await future


class Exiting(Anticipator):
    """Ends as a program does."""

    kind = "exiting"
    points = ("hit",)

    async def predictions(self) -> Predictions:
        yield "hit", 1.0
        raise SystemExit(3)


@pytest.mark.parametrize("kind", [Canceled, Exiting])
async def test_a_stream_that_ends_by_any_exception_is_reported(opened: Open, kind: type[Anticipator]) -> None:
    async with opened(kind) as pilot:
        pilot.block("b", NOD.format(f"{kind.kind}:hit"))
        await pilot.advance(3)
        assert pilot.feedback.warnings == [(f"anticipators:{kind.kind}", "EXECUTION_FAILURE")]
        assert pilot.feedback.time("b:h:start") == 1.0


class Exact(Anticipator):
    """Yields a number of numpy."""

    kind = "exact"
    points = ("hit",)

    async def predictions(self) -> Predictions:
        yield "hit", np.float32(1.5)  # type: ignore[misc]  # a plug-in need not be typed


async def test_any_kind_of_number_is_recorded_as_seconds(opened: Open) -> None:
    async with opened(Exact) as pilot:
        recorded: list[TickInputs] = []
        pilot.realizer.record(recorded.append)
        await pilot.advance(1)
        (time,) = [each.time for inputs in recorded for each in inputs.predicted if isinstance(each, Prediction)]
        assert type(time) is float


class Endless(Anticipator):
    """Never waits."""

    kind = "endless"
    points = ("hit",)

    async def predictions(self) -> Predictions:
        while True:
            yield "hit", self.clock.now() + 1.0


async def test_a_stream_that_never_waits_fails_and_everything_else_plays(opened: Open) -> None:
    async with opened(Endless, Ticking) as pilot:
        pilot.block("b", NOD.format("ticking:tock"))
        await pilot.advance(2)
        assert ("anticipators:endless", "EXECUTION_FAILURE") in pilot.feedback.warnings
        assert "10000 predictions in one tick" in pilot.feedback.of("warningFeedback")[0].text
        assert pilot.feedback.time("b:h:start") == 1.0


async def test_a_mistyped_point_of_a_remote_anticipator_with_declared_points_is_told(tmp_path: Path) -> None:
    human = tmp_path / "human.toml"
    human.write_text('[character.alice]\n[anticipator.partner]\nkind = "remote"\npoints = ["hit"]\n')
    async with open_pilot(SceneOptions(human, "text")) as pilot:
        with pytest.raises(RealizerError, match="the anticipator 'partner' has no point 'hti'; it has hit"):
            pilot.realizer.check_prediction("partner", "hti")
        pilot.predict("partner", "hit", 0.5)
        pilot.block("b", NOD.format("partner:hti"))
        pilot.block("c", NOD.format("partner:hit"))
        await pilot.advance(1)
        (warning,) = pilot.feedback.of("warningFeedback")
        assert "the anticipator 'partner' has no point 'hti'; it has hit" in warning.text
        assert pilot.feedback.time("c:h:start") == 0.5
