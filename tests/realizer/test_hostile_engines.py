"""Whatever an engine of a plug-in raises or returns costs its own behaviors; the session and the others go on."""

import asyncio
import math
from collections.abc import AsyncIterator, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import pytest

from reactive_realizer.assembly.scene import Scene, SceneOptions, open_scene
from reactive_realizer.bml.behavior import Behavior, ForeignBehavior
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.humanoid import EyePose
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.world import World
from reactive_realizer.engine.effects import EndUnit, Output, Play, Reached
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import timing_at
from reactive_realizer.reactive.cell import Source
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.realizer.character import Character
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.scheduler.convex.convex_strategy import ConvexStrategy
from reactive_realizer.testing.pilot import RealizerPilot

TESTS = "urn:tests"
NAN = float("nan")
THING = f'<thing xmlns="{TESTS}" id="x"/>'


class Hostile(DefaultEngine):
    """Plays one kind of behavior."""

    def supports(self, behavior: Behavior) -> bool:
        return isinstance(behavior, ForeignBehavior)

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        return PlanUnit(block, behavior, timing_at({"start": 0.0, "end": 1.0}))


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    """Alice, with a hostile engine beside her own, and with a viewer."""
    async with open_scene(SceneOptions(voice="text")) as scene:
        alice = scene.realizer.characters["alice"]
        character = Character("alice", alice.humanoid, (Hostile("alice/hostile"), *alice.engines))
        time = Source(Graph(), "time", GlobalTime(0.0))
        async with Realizer([character], World({}), lambda _: [], ConvexStrategy(), Limits(), time) as realizer:
            pilot = RealizerPilot(Scene(realizer, scene.specification, scene.assets, scene.tts))
            pilot.watch()
            yield pilot


@contextmanager
def rigged(method: str, answer: Any) -> Iterator[None]:
    """Has a method of the hostile engine raise an exception, or return something."""

    def call(*_: object) -> Any:
        if isinstance(answer, BaseException):
            raise answer
        return answer

    with pytest.MonkeyPatch.context() as monkeypatch:
        monkeypatch.setattr(Hostile, method, property(call) if method == "next_due" else call)
        yield


async def assert_that_others_go_on(pilot: RealizerPilot, id_: str = "b") -> None:
    pilot.frames["alice"] = []
    pilot.block(id_, THING + '<wait id="w" duration="0.1"/>')
    await pilot.advance(0.2)
    pilot.block("stop", composition="REPLACE")
    await pilot.advance(0.1)
    assert pilot.feedback.reached(f"{id_}:w:end")
    assert pilot.feedback.status(id_) in ("DONE", "INTERRUPTED")
    frames = pilot.frames["alice"]
    assert len(frames) == 15
    for frame in frames:
        for numbers in (frame.rotations, frame.root, frame.weights):
            assert np.isfinite(numbers).all()


METHODS = ("supports", "check", "prepare", "plan", "add", "remove", "next_due", "play", "show", "fail", "reset", "face")


@pytest.mark.parametrize("raised", [ValueError("on purpose"), SystemExit(3), asyncio.CancelledError()], ids=repr)
async def test_a_plug_in_may_raise_anything_anywhere(
    pilot: RealizerPilot, subtests: pytest.Subtests, raised: BaseException
) -> None:
    for method in METHODS:
        with subtests.test(method), rigged(method, raised):
            await assert_that_others_go_on(pilot, method)


PLAYED = [
    ("check", "text"),
    ("check", [1]),
    ("prepare", "text"),
    ("plan", None),
    ("plan", "text"),
    ("next_due", "text"),
    ("next_due", NAN),
    ("play", None),
    ("play", Play(requests=("text",))),  # type: ignore[arg-type]
    ("play", Play(reached=(Reached("x", "y", NAN),))),  # type: ignore[arg-type]
    ("play", Play(requests=(EndUnit("x", NAN),))),  # type: ignore[arg-type]
    ("requests", "text"),
    ("requests", None),
    ("audio", ("text",)),
    ("warnings", (None,)),
]

SHOWN = [
    ("show", None),
    ("show", Output(eyes=lambda _: EyePose({"l_eyeball_joint": (NAN, 0.0, 0.0, 0.0)}, {}))),
    ("show", Output(eyes=lambda _: "text")),  # type: ignore[arg-type,return-value]
    ("show", Output(eyes="text")),  # type: ignore[arg-type]
    ("face", "text"),
    ("face", {"jawOpen": NAN}),
    ("face", {"jawOpen": math.inf}),
    ("face", {"jawOpen": "wide"}),
    ("layers", None),
    ("layers", ("text",)),
    ("layers", (Layer(LayerKind.GESTURE, {"l_elbow": (NAN, 0.0, 0.0, 0.0)}),)),
    ("layers", (Layer(LayerKind.GESTURE, {"l_elbow": (1.0, 0.0)}),)),  # type: ignore[dict-item]
    ("layers", (Layer(LayerKind.GESTURE, {"l_elbow": (2.0, 0.0, 0.0, 0.0)}),)),
    ("layers", (Layer(LayerKind.GESTURE, {}, NAN),)),
    ("layers", (Layer(LayerKind.GESTURE, {}, 1.0, 0, (NAN, 0.0, 0.0)),)),
    ("layers", (Layer("text", {}),)),  # type: ignore[arg-type]
    ("layers", (Layer(LayerKind.GESTURE, {}, weights={"l_elbow": NAN}),)),
]


@pytest.mark.parametrize("answers", [PLAYED, SHOWN], ids=["played", "shown"])
async def test_a_plug_in_may_return_anything(
    pilot: RealizerPilot, subtests: pytest.Subtests, answers: list[tuple[str, Any]]
) -> None:
    for number, (method, answer) in enumerate(answers):
        with subtests.test(method, answer=answer), rigged(method, answer):
            await assert_that_others_go_on(pilot, f"b{number}")


@pytest.mark.parametrize("raised", [ValueError("on purpose"), SystemExit(3), asyncio.CancelledError()], ids=repr)
async def test_slow_work_of_a_plug_in_may_raise_anything(pilot: RealizerPilot, raised: BaseException) -> None:
    async def work() -> None:
        raise raised

    with pytest.MonkeyPatch.context() as monkeypatch:
        monkeypatch.setattr(Hostile, "prepare", lambda *_: work())
        await assert_that_others_go_on(pilot)
    assert pilot.feedback.warnings == [("b:x", "CANNOT_CREATE_BEHAVIOR")]


async def test_a_plug_in_that_fails_in_every_frame_is_logged_once(
    pilot: RealizerPilot, caplog: pytest.LogCaptureFixture
) -> None:
    with rigged("layers", None):
        await pilot.advance(1)
    assert len([record for record in caplog.records if record.levelname == "ERROR"]) == 1
