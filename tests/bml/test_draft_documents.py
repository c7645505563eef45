"""Documents older than BML 1.0: blocks and behaviors without an id, and blocks in elements of other languages."""

import pytest

from reactive_realizer.bml.block import Parsed
from reactive_realizer.bml.document import parse
from reactive_realizer.limits import Limits


def read(text: str, name: str = "document1") -> list[Parsed]:
    return parse(text, Limits(), name)


def ids(text: str, name: str = "document1") -> list[str | None]:
    return [parsed.block.id if parsed.block else None for parsed in read(text, name)]


def told(text: str) -> list[tuple[str, str, int | None]]:
    return [(each.id, each.fault.code, each.fault.line) for parsed in read(text) for each in parsed.problems]


def test_blocks_of_drafts_without_an_id_are_named_after_their_document() -> None:
    assert ids("<bml/><bml id='own'/><bml/>", "document7") == ["document7", "own", "document7_2"]


def test_behaviors_of_drafts_without_an_id_are_numbered_by_element() -> None:
    text = '<bml id="b"><head type="NOD"/><head id="head1" type="NOD"/><gaze target="x"/><head type="SHAKE"/></bml>'
    (parsed,) = read(text)
    assert parsed.block is not None
    assert [behavior.id for behavior in parsed.block.behaviors] == ["head2", "head1", "gaze1", "head3"]
    assert parsed.problems == ()


def test_a_block_may_refer_to_its_own_points_whatever_its_id() -> None:
    (parsed,) = read(
        '<bml><head id="h" type="NOD"/><gesture id="g" type="BEAT" stroke="h:stroke" end="bml:start+3"/></bml>'
    )
    assert parsed.block is not None
    assert parsed.problems == ()
    assert [str(ref) for ref in parsed.block.behaviors[1].syncs.values()] == ["h:stroke", "3"]


WRAPPED = """<?xml version="1.0"?>
<!DOCTYPE fml-apml SYSTEM "fml-apml.dtd" []>
<fml-apml>
  <bml id="one"/>
  <fml><performative id="p" type="greet" start="s1:tm1"/></fml>
  <bml id="two"><wait id="w" duration="1"/></bml>
</fml-apml>"""


def test_blocks_inside_fml_are_read_and_the_fml_is_left_out_with_one_warning() -> None:
    assert ids(WRAPPED) == ["one", "two"]
    assert told(WRAPPED) == [("one", "left-out", 5)]


def test_fml_without_content_is_not_mentioned() -> None:
    assert told('<fml-apml><bml id="b"/><fml>\n</fml></fml-apml>') == []


def test_an_act_of_smartbody_is_a_wrapper_too() -> None:
    text = '<act><participant id="brad" role="actor"/><bml><head type="NOD"/></bml></act>'
    assert ids(text) == ["document1"]
    assert told(text) == []


def test_what_an_act_was_planned_from_is_not_mentioned() -> None:
    text = '<act><fml><turn start="take"/></fml><turn end="give"/><bml id="b"/></act>'
    assert ids(text) == ["b"]
    assert told(text) == []


def test_other_elements_in_an_act_are_left_out_with_one_warning() -> None:
    assert told('<act><mood value="1"/><bml id="b"/></act>') == [("b", "left-out", 1)]


@pytest.mark.parametrize("text", ["<act/>", "<fml-apml><fml><emotion type='joy'/></fml></fml-apml>"])
def test_a_wrapper_without_a_block_is_refused(text: str) -> None:
    assert told(text) == [("bml", "no-block", 1)]


def test_after_an_error_in_a_wrapper_the_next_document_is_read() -> None:
    text = '<act><bml id="one"><oops></bml></act><act><bml id="two"/></act>'
    assert ids(text) == [None, "two"]


def test_the_prefix_of_smartbody_needs_no_declaration() -> None:
    (parsed,) = read('<bml id="b"><gaze target="x" sbm:handle="h"/><sbm:reach target="x"/></bml>')
    assert parsed.block is not None
    assert [behavior.name for behavior in parsed.block.behaviors] == ["gaze", "pointing"]
    assert parsed.problems == ()
