"""Procedures: behaviors that are written once and played several times (thesis 6.6.2)."""

from collections.abc import Callable
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

T = 'xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt"'
TWO = Path(__file__).parents[1] / "data" / "humans" / "two.toml"
WELCOME = f"""
<bmlt:defineproc xmlns="http://www.bml-initiative.org/bml/bml-1.0" {T} id="welcome">
  <speech id="s" start="n:stroke"><text>Welcome, all of you!</text></speech>
  <head id="n" lexeme="NOD"/>
</bmlt:defineproc>
"""


def use(block: str, procedure: str = "welcome", more: str = "") -> str:
    return f'<bmlt:useproc {T} procid="{procedure}" bmlid="{block}" {more}/>'


async def test_a_use_plays_a_block_with_the_behaviors_and_constraints_of_the_procedure(pilot: RealizerPilot) -> None:
    pilot.perform(WELCOME)
    pilot.perform(use("one"))
    await pilot.advance(4)
    assert pilot.feedback.time("one:s:start") == pilot.feedback.time("one:n:stroke")
    assert pilot.feedback.status("one") == "DONE"


async def test_defining_plays_nothing(pilot: RealizerPilot) -> None:
    pilot.perform(WELCOME)
    await pilot.advance(1)
    assert pilot.feedback.messages == []


async def test_a_second_use_is_not_prepared_again(monkeypatch: pytest.MonkeyPatch) -> None:
    async with open_pilot() as pilot:
        asked: list[str] = []
        for engine in pilot.realizer.characters["alice"].engines:

            def prepare(behavior: Behavior, original: Callable[[Behavior], object] = engine.prepare) -> object:
                asked.append(behavior.id)
                return original(behavior)

            monkeypatch.setattr(engine, "prepare", prepare)
        pilot.perform(WELCOME)
        await pilot.tick()
        assert sorted(asked) == ["n", "s"]
        pilot.perform(use("one"))
        await pilot.advance(4)
        pilot.perform(use("two"))
        await pilot.advance(4)
        assert sorted(asked) == ["n", "s"]
        assert pilot.feedback.status("two") == "DONE"


async def test_uses_have_the_compositions_of_blocks(pilot: RealizerPilot) -> None:
    pilot.perform(WELCOME)
    pilot.perform(use("one"))
    pilot.perform(use("two", more='composition="APPEND"'))
    await pilot.advance(8)
    assert pilot.feedback.time("two:start") == pilot.feedback.time("one:end")


async def test_procedures_remain_after_a_replace_and_an_interrupted_use(pilot: RealizerPilot) -> None:
    pilot.perform(WELCOME)
    pilot.perform(use("one"))
    await pilot.advance(0.5)
    pilot.perform(use("two", more='composition="REPLACE"'))
    await pilot.advance(4)
    assert [pilot.feedback.status(block) for block in ("one", "two")] == ["INTERRUPTED", "DONE"]


async def test_a_second_definition_replaces_the_first(pilot: RealizerPilot) -> None:
    pilot.perform(WELCOME)
    pilot.perform(WELCOME.replace('lexeme="NOD"', 'lexeme="SHAKE"').replace('id="n"', 'id="m"').replace("n:", "m:"))
    pilot.perform(use("one"))
    await pilot.advance(4)
    assert pilot.feedback.reached("one:m:start")
    assert not pilot.feedback.reached("one:n:start")


async def test_a_use_of_an_unknown_procedure_is_refused_with_a_warning(pilot: RealizerPilot) -> None:
    pilot.perform(use("one", "nothing"))
    await pilot.advance(1)
    assert pilot.feedback.warnings == [("one", "NO_SUCH_TARGET")]
    assert pilot.feedback.progress == []


@pytest.mark.parametrize("character", ["alice", "bob"])
async def test_every_character_may_use_a_procedure(character: str) -> None:
    async with open_pilot(SceneOptions(voice="text", human=TWO)) as pilot:
        pilot.perform(WELCOME)
        pilot.perform(use("one", more=f'characterId="{character}"'))
        await pilot.advance(4)
        assert pilot.feedback.status("one") == "DONE"
