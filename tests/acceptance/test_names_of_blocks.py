"""Whose block an id names: one's own first, alive or ended; another character's only where one never had it."""

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
"""What the text voice takes for the speech, s."""
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
    """Whose blocks ended, when and how."""
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
async def test_what_names_ones_own_block_that_has_ended_leaves_those_of_others_alone(
    met: RealizerPilot, inside: Any, attributes: Any, warning: str | None
) -> None:
    met.block("new", inside, characterId="alice", **attributes)
    await met.advance(4)
    assert ("alice", "new:end", 0.5, "DONE") in ends(met)
    assert ("bob", "a:end", SPOKEN, "DONE") in ends(met)
    assert [text.partition(": ")[2] for text in texts(met)] == ([] if warning is None else [warning])


@pytest.mark.parametrize("attribute", ["appendAfter", "chunkAfter"])
async def test_who_waits_for_ones_own_block_that_has_ended_waits_for_nobody(met: RealizerPilot, attribute: str) -> None:
    met.block("new", characterId="alice", **{f"bmla:{attribute}": "a"})
    await met.tick()
    assert met.feedback.time("new:start") == 0.5
    assert texts(met) == []


async def test_an_id_that_one_never_had_is_looked_for_with_others(met: RealizerPilot) -> None:
    met.block("b", SPEECH, characterId="bob", composition="APPEND")
    await met.tick()
    met.block("new", nod("n", start="b:s:start"), characterId="alice", **{"bmla:appendAfter": "nobody"})
    await met.advance(5)
    assert met.feedback.time("new:n:start") == met.feedback.time("b:s:start")
    assert ["there has never been a block 'nobody'" in text for text in texts(met)] == [True]


async def test_an_id_that_is_in_use_again_means_the_new_block(met: RealizerPilot) -> None:
    met.block("a", '<wait id="w" duration="1"/>', characterId="alice")
    met.block("new", characterId="alice", **{"bmla:appendAfter": "a"})
    await met.advance(2)
    assert met.feedback.time("new:start") == 1.5


async def test_times_are_explained_of_ones_own_blocks_too(met: RealizerPilot) -> None:
    with pytest.raises(RealizerError, match="has ended"):
        met.realizer.scheduler.explain("alice", "a")
    assert met.realizer.scheduler.explain("bob", "a")["character"] == "bob"
