"""Hostile input: everything is answered, and every block ends once."""

from collections import Counter
from itertools import permutations
from pathlib import Path
from typing import Any

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import OWN
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

SPEECH = '<speech id="s"><text>one <sync id="m"/>two three</text></speech>'
NOD = '<head id="n" lexeme="NOD"/>'
WAYS = {
    "interrupt": ("cut", '<bmla:interrupt id="i" target="talk"/>', {}),
    "activate": ("wake", '<bmla:activate id="a" target="prepared"/>', {}),
    "replace": ("new", SPEECH, {"composition": "REPLACE"}),
    "onStart": ("both", "", {"bmla:onStart": "prepared", "bmla:interrupt": "talk"}),
}
ORDERS = list(permutations(WAYS))


def ends(pilot: RealizerPilot) -> Counter[Any]:
    """How often each block ended."""
    return Counter(line.id for line in pilot.feedback.of("blockProgress") if line.id.endswith(":end"))


def reached(pilot: RealizerPilot, behavior: str) -> list[Any]:
    return [id_.removeprefix(f"{behavior}:") for id_ in pilot.feedback.progress if id_.startswith(f"{behavior}:")]


@pytest.mark.parametrize("order", ORDERS, ids=["-".join(order) for order in ORDERS])
async def test_every_block_ends_once_after_interrupt_replace_and_activate_in_one_tick_in_any_order(
    pilot: RealizerPilot, order: Any
) -> None:
    pilot.block("talk", SPEECH)
    pilot.block("prepared", SPEECH, **{"bmla:preplan": "true"})
    await pilot.advance(0.1)
    for way in order:
        name, behaviors, attributes = WAYS[way]
        pilot.block(name, behaviors, **attributes)
    await pilot.advance(3)
    assert ends(pilot) == {f"{name}:end": 1 for name in ("talk", "prepared", *(name for name, *_ in WAYS.values()))}
    assert pilot.feedback.status("talk") == "INTERRUPTED"
    assert pilot.feedback.time("talk:end") == 0.1
    assert pilot.realizer.scheduler.blocks.alive == ()


async def test_blocks_that_activate_each_other_play_once(pilot: RealizerPilot) -> None:
    pilot.block("a", NOD, **{"bmla:preplan": "true", "bmla:onStart": "b"})
    pilot.block("b", NOD, **{"bmla:preplan": "true", "bmla:onStart": "a,b"})
    pilot.block("go", **{"bmla:onStart": "a"})
    await pilot.advance(2)
    assert ends(pilot) == {"a:end": 1, "b:end": 1, "go:end": 1}
    assert pilot.feedback.warnings == [("b", "IMPOSSIBLE_TO_SCHEDULE")] * 2


async def test_a_chunk_after_a_revoked_block_starts_at_once(pilot: RealizerPilot) -> None:
    pilot.block("gone", SPEECH, **{"bmla:preplan": "true"})
    pilot.block("i", '<bmla:interrupt id="i" target="gone"/>')
    await pilot.advance(0.5)
    pilot.block("next", NOD, **{"bmla:chunkAfter": "gone"})
    await pilot.tick()
    assert pilot.feedback.time("next:start") == 0.5
    assert pilot.feedback.warnings == []


async def test_one_character_may_interrupt_the_speech_of_another(tests_data: Path) -> None:
    async with open_pilot(SceneOptions(human=tests_data / "humans" / "two.toml", voice="text")) as pilot:
        pilot.block("talk", SPEECH, characterId="alice")
        pilot.block("stop", f'<bmla:interrupt id="i" target="talk" start="0.3"/>{SPEECH}', characterId="bob")
        await pilot.advance(2)
        assert (pilot.feedback.status("talk"), pilot.feedback.status("stop")) == ("INTERRUPTED", "DONE")
        assert pilot.feedback.time("talk:s:end") == 0.3
        assert pilot.feedback.warnings == []


async def test_a_speech_that_finishes_its_word_may_be_interrupted_before_the_end_of_the_word(
    pilot: RealizerPilot,
) -> None:
    pilot.block("talk", '<speech id="s"><text>one uninterruptible word</text></speech>')
    for number, (start, how) in enumerate([("0.3", "word"), ("0.4", "word"), ("0.5", "now")]):
        pilot.block(f"i{number}", f'<bmla:interrupt id="i" target="talk" start="{start}" speech="{how}"/>')
    await pilot.advance(3)
    (end,) = (line.element for line in pilot.feedback.of("syncPointProgress") if line.id == "talk:s:end")
    assert (pilot.feedback.time("talk:s:end"), end.get(f"{{{OWN}}}text")) == (0.5, "uninterruptible")
    assert ends(pilot)["talk:end"] == 1


@pytest.mark.parametrize("speech", ["now", "word"])
async def test_an_interrupt_at_the_end_of_its_target_has_no_effect(pilot: RealizerPilot, speech: str) -> None:
    pilot.block("talk", SPEECH)
    pilot.block("i", f'<bmla:interrupt id="i" target="talk" start="talk:s:end" speech="{speech}"/>')
    await pilot.advance(2)
    assert pilot.feedback.status("talk") == "DONE"
    assert reached(pilot, "talk:s") == ["start", "m", "end"]
    assert pilot.feedback.warnings == []


async def test_a_point_that_is_moved_many_times_in_a_tick_happens_once_at_its_last_time(pilot: RealizerPilot) -> None:
    pilot.block("b", '<gesture id="g" lexeme="BEAT" stroke="anticipators:t:hit"/>')
    for tick in range(60):
        for jitter in (0.2, -0.3, float("nan"), float("inf"), 0.01, 0.0):
            pilot.predict("t", "hit", 1.0 + jitter * (tick % 3))
        await pilot.tick()
    await pilot.advance(2)
    assert reached(pilot, "b:g") == ["start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end"]
    assert pilot.feedback.time("b:g:stroke") == 1.0
    predictions = Counter(line.time for line in pilot.feedback.predictions("b"))
    assert set(predictions.values()) == {1}


async def test_an_id_can_be_used_again_after_any_end_of_its_block(pilot: RealizerPilot) -> None:
    for turn in range(20):
        cut = '<bmla:interrupt id="i" target="same" start="0.05"/>' if turn % 2 else ""
        pilot.block("same", f'<wait id="w" duration="0.08"/>{cut}')
        await pilot.advance(0.1)
    assert ends(pilot) == {"same:end": 20}
    assert pilot.feedback.warnings == []


async def test_a_point_that_rounding_moves_after_an_interruption_is_reported_before_it(pilot: RealizerPilot) -> None:
    # The start of this gesture comes out as 2e-18 s.
    pilot.block("b", '<gesture id="g" lexeme="BEAT" stroke="g:relax" ready="0.4"/>')
    pilot.block("i", '<bmla:interrupt id="i" target="b"/>')
    await pilot.advance(1)
    assert [id_ for id_ in pilot.feedback.progress if id_.startswith("b:")] == [
        *("b:start", "b:g:start", "b:g:relax", "b:g:end", "b:end")
    ]


@pytest.mark.parametrize("strategy", ["convex", "embr", "smartbody"])
async def test_a_constraint_between_two_fixed_times_has_no_effect(strategy: str) -> None:
    constraints = [
        '<synchronize><sync ref="0"/><sync ref="0"/></synchronize>',
        '<before ref="1"><sync ref="1"/></before>',
        '<before ref="0.4"><sync ref="0.05"/></before>',
        '<after ref="anticipators:metronome:tick1"><sync ref="anticipators:metronome:tick2"/></after>',
    ]
    async with open_pilot(SceneOptions(voice="text", strategy=strategy)) as pilot:
        pilot.block("b", NOD + "".join(f"<constraint>{each}</constraint>" for each in constraints))
        await pilot.advance(1)
        assert pilot.feedback.status("b") == "DONE"
        assert reached(pilot, "b:n")[-1] == "end"
