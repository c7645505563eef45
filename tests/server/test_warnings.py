"""Warnings in the answer to a document: what is known at once to be wrong with it."""

import re
from typing import Any

import pytest
from lxml import etree

from .conftest import ALICE, BML, OnAir, Open, Socket, post, wait

SCENE = ALICE + "[target.viewer]\nposition = [0.0, 1.6, 2.0]\n"
BMLT = 'xmlns:x="http://hmi.ewi.utwente.nl/bmlt"'


def block(inside: str, id_: str = "b", attributes: str = "") -> str:
    """A block that begins in line 1, with its content in line 2."""
    return f'<bml {BML} {BMLT} id="{id_}" {attributes}>\n{inside}</bml>'


async def warnings_of(air: OnAir, document: str) -> list[dict[str, Any]]:
    status, answer = await post(air, "/bml", document)
    assert status == 202
    warnings: list[dict[str, Any]] = answer["warnings"]
    return warnings


MISTAKES = {
    '<speach id="s"/>': ("b:s", "unknown-behavior", "<speach> is not a behavior of BML 1.0", "speech"),
    '<gesture id="g" lexeme="BEAT" strok="1"/>': ("b:g", "unknown-attribute", "unknown attribute strok", "stroke"),
    '<gesture id="g" lexeme="BEAT" mode="LEFT"/>': ("b:g", "bad-attribute", "mode='LEFT' of <gesture>", None),
    '<gesture id="g" lexeme="DANCE"/>': ("b:g", "no-motion-for", "plays <gesture> with lexeme='DANCE'", None),
    '<gesture id="g" lexeme="BAET"/>': ("b:g", "no-motion-for", "plays <gesture> with lexeme='BAET'", "BEAT"),
    '<head id="h" lexeme="NODD"/>': ("b:h", "no-motion-for", "plays <head> with lexeme='NODD'", "NOD"),
    '<faceLexeme id="f" lexeme="OPEN-MOUHT" amount="1"/>': ("b:f", "no-face", "lexeme 'OPEN-MOUHT'", "OPEN_MOUTH"),
    '<postureShift id="p"><pose part="ARMS" lexeme="ARMS_CROSED"/></postureShift>': (
        "b:p", "no-posture", "no ARMS pose 'ARMS_CROSED'", "ARMS_CROSSED",
    ),
    '<gaze id="g" target="viever"/>': ("b:g", "no-target", "there is no target 'viever'", "viewer"),
    '<pointing id="g" target="nobody"/>': ("b:g", "no-target", "there is no target 'nobody'", None),
    '<x:procanimation id="p" name="beat_rihgt"/>': (
        "b:p", "no-asset", "there is no asset named 'beat_rihgt.xml'", "beat_right.xml",
    ),
    '<locomotion id="l" target="viewer" manner="WALC"/>': ("b:l", "no-manner", "there is no manner 'WALC'", "WALK"),
    '<locomotion id="l" target="viewre"/>': ("b:l", "no-target", "there is no target 'viewre'", "viewer"),
    '<dance xmlns="urn:f" id="d"/>': ("b:d", "foreign-not-supported", "<dance> of urn:f is left out", None),
    '<wait id="w" duration="1" xmlns:f="urn:f" f:mood="1"/>': (
        "b:w", "foreign-attribute", "mood of urn:f has no effect", None,
    ),
    '<wait id="w" duration="1" xmlns:f="urn:f" f:mood="1" f:pace="2"/>': (
        "b:w", "foreign-attribute", "mood, pace of urn:f has no effect", None,
    ),
    '<wait id="w" start="hed:end"/><wait id="head" duration="1"/>': (
        "b:w", "unknown-owner", "'hed' is neither a behavior", "head",
    ),
    '<wait id="w" start="b:hed:end"/><wait id="head" duration="1"/>': (
        "b:w", "unknown-reference", "no behavior 'hed'", "head",
    ),
    '<gesture id="g" lexeme="BEAT"/><wait id="w" start="g:strok"/>': (
        "b:w", "unknown-sync", "'g' has no sync point 'strok'", "stroke",
    ),
    '<wait id="w" start="earlyer:w:end"/>': ("b:w", "unknown-block", "the block 'earlyer' is unknown", "earlier"),
    '<wait id="w" start="anticipators:metronom:tick3" duration="1"/>': (
        "b:w", "no-anticipator-yet", "no anticipator 'metronom' is known yet", "metronome",
    ),
    '<wait id="w" duration="1"/><constraint><synchronize><sync ref="w:end"/><sync ref="anticipators:metronom:tick3"/>'
    '</synchronize></constraint>': (
        "b", "no-anticipator-yet", "no anticipator 'metronom' is known yet", "metronome",
    ),
    '<wait id="w" start="earlier:strok" duration="1"/>': (
        "b:w", "unknown-block-point", "the block 'earlier' has no sync point 'strok'", "stroke",
    ),
    '<wait id="w" start="anticpators:spacebar:press" duration="1"/>': (
        "b:w", "unknown-block", "the block 'anticpators' is unknown", "anticipators",
    ),
    '<x:parametervaluechange id="c" target="g" paramId="amount"><x:trajectory type="liner" targetValue="1"/>'
    '</x:parametervaluechange><gesture id="g" lexeme="BEAT"/>': (
        "b:c", "no-trajectory", "there is no trajectory 'liner'", "linear",
    ),
}  # fmt: skip
"""Content of a block -> id and code of its warning, a part of the message, and the name that it suggests."""


@pytest.mark.parametrize("inside", MISTAKES)
async def test_a_mistake_is_answered_with_its_line_and_the_nearest_known_name_and_feedback_says_the_same(
    on_air: Open, inside: str
) -> None:
    async with on_air(SCENE) as air:
        socket = await air.connect()
        await post(air, "/bml", block('<gesture id="g" lexeme="BEAT"/>', "earlier", 'stroke="g:stroke"'))
        (warning,) = await warnings_of(air, block(inside))
        id_, code, part, meant = MISTAKES[inside]
        assert (warning["id"], warning["code"], warning["line"]) == (id_, code, 2)
        assert part in warning["message"]
        assert re.findall(r"did you mean '(.*)'\?$", warning["message"]) == ([] if meant is None else [meant])
        await air.tick_until(0.1)
        assert await told(socket) == [(id_, warning["type"], placed(warning))]


def placed(warning: dict[str, Any]) -> str:
    """The text of the warningFeedback with the same warning."""
    return f"line {warning['line']}, column {warning['column']}: {warning['message']}"


async def told(socket: Socket) -> list[tuple[str, str, str]]:
    """The id, type and text of the warnings in feedback so far."""
    await socket.say(type="ping", t=0)
    found = []
    while (message := await socket.hear("feedback", "pong"))["type"] == "feedback":
        feedback = etree.fromstring(message["xml"])
        if etree.QName(feedback).localname == "warningFeedback":
            found.append((feedback.get("id", ""), feedback.get("type", ""), (feedback.text or "").strip()))
    return found


async def test_the_socket_answers_with_the_same_warnings(on_air: Open) -> None:
    async with on_air(SCENE) as air:
        socket = await air.connect()
        inside = '<gesture id="g" lexeme="BAET"/><gaze id="h" target="viever"/><speach id="s"/>'
        posted = await warnings_of(air, block(inside, "b"))
        answer = await socket.ask(type="bml", xml=block(inside, "c"))
        assert answer["type"] == "accepted"
        assert [each["code"] for each in answer["warnings"]] == ["no-motion-for", "no-target", "unknown-behavior"]
        assert answer["warnings"] == [each | {"id": each["id"].replace("b:", "c:")} for each in posted]


async def test_a_mistyped_point_of_another_block_of_the_document_is_not_taken_for_a_behavior(on_air: Open) -> None:
    beat = block('<gesture id="g" lexeme="BEAT"/>', "t", 'stroke="g:stroke"')
    async with on_air(SCENE) as air:
        socket = await air.connect()
        document = block('<head id="n" lexeme="NOD" start="t:strok"/>') + beat
        (warning,) = await warnings_of(air, document)
        assert (warning["id"], warning["code"], warning["line"]) == ("b:n", "unknown-block-point", 2)
        assert warning["message"].startswith("t:strok: the block 't' has no sync point 'strok'; it has start, ready")
        assert warning["message"].endswith("did you mean 'stroke'?")
        await air.tick_until(0.1)
        assert await told(socket) == [("b:n", warning["type"], placed(warning))]


async def test_an_anticipator_that_clients_have_predicted_or_may_predict_is_no_mistake(on_air: Open) -> None:
    async with on_air(SCENE) as air:
        tied = '<wait id="w" start="anticipators:{}:hit" duration="1"/>'
        assert await warnings_of(air, block(tied.format("partner"), "a")) == []
        await post(air, "/predict", '{"anticipator": "metronom", "sync": "hit", "in": 2}')
        await air.tick()
        assert await warnings_of(air, block(tied.format("metronom"), "b")) == []


async def test_a_document_without_mistakes_has_no_warnings(on_air: Open) -> None:
    inside = """<speech id="s"><text>Look <sync id="there"/>there</text></speech>
      <gesture id="g" lexeme="beat" stroke="s:there"/><gaze id="z" target="viewer" start="g:strokeStart"/>
      <wait id="w" start="other:k:stroke" end="anticipators:metronome:tick3"/>"""
    other = f'<bml {BML} id="other"><head id="k" lexeme="NOD"/></bml>'
    async with on_air(SCENE) as air:
        assert await warnings_of(air, block(inside) + other) == []
        named = block('<wait id="w" start="other:k:end"/>', "later", 'x:appendAfter="b" composition="APPEND"')
        assert await warnings_of(air, named) == [], "blocks that are to enter are known"
        await air.tick()
        assert await warnings_of(air, named.replace("later", "last")) == []


async def test_a_block_that_has_ended_may_be_named_by_composition_and_not_by_references(on_air: Open) -> None:
    async with on_air(SCENE) as air:
        await post(air, "/bml", wait("gone", 0.01))
        await air.tick_until(0.1)
        assert await warnings_of(air, block("", "b", 'x:appendAfter="gone"')) == []
        (warning,) = await warnings_of(air, block('<wait id="w" start="gone:w:end"/>', "c"))
        assert warning["code"] == "unknown-block"
        (warning,) = await warnings_of(air, block("", "d", 'x:appendAfter="never"'))
        assert (warning["id"], warning["code"]) == ("d", "unknown-target-block")


async def test_mistakes_of_a_refused_block_and_of_accepted_ones_are_answered_together(on_air: Open) -> None:
    async with on_air(SCENE) as air:
        socket = await air.connect()
        document = wait("b1") + "\n" + wait("b1") + "\n" + block('<speach id="s"/>', "b2")
        answer = await socket.ask(type="bml", xml=document)
        assert (answer["type"], answer["blocks"]) == ("error", ["b1", "b2"])
        assert [(each["id"], each["code"], each["line"]) for each in answer["warnings"]] == [
            ("b1", "duplicate-block", 2),
            ("b2:s", "unknown-behavior", 4),
        ]


async def test_a_refused_document_is_answered_with_the_mistakes_of_all_its_blocks(on_air: Open) -> None:
    async with on_air(SCENE) as air:
        document = wait("b1") + "\n" + wait("b1") + "\n" + block('<speach id="s"/>', "b2")
        status, answer = await post(air, "/bml", document)
        assert (status, answer["error"]["code"], answer["blocks"]) == (409, "duplicate-block", [])
        assert [(each["id"], each["code"], each["line"]) for each in answer["warnings"]] == [
            ("b1", "duplicate-block", 2),
            ("b2:s", "unknown-behavior", 4),
        ]


async def test_warnings_above_the_limit_are_counted(on_air: Open) -> None:
    inside = "".join(f'<gaze id="g{n}" target="nobody{n}"/>' for n in range(7))
    async with on_air(ALICE + "[limits]\nanswered_warnings = 3\n") as air:
        _, answer = await post(air, "/bml", block(inside))
        assert [each["id"] for each in answer["warnings"]] == ["b:g0", "b:g1", "b:g2"]
        assert answer["more_warnings"] == 4
        assert await warnings_of(air, block("", "c")) == []
