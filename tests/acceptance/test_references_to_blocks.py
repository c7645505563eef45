"""References to points of other blocks, in any order of the blocks."""

from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.assertions import assert_linked, assert_not_played
from reactive_realizer.testing.feedback_list import FeedbackList
from reactive_realizer.testing.pilot import RealizerPilot, block, open_pilot

from .living_time import WELL, nod, synchronize, texts, wait
from .parameter_changes import change

TALK = block("talk", WELL.format(""))
LISTEN = block("listen", nod("n", start="talk:s:end"))
MANY = 400
"""More blocks than Python allows nested calls if each takes three."""


async def played(pilot: RealizerPilot, *documents: str) -> FeedbackList:
    for document in documents:
        pilot.perform(document)
    await pilot.advance(4)
    return pilot.feedback


@pytest.mark.parametrize("documents", [[TALK + LISTEN], [LISTEN + TALK], [TALK, LISTEN], [LISTEN, TALK]])
async def test_a_block_may_refer_to_an_earlier_or_a_later_block(pilot: RealizerPilot, documents: Any) -> None:
    told = await played(pilot, *documents)
    assert_linked(told, "listen:n:start", "talk:s:end")
    assert told.warnings == []


@pytest.mark.parametrize("characters", ["alice bob", "bob alice"])
@pytest.mark.parametrize("first", ["talk", "listen"])
async def test_references_between_characters_do_not_depend_on_the_order_of_blocks(
    tests_data: Path, characters: str, first: str
) -> None:
    speaker, listener = characters.split()
    both = [
        block("talk", WELL.format(""), characterId=speaker),
        block("listen", nod("n", start="talk:s:end"), characterId=listener),
    ]
    options = SceneOptions(human=tests_data / "humans" / "two.toml", voice="text", verify=True)
    async with open_pilot(options) as pilot:
        told = await played(pilot, *(both if first == "talk" else reversed(both)))
    assert_linked(told, "listen:n:start", "talk:s:end")
    assert told.warnings == []


async def test_a_constraint_may_refer_to_a_later_block(pilot: RealizerPilot) -> None:
    told = await played(pilot, block("listen", nod("n") + synchronize("n:stroke", "talk:s:m")) + TALK)
    assert_linked(told, "listen:n:stroke", "talk:s:m")
    assert told.warnings == []


async def test_a_block_may_refer_to_a_later_preplanned_block(pilot: RealizerPilot) -> None:
    pilot.perform(LISTEN + block("talk", WELL.format(""), **{"bmla:preplan": "true"}))
    await pilot.advance(0.5)
    assert not pilot.feedback.reached("listen:n:start")
    told = await played(pilot, block("go", **{"bmla:onStart": "talk"}))
    assert_linked(told, "listen:n:start", "talk:s:end")
    assert told.warnings == []


async def test_the_warning_of_a_missing_behavior_of_a_later_block_lists_its_behaviors(pilot: RealizerPilot) -> None:
    told = await played(pilot, block("listen", nod("n", start="talk:x:end")) + TALK)
    assert ["talk:x:end: there is no behavior 'x'; available: s" in text for text in texts(pilot)] == [True]
    assert_not_played(told, "listen:n")


async def test_a_reference_to_a_block_that_is_interrupted_before_its_planning_is_reported(pilot: RealizerPilot) -> None:
    told = await played(pilot, LISTEN + TALK + block("stop", **{"bmla:interrupt": "talk"}))
    assert ["'talk'" in text and "talk:s:end" in text for text in texts(pilot)] == [True]
    assert told.status("listen") == "DONE"


async def test_one_of_two_mutual_references_is_dropped_with_a_warning(pilot: RealizerPilot) -> None:
    one = block("one", wait("v", 0.5) + nod("n", start="two:w:end"))
    two = block("two", wait("w", 0.5) + nod("m", start="one:v:end"))
    told = await played(pilot, one + two)
    (said,) = told.of("warningFeedback")
    assert said.id == "two:m"
    assert (
        "one:v:end: 'one' is not planned before 'two', because it refers to it directly or through other blocks"
        in said.text
    )
    assert_not_played(told, "two:m")
    assert_linked(told, "one:n:start", "two:w:end")


async def test_two_behaviors_that_wait_for_each_other_both_get_a_warning(pilot: RealizerPilot) -> None:
    await played(pilot, block("one", nod("n", start="two:m:end")) + block("two", nod("m", start="one:n:end")))
    told = {line.id: line.text for line in pilot.feedback.of("warningFeedback")}
    assert "one:n:end: 'one' is not planned before 'two'" in told["two:m"]
    assert "two:m" in told["one:n"]
    assert len(texts(pilot)) == len(told) == 2
    assert pilot.feedback.status("one") == pilot.feedback.status("two") == "DONE"


async def test_a_block_that_is_being_solved_cannot_refer_to_blocks_that_enter_later(pilot: RealizerPilot) -> None:
    pilot.block("big", "".join(wait(f"w{number}", 0.1) for number in range(60)) + nod("n", start="late:w:end"))
    await pilot.tick()
    told = await played(pilot, block("late", wait("w", 0.5, start="big:w0:end")))
    assert [line.id for line in told.of("warningFeedback")] == ["big:n"]
    assert_linked(told, "late:w:start", "big:w0:end")


async def test_a_cycle_of_several_blocks_loses_one_reference(pilot: RealizerPilot) -> None:
    ids = ["a", "b", "c", "d"]
    circle = [
        block(each, wait("w", 0.3) + nod("n", start=f"{following}:w:end"))
        for each, following in zip(ids, [*ids[1:], ids[0]], strict=True)
    ]
    told = await played(pilot, "".join(circle))
    assert [line.id for line in told.of("warningFeedback")] == ["d:n"]
    for each, following in pairwise(ids):
        assert_linked(told, f"{each}:n:start", f"{following}:w:end")


@pytest.mark.parametrize("first", ["talk", "louder"])
async def test_a_parameter_change_of_a_block_that_refers_back_is_no_cycle(pilot: RealizerPilot, first: str) -> None:
    talk = block("talk", WELL.format(' start="louder:w:end"'))
    louder = block("louder", wait("w", 0.5) + change("p", 'start="1" end="1.5"', target="talk:s"))
    told = await played(pilot, talk + louder if first == "talk" else louder + talk)
    assert_linked(told, "talk:s:start", "louder:w:end")
    assert told.reached("louder:p:end")
    assert told.warnings == []


@pytest.mark.parametrize("step", [1, -1])
async def test_a_long_chain_of_references_through_a_document_is_planned_within_three_fifths_of_a_second(
    pilot: RealizerPilot, step: int
) -> None:
    def link(number: int) -> str:
        named = number + step
        return wait("w", 0.2, **({"start": f"b{named}:w:start"} if 0 <= named < MANY else {}))

    pilot.perform("".join(block(f"b{number}", link(number)) for number in range(MANY)))
    await pilot.advance(0.6)
    starts = [line for line in pilot.feedback.of("syncPointProgress") if line.id.endswith(":w:start")]
    assert len(starts) == MANY
    assert pilot.feedback.warnings == []
