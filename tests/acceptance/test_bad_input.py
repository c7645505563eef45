"""Errors in blocks are reported with name, line and reason, and everything else plays."""

import re

import pytest

from anticipators.metronome import Metronome
from reactive_realizer.testing.pilot import RealizerPilot

FINE = '<wait id="fine" duration="0.2"/>'

# What stands on line 2 of the block; the id of its warning, its type, and what the reason mentions.
BAD = [
    ('<teleport id="x"/>', "b:x", "BEHAVIOR_TYPE_NOT_SUPPORTED", "<teleport>"),
    ('<magic xmlns="urn:other" id="x"/>', "b:x", "CUSTOM_BEHAVIOUR_NOT_SUPPORTED", "urn:other"),
    ('<head id="x" lexeme="NOD" speed="9"/>', "b:x", "PARSING_FAILURE", "speed"),
    ('<head id="x" lexeme="NOD" amount="NaN"/>', "b:x", "PARSING_FAILURE", "NaN"),
    ('<head id="x" lexeme="NOD" amount="-1"/>', "b:x", "PARSING_FAILURE", "-1"),
    ('<head id="x" lexeme="NOD" start="1e300"/>', "b:x", "PARSING_FAILURE", "86400"),
    ('<wait id="x" duration="-3"/>', "b:x", "PARSING_FAILURE", "-3"),
    ('<head id="fine" lexeme="NOD"/>', "b:fine", "PARSING_FAILURE", "fine"),
    ('<head lexeme="NOD"/>', "b", "PARSING_FAILURE", "id"),
    ('<gaze id="x" target="nowhere"/>', "b:x", "NO_SUCH_TARGET", "nowhere"),
    ('<gesture id="x" lexeme="SAMBA"/>', "b:x", "CANNOT_CREATE_BEHAVIOR", "SAMBA"),
    ('<head id="x" lexeme="NOD" start="nobody:end"/>', "b:x", "IMPOSSIBLE_TO_SCHEDULE", "nobody"),
    ('<head id="x" lexeme="NOD" start="fine:stroke"/>', "b:x", "IMPOSSIBLE_TO_SCHEDULE", "stroke"),
    ('<head id="x" lexeme="NOD" start="other:fine:end"/>', "b:x", "IMPOSSIBLE_TO_SCHEDULE", "other"),
    ('<head id="x" lexeme="NOD" start="-1"/>', "b:x", "IMPOSSIBLE_TO_SCHEDULE", "the start of the block by 1.00 s"),
    ('<head id="x" lexeme="NOD" start="2" end="1"/>', "b:x", "IMPOSSIBLE_TO_SCHEDULE", "x:end = 1 is dropped"),
    ('<head id="x" lexeme="NOD" start="2" end="2"/>', "b:x", "IMPOSSIBLE_TO_SCHEDULE", "x:end = 2 is dropped"),
    ('<faceLexeme id="x" lexeme="RAISE_BROWS" start="2" end="2"/>', "b:x", "IMPOSSIBLE_TO_SCHEDULE", "no time is left"),
    ('<wait id="x" start="1" end="3" duration="1"/>', "b:x", "IMPOSSIBLE_TO_SCHEDULE", "x:end"),
    ('<head id="x" lexeme="NOD" start="x:start+1"/>', "b:x", "IMPOSSIBLE_TO_SCHEDULE", "x:start"),
    (
        '<constraint><synchronize><sync ref="fine:start"/><sync ref="fine:end+1"/></synchronize></constraint>',
        "b",
        "IMPOSSIBLE_TO_SCHEDULE",
        "fine:end",
    ),
    (
        '<constraint><synchronize><sync ref="fine:start"/><sync ref="nobody:end"/></synchronize></constraint>',
        "b",
        "IMPOSSIBLE_TO_SCHEDULE",
        "nobody",
    ),
]


@pytest.mark.parametrize(("bad", "id_", "kind", "mentions"), BAD, ids=[bad for bad, *_ in BAD])
async def test_each_error_in_a_block_causes_one_warning_and_the_rest_plays(
    pilot: RealizerPilot, bad: str, id_: str, kind: str, mentions: str
) -> None:
    pilot.block("b", f"{FINE}\n{bad}")
    pilot.block("after", FINE, composition="APPEND")
    await pilot.advance(5)
    told = pilot.feedback
    assert told.warnings == [(id_, kind)]
    text = told.of("warningFeedback")[0].text
    assert re.match(r"line [12], column \d+: ", text)
    assert mentions in text
    assert told.reached("b:fine:end")
    assert told.status("b") == told.status("after") == "DONE"


REFUSED = [
    ("<bml>", "bml", "PARSING_FAILURE", "line 1"),
    ('<bml id="b"><head id="x"</bml>', "b", "PARSING_FAILURE", "line 1"),
    ("<bml id=''><wait/></bml>", "bml", "PARSING_FAILURE", "no id"),
    ("<!DOCTYPE bml [<!ENTITY a 'b'>]><bml id='b'/>", "bml", "PARSING_FAILURE", "DOCTYPE"),
    ("<html/>", "bml", "PARSING_FAILURE", "html"),
    ("", "bml", "PARSING_FAILURE", "no bml block"),
    (b"\x00\xff\xfe\x01", "bml", "PARSING_FAILURE", ""),
    ('<bml id="b" characterId="carol"/>', "b", "NO_SUCH_TARGET", "alice"),
    ('<bml id="b" character="Prudence"/>', "b", "NO_SUCH_TARGET", "no character 'Prudence'"),
    ('<act><bml id="b" character="Poppy"/></act>', "b", "NO_SUCH_TARGET", "no character 'Poppy'"),
]


@pytest.mark.parametrize(("text", "id_", "kind", "mentions"), REFUSED, ids=[repr(text) for text, *_ in REFUSED])
async def test_text_without_a_valid_block_is_refused_with_one_warning(
    pilot: RealizerPilot, text: bytes | str, id_: str, kind: str, mentions: str
) -> None:
    pilot.block("fine", FINE)
    pilot.perform(text)
    await pilot.advance(1)
    assert pilot.feedback.warnings == [(id_, kind)]
    assert mentions in pilot.feedback.of("warningFeedback")[0].text
    assert pilot.feedback.progress == ["fine:start", "fine:fine:start", "fine:fine:end", "fine:end"]
    assert pilot.realizer.scheduler.refused == 1


async def test_an_invalid_input_is_skipped_and_the_others_enter(pilot: RealizerPilot) -> None:
    pilot.event("metronome", "tempo", -5)
    pilot.predict("test", "hit", float("nan"))
    pilot.event("nobody", "press")
    pilot.move("nothing", None)
    pilot.block("b", FINE)
    await pilot.advance(1)
    assert pilot.feedback.status("b") == "DONE"
    metronome = pilot.realizer.anticipators["metronome"]
    assert isinstance(metronome, Metronome)
    assert metronome.tempo == 60


async def test_blocks_above_the_limit_are_refused_and_may_be_sent_again_later(pilot: RealizerPilot) -> None:
    limit = pilot.realizer.limits.blocks_alive
    pilot.block("first", FINE)
    for number in range(limit + 2):
        pilot.block(f"b{number}", '<head id="h" lexeme="NOD" start="anticipators:test:go"/>' if number else "")
    await pilot.advance(5)
    assert pilot.feedback.warnings == [(f"b{limit + 1}", "PARSING_FAILURE")]
