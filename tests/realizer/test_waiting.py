"""A character that waits costs nothing: its engines are not asked to play, and its behaviors are not read."""

import gc
import sys
from collections import Counter
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.engine.effects import Output
from reactive_realizer.engine.engine_task import EngineTask
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

WAITING = """
  <speech id="s" start="anticipators:partner:hit"><text>Now.</text></speech>
  <gesture id="g" lexeme="BEAT" stroke="anticipators:partner:hit"/>
  <gaze id="z" target="bluebox" start="anticipators:partner:hit"/>
  <faceLexeme id="f" lexeme="RAISE_BROWS" start="g:end"/>
  <wait id="w" start="s:end" duration="1"/>
  <bmla:parametervaluechange id="p" target="s" paramId="volume" start="s:start">
    <bmla:trajectory type="linear" targetValue="80"/>
  </bmla:parametervaluechange>
"""


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot() as pilot:
        yield pilot


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    """How often engines were posted, and behaviors asked whether they are due."""
    calls: Counter[str] = Counter()

    def count(owner: type, name: str) -> None:
        original: Callable[..., Any] = getattr(owner, name)

        def counted(*args: object) -> object:
            calls[name] += 1
            return original(*args)

        monkeypatch.setattr(owner, name, counted)

    count(EngineTask, "post")
    count(PlanUnit, "due")
    count(PlanUnit, "next_due")
    return calls


@pytest.mark.parametrize("blocks", [1, 100])
async def test_a_character_that_only_waits_is_not_asked_for_anything(
    pilot: RealizerPilot, calls: Counter[str], blocks: int
) -> None:
    for number in range(blocks):
        pilot.block(f"b{number}", WAITING)
        pilot.block(f"c{number}", '<head id="h" lexeme="NOD"/>', composition="APPEND")
    pilot.block("preplanned", '<head id="h" lexeme="NOD"/>', **{"bmla:preplan": "true"})
    await pilot.advance(1)
    calls.clear()
    await pilot.advance(10)
    assert calls == {}


async def calls_in_a_second(blocks: int, options: SceneOptions | None = None) -> int:
    """The number of all function calls of a second in which blocks wait."""
    calls = 0

    def count(frame: FrameType, event: str, argument: object) -> None:
        nonlocal calls
        calls += event == "call"

    async with open_pilot(options) as pilot:
        for number in range(blocks):
            pilot.block(f"b{number}", WAITING)
        await pilot.advance(0.5)
        gc.disable()  # callbacks of the collector would be counted
        sys.setprofile(count)
        await pilot.advance(1)
        sys.setprofile(None)
        gc.enable()
    return calls


async def test_blocks_that_wait_cost_as_much_as_none() -> None:
    assert await calls_in_a_second(30) == await calls_in_a_second(0)


async def test_further_characters_are_not_asked_whether_they_have_blocks_to_plan(tmp_path: Path) -> None:
    async def calls(characters: int) -> int:
        human = tmp_path / f"{characters}.toml"
        human.write_text("".join(f'[character.c{n}]\navatar = "avatars/female.glb"\n' for n in range(characters)))
        return await calls_in_a_second(0, SceneOptions(human, "text"))

    one, two, three = [await calls(number) for number in (1, 2, 3)]
    assert one == two == three


async def test_a_prediction_wakes_the_engines_that_wait_for_it_once_each(
    pilot: RealizerPilot, calls: Counter[str]
) -> None:
    pilot.block("b", WAITING)
    await pilot.advance(0.1)
    calls.clear()
    pilot.predict("partner", "hit", 9.0)
    await pilot.advance(1)
    assert calls["post"] == 5
    await pilot.advance(7)
    pilot.predict("partner", "hit", 8.6)
    await pilot.advance(5)
    assert pilot.feedback.time("b:s:start") == pilot.feedback.time("b:g:stroke") == 8.6


async def test_behaviors_that_wait_for_a_prediction_are_not_asked_again_when_it_is_put_off(
    pilot: RealizerPilot, calls: Counter[str]
) -> None:
    pilot.predict("partner", "hit", 2.0)
    pilot.block("b", WAITING)
    await pilot.advance(0.1)
    calls.clear()
    for hit in (3.0, 4.0, 5.0):
        pilot.predict("partner", "hit", hit)
        await pilot.tick()
    assert calls["next_due"] == 0
    await pilot.advance(6)
    assert pilot.feedback.time("b:s:start") == pilot.feedback.time("b:g:stroke") == 5.0


async def test_frames_are_shown_once_each(pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[int] = []
    engine = next(each for each in pilot.realizer.characters["alice"].engines if each.name.endswith("/animation"))
    show = engine.show

    def note(tick: Tick) -> Output:
        shown.append(tick.number)
        return show(tick)

    monkeypatch.setattr(engine, "show", note)
    pilot.watch()
    for number in range(5):
        pilot.block(f"b{number}", '<gesture id="g" lexeme="BEAT"/><head id="h" lexeme="NOD"/>', composition="APPEND")
    await pilot.advance(6)
    assert shown == list(range(0, 600, 2))
