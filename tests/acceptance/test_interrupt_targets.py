"""Targets of `interrupt` and `activate`, and the warnings if there is nothing to do."""

import asyncio
from collections.abc import AsyncIterator

import pytest

from reactive_realizer.clock.ticker import Tick
from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.testing.pilot import RealizerPilot

TALK = '<speech id="s"><text>one two three <sync id="m"/>four five six</text></speech>'
BEAT = '<gesture id="g" lexeme="BEAT" start="0.2"/>'
PREPLAN = {"bmla:preplan": "true"}


def told_of(pilot: RealizerPilot, block: str) -> list[str]:
    return [point for point in pilot.feedback.progress if point.startswith(f"{block}:")]


async def test_interrupting_an_ended_block_has_no_effect_and_an_unknown_one_is_reported(pilot: RealizerPilot) -> None:
    pilot.block("old", '<wait id="w" duration="0.1"/>')
    await pilot.advance(0.5)
    pilot.block("stop", '<bmla:interrupt id="i" target="old"/><bmla:interrupt id="j" target="nobody"/>')
    await pilot.advance(0.5)
    assert pilot.feedback.warnings == [("stop:j", "NO_SUCH_TARGET")]
    assert told_of(pilot, "stop") == [
        "stop:start",
        "stop:i:start",
        "stop:i:end",
        "stop:j:start",
        "stop:j:end",
        "stop:end",
    ]
    assert pilot.feedback.status("stop") == "DONE"


@pytest.mark.parametrize("whom", ['include="x"', 'exclude="s,x"'])
async def test_an_interrupt_of_unknown_behaviors_only_causes_one_warning(pilot: RealizerPilot, whom: str) -> None:
    pilot.block("talk", TALK)
    pilot.block("stop", f'<bmla:interrupt id="i" target="talk" {whom}/>')
    await pilot.advance(3)
    assert pilot.feedback.warnings == [("stop:i", "NO_SUCH_TARGET")]
    assert told_of(pilot, "stop") == ["stop:start", "stop:end"]
    assert pilot.feedback.status("talk") == "DONE"


@pytest.mark.parametrize("whom", ['include="s,x"', 'exclude="g,x"'])
async def test_an_interrupt_ends_those_of_its_behaviors_that_exist(pilot: RealizerPilot, whom: str) -> None:
    pilot.block("talk", TALK + BEAT)
    pilot.block("stop", f'<bmla:interrupt id="i" target="talk" start="0.5" {whom}/>')
    await pilot.advance(3)
    assert pilot.feedback.warnings == [("stop:i", "NO_SUCH_TARGET")]
    assert pilot.feedback.time("talk:s:end") == pilot.feedback.time("stop:i:end") == 0.5
    assert pilot.feedback.status("talk") == "DONE"


async def test_background_work_for_an_interrupted_block_is_cancelled(
    pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def never(self: TextVoice, *said: object) -> AsyncIterator[Utterance]:
        await asyncio.Event().wait()
        yield Utterance("", 0.0, (), {})

    monkeypatch.setattr(TextVoice, "synthesize", never)
    pilot.block("talk", TALK)
    pilot.block("stop", '<bmla:interrupt id="i" target="talk"/>')
    await pilot.realizer.step(Tick.on_time(0, frame=False))
    assert pilot.feedback.status("talk") == "REVOKED"
    async with asyncio.timeout(5):
        await pilot.realizer.settle()


async def test_a_parameter_change_of_a_behavior_interrupted_in_the_same_tick_has_no_effect(
    pilot: RealizerPilot,
) -> None:
    pilot.block("talk", TALK)
    change = '<bmla:trajectory type="linear" targetValue="90"/>'
    pilot.block(
        "b",
        '<bmla:interrupt id="i" target="talk" start="0.501"/>'
        f'<bmla:parametervaluechange id="v" target="talk:s" paramId="volume" start="0.505">{change}'
        "</bmla:parametervaluechange>",
    )
    await pilot.advance(2)
    assert pilot.feedback.warnings == [("b:v", "IMPOSSIBLE_TO_SCHEDULE")]
    assert told_of(pilot, "b") == ["b:start", "b:i:start", "b:i:end", "b:end"]


async def test_an_interrupt_tied_to_a_block_that_is_revoked_is_dropped(pilot: RealizerPilot) -> None:
    pilot.block("first", '<wait id="w" duration="1"/>')
    pilot.block("next", '<head id="n" lexeme="NOD"/>', **{"bmla:appendAfter": "first"})
    pilot.block("talk", '<wait id="w" duration="2"/>')
    pilot.block("lost", '<bmla:interrupt id="j" target="talk" start="next:n:start"/>')
    pilot.block("stop", '<bmla:interrupt id="i" target="next" start="1"/>')
    await pilot.advance(3)
    assert pilot.feedback.warnings == [("lost:j", "IMPOSSIBLE_TO_SCHEDULE")]
    assert [pilot.feedback.status(block) for block in ("next", "talk")] == ["REVOKED", "DONE"]


async def test_an_empty_waiting_block_can_be_revoked(pilot: RealizerPilot) -> None:
    pilot.block("empty", **PREPLAN)
    await pilot.tick()
    pilot.block("stop", '<bmla:interrupt id="i" target="empty"/>')
    await pilot.advance(1)
    assert pilot.feedback.status("empty") == "REVOKED"


@pytest.mark.parametrize(("block", "start"), [("talk", "s:end-0.5"), ("stop", "talk:s:end-0.5")])
async def test_an_interrupt_may_be_tied_to_its_target(pilot: RealizerPilot, block: str, start: str) -> None:
    inside = f'<bmla:interrupt id="i" target="talk" start="{start}"/>'
    pilot.block("talk", TALK + (inside if block == "talk" else ""))
    if block == "stop":
        pilot.block("stop", inside)
    await pilot.tick()
    expected = pilot.feedback.predicted("talk:s:end") - 0.5
    await pilot.advance(3)
    assert pilot.feedback.time("talk:s:end") == pilot.feedback.time(f"{block}:i:end") == pytest.approx(expected)
    assert pilot.feedback.warnings == []


async def test_two_blocks_that_interrupt_each_other_at_one_time_both_end(pilot: RealizerPilot) -> None:
    for own, other in ("ab", "ba"):
        pilot.block(own, f'{BEAT}<bmla:interrupt id="i" target="{other}" start="0.5"/>')
    await pilot.advance(3)
    assert [pilot.feedback.status(block) for block in "ab"] == ["INTERRUPTED"] * 2
    assert [pilot.feedback.time(f"{block}:i:end") for block in "ab"] == [0.5, 0.5]
    assert pilot.feedback.warnings == []


async def test_an_invalid_activation_is_reported(pilot: RealizerPilot) -> None:
    pilot.block("plain", '<wait id="w" duration="0.1"/>')
    pilot.block("ready", TALK, **PREPLAN)
    inside = "".join(
        f'<bmla:activate id="a{i}" target="{target}"/>' for i, target in enumerate(("plain", "ready", "ready", "x"))
    )
    pilot.block("go", inside)
    await pilot.advance(0.5)
    assert sorted(pilot.feedback.warnings) == [
        ("go:a0", "IMPOSSIBLE_TO_SCHEDULE"),
        ("go:a2", "IMPOSSIBLE_TO_SCHEDULE"),
        ("go:a3", "NO_SUCH_TARGET"),
    ]
    assert pilot.feedback.reached("ready:start")
    assert told_of(pilot, "go") == ["go:start", "go:a1:start", "go:a1:end", "go:end"]


async def test_a_behavior_tied_to_an_activate_without_a_target_keeps_its_time_with_a_warning(
    pilot: RealizerPilot,
) -> None:
    pilot.block("go", '<bmla:activate id="a" target="x" start="0.5"/><head id="h" lexeme="NOD" start="a:start+0.5"/>')
    await pilot.advance(3)
    assert pilot.feedback.warnings == [("go:a", "NO_SUCH_TARGET"), ("go:h", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.time("go:h:start") == 1.0
    assert not pilot.feedback.reached("go:a:start")
