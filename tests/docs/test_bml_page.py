"""docs/bml.md: its examples play without other warnings than those on the page."""

import re

import pytest
from lxml import etree

from reactive_realizer.bml.document import parse
from reactive_realizer.limits import Limits
from reactive_realizer.testing.feedback_list import FeedbackList
from reactive_realizer.testing.pilot import open_pilot

from .conftest import Fence, fences, page

EXAMPLES = fences("docs/bml.md", "xml")


def said_to_warn(example: Fence) -> list[tuple[str, str]]:
    """Id and type of the warnings that the page announces."""
    said = example.note.removeprefix("warns: ")
    return [(id_, type_) for id_, _, type_ in (one.partition(" ") for one in said.split(", ") if one)]


async def feedback_of(example: Fence) -> FeedbackList:
    async with open_pilot() as pilot:
        pilot.perform(example.text)
        await pilot.advance(12)
        return pilot.feedback


@pytest.mark.parametrize("example", EXAMPLES, ids=str)
async def test_every_block_of_an_example_ends_with_the_warnings_of_the_page_only(example: Fence) -> None:
    blocks = [parsed.block.id for parsed in parse(example.text, Limits()) if parsed.block]
    assert blocks
    feedback = await feedback_of(example)
    assert {block: feedback.status(block) for block in blocks} == dict.fromkeys(blocks, "DONE")
    assert feedback.warnings == said_to_warn(example)


async def test_a_warning_on_the_page_has_the_reported_text() -> None:
    told = [
        line.element
        for each in EXAMPLES
        if said_to_warn(each)
        for line in (await feedback_of(each)).of("warningFeedback")
    ]
    shown = [
        etree.fromstring(line) for line in re.findall(r"^ {4}(<warningFeedback .*)$", page("docs/bml.md"), re.MULTILINE)
    ]
    assert shown
    for warning in shown:
        assert (warning.get("id"), warning.get("type"), warning.text) in [
            (w.get("id"), w.get("type"), w.text) for w in told
        ]


def test_the_page_has_examples() -> None:
    assert len(EXAMPLES) > 8
