"""Continuous interaction: the attributes and elements of BMLA and BMLT."""

from collections.abc import Callable

import pytest

from reactive_realizer.bml.behavior import ForeignBehavior
from reactive_realizer.bml.block import BehaviorBlock, Parsed
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.extensions import Activate, ParameterValueChange
from reactive_realizer.bml.names import BML, BMLA, BMLT
from reactive_realizer.bml.references import check_references
from reactive_realizer.bml.vocabulary import Composition
from reactive_realizer.errors import WarningType
from reactive_realizer.limits import Limits

Read = Callable[[str], Parsed]
Block = Callable[[str], BehaviorBlock]

TWICE = pytest.mark.parametrize("namespace", [BMLA, BMLT])


def block_with(attributes: str, namespace: str = BMLA) -> Parsed:
    (parsed,) = parse(f'<bml xmlns="{BML}" xmlns:x="{namespace}" id="b" {attributes}/>', Limits())
    return parsed


BLOCK_LISTS = [
    ("appendAfter", "append_after"),
    ("chunkAfter", "chunk_after"),
    ("prependBefore", "prepend_before"),
    ("chunkBefore", "chunk_before"),
    ("interrupt", "interrupts"),
    ("onStart", "on_start"),
]


@TWICE
def test_a_block_lists_other_blocks_in_either_namespace(namespace: str, subtests: pytest.Subtests) -> None:
    for attribute, field in BLOCK_LISTS:
        with subtests.test(attribute):
            parsed = block_with(f'x:{attribute}=" b1, b-2,b1 "', namespace)
            assert not parsed.problems
            assert getattr(parsed.block, field) == ("b1", "b-2")
            assert parsed.block
            assert not parsed.block.extensions


BOOLEANS = [("true", True), ("FALSE", False), ("1", True), (" 0 ", False)]


@TWICE
def test_a_block_may_be_preplanned(namespace: str, subtests: pytest.Subtests) -> None:
    for word, planned in BOOLEANS:
        with subtests.test(word):
            parsed = block_with(f'x:preplan="{word}" x:allowexternalrefs="{word}"', namespace)
            assert not parsed.problems
            assert parsed.block
            assert (parsed.block.preplan, parsed.block.external_refs) == (planned, planned)


def test_a_block_without_attributes_waits_for_no_other_block() -> None:
    (block,) = (parsed.block for parsed in parse('<bml id="b"/>', Limits()))
    assert block
    assert (block.append_after, block.chunk_after, block.prepend_before, block.chunk_before) == ((), (), (), ())
    assert (block.interrupts, block.on_start, block.preplan) == ((), (), False)


BAD_ATTRIBUTES = [
    ('x:preplan="maybe"', "preplan='maybe' of <bml>: not one of true, false"),
    ('x:onStart="a,b c"', "onStart='a,b c' of <bml>: an id must have 1 to 200 characters"),
    ('x:chunkAfter="a,"', "chunkAfter='a,' of <bml>: an id must have 1 to 200 characters"),
    ('composition="APPEND-AFTER(a"', "composition='APPEND-AFTER(a' of <bml>: not one of MERGE"),
    ('composition="APPEND-AFTER(a b)"', "composition='APPEND-AFTER(a b)' of <bml>: an id must have 1 to 200"),
    ('appendAfter="a"', "unknown attribute appendAfter of <bml>; known: id, characterId, composition"),
]


def test_a_bad_attribute_is_reported_and_has_its_default(subtests: pytest.Subtests) -> None:
    for written, sentence in BAD_ATTRIBUTES:
        with subtests.test(written):
            parsed = block_with(written)
            (problem,) = parsed.problems
            assert problem.fault.warning is WarningType.PARSING_FAILURE
            assert problem.fault.sentence.startswith(sentence)
            default = block_with("").block
            assert default
            assert parsed.block
            assert (parsed.block.composition, parsed.block.append_after) == (default.composition, default.append_after)


COMPOSITIONS = [
    ("APPEND-AFTER(b1,b2)", ("b1", "b2"), ()),
    ("append_after( b1 , b2 )", ("b1", "b2"), ()),
    ("Append-After (b1)", ("b1",), ()),
    ("APPENDAFTER()", (), ()),
    ("CHUNK-AFTER(b1)", (), ("b1",)),
]


def test_a_composition_may_list_the_blocks_for_which_it_waits(subtests: pytest.Subtests) -> None:
    for word, appended, chunked in COMPOSITIONS:
        with subtests.test(word):
            parsed = block_with(f'composition="{word}"')
            assert not parsed.problems
            assert parsed.block
            assert parsed.block.composition is Composition.MERGE
            assert (parsed.block.append_after, parsed.block.chunk_after) == (appended, chunked)


def test_the_blocks_of_composition_and_attribute_are_combined() -> None:
    block = block_with('composition="APPEND-AFTER(b1,b2)" x:appendAfter="b2,b3"').block
    assert block
    assert block.append_after == ("b1", "b2", "b3")


@TWICE
def test_elements_of_either_namespace_are_read_alike_and_keep_it(block: Block, namespace: str) -> None:
    (change,) = block(
        f'<parametervaluechange xmlns="{namespace}" id="p" target="s" paramId="volume" stroke="2">'
        '<trajectory type="instant" targetValue="90"/></parametervaluechange>'
    ).behaviors
    assert isinstance(change, ParameterValueChange)
    assert change.namespace == namespace
    assert (change.target_block, change.target_behavior) == (None, "s")
    assert (change.trajectory.type, change.trajectory.initial_value) == ("instant", None)


def test_a_trajectory_needs_no_prefix(block: Block, subtests: pytest.Subtests) -> None:
    for prefix in ["bmla:", "bmlt:", ""]:
        with subtests.test(prefix):
            (change,) = block(
                '<bmlt:parametervaluechange id="p" target="s" paramId="volume">'
                f'<{prefix}trajectory type="instant" targetValue="90"/></bmlt:parametervaluechange>'
            ).behaviors
            assert isinstance(change, ParameterValueChange)


def test_elements_of_continuous_interaction_are_not_part_of_bml_1_0(read: Read) -> None:
    parsed = read('<activate id="a" target="b1"/>')
    (problem,) = parsed.problems
    assert problem.fault.warning is WarningType.BEHAVIOR_TYPE_NOT_SUPPORTED
    assert "parametervaluechange" not in problem.fault.sentence


def test_elements_without_an_id_get_the_next_free_one(block: Block) -> None:
    behaviors = block(
        '<wait id="w" start="activate3:end"/><bmla:activate target="b1"/><bmla:activate id="activate2" target="b1"/>'
        '<required><bmla:activate target="b1"/></required><bmlt:text/>'
    ).behaviors
    assert [each.id for each in behaviors] == ["w", "activate1", "activate2", "activate3", "text1"]
    assert isinstance(behaviors[1], Activate)
    assert isinstance(behaviors[4], ForeignBehavior)
    assert str(behaviors[0].syncs["start"]) == "activate3:end"
    assert 'id="activate1"' in behaviors[1].source


def test_a_name_that_is_no_behavior_of_the_block_is_another_block(block: Block) -> None:
    read = block('<wait id="w" start="b1:relax" end="g:end"/><wait id="g" start="b1:end+1" end="b1:w:end"/>')
    named = [(ref.block, ref.behavior, ref.sync) for each in read.behaviors for ref in each.syncs.values()]
    assert named == [("b1", None, "relax"), (None, "g", "end"), ("b1", None, "end"), ("b1", "w", "end")]
    assert check_references(read) == ()


def test_the_name_of_an_unreadable_behavior_is_not_read_as_a_block(read: Read) -> None:
    parsed = read('<wait id="w" start="lost:end"/><wait id="lost" duration="long"/>')
    assert parsed.block
    assert [problem.fault.code for problem in check_references(parsed.block)] == ["lost-with"]
