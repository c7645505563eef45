"""Messages of the Virtual Human Toolkit, as programs send them."""

import pytest
from lxml import etree

from reactive_realizer.bml.document import parse
from reactive_realizer.bridges.vhmsg_messages import Act
from reactive_realizer.client.vh_message import VhMessage
from reactive_realizer.limits import Limits

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


def test_a_command_of_smartbody_that_plays_bml_is_a_request() -> None:
    """As generators of nonverbal behavior send saccades."""
    saccade = '<saccade magnitude="-5" sbm:duration="0.2" direction="70"/>'
    act = Act.of(VhMessage("sbm", f"bml char brad {saccade}"))
    assert act == Act("brad", "all", "sbm", saccade)
    text, ids = act.document("alice", {"sbm"})
    assert ids == ["sbm_2"]
    assert etree.fromstring(text)[0].tag == "saccade"


@pytest.mark.parametrize(
    ("word", "argument"),
    [
        ("sbm", "set camera eye 1 2 3"),
        ("sbm", "bml char brad"),
        ("sb", "scene.run('a.py')"),
        ("vrSpeak", "brad all m1"),
        ("vrSpeak", ""),
        ("vrAgentBML", "brad m1 start"),
        ("vrSpoke", "brad all m1 <bml/>"),
    ],
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
    "xml",
    [
        '<act><participant id="brad" role="actor"/>{}<head id="h" type="NOD"/></act>',
        '{}<head id="h" type="NOD"/>',
        '<?xml version="1.0" encoding="utf-16"?>\n<act>{}<head id="h" type="NOD"/></act>',
    ],
)
def test_behaviors_without_a_block_get_one(xml: str) -> None:
    speech = '<speech id="s"><mark name="T0"/>hello</speech>'
    text, ids = request(xml.format(speech)).document("alice", ())
    block = etree.fromstring(text)
    assert ids == ["m1"]
    assert (block.tag, dict(block.items())) == ("bml", {"id": "m1", "characterId": "alice"})
    assert [each.tag for each in block] == ["speech", "head"]


def test_each_act_without_a_block_gets_its_own() -> None:
    text, ids = request('<act><head type="NOD"/></act><act><wait/></act>').document("alice", ())
    assert ids == ["m1", "m1_2"]
    assert [each[0].tag for each in etree.fromstring(f"<_>{text}</_>")] == ["head", "wait"]


def test_marks_without_end_tags_are_closed() -> None:
    text, _ = request('<act><bml><speech>That is <tm id="not"> not it.</speech></bml></act>').document("alice", ())
    (block,) = parse(text, Limits())
    assert block.block is not None
    assert "not" in block.block.behaviors[0].sync_points


REAL = """<?xml version="1.0" encoding="utf-16"?><act><participant id="brad" role="actor" /><bml>
<speech id="sp1" ref="voice_defaultTTS" type="application/ssml+xml"><mark name="T0" />it <mark name="T1" />
<mark name="T2" />works <mark name="T3" /></speech>
<event message="vrAgentSpeech partial 7-1 T1 it " stroke="sp1:T1" />
<event message="vrAgentSpeech partial 7-1 T5 it works so " stroke="sp1:T5" />
<sbm:event message="vrSpoke brad user 7 it works." stroke="sp1:relax" xmlns:xml="http://www.w3.org/XML/1998/namespace"
  xmlns:sbm="http://ict.usc.edu" />
<intonation_tone endtone="L-H%" start="sp1:T0" end="sp1:T3"/><!--Noun clause nod-->
<head type="NOD" amount="0.20" repeats="1.0" start="sp1:T2" priority="5" duration="1" />
<gaze participant = "brad" id ="gaze" target="user" direction="POLAR 0" angle="0" joint-range="HEAD EYES"
  xmlns:sbm="http://ict.usc.edu" /></bml></act>"""
"""A request with all that generators of nonverbal behavior are seen to write, also what refers to no mark."""


def test_a_request_of_a_generator_is_passed_on_whole() -> None:
    text, _ = request(REAL).document("alice", ())
    (read,) = parse(text, Limits())
    assert read.block is not None
    assert [each.name for each in read.block.behaviors] == ["speech", "emit", "emit", "emit", "head", "gaze"]
    assert [each.fault.code for each in read.problems] == ["unknown-behavior"]


@pytest.mark.parametrize(
    "xml",
    [
        "<bml><speech></bml>",
        "<act/>",
        '<act><participant id="brad"/></act>',
        "hello",
        '<!DOCTYPE a [<!ENTITY e "x">]><bml>&e;</bml>',
    ],
)
def test_what_has_no_well_formed_block_is_refused(xml: str) -> None:
    with pytest.raises(ValueError):
        request(xml).document("alice", ())
