"""Procedures: behaviors that are written once and played many times (thesis 6.6.2)."""

import pytest

from reactive_realizer.bml.behaviors import Gaze
from reactive_realizer.bml.block import Parsed
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML, BMLA, BMLT, Location
from reactive_realizer.bml.references import check_references
from reactive_realizer.bml.speech import Speech
from reactive_realizer.bml.vocabulary import Composition
from reactive_realizer.limits import Limits

GREETING = '<gaze id="look" target="box"/><speech id="say" start="look:ready"><text>Hi</text></speech>'


def read(xml: str, namespace: str = BMLT) -> Parsed:
    (parsed,) = parse(xml.replace(" ", f' xmlns:p="{namespace}" ', 1), Limits())
    return parsed


def test_a_procedure_has_behaviors_and_constraints_like_a_block(subtests: pytest.Subtests) -> None:
    for core in ["", f' xmlns="{BML}"']:
        for namespace in [BMLA, BMLT]:
            with subtests.test(f"{namespace} {core}"):
                tie = '<constraint><synchronize><sync ref="2"/><sync ref="say:end"/></synchronize></constraint>'
                parsed = read(f'<p:defineproc id="greet"{core}>{GREETING}{tie}</p:defineproc>', namespace)
                assert (parsed.block, parsed.problems, parsed.failed, parsed.refusal) == (None, (), False, None)
                assert parsed.procedure is not None
                assert (parsed.procedure.id, parsed.procedure.location) == ("greet", Location(1, 1))
                assert [type(each) for each in parsed.procedure.behaviors] == [Gaze, Speech]
                assert len(parsed.procedure.constraints) == 1
                assert check_references(parsed.procedure) == ()


def test_a_use_of_a_procedure_is_a_block_that_names_the_procedure() -> None:
    parsed = read(
        '<p:useproc procid="greet" bmlid="b" scheduling="append" characterId="bob" p:preplan="true" p:chunkAfter="a"/>'
    )
    block = parsed.block
    assert block is not None
    assert not parsed.problems
    assert (block.id, block.procedure, block.behaviors) == ("b", "greet", ())
    assert (block.composition, block.character, block.preplan) == (Composition.APPEND, "bob", True)
    assert (block.chunk_after, block.extensions) == (("a",), {})


def test_the_attributes_of_a_use_may_have_a_prefix_or_none() -> None:
    parsed = read('<p:useproc procid="greet" bmlid="b" appendAfter="a" p:chunkBefore="c" preplan="true"/>')
    block = parsed.block
    assert block is not None
    assert not parsed.problems
    assert (block.append_after, block.chunk_before, block.preplan) == (("a",), ("c",), True)


def test_the_attributes_of_bmla_need_a_prefix_in_a_block_of_bml_1_0() -> None:
    (parsed,) = parse('<bml id="b" preplan="true"/>', Limits())
    assert parsed.block is not None
    assert not parsed.block.preplan
    assert [problem.fault.code for problem in parsed.problems] == ["unknown-attribute"]


def test_an_ordinary_block_has_no_procedure() -> None:
    (parsed,) = parse('<bml id="b"/>', Limits())
    assert parsed.block is not None
    assert parsed.block.procedure is None


REFUSED = {
    "<p:defineproc >": ("bml", "<defineproc> requires the attribute 'id'"),
    '<p:defineproc id="a:b">': ("bml", "id='a:b' of <defineproc>: an id must have"),
    '<p:useproc procid="greet">': ("bml", "<useproc> requires the attribute 'bmlid'"),
    '<p:useproc bmlid="b">': ("b", "<useproc> requires the attribute 'procid'"),
    '<p:callproc id="greet">': ("bml", "<callproc> is not a bml block, defineproc or useproc"),
}


def test_a_procedure_or_use_without_an_id_is_refused(subtests: pytest.Subtests) -> None:
    for start in REFUSED:
        with subtests.test(start):
            parsed = read(f"{start}</{start[1:].split()[0]}>")
            assert (parsed.block, parsed.procedure) == (None, None)
            (problem,) = parsed.problems
            place, sentence = REFUSED[start]
            assert problem.id == place
            assert problem.fault.sentence.startswith(sentence)
            assert parsed.refusal == problem.fault


def test_an_unreadable_behavior_of_a_procedure_is_dropped_or_if_required_refuses_it() -> None:
    bad = '<head id="no"/>'
    kept = read(f'<p:defineproc id="greet" color="red">{GREETING}{bad}</p:defineproc>')
    assert kept.procedure is not None
    assert [problem.id for problem in kept.problems] == ["greet", "greet:no"]
    assert len(kept.procedure.behaviors) == 2
    lost = read(f'<p:defineproc id="greet">{GREETING}<required>{bad}</required></p:defineproc>')
    assert lost.procedure is None
    assert lost.refusal is not None


def test_the_content_of_a_use_is_ignored() -> None:
    parsed = read(f'<p:useproc procid="greet" bmlid="b" id="x">so{GREETING}</p:useproc>')
    assert parsed.block is not None
    assert not parsed.block.behaviors
    assert [problem.fault.code for problem in parsed.problems] == ["unknown-attribute", "stray-text", "unknown-element"]


def test_a_missing_reference_in_a_procedure_is_reported() -> None:
    parsed = read('<p:defineproc id="greet"><wait id="w" start="look:attackPeak"/></p:defineproc>')
    assert parsed.procedure is not None
    (problem,) = check_references(parsed.procedure)
    assert (problem.id, problem.fault.code) == ("greet:w", "unknown-reference")


def test_a_procedure_inside_a_block_is_dropped(subtests: pytest.Subtests) -> None:
    for name in ["defineproc", "useproc"]:
        with subtests.test(name):
            (parsed,) = parse(f'<bml id="b" xmlns:p="{BMLT}"><p:{name} id="greet"/></bml>', Limits())
            assert parsed.block is not None
            assert not parsed.block.behaviors
            (problem,) = parsed.problems
            assert problem.fault.sentence == f"<{name}> must be placed outside of blocks"


def test_procedures_after_malformed_text_are_read() -> None:
    text = f'& <p:defineproc xmlns:p="{BMLT}" id="greet"/> <p:useproc xmlns:p="{BMLT}" procid="greet" bmlid="b"/>'
    first, second, third = parse(text, Limits())
    assert first.refusal is not None
    assert second.procedure is not None
    assert third.block is not None


def test_a_block_after_a_malformed_procedure_is_read() -> None:
    text = f'<p:defineproc xmlns:p="{BMLT}" id="greet"><gaze></p:defineproc><bml id="b"/>'
    assert [parsed.block and parsed.block.id for parsed in parse(text, Limits())] == [None, "b"]
