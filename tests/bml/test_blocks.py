"""Blocks: attributes, constraints, required content, references."""

from collections.abc import Callable

import pytest

from reactive_realizer.bml.block import BehaviorBlock, Order, OrderKind, Parsed, Synchronize
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML, BMLA, Location
from reactive_realizer.bml.references import check_references
from reactive_realizer.bml.vocabulary import Composition
from reactive_realizer.errors import WarningType
from reactive_realizer.limits import Limits

Read = Callable[[str], Parsed]
Block = Callable[[str], BehaviorBlock]

NOD = '<head id="nod" lexeme="NOD"/>'


def test_a_block_without_attributes_merges_and_is_for_the_first_character() -> None:
    (parsed,) = parse(f'<bml xmlns="{BML}" id="b"/>', Limits())
    assert parsed == Parsed(BehaviorBlock(id="b", location=Location(1, 1)))


def test_a_block_has_a_character_a_composition_and_attributes_of_other_namespaces() -> None:
    xml = f'<bml xmlns="{BML}" xmlns:a="{BMLA}" id="b" characterId="Alice" composition="APPEND" a:mood="calm"/>'
    (parsed,) = parse(xml, Limits())
    assert parsed.block == BehaviorBlock(
        id="b",
        character="Alice",
        composition=Composition.APPEND,
        extensions={(BMLA, "mood"): "calm"},
        location=Location(1, 1),
    )


def test_a_composition_may_be_in_any_case(subtests: pytest.Subtests) -> None:
    for word in ["REPLACE", "replace", "Replace"]:
        with subtests.test(word):
            (parsed,) = parse(f'<bml xmlns="{BML}" id="b" composition="{word}"/>', Limits())
            assert parsed.block is not None
            assert parsed.block.composition is Composition.REPLACE


SPELLINGS = ['<bml id="b"><head id="h" lexeme="NOD"/></bml>', '<q:bml xmlns:q="NS" id="b"/>']


def test_the_namespace_may_be_missing_or_have_a_prefix(subtests: pytest.Subtests) -> None:
    for xml in SPELLINGS:
        with subtests.test(xml):
            (parsed,) = parse(xml.replace("NS", BML), Limits())
            assert parsed.block is not None
            assert not parsed.problems
            assert all(behavior.namespace == BML for behavior in parsed.block.behaviors)


def test_synchronize_has_all_its_points(block: Block) -> None:
    (tie,) = block(
        f'{NOD}<constraint id="c"><synchronize><sync ref="nod:stroke"/><sync ref="2.5"/></synchronize></constraint>'
    ).constraints
    assert isinstance(tie, Synchronize)
    assert (tie.id, [str(ref) for ref in tie.refs], tie.required) == ("c", ["nod:stroke", "2.5"], False)


def test_before_and_after_compare_their_points_with_one_point(block: Block, subtests: pytest.Subtests) -> None:
    for kind in OrderKind:
        with subtests.test(kind.value):
            (order,) = block(
                f'{NOD}<constraint><{kind} ref="other:end"><sync ref="nod:start"/><sync ref="1"/></{kind}></constraint>'
            ).constraints
            assert isinstance(order, Order)
            assert (order.kind, order.id, str(order.ref)) == (kind, None, "other:end")
            assert [str(ref) for ref in order.refs] == ["nod:start", "1"]


def test_a_constraint_element_may_contain_several_constraints(block: Block) -> None:
    inside = (
        '<synchronize><sync ref="1"/><sync ref="nod:end"/></synchronize><after ref="0"><sync ref="nod:end"/></after>'
    )
    assert len(block(f"{NOD}<constraint>{inside}</constraint>").constraints) == 2


def test_the_content_of_required_is_required_and_keeps_its_order(block: Block) -> None:
    tie = '<constraint><synchronize><sync ref="nod:end"/><sync ref="3"/></synchronize></constraint>'
    read = block(f'<wait id="a"/><required>{NOD}{tie}<required><wait id="c"/></required></required><wait id="d"/>')
    assert [(each.id, each.order, each.required) for each in read.behaviors] == [
        ("a", 0, False),
        ("nod", 1, True),
        ("c", 2, True),
        ("d", 3, False),
    ]
    assert [each.required for each in read.constraints] == [True]


UNREADABLE = [
    '<head id="h"/>',
    '<dance id="h"/>',
    '<head id="h" lexeme="NOD" start="soon"/>',
    '<constraint><synchronize><sync ref="x:y"/><sync ref="?"/></synchronize></constraint>',
]


def test_a_block_fails_if_something_required_is_dropped(read: Read, subtests: pytest.Subtests) -> None:
    for inside in UNREADABLE:
        with subtests.test(inside):
            assert read(f"{NOD}<required>{inside}</required>").failed
            assert not read(f"{NOD}{inside}").failed


def test_a_problem_of_something_required_that_is_read_does_not_fail_the_block(read: Read) -> None:
    parsed = read('<required><head id="h" lexeme="NOD" color="red"/></required>')
    assert len(parsed.problems) == 1
    assert not parsed.failed


def test_references_to_existing_sync_points_have_no_problem(block: Block) -> None:
    text = 'Well, <sync id="s-1"/>yes'
    read = block(
        f'<speech id="say"><text>{text}</text></speech>'
        '<head id="nod" lexeme="NOD" repetition="2" start="say:s-1" stroke:1="" end="8"/>'.replace(' stroke:1=""', "")
        + '<gesture id="g" lexeme="BEAT" start="nod:stroke:2" stroke="b:say:end" end="other:g:end"/>'
        '<bmla:thing id="t" start="anticipators:x:y" end="t:whatever"/>'
    )
    assert check_references(read) == ()


MISSING = {
    '<head id="h" lexeme="NOD" start="nobody:attackPeak+1"/>': (
        "b:h",
        "line 1, column {column}: nobody:attackPeak+1: there is no behavior 'nobody'; available: nod, h",
    ),
    '<wait id="w" start="w:apex"/>': (
        "b:w",
        "line 1, column {column}: w:apex: 'w' has no sync point 'apex'; it has start, end",
    ),
    '<head id="h" lexeme="NOD" start="b:nobody:end"/>': (
        "b:h",
        "line 1, column {column}: b:nobody:end: there is no behavior 'nobody'; available: nod, h",
    ),
    '<constraint id="c"><after ref="nod:end"><sync ref="say:word"/></after></constraint>': (
        "b:c",
        "line 1, column {column}: say:word: there is no behavior 'say'; available: nod",
    ),
    '<constraint><synchronize><sync ref="1"/><sync ref="say:word"/></synchronize></constraint>': (
        "b",
        "line 1, column {column}: say:word: there is no behavior 'say'; available: nod",
    ),
}


def test_the_problem_of_a_missing_reference_lists_what_exists(subtests: pytest.Subtests) -> None:
    for inside in MISSING:
        with subtests.test(inside):
            start = f'<bml id="b">{NOD}'
            (parsed,) = parse(f"{start}{inside}</bml>", Limits())
            assert parsed.block is not None
            place, sentence = MISSING[inside]
            (problem,) = check_references(parsed.block)
            assert problem.id == place
            assert problem.fault.warning is WarningType.IMPOSSIBLE_TO_SCHEDULE
            column = len(start) + (inside.index("<", 1) if inside.startswith("<constraint") else 0) + 1
            assert str(problem.fault) == sentence.format(column=column)


WITH_OPEN_POINTS = [
    '<gesture id="g" lexeme="3-BEAT"/>',
    '<head id="g" lexeme="NOD"/>',
    '<bmlt:procanimation id="g" name="3-beat"/>',
]


def test_an_engine_may_know_more_sync_points_than_bml(block: Block, subtests: pytest.Subtests) -> None:
    for behavior in WITH_OPEN_POINTS:
        with subtests.test(behavior):
            read = block(f'{behavior}<wait id="w" start="g:beat2"/>')
            assert not check_references(read)
            (problem,) = check_references(read, lambda each: ("start", "end"))
            assert problem.fault.sentence == "g:beat2: 'g' has no sync point 'beat2'; it has start, end"
