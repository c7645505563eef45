"""docs/continuous.md: its examples play as described, and its table of faults matches the warnings."""

import re
from collections.abc import Callable, Mapping

import pytest

from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML, BMLA, BMLT, OWN
from reactive_realizer.errors import FAULTS
from reactive_realizer.limits import Limits
from reactive_realizer.scheduler.block_state import BlockState
from reactive_realizer.testing.pilot import open_pilot

from .conftest import Fence, fences, page

PAGE = "docs/continuous.md"
EXAMPLES = fences(PAGE, "xml")
ROWS = re.findall(r"^\| .* \| `([a-z-]+)` \| ([A-Z_]+) \|$", page(PAGE), re.MULTILINE)

REPORTED = [
    dict(re.findall(r'(\w+)="(.*?)"', line)) for line in re.findall(r"^ {4}<syncPoint.*$", page(PAGE), re.MULTILINE)
]

WORDS = '<speech id="words"><text>one two three</text></speech>'
CHANGE = (
    '<bmla:parametervaluechange id="x" target="{}" paramId="{}" start="{}">'
    '<bmla:trajectory type="{}" targetValue="{}"/></bmla:parametervaluechange>'
)
CUT = '<bmla:interrupt id="x" target="talk" {}/>'

WRONG = {
    "unknown-target-block": [("b", "", 'bmla:appendAfter="nobody"')],
    "started-already": [("talk", WORDS, ""), ("b", "", 'bmla:prependBefore="talk"')],
    "cyclic-composition": [
        ("talk", WORDS, ""),
        ("next", WORDS, 'composition="APPEND"'),
        ("b", "", 'bmla:appendAfter="next" bmla:prependBefore="next"'),
    ],
    "cyclic-reference": [
        ("talk", WORDS, ""),
        ("next", WORDS, 'composition="APPEND"'),
        ("b", '<head id="x" lexeme="NOD" start="next:words:start"/>', 'bmla:prependBefore="next"'),
    ],
    "no-such-block": [("b", '<bmla:interrupt id="x" target="nobody"/>', "")],
    "block-ended": [("old", "", ""), ("b", '<bmla:activate id="x" target="old"/>', "")],
    "not-preplanned": [("talk", WORDS, ""), ("b", '<bmla:activate id="x" target="talk"/>', "")],
    "activated-already": [
        ("talk", WORDS, 'bmla:preplan="true"'),
        ("a", "", 'bmla:onStart="talk"'),
        ("b", '<bmla:activate id="x" target="talk"/>', ""),
    ],
    "no-such-behavior": [("talk", WORDS, ""), ("b", CUT.format('include="nobody"'), "")],
    "behavior-ended": [
        ("talk", WORDS + '<wait id="w" duration="9"/>', ""),
        ("b", CHANGE.format("talk:words", "volume", 5, "linear", 1), ""),
    ],
    "no-such-parameter": [("talk", WORDS, ""), ("b", CHANGE.format("talk:words", "pitch", 0, "linear", 1), "")],
    "no-trajectory": [("talk", WORDS, ""), ("b", CHANGE.format("talk:words", "volume", 0, "wavy", 1), "")],
    "parameter-range": [("talk", WORDS, ""), ("b", CHANGE.format("talk:words", "volume", 0, "linear", 101), "")],
    "cut-tie": [
        ("talk", WORDS + '<head id="x" lexeme="NOD" start="words:end"/>', ""),
        ("b", CUT.format('include="words"'), ""),
    ],
    "late-tie": [("talk", WORDS, ""), ("b", '<head id="x" lexeme="NOD" end="talk:start"/>', "")],
    "passed-moment": [
        ("talk", WORDS, ""),
        ("b", '<head id="x" lexeme="NOD" start="anticipators:metronome:tick0"/>', ""),
    ],
    "resource-taken": [("talk", WORDS, ""), ("b", WORDS, "")],
    "waits-for-itself": [("b", '<wait id="x" event="go" start="x:end+1"/>', "")],
    "unknown-procedure": [],
}
"""The blocks that cause the fault of each row of the table."""


def block(id_: str, inside: str, attributes: str) -> str:
    return f'<bml xmlns="{BML}" xmlns:bmla="{BMLA}" id="{id_}" {attributes}>{inside}</bml>'


def ends(example: Fence) -> dict[str, str]:
    """The final status of each block of an example."""
    said = dict(each.split() for each in example.note.removeprefix("ends: ").split(", ") if each)
    blocks = [parsed.block.id for parsed in parse(example.text, Limits()) if parsed.block]
    return dict.fromkeys(blocks, "DONE") | said


@pytest.mark.parametrize("example", EXAMPLES, ids=str)
async def test_every_block_of_an_example_ends_as_the_page_says_and_without_a_warning(example: Fence) -> None:
    async with open_pilot() as pilot:
        pilot.perform(example.text)
        await pilot.advance(4)
        pilot.event("spacebar", "release")
        await pilot.advance(8)
        assert {id_: pilot.feedback.status(id_) for id_ in ends(example)} == ends(example)
        assert pilot.feedback.warnings == []


@pytest.mark.parametrize(("contains", "shown"), [*zip(['speech="word"', "rr:words"], REPORTED, strict=True)])
async def test_speech_is_reported_as_on_the_page(contains: str, shown: Mapping[str, str]) -> None:
    example = next(each for each in EXAMPLES if contains in each.text)
    async with open_pilot() as pilot:
        pilot.perform(example.text)
        await pilot.advance(5)
        (told,) = [line.element for line in pilot.feedback.messages if line.id == shown["id"]]
    assert {str(name).rpartition("}")[2]: value for name, value in told.items()}.items() >= shown.items()


async def test_the_program_on_the_page_finds_the_rest_of_an_interrupted_speech_with_any_white_space() -> None:
    (code,) = fences(PAGE, "python")
    found: dict[str, Callable[[str, int], str]] = {}
    exec(code.text, found)
    text = "\n  It is   quite \u00e9 \U0001f680 close\n\tto the station,  and   not far.\n"
    marked = text.replace("close", '<sync id="m"/> close')
    async with open_pilot() as pilot:
        pilot.block("talk", f'<speech id="s"><text>{marked}</text></speech>')
        pilot.block("stop", '<bmla:interrupt id="x" target="talk" start="talk:s:m+0.1" speech="word"/>')
        await pilot.advance(5)
        (told,) = [line.element for line in pilot.feedback.messages if line.id == "talk:s:end"]
    assert told.get(f"{{{OWN}}}text") == "close"
    assert found["rest"](text, int(told.get(f"{{{OWN}}}heard", ""))) == " to the station, and not far."


@pytest.mark.parametrize(("code", "warning"), ROWS)
async def test_each_fault_in_the_table_causes_its_warning(code: str, warning: str) -> None:
    assert FAULTS[code].warning == warning
    sentence = re.sub(r"\\\{.*?\\\}", ".*", re.escape(FAULTS[code].template))
    async with open_pilot() as pilot:
        for each in WRONG[code]:
            pilot.perform(block(*each))
            await pilot.tick()
        if code == "unknown-procedure":
            pilot.perform(f'<bmlt:useproc xmlns:bmlt="{BMLT}" procid="x" bmlid="b"/>')
        await pilot.advance(6)
        told = pilot.feedback.of("warningFeedback")
        assert [each.element.get("type") for each in told] == [warning]
        assert re.search(sentence, told[0].text)


def test_the_page_lists_every_status() -> None:
    listed = re.findall(r"^\| ([A-Z_]+) \| ", page(PAGE), re.MULTILINE)
    assert set(listed) == {state.value for state in BlockState}
