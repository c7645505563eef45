"""Messages of the Virtual Human Toolkit, as programs send them."""

import pytest
from lxml import etree

from reactive_realizer.bridges.vhmsg_messages import Act, VhMessage

SPEECH = '<speech id="s"><text>Up &amp; down + 50%</text></speech>'
ACT = f'<?xml version="1.0"?><act><participant id="brad" role="actor"/><bml agent="brad">{SPEECH}</bml></act>'


def request(xml: str = ACT, name: str = "m1") -> Act:
    act = Act.of(VhMessage("vrSpeak", f"brad user {name} {xml}"))
    assert act is not None
    return act


@pytest.mark.parametrize("argument", ["brad user m1 <bml/>", "all", "", "50% + 1 < ü"])
def test_a_message_survives_being_sent(argument: str) -> None:
    message = VhMessage("vrSpeak", argument)
    assert VhMessage.read(message.text) == message


def test_an_argument_that_is_not_encoded_is_read_as_it_is() -> None:
    assert VhMessage.read("vrSpeak brad user m1 <a>50%+1</a>").argument == "brad user m1 <a>50%+1</a>"


def test_both_requests_name_agent_recipient_and_message() -> None:
    wanted = Act("brad", "all", "m1", "<bml/>")
    assert Act.of(VhMessage("vrSpeak", "brad all m1 <bml/>")) == wanted
    assert Act.of(VhMessage("vrAgentBML", "request brad all m1 <bml/>")) == wanted


@pytest.mark.parametrize(
    ("word", "argument"),
    [("vrSpeak", "brad all m1"), ("vrSpeak", ""), ("vrAgentBML", "brad m1 start"), ("vrSpoke", "brad all m1 <bml/>")],
)
def test_other_messages_are_no_requests(word: str, argument: str) -> None:
    assert Act.of(VhMessage(word, argument)) is None


def test_the_blocks_of_a_request_get_its_name_and_its_character() -> None:
    text, ids = request().document("alice", ())
    block = etree.fromstring(text)
    assert (ids, dict(block.items())) == (["m1"], {"id": "m1", "characterId": "alice"})
    assert block.findtext("speech/text") == "Up & down + 50%"


def test_ids_are_free_and_well_formed() -> None:
    _, ids = request("<act><bml/><bml/></act>", "a:b/c").document("alice", {"a_b_c"})
    assert ids == ["a_b_c_2", "a_b_c_3"]


def test_the_prefix_of_smartbody_needs_no_declaration() -> None:
    text, _ = request('<act><bml><sbm:event message="x y" start="0"/></bml></act>').document("alice", ())
    assert etree.fromstring(text)[0].tag == "{urn:smartbody}event"


@pytest.mark.parametrize(
    "xml", ["<bml><speech></bml>", "<act/>", "hello", '<!DOCTYPE a [<!ENTITY e "x">]><bml>&e;</bml>']
)
def test_what_has_no_well_formed_block_is_refused(xml: str) -> None:
    with pytest.raises(ValueError):
        request(xml).document("alice", ())
