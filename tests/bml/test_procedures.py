"""Procedures: behaviors that are written once and used many times (thesis 6.6.2)."""

import pytest

from reactive_realizer.bml.behaviors import Gaze, Speech
from reactive_realizer.bml.block import Parsed
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML, BMLA, BMLT, Location
from reactive_realizer.bml.references import check_references
from reactive_realizer.bml.words import Composition
from reactive_realizer.limits import Limits

GREETING = '<gaze id="look" target="box"/><speech id="say" start="look:ready"><text>Hi</text></speech>'


def read(xml: str, namespace: str = BMLT) -> Parsed:
    (parsed,) = parse(xml.replace(" ", f' xmlns:p="{namespace}" ', 1), Limits())
    return parsed


@pytest.mark.parametrize("namespace", [BMLA, BMLT])
@pytest.mark.parametrize("core", ["", f' xmlns="{BML}"'])
def test_a_procedure_stands_beside_blocks_and_holds_what_a_block_holds(namespace: str, core: str) -> None:
    tie = '<constraint><synchronize><sync ref="2"/><sync ref="say:end"/></synchronize></constraint>'
    parsed = read(f'<p:defineproc id="greet"{core}>{GREETING}{tie}</p:defineproc>', namespace)
    assert (parsed.block, parsed.problems, parsed.failed, parsed.refusal) == (None, (), False, None)
    assert parsed.procedure is not None
    assert (parsed.procedure.id, parsed.procedure.location) == ("greet", Location(1, 1))
    assert [type(each) for each in parsed.procedure.behaviors] == [Gaze, Speech]
    assert len(parsed.procedure.constraints) == 1
    assert check_references(parsed.procedure) == ()


def test_a_use_is_a_block_with_the_behaviors_of_a_procedure() -> None:
    parsed = read(
        '<p:useproc procid="greet" bmlid="b" scheduling="append" characterId="bob" p:preplan="true" p:chunkAfter="a"/>'
    )
    block = parsed.block
    assert block is not None
    assert not parsed.problems
    assert (block.id, block.procedure, block.behaviors) == ("b", "greet", ())
    assert (block.composition, block.character, block.preplan) == (Composition.APPEND, "bob", True)
    assert (block.chunk_after, block.extensions) == (("a",), {})


def test_a_use_says_what_is_of_its_own_namespace_with_a_prefix_or_without() -> None:
    parsed = read('<p:useproc procid="greet" bmlid="b" appendAfter="a" p:chunkBefore="c" preplan="true"/>')
    block = parsed.block
    assert block is not None
    assert not parsed.problems
    assert (block.append_after, block.chunk_before, block.preplan) == (("a",), ("c",), True)


def test_a_block_of_the_core_says_what_is_of_another_namespace_with_its_prefix() -> None:
    (parsed,) = parse('<bml id="b" preplan="true"/>', Limits())
    assert parsed.block is not None
    assert not parsed.block.preplan
    assert [problem.fault.code for problem in parsed.problems] == ["unknown-attribute"]


def test_a_block_of_its_own_has_no_procedure() -> None:
    (parsed,) = parse('<bml id="b"/>', Limits())
    assert parsed.block is not None
    assert parsed.block.procedure is None


REFUSED = {
    "<p:defineproc >": ("bml", "<defineproc> needs the attribute 'id'"),
    '<p:defineproc id="a:b">': ("bml", "id='a:b' of <defineproc>: an id has"),
    '<p:useproc procid="greet">': ("bml", "<useproc> needs the attribute 'bmlid'"),
    '<p:useproc bmlid="b">': ("b", "<useproc> needs the attribute 'procid'"),
    '<p:callproc id="greet">': ("bml", "<callproc> is no bml block, defineproc or useproc"),
}


@pytest.mark.parametrize("start", REFUSED)
def test_what_has_no_name_is_refused(start: str) -> None:
    parsed = read(f"{start}</{start[1:].split()[0]}>")
    assert (parsed.block, parsed.procedure) == (None, None)
    (problem,) = parsed.problems
    place, sentence = REFUSED[start]
    assert problem.id == place
    assert problem.fault.sentence.startswith(sentence)
    assert parsed.refusal == problem.fault


def test_what_cannot_be_read_in_a_procedure_is_dropped_unless_it_is_required() -> None:
    bad = '<head id="no"/>'
    kept = read(f'<p:defineproc id="greet" color="red">{GREETING}{bad}</p:defineproc>')
    assert kept.procedure is not None
    assert [problem.id for problem in kept.problems] == ["greet", "greet:no"]
    assert len(kept.procedure.behaviors) == 2
    lost = read(f'<p:defineproc id="greet">{GREETING}<required>{bad}</required></p:defineproc>')
    assert lost.procedure is None
    assert lost.refusal is not None


def test_a_use_holds_nothing_itself() -> None:
    parsed = read(f'<p:useproc procid="greet" bmlid="b" id="x">so{GREETING}</p:useproc>')
    assert parsed.block is not None
    assert not parsed.block.behaviors
    assert [problem.fault.code for problem in parsed.problems] == ["unknown-attribute", "stray-text", "unknown-element"]


def test_a_reference_to_nothing_in_a_procedure_is_found() -> None:
    parsed = read('<p:defineproc id="greet"><wait id="w" start="look:ready"/></p:defineproc>')
    assert parsed.procedure is not None
    (problem,) = check_references(parsed.procedure)
    assert (problem.id, problem.fault.code) == ("greet:w", "unknown-reference")


@pytest.mark.parametrize("name", ["defineproc", "useproc"])
def test_inside_a_block_it_is_dropped_and_told_where_it_belongs(name: str) -> None:
    (parsed,) = parse(f'<bml id="b" xmlns:p="{BMLT}"><p:{name} id="greet"/></bml>', Limits())
    assert parsed.block is not None
    assert not parsed.block.behaviors
    (problem,) = parsed.problems
    assert problem.fault.sentence == f"<{name}> stands beside blocks, not in one"


def test_after_what_is_no_xml_reading_goes_on_with_the_next_procedure() -> None:
    text = f'& <p:defineproc xmlns:p="{BMLT}" id="greet"/> <p:useproc xmlns:p="{BMLT}" procid="greet" bmlid="b"/>'
    first, second, third = parse(text, Limits())
    assert first.refusal is not None
    assert second.procedure is not None
    assert third.block is not None


def test_after_a_malformed_procedure_reading_goes_on_with_the_next_block() -> None:
    text = f'<p:defineproc xmlns:p="{BMLT}" id="greet"><gaze></p:defineproc><bml id="b"/>'
    assert [parsed.block and parsed.block.id for parsed in parse(text, Limits())] == [None, "b"]
