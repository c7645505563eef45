"""Errors inside a block are reported with element, attribute, location and reason, and all the rest is read."""

from collections.abc import Callable

import pytest

from reactive_realizer.bml.block import Parsed
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML
from reactive_realizer.errors import WarningType
from reactive_realizer.limits import Limits

Read = Callable[[str], Parsed]

SAY = '<speech id="x"><text>{}</text></speech>'
CHANGE = '<bmla:parametervaluechange id="x" target="s" paramId="volume"><trajectory {}/></bmla:parametervaluechange>'

DROPPED = {
    '<head lexeme="NOD"/>': ("b", "<head> requires the attribute 'id'"),
    '<head id="x"/>': ("b:x", "<head> requires the attribute 'lexeme'"),
    '<head id="a:b" lexeme="NOD"/>': (
        "b:a:b",
        "id='a:b' of <head>: an id must have 1 to 200 characters, without white space, control "
        "characters, ':' or '+', and cannot be 'bml'",
    ),
    '<head id="x" lexeme="NOD" amount="much"/>': ("b:x", "amount='much' of <head>: not a finite number"),
    '<head id="x" lexeme="NOD" amount="nan"/>': ("b:x", "amount='nan' of <head>: not a finite number"),
    '<head id="x" lexeme="NOD" amount="1e999"/>': ("b:x", "amount='1e999' of <head>: not a finite number"),
    '<head id="x" lexeme="NOD" amount="1.01"/>': ("b:x", "amount='1.01' of <head>: not between 0 and 1"),
    '<head id="x" lexeme="NOD" amount="-0.1"/>': ("b:x", "amount='-0.1' of <head>: not between 0 and 1"),
    '<head id="x" lexeme="NOD" repetition="1.5"/>': ("b:x", "repetition='1.5' of <head>: not a whole number"),
    '<head id="x" lexeme="NOD" repetition="0"/>': ("b:x", "repetition='0' of <head>: not between 1 and 100"),
    '<head id="x" lexeme="NOD" repetition="1000000000"/>': (
        "b:x",
        "repetition='1000000000' of <head>: not between 1 and 100",
    ),
    '<head id="x" lexeme="NOD" start="now"/>': (
        "b:x",
        "start='now' of <head>: not a sync reference; write [block:]behavior:sync[+seconds], or seconds",
    ),
    '<head id="x" lexeme="NOD" end="nan"/>': (
        "b:x",
        "end='nan' of <head>: not a sync reference; write [block:]behavior:sync[+seconds], or seconds",
    ),
    '<head id="x" lexeme="NOD" end="1e7"/>': ("b:x", "end='1e7' of <head>: times cannot exceed 86400 s"),
    '<gesture id="x" lexeme="BEAT" mode="FEET"/>': (
        "b:x",
        "mode='FEET' of <gesture>: not one of LEFT_HAND, RIGHT_HAND, BOTH_HANDS",
    ),
    '<gaze id="x" target="box" offsetAngle="720"/>': ("b:x", "offsetAngle='720' of <gaze>: not between -360 and 360"),
    '<gaze id="x"/>': ("b:x", "<gaze> requires the attribute 'target'"),
    '<wait id="x" duration="-1"/>': ("b:x", "duration='-1' of <wait>: not between 0 and 86400"),
    '<wait id="x" max-wait="86401"/>': ("b:x", "max-wait='86401' of <wait>: not between 0 and 86400"),
    '<speech id="x"/>': ("b:x", "<speech> must contain <text>"),
    '<speech id="x"><text/><text/></speech>': ("b:x", "<speech> contains more than one <text>"),
    '<face id="x"/>': ("b:x", "<face> must contain <faceLexeme> or <faceFacs>"),
    '<face id="x"><faceLexeme/></face>': ("b:x", "<faceLexeme> requires the attribute 'lexeme'"),
    '<posture id="x"/>': ("b:x", "<posture> must contain <stance> or <pose>"),
    '<posture id="x"><stance type="FLYING"/></posture>': (
        "b:x",
        "type='FLYING' of <stance>: not one of SITTING, CROUCHING, STANDING, LYING; did you mean 'LYING'?",
    ),
    '<posture id="x"><stance type="LYING"/><stance type="LYING"/></posture>': (
        "b:x",
        "<posture> contains more than one <stance>",
    ),
    '<posture id="x"><pose part="ARMS" lexeme="A"/><pose part="arms" lexeme="B"/></posture>': (
        "b:x",
        "<posture> contains more than one <pose part='ARMS'>",
    ),
    '<wait id="same"/>': ("b:same", "<wait>: the id 'same' is already in use"),
    '<bmla:interrupt target="b1" start="then"/>': (
        "b:interrupt1",
        "start='then' of <interrupt>: not a sync reference; write [block:]behavior:sync[+seconds], or seconds",
    ),
    '<bmla:interrupt id="x"/>': ("b:x", "<interrupt> requires the attribute 'target'"),
    '<bmla:interrupt id="x" target="b1" include="a,,b"/>': (
        "b:x",
        "include='a,,b' of <interrupt>: an id must have 1 to 200 characters, without white space, control "
        "characters, ':' or '+', and cannot be 'bml'",
    ),
    '<bmla:interrupt id="x" target="b1" speech="later"/>': (
        "b:x",
        "speech='later' of <interrupt>: not one of now, word, clause",
    ),
    '<bmla:parametervaluechange id="x" target="b1:s" paramId="volume"/>': (
        "b:x",
        "<parametervaluechange> must contain <trajectory>",
    ),
    '<bmla:parametervaluechange id="x" target="a:b:c" paramId="volume"><trajectory/></bmla:parametervaluechange>': (
        "b:x",
        "target='a:b:c' of <parametervaluechange>: an id must have 1 to 200 characters, without white space, "
        "control characters, ':' or '+', and cannot be 'bml'",
    ),
    CHANGE.format('type="linear" targetValue="1"/><trajectory'): (
        "b:x",
        "<parametervaluechange> contains more than one <trajectory>",
    ),
    CHANGE.format(""): ("b:x", "<trajectory> requires the attribute 'type'"),
    CHANGE.format('type="linear"'): ("b:x", "<trajectory> requires the attribute 'targetValue'"),
    CHANGE.format('type="linear" targetValue="loud"'): (
        "b:x",
        "targetValue='loud' of <trajectory>: not a finite number",
    ),
    '<head id="x" lexeme="NOD"><bmlt:parameter name="a"/></head>': (
        "b:x",
        "<parameter> requires the attribute 'value'",
    ),
    '<head id="x" lexeme="A"><bmlt:parameter name="a" value="1"/><bmlt:parameter name="a" value="2"/></head>': (
        "b:x",
        "<head> contains more than one <parameter name='a'>",
    ),
    '<bmlt:keyframe id="x"><SkeletonInterpolator/><SkeletonInterpolator/></bmlt:keyframe>': (
        "b:x",
        "<keyframe> contains more than one <SkeletonInterpolator>",
    ),
    '<bmlt:text id="x" start="bml:end"/>': (
        "b:x",
        "start='bml:end' of <text>: a reference can name the start of its own block, or a sync point of another "
        "block: start, ready, strokeStart, stroke, strokeEnd, relax, end",
    ),
    '<constraint id="x"><synchronize><sync ref="1"/></synchronize></constraint>': (
        "b:x",
        "<synchronize> must contain <sync> and <sync>",
    ),
    '<constraint><after ref="1"/></constraint>': ("b", "<after> must contain <sync>"),
    '<constraint><before><sync ref="1"/></before></constraint>': ("b", "<before> requires the attribute 'ref'"),
    '<constraint><after ref="1"><sync/></after></constraint>': ("b", "<sync> requires the attribute 'ref'"),
}


def test_an_unreadable_behavior_or_constraint_is_dropped_with_one_problem(
    read: Read, subtests: pytest.Subtests
) -> None:
    for bad, (place, sentence) in DROPPED.items():
        with subtests.test(bad):
            parsed = read(f'<wait id="same"/>{bad}<wait id="after"/>')
            assert parsed.block is not None
            assert [behavior.id for behavior in parsed.block.behaviors] == ["same", "after"]
            assert parsed.block.constraints == ()
            (problem,) = parsed.problems
            assert (problem.id, problem.fault.sentence) == (place, sentence)
            assert problem.fault.warning is WarningType.PARSING_FAILURE
            assert problem.fault.line == 1


KEPT = {
    '<wait id="x" color="red" mood="blue"/>': "unknown attribute color, mood of <wait>; "
    "known: id, duration, max-wait, event, start, end",
    '<wait id="x"><nap/></wait>': "unknown nap in <wait>; known: description, parameter",
    '<wait id="x"><parameter name="a" value="1"/></wait>': (
        "unknown parameter in <wait>; known: description, parameter"
    ),
    '<wait id="x">zzz</wait>': "unexpected text 'zzz'",
    SAY.format("so <b>very</b> nice"): "unknown b in <text>; known: sync",
    SAY.format("so <sync/>"): "<sync> requires the attribute 'id'",
    SAY.format('<sync id="a"/>so <sync id="a"/>'): "<sync>: the id 'a' is already in use",
    SAY.format('so <sync id="end"/>'): "<sync>: the id 'end' is already in use",
    SAY.format('so <sync id="bml"/>'): "id='bml' of <sync>: an id must have 1 to 200 characters, without white space, "
    "control characters, ':' or '+', and cannot be 'bml'",
    SAY.format('so <sync id="a" pace="2"/>'): "unknown attribute pace of <sync>; known: id, time",
    SAY.format('so <sync id="a"><b>very</b></sync>'): "unknown b in <sync>; known: none",
    SAY.format('so <sync id="a" xmlns:u="urn:u" u:pace="2"/>'): "pace of urn:u has no effect here",
    '<speech id="x"><text pace="2">so</text></speech>': "unknown attribute pace of <text>; known: none",
    '<wait id="x"><description type="t"/></wait>': "<description> requires the attribute 'priority'",
    '<wait id="x"><description type="t" priority="high"/></wait>': "priority='high' of <description>: "
    "not a finite number",
    '<face id="x"><faceLexeme lexeme="A" start="1"/></face>': "unknown attribute start of <faceLexeme>; "
    "known: id, lexeme, amount, overshoot",
}


def test_unknown_content_is_ignored_with_one_problem(read: Read, subtests: pytest.Subtests) -> None:
    for odd in KEPT:
        with subtests.test(odd):
            parsed = read(odd)
            assert parsed.block is not None
            assert [behavior.id for behavior in parsed.block.behaviors] == ["x"]
            (problem,) = parsed.problems
            assert (problem.id, problem.fault.sentence) == ("b:x", KEPT[odd])
            assert problem.fault.warning is not None


def test_an_unknown_element_of_bml_is_reported_as_not_supported(read: Read) -> None:
    parsed = read('<dance id="d"/><wait id="w"/>')
    assert parsed.block is not None
    assert [behavior.id for behavior in parsed.block.behaviors] == ["w"]
    (problem,) = parsed.problems
    assert problem.id == "b:d"
    assert problem.fault.warning is WarningType.BEHAVIOR_TYPE_NOT_SUPPORTED
    assert problem.fault.sentence.startswith("<dance> is not a behavior of BML 1.0; known: speech, gesture, ")


def test_problems_have_line_and_column_and_are_in_document_order(read: Read) -> None:
    parsed = read('\n<wait id="x" duration="-1"/>\n  <constraint u="1"/> <head id="y"/>\n')
    assert [str(problem.fault).partition(": ")[0] for problem in parsed.problems] == [
        "line 2, column 1",
        "line 3, column 3",
        "line 3, column 23",
    ]


WITHOUT_ID = ['<bml id=""/>', '<bml id=" "/>', f'<bml xmlns="{BML}"/>']


def test_a_block_without_an_id_is_refused(subtests: pytest.Subtests) -> None:
    for block in WITHOUT_ID:
        with subtests.test(block):
            (parsed,) = parse(block, Limits())
            assert parsed.block is None
            assert [(problem.id, problem.fault.code) for problem in parsed.problems] == [("bml", "no-block-id")]


def test_a_block_whose_id_cannot_be_referenced_is_refused(subtests: pytest.Subtests) -> None:
    for name in ["bml", "a:b", "a b", "a+b", "x" * 201]:
        with subtests.test(name[:20]):
            (parsed,) = parse(f'<bml id="{name}"/>', Limits())
            assert parsed.block is None
            assert [(problem.id, problem.fault.code) for problem in parsed.problems] == [("bml", "bad-attribute")]


def test_a_bad_attribute_of_a_block_has_its_default() -> None:
    (parsed,) = parse('<bml id="b" composition="SOMEHOW" mood="x">so<wait id="w"/></bml>', Limits())
    assert parsed.block is not None
    assert (parsed.block.composition, len(parsed.block.behaviors)) == ("MERGE", 1)
    assert [(problem.id, problem.fault.sentence) for problem in parsed.problems] == [
        (
            "b",
            "composition='SOMEHOW' of <bml>: not one of MERGE, APPEND, REPLACE, APPEND-AFTER(ids), CHUNK-AFTER(ids)",
        ),
        (
            "b",
            "unknown attribute mood of <bml>; known: id, characterId, composition, start, ready, strokeStart, "
            "stroke, strokeEnd",
        ),
        ("b", "unexpected text 'so'"),
    ]


def test_a_long_value_is_truncated_in_the_message(read: Read) -> None:
    (problem,) = read(f'<head id="x" lexeme="NOD" amount="{"9" * 5000}"/>').problems
    assert len(str(problem.fault)) < 150


LIMITS = Limits(
    bml_bytes=1_000,
    xml_depth=5,
    xml_attributes=6,
    behaviors_per_block=3,
    reported_problems=3,
    blocks_alive=2,
    utterance_characters=10,
)
INSIDE = '<bml id="b">{}</bml>'


ABOVE_A_LIMIT = [
    (INSIDE.format("<x>" * 5 + "</x>" * 5), "too-deep"),
    ('<bml id="b" a="" c="" d="" e="" f="" g=""/>', "too-many-attributes"),
    ('<bml id="b" xmlns:c="c" xmlns:d="d" xmlns:e="e" f="" g="" h=""/>', "too-many-attributes"),
    (INSIDE.format("<wait/>" * 4), "too-many-behaviors"),
    (INSIDE.format("<required><wait/><wait/></required>" * 2), "too-many-behaviors"),
]


def test_a_block_above_a_limit_is_refused_and_the_next_one_is_read(subtests: pytest.Subtests) -> None:
    for text, code in ABOVE_A_LIMIT:
        with subtests.test(text):
            refused, following = parse(text + '<bml id="c"/>', LIMITS)
            assert refused.block is None
            assert [(problem.id, problem.fault.code) for problem in refused.problems] == [("b", code)]
            assert following.block is not None


def test_a_document_above_the_limit_of_bytes_is_refused(subtests: pytest.Subtests) -> None:
    texts: list[str | bytes] = [" " * 1_001, b" " * 1_001, "é" * 501]
    for text in texts:
        with subtests.test(repr(text[:1])):
            (parsed,) = parse(text, LIMITS)
            assert parsed.block is None
            assert [(problem.id, problem.fault.code) for problem in parsed.problems] == [("bml", "too-many-bytes")]


def test_of_too_many_blocks_in_a_document_the_first_are_read() -> None:
    parsed = parse('<bml id="a"/><bml id="b"/><bml id="c"/><bml id="d"/>', LIMITS)
    assert [each.block and each.block.id for each in parsed] == ["a", "b", None]
    assert parsed[-1].problems[0].fault.code == "too-many-roots"


def test_a_speech_above_the_limit_of_characters_is_dropped() -> None:
    (parsed,) = parse(
        INSIDE.format(SAY.format("1234567890 ") + SAY.format("12345 78901").replace('"x"', '"y"')), LIMITS
    )
    assert parsed.block is not None
    assert [behavior.id for behavior in parsed.block.behaviors] == ["x"]
    assert [(problem.id, problem.fault.code) for problem in parsed.problems] == [("b:y", "utterance-too-long")]


def test_the_number_of_problems_of_a_block_is_limited() -> None:
    (parsed,) = parse(INSIDE.format(f'<wait id="w">{"<description/>" * 5}</wait>'), LIMITS)
    assert [problem.fault.code for problem in parsed.problems] == ["missing-attribute"] * 3 + ["more-problems"]
    assert parsed.problems[-1].fault.sentence == "2 more problems in this block"


def test_the_copies_kept_of_a_document_are_limited() -> None:
    waits = "".join(f'<wait id="{number}"/>' for number in range(100))
    (parsed,) = parse(f'<bml xmlns:x="{"u" * 2_000}" id="b">{waits}</bml>', Limits(bml_bytes=5_000))
    assert parsed.block is not None
    assert sum(len(behavior.source) for behavior in parsed.block.behaviors) <= 50_000
    assert {problem.fault.code for problem in parsed.problems} == {"too-many-bytes"}
