"""Ids of blocks: they refer to blocks of the same character first, and else to those of other characters."""

from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import BMLA
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .living_time import nod, texts

STATUS = f"{{{BMLA}}}status"
SPOKEN = 1.62
"""The duration of the speech with the text voice, s."""
SPEECH = '<speech id="s"><text>one two three four five six</text></speech>'
LOUDER = (
    '<bmla:parametervaluechange id="p" target="a:s" paramId="volume" start="0">'
    '<bmla:trajectory type="instant" targetValue="90"/></bmla:parametervaluechange>'
)


@pytest.fixture
async def two(tests_data: Path) -> AsyncIterator[RealizerPilot]:
    options = SceneOptions(human=tests_data / "humans" / "two.toml", voice="text", verify=True)
    async with open_pilot(options) as pilot:
        yield pilot


@pytest.fixture
async def met(two: RealizerPilot) -> RealizerPilot:
    """Alice's block a has ended, bob's plays."""
    two.block("a", '<wait id="w" duration="0.3"/>', characterId="alice")
    two.block("a", SPEECH, characterId="bob")
    await two.advance(0.5)
    return two


def ends(pilot: Any) -> list[tuple[Any, Any, Any, Any]]:
    """The ends of blocks: character, id, time and status."""
    lines = [line for line in pilot.feedback.of("blockProgress") if line.id.endswith(":end")]
    return [(line.element.get("characterId"), line.id, line.global_time, line.element.get(STATUS)) for line in lines]


@pytest.mark.parametrize(
    ("inside", "attributes", "warning"),
    [
        ('<bmla:interrupt id="i" target="a"/>', {}, None),
        ("", {"bmla:interrupt": "a"}, None),
        ("", {"bmla:prependBefore": "a"}, None),
        (LOUDER, {}, "the block 'a' has ended"),
        ('<bmla:activate id="i" target="a"/>', {}, "the block 'a' has ended"),
        ("", {"bmla:onStart": "a"}, "the block 'a' has ended"),
        (nod("n", start="a:s:end"), {}, "a:s:end: the block 'a' is unknown or has ended"),
    ],
)
async def test_a_reference_to_an_ended_block_of_the_character_does_not_affect_equal_ids_of_others(
    met: RealizerPilot, inside: Any, attributes: Any, warning: str | None
) -> None:
    met.block("new", inside, characterId="alice", **attributes)
    await met.advance(4)
    assert ("alice", "new:end", 0.5, "DONE") in ends(met)
    assert ("bob", "a:end", SPOKEN, "DONE") in ends(met)
    assert [text.partition(": ")[2] for text in texts(met)] == ([] if warning is None else [warning])


@pytest.mark.parametrize("attribute", ["appendAfter", "chunkAfter"])
async def test_a_block_appended_to_an_ended_block_of_its_character_starts_at_once(
    met: RealizerPilot, attribute: str
) -> None:
    met.block("new", characterId="alice", **{f"bmla:{attribute}": "a"})
    await met.tick()
    assert met.feedback.time("new:start") == 0.5
    assert texts(met) == []


async def test_an_id_that_a_character_never_had_refers_to_other_characters(met: RealizerPilot) -> None:
    met.block("b", SPEECH, characterId="bob", composition="APPEND")
    await met.tick()
    met.block("new", nod("n", start="b:s:start"), characterId="alice", **{"bmla:appendAfter": "nobody"})
    await met.advance(5)
    assert met.feedback.time("new:n:start") == met.feedback.time("b:s:start")
    assert ["there has never been a block 'nobody'" in text for text in texts(met)] == [True]


async def test_an_id_that_is_used_again_refers_to_the_new_block(met: RealizerPilot) -> None:
    met.block("a", '<wait id="w" duration="1"/>', characterId="alice")
    met.block("new", characterId="alice", **{"bmla:appendAfter": "a"})
    await met.advance(2)
    assert met.feedback.time("new:start") == 1.5


async def test_explanations_resolve_ids_in_the_same_way(met: RealizerPilot) -> None:
    with pytest.raises(RealizerError, match="has ended"):
        met.realizer.scheduler.explain("alice", "a")
    assert met.realizer.scheduler.explain("bob", "a")[0].character == "bob"
