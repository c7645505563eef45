"""Ended blocks are freed."""

import gc
import tracemalloc
import weakref
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import TypeVar

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engines.animation.fade_out import FadeOut
from reactive_realizer.engines.animation.motions.gesture import GestureMotionUnit
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

T = TypeVar("T")
OURS, TESTING = "reactive_realizer", "reactive_realizer.testing"


def tracked(kind: type[T], besides: Iterable[T] = ()) -> list[T]:
    """The objects of a type that the garbage collector tracks, except some."""
    known = {id(each) for each in besides}
    return [each for each in gc.get_objects() if isinstance(each, kind) and id(each) not in known]


def living() -> Counter[str]:
    """The number of live objects of the realizer, by type."""
    gc.collect()
    modules = ((type(each).__name__, str(type(each).__module__)) for each in gc.get_objects())
    return Counter(name for name, module in modules if module.startswith(OURS) and not module.startswith(TESTING))


async def test_300_blocks_leave_nothing_behind(pilot: RealizerPilot) -> None:
    before = tracked(BMLBlock)
    pilot.predict("test", "hit", 0.1)
    pilot.block("forever", '<head id="h" lexeme="NOD" start="anticipators:never:comes"/>')
    blocks = []
    for number in range(300):
        pilot.block(
            f"b{number}",
            f"""
            <head id="h" lexeme="NOD" start="anticipators:metronome:tick{number}" end="anticipators:test:hit+9"/>
            <head id="i" lexeme="NOD" start="nobody:end"/>
            <wait id="w" start="forever:0" duration="0.01"/>
            <gesture id="g" lexeme="BEAT" stroke="anticipators:new{number}:hit"/>
            """,
            composition="REPLACE" if number % 7 == 0 else "APPEND",
        )
        await pilot.tick()
        blocks.append(weakref.ref(pilot.realizer.scheduler.blocks.alive[-1]))
        if number % 10 == 9:
            pilot.block("last", composition="REPLACE")
            await pilot.tick()
    board = pilot.realizer.board
    assert [str(view.key) for view in board.snapshot()] == []
    assert board.predicted("test", "hit").dependents == {}
    engines = pilot.realizer.characters["alice"].engines
    assert all(engine.player.units == () for engine in engines if isinstance(engine, DefaultEngine))
    gc.collect()
    assert [block() for block in blocks if block() is not None] == []
    assert tracked(BMLBlock, before) == []


async def test_an_endless_chain_of_appended_blocks_does_not_keep_the_first(pilot: RealizerPilot) -> None:
    pilot.block("b0", '<wait id="w" duration="0.05"/>')
    await pilot.tick()
    first = weakref.ref(pilot.realizer.scheduler.blocks.alive[0])
    for number in range(1, 20):
        pilot.block(f"b{number}", '<wait id="w" duration="0.05"/>', composition="APPEND")
        await pilot.advance(0.04)
    assert pilot.realizer.scheduler.blocks.alive
    gc.collect()
    assert first() is None


async def test_only_the_latest_ended_blocks_are_remembered(pilot: RealizerPilot) -> None:
    blocks = pilot.realizer.scheduler.blocks
    blocks._remembered = 5
    for number in range(10):
        pilot.block(f"b{number}")
    await pilot.tick()
    assert [ended.key.block for ended in blocks.ended] == [f"b{n}" for n in range(5, 10)]


async def test_blocks_that_are_sent_again_and_again_leave_nothing_new_behind(pilot: RealizerPilot) -> None:
    async def play() -> Counter[str]:
        for number in range(10):
            pilot.predict("t", f"hit{number % 4}", pilot.now + 0.1)
            pilot.block(
                f"b{number}",
                f"""
                <speech id="s"><text>one <sync id="m"/>two</text></speech>
                <gesture id="g" lexeme="BEAT" stroke="s:m"/>
                <head id="h" lexeme="NOD" start="anticipators:t:hit{number % 4}"/>
                <wait id="w" event="asked" max-wait="0.5"/><bmla:emit id="e" event="asked" start="s:end"/>
                """,
                composition="REPLACE" if number % 5 == 0 else "MERGE",
            )
            await pilot.advance(0.1 if number % 5 == 4 else 1.5)
        await pilot.advance(2.0)
        assert pilot.feedback.messages  # parsed; the reports are freed
        pilot.sounds.clear()
        return living()

    await play()
    before = await play()
    assert await play() - before == Counter()


@pytest.mark.parametrize(
    "behavior",
    [
        '<wait id="w" duration="0.01"><description priority="1" type="x/{0}"><a>{1}</a></description></wait>',
        '<head id="h" lexeme="NOD" start="anticipators:t:never"><bmlt:parameter name="n" value="{0}{1}"/></head>',
    ],
)
async def test_large_behaviors_are_not_remembered_when_they_have_ended(pilot: RealizerPilot, behavior: str) -> None:
    tracemalloc.start()
    try:
        for number in range(40):
            pilot.block("b", behavior.format(number, "x" * 500_000), **{"bmla:interrupt": "b"})
            await pilot.tick()
            pilot.feedback.clear()
        gc.collect()
        assert tracemalloc.get_traced_memory()[0] < 20e6
    finally:
        tracemalloc.stop()


async def test_points_and_blocks_with_new_names_are_remembered_up_to_the_limits(tmp_path: Path) -> None:
    human = tmp_path / "few.toml"
    human.write_text("[character.alice]\n[limits]\nremembered_blocks = 10\npredicted_points = 10\n")
    async with open_pilot(SceneOptions(human, "text")) as pilot:

        async def play(first: int) -> Counter[str]:
            for number in range(first, first + 15):
                pilot.predict("t", f"turn{number}", pilot.now + 0.1)
                pilot.block(
                    f"b{number}",
                    f"""
                    <speech id="s"><text>number {number:03}</text></speech>
                    <head id="h" lexeme="NOD" stroke="anticipators:t:turn{number}"/>
                    <wait id="w" start="anticipators:metronome:tick{number}" duration="0.1"/>
                    """,
                    composition="REPLACE",
                )
                await pilot.advance(0.5)
            await pilot.advance(2.0)
            pilot.feedback.clear()
            pilot.sounds.clear()
            return living()

        await play(0)
        before = await play(15)
        more = await play(30) - before
        assert set(more) <= {"_Template", "_TemplateKey", "Utterance", "Word", "_Text"}  # limited by their size


async def test_fading_motions_are_not_kept_if_no_frames_are_made(pilot: RealizerPilot) -> None:
    before = tracked(FadeOut)
    for number in range(12):
        stance = "SITTING" if number % 2 else "STANDING"
        pilot.block(
            f"b{number}",
            f"""
            <postureShift id="p" start="0" end="0.1"><stance type="{stance}"/></postureShift>
            <gazeShift id="g" target="bluebox" start="0" end="0.1"/>
            """,
            composition="REPLACE" if number == 1 else "MERGE",
        )
        await pilot.advance(3.1)
    gc.collect()
    assert len(tracked(FadeOut, before)) < 4


async def test_the_number_of_cached_gestures_is_limited(pilot: RealizerPilot) -> None:
    before = tracked(GestureMotionUnit)
    for number in range(300):
        size = f'<bmlt:parameter name="amount" value="{number / 300}"/>'
        pilot.block(
            f"b{number}", f'<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND">{size}</gesture>', composition="REPLACE"
        )
        await pilot.tick()
        assert pilot.feedback.warnings == []
    gc.collect()
    assert len(tracked(GestureMotionUnit, before)) < 270


_PERFORMED = """
    <speech id="s"><text>one <sync id="m"/>two three four five</text></speech>
    <gesture id="g" lexeme="BEAT" stroke="s:m"/>
    <head id="h" lexeme="NOD" start="s:start" end="s:end"/>
    <gaze id="z" target="camera" start="s:start" end="s:end+0.5"/>
    <pointing id="p" target="bluebox" start="s:end"/>
    <faceLexeme id="f" lexeme="RAISE_BROWS" start="s:start" end="s:end"/>
    <wait id="w" duration="0.2" start="s:end"/>
    <bmlt:parametervaluechange id="v" target="{0}:s" paramId="volume" start="s:start+0.1" end="s:start+0.3">
      <bmlt:trajectory type="linear" targetValue="20"/>
    </bmlt:parametervaluechange>
    <bmla:interrupt id="i" target="other" start="s:m"/>
    <wait id="k" duration="0.1"/><constraint id="c"><after ref="h:end"><sync ref="k:start"/></after></constraint>
"""


async def test_ended_behaviors_are_freed_without_the_garbage_collector(pilot: RealizerPilot) -> None:
    async def perform(block: str) -> None:
        pilot.block(block, _PERFORMED.format(block))
        pilot.block("big", "".join(f'<wait id="w{number}" duration="0.1"/>' for number in range(60)))  # solved aside
        pilot.block("other", '<gazeShift id="z" target="bluebox"/><speech id="s"><text>and so on</text></speech>')
        await pilot.advance(6.0)

    await perform("first")
    assert pilot.feedback.warnings == []
    gc.collect()
    gc.disable()
    gc.set_debug(gc.DEBUG_SAVEALL)
    try:
        await perform("second")
        gc.collect()
        ours = {type(thing).__name__ for thing in gc.garbage if type(thing).__module__.startswith("reactive_realizer")}
    finally:
        gc.set_debug(0)
        gc.garbage.clear()
        gc.enable()
    assert ours == set()
