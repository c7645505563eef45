"""What is wrong inside a block is answered by element, attribute, place and reason, and nothing else is lost."""

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
    '<head lexeme="NOD"/>': ("b", "<head> needs the attribute 'id'"),
    '<head id="x"/>': ("b:x", "<head> needs the attribute 'lexeme'"),
    '<head id="a:b" lexeme="NOD"/>': (
        "b:a:b",
        "id='a:b' of <head>: an id has 1 to 200 characters, no white space, control character, ':' or '+', "
        "and is not 'bml'",
    ),
    '<head id="x" lexeme="NOD" amount="much"/>': ("b:x", "amount='much' of <head>: not a finite number"),
    '<head id="x" lexeme="NOD" amount="nan"/>': ("b:x", "amount='nan' of <head>: not a finite number"),
    '<head id="x" lexeme="NOD" amount="1e999"/>': ("b:x", "amount='1e999' of <head>: not a finite number"),
    '<head id="x" lexeme="NOD" amount="1.01"/>': ("b:x", "amount='1.01' of <head>: not within 0 and 1"),
    '<head id="x" lexeme="NOD" amount="-0.1"/>': ("b:x", "amount='-0.1' of <head>: not within 0 and 1"),
    '<head id="x" lexeme="NOD" repetition="1.5"/>': ("b:x", "repetition='1.5' of <head>: not a whole number"),
    '<head id="x" lexeme="NOD" repetition="0"/>': ("b:x", "repetition='0' of <head>: not within 1 and 100"),
    '<head id="x" lexeme="NOD" repetition="1000000000"/>': (
        "b:x",
        "repetition='1000000000' of <head>: not within 1 and 100",
    ),
    '<head id="x" lexeme="NOD" start="now"/>': (
        "b:x",
        "start='now' of <head>: not a sync reference, [block:]behavior:sync[+seconds] or seconds",
    ),
    '<head id="x" lexeme="NOD" end="nan"/>': (
        "b:x",
        "end='nan' of <head>: not a sync reference, [block:]behavior:sync[+seconds] or seconds",
    ),
    '<head id="x" lexeme="NOD" end="1e7"/>': ("b:x", "end='1e7' of <head>: more than 86400 s"),
    '<gesture id="x" lexeme="BEAT" mode="FEET"/>': (
        "b:x",
        "mode='FEET' of <gesture>: known are LEFT_HAND, RIGHT_HAND, BOTH_HANDS",
    ),
    '<gaze id="x" target="box" offsetAngle="720"/>': ("b:x", "offsetAngle='720' of <gaze>: not within -360 and 360"),
    '<gaze id="x"/>': ("b:x", "<gaze> needs the attribute 'target'"),
    '<wait id="x" duration="-1"/>': ("b:x", "duration='-1' of <wait>: not within 0 and 86400"),
    '<wait id="x" max-wait="86401"/>': ("b:x", "max-wait='86401' of <wait>: not within 0 and 86400"),
    '<speech id="x"/>': ("b:x", "<speech> needs <text> in it"),
    '<speech id="x"><text/><text/></speech>': ("b:x", "a second <text> in <speech>"),
    SAY.format("<sync/>"): ("b:x", "<sync> needs the attribute 'id'"),
    SAY.format('<sync id="a"/><sync id="a"/>'): ("b:x", "<sync>: the id 'a' is taken"),
    SAY.format('<sync id="end"/>'): ("b:x", "<sync>: the id 'end' is taken"),
    '<face id="x"/>': ("b:x", "<face> needs <faceLexeme> or <faceFacs> in it"),
    '<face id="x"><faceLexeme/></face>': ("b:x", "<faceLexeme> needs the attribute 'lexeme'"),
    '<posture id="x"/>': ("b:x", "<posture> needs <stance> or <pose> in it"),
    '<posture id="x"><stance type="FLYING"/></posture>': (
        "b:x",
        "type='FLYING' of <stance>: known are SITTING, CROUCHING, STANDING, LYING",
    ),
    '<posture id="x"><stance type="LYING"/><stance type="LYING"/></posture>': ("b:x", "a second <stance> in <posture>"),
    '<posture id="x"><pose part="ARMS" lexeme="A"/><pose part="arms" lexeme="B"/></posture>': (
        "b:x",
        "a second <pose part='ARMS'> in <posture>",
    ),
    '<wait id="same"/>': ("b:same", "<wait>: the id 'same' is taken"),
    '<bmla:interrupt target="b1" start="then"/>': (
        "b:interrupt1",
        "start='then' of <interrupt>: not a sync reference, [block:]behavior:sync[+seconds] or seconds",
    ),
    '<bmla:interrupt id="x"/>': ("b:x", "<interrupt> needs the attribute 'target'"),
    '<bmla:interrupt id="x" target="b1" include="a,,b"/>': (
        "b:x",
        "include='a,,b' of <interrupt>: an id has 1 to 200 characters, no white space, control character, ':' or '+', "
        "and is not 'bml'",
    ),
    '<bmla:interrupt id="x" target="b1" speech="later"/>': (
        "b:x",
        "speech='later' of <interrupt>: known are now, word",
    ),
    '<bmla:parametervaluechange id="x" target="b1:s" paramId="volume"/>': (
        "b:x",
        "<parametervaluechange> needs <trajectory> in it",
    ),
    '<bmla:parametervaluechange id="x" target="a:b:c" paramId="volume"><trajectory/></bmla:parametervaluechange>': (
        "b:x",
        "target='a:b:c' of <parametervaluechange>: an id has 1 to 200 characters, no white space, control character, "
        "':' or '+', and is not 'bml'",
    ),
    CHANGE.format('type="linear" targetValue="1"/><trajectory'): (
        "b:x",
        "a second <trajectory> in <parametervaluechange>",
    ),
    CHANGE.format(""): ("b:x", "<trajectory> needs the attribute 'type'"),
    CHANGE.format('type="linear"'): ("b:x", "<trajectory> needs the attribute 'targetValue'"),
    CHANGE.format('type="linear" targetValue="loud"'): (
        "b:x",
        "targetValue='loud' of <trajectory>: not a finite number",
    ),
    '<head id="x" lexeme="NOD"><bmlt:parameter name="a"/></head>': (
        "b:x",
        "<parameter> needs the attribute 'value'",
    ),
    '<head id="x" lexeme="A"><bmlt:parameter name="a" value="1"/><bmlt:parameter name="a" value="2"/></head>': (
        "b:x",
        "a second <parameter name='a'> in <head>",
    ),
    '<bmlt:keyframe id="x"><SkeletonInterpolator/><SkeletonInterpolator/></bmlt:keyframe>': (
        "b:x",
        "a second <SkeletonInterpolator> in <keyframe>",
    ),
    '<bmlt:text id="x" start="bml:end"/>': (
        "b:x",
        "start='bml:end' of <text>: of its own block a reference may name the start, of another one start, relax and "
        "end",
    ),
    '<constraint id="x"><synchronize><sync ref="1"/></synchronize></constraint>': (
        "b:x",
        "<synchronize> needs <sync> and <sync> in it",
    ),
    '<constraint><after ref="1"/></constraint>': ("b", "<after> needs <sync> in it"),
    '<constraint><before><sync ref="1"/></before></constraint>': ("b", "<before> needs the attribute 'ref'"),
    '<constraint><after ref="1"><sync/></after></constraint>': ("b", "<sync> needs the attribute 'ref'"),
}


@pytest.mark.parametrize("bad", DROPPED)
def test_what_cannot_be_read_is_dropped_with_one_problem(read: Read, bad: str) -> None:
    place, sentence = DROPPED[bad]
    parsed = read(f'<wait id="same"/>{bad}<wait id="after"/>')
    assert parsed.block is not None
    assert [behavior.id for behavior in parsed.block.behaviors] == ["same", "after"]
    assert parsed.block.constraints == ()
    (problem,) = parsed.problems
    assert (problem.id, problem.fault.sentence) == (place, sentence)
    assert problem.fault.kind.warning is WarningType.PARSING_FAILURE
    assert problem.fault.line == 1


KEPT = {
    '<wait id="x" color="red" mood="blue"/>': "unknown attribute color, mood of <wait>; "
    "known are id, duration, max-wait, start, end",
    '<head id="x" lexeme="NOD" repetition="2" stroke="1"/>': "unknown attribute stroke of <head>; "
    "known are id, lexeme, repetition, amount, start, ready, strokeStart, strokeEnd, relax, end",
    '<wait id="x"><nap/></wait>': "unknown nap in <wait>; known are description, parameter",
    '<wait id="x"><parameter name="a" value="1"/></wait>': (
        "unknown parameter in <wait>; known are description, parameter"
    ),
    '<wait id="x">zzz</wait>': "text 'zzz' stands where none is read",
    SAY.format("so <b>very</b> nice"): "unknown b in <text>; known are sync",
    '<wait id="x"><description type="t"/></wait>': "<description> needs the attribute 'priority'",
    '<wait id="x"><description type="t" priority="high"/></wait>': "priority='high' of <description>: "
    "not a finite number",
    '<face id="x"><faceLexeme lexeme="A" start="1"/></face>': "unknown attribute start of <faceLexeme>; "
    "known are id, lexeme, amount, overshoot",
}


@pytest.mark.parametrize("odd", KEPT)
def test_what_is_not_understood_is_passed_over_with_a_problem(read: Read, odd: str) -> None:
    parsed = read(odd)
    assert parsed.block is not None
    assert [behavior.id for behavior in parsed.block.behaviors] == ["x"]
    (problem,) = parsed.problems
    assert (problem.id, problem.fault.sentence) == ("b:x", KEPT[odd])
    assert problem.fault.kind.warning is WarningType.PARSING_FAILURE


def test_an_unknown_element_of_bml_is_a_behavior_that_is_not_supported(read: Read) -> None:
    parsed = read('<dance id="d"/><wait id="w"/>')
    assert parsed.block is not None
    assert [behavior.id for behavior in parsed.block.behaviors] == ["w"]
    (problem,) = parsed.problems
    assert problem.id == "b:d"
    assert problem.fault.kind.warning is WarningType.BEHAVIOR_TYPE_NOT_SUPPORTED
    assert problem.fault.sentence.startswith("<dance> is no behavior of BML 1.0; known are speech, gesture, ")


def test_problems_name_line_and_column_in_the_order_of_the_document(read: Read) -> None:
    parsed = read('\n<wait id="x" duration="-1"/>\n  <constraint u="1"/> <head id="y"/>\n')
    assert [str(problem.fault).partition(": ")[0] for problem in parsed.problems] == [
        "line 2, column 1",
        "line 3, column 3",
        "line 3, column 23",
    ]


@pytest.mark.parametrize("block", ["<bml/>", '<bml id=""/>', '<bml id=" "/>', f'<bml xmlns="{BML}"/>'])
def test_a_block_without_an_id_is_refused(block: str) -> None:
    (parsed,) = parse(block, Limits())
    assert parsed.block is None
    assert [(problem.id, problem.fault.code) for problem in parsed.problems] == [("bml", "no-block-id")]


@pytest.mark.parametrize("name", ["bml", "a:b", "a b", "a+b", "x" * 201])
def test_a_block_whose_id_no_reference_could_name_is_refused(name: str) -> None:
    (parsed,) = parse(f'<bml id="{name}"/>', Limits())
    assert parsed.block is None
    assert [(problem.id, problem.fault.code) for problem in parsed.problems] == [("bml", "bad-attribute")]


def test_a_bad_attribute_of_a_block_has_its_default() -> None:
    (parsed,) = parse('<bml id="b" composition="SOMEHOW" mood="x">so<wait id="w"/></bml>', Limits())
    assert parsed.block is not None
    assert (parsed.block.composition, len(parsed.block.behaviors)) == ("MERGE", 1)
    assert [(problem.id, problem.fault.sentence) for problem in parsed.problems] == [
        ("b", "composition='SOMEHOW' of <bml>: known are MERGE, APPEND, REPLACE, APPEND-AFTER(ids), CHUNK-AFTER(ids)"),
        ("b", "unknown attribute mood of <bml>; known are id, characterId, composition"),
        ("b", "text 'so' stands where none is read"),
    ]


def test_a_long_value_is_quoted_in_part(read: Read) -> None:
    (problem,) = read(f'<head id="x" lexeme="NOD" amount="{"9" * 5000}"/>').problems
    assert len(str(problem.fault)) < 150


LIMITS = Limits(
    bml_bytes=1_000, xml_depth=5, xml_attributes=6, behaviors_per_block=3, blocks_alive=2, utterance_characters=10
)
INSIDE = '<bml id="b">{}</bml>'


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (INSIDE.format("<x>" * 5 + "</x>" * 5), "too-deep"),
        ('<bml id="b" a="" c="" d="" e="" f="" g=""/>', "too-many-attributes"),
        ('<bml id="b" xmlns:c="c" xmlns:d="d" xmlns:e="e" f="" g="" h=""/>', "too-many-attributes"),
        (INSIDE.format("<wait/>" * 4), "too-many-behaviors"),
        (INSIDE.format("<required><wait/><wait/></required>" * 2), "too-many-behaviors"),
    ],
)
def test_a_block_above_a_limit_is_refused_and_the_next_one_read(text: str, code: str) -> None:
    refused, following = parse(text + '<bml id="c"/>', LIMITS)
    assert refused.block is None
    assert [(problem.id, problem.fault.code) for problem in refused.problems] == [("b", code)]
    assert following.block is not None


@pytest.mark.parametrize("text", [" " * 1_001, b" " * 1_001, "é" * 501])
def test_a_document_above_the_limit_of_bytes_is_not_read(text: str | bytes) -> None:
    (parsed,) = parse(text, LIMITS)
    assert parsed.block is None
    assert [(problem.id, problem.fault.code) for problem in parsed.problems] == [("bml", "too-many-bytes")]


def test_a_document_with_more_blocks_than_may_be_alive_is_read_up_to_there() -> None:
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


def test_a_block_has_not_more_problems_than_it_may_have_behaviors() -> None:
    (parsed,) = parse(INSIDE.format(f'<wait id="w">{"<description/>" * 5}</wait>'), LIMITS)
    assert [problem.fault.code for problem in parsed.problems] == ["missing-attribute"] * 3 + ["more-problems"]
    assert parsed.problems[-1].fault.sentence == "2 more problems in this block"


def test_a_namespace_repeated_in_every_behavior_cannot_fill_the_memory() -> None:
    waits = "".join(f'<wait id="{number}"/>' for number in range(100))
    (parsed,) = parse(f'<bml xmlns:x="{"u" * 2_000}" id="b">{waits}</bml>', Limits(bml_bytes=5_000))
    assert parsed.block is not None
    assert sum(len(behavior.source) for behavior in parsed.block.behaviors) <= 50_000
    assert {problem.fault.code for problem in parsed.problems} == {"too-many-bytes"}
