"""Requests as SmartBody gets them: words before a document, acts, marks and events."""

from reactive_realizer.bml.behaviors import FaceFacs, Gaze
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.extensions import Emit, Interrupt
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.speech import Speech
from reactive_realizer.bml.vocabulary import Influence
from reactive_realizer.limits import Limits

from .reading import block, only

TABLE_1 = """vrAgentBML request Alice Bob SPEECH_24
<?xml version="1.0" encoding="UTF-8"?>
<act> <bml>
  <speech id="b1">
    <text>
      Wait! That's <tm id="not"> not what I mean.
    </text>
  </speech>
  <sbm:interrupt id="b2" act="SPEECH_23"
    start="b1:start" />
  <gaze id="b3" target="Bob" start="b2:start" />
  <head id="b4" type="SHAKE" stroke="b1:not" />
</bml> </act>
"""
"""The request in table 1 of Thiebaux and others (2008), to the letter."""


def cast(text: str) -> str:
    return block(text).played_by(["alice", "brad", "rachel"])


def test_the_words_before_a_request_name_the_block_and_its_character() -> None:
    for words in ("vrAgentBML request rachel Bob act_7", "vrSpeak rachel ALL act_7"):
        assert block(f"{words} <act><bml/></act>").id == "act_7"
        assert cast(f"{words} <act><bml/></act>") == "rachel"


def test_the_name_of_a_request_becomes_an_id() -> None:
    assert block("vrSpeak brad user sb:7+1 <act><bml/></act>").id == "sb_7_1"


def test_an_actor_plays_the_blocks_of_an_act_unless_the_words_before_name_another_one() -> None:
    act = '<act><participant id="brad" role="actor"/><participant id="rachel" role="addressee"/><bml/></act>'
    assert cast(act) == "brad"
    assert cast(f"vrSpeak rachel brad r1 {act}") == "rachel"
    assert cast('<act><participant id="rachel" role="addressee"/><bml/></act>') == "alice"


def test_the_first_character_stands_in_for_an_actor_that_the_scene_lacks() -> None:
    assert cast('<act><participant id="doctor"/><bml/></act>') == "alice"


def test_a_block_keeps_its_own_id_and_character_in_a_request() -> None:
    own = block('vrSpeak brad user r1 <act><bml id="b" characterId="rachel"/></act>')
    assert (own.id, own.character) == ("b", "rachel")


def test_the_request_of_the_paper_is_read_to_the_letter() -> None:
    speech, interrupt, gaze, head = block(TABLE_1).behaviors
    assert [point for point in speech.sync_points if point not in ("start", "end")] == ["not"]
    assert isinstance(interrupt, Interrupt)
    assert (interrupt.target, str(interrupt.syncs["start"])) == ("SPEECH_23", "b1:start")
    assert (str(gaze.syncs["start"]), gaze.persistent) == ("b2:start", True)
    assert str(head.syncs["stroke"]) == "b1:not"


def test_places_in_a_request_are_those_of_the_text_as_it_was_sent() -> None:
    locations = [behavior.location for behavior in block(TABLE_1).behaviors]
    assert locations == [Location(4, 3), Location(9, 3), Location(11, 3), Location(12, 3)]
    text = 'vrSpeak a b c <bml><speech><tm id="t"> one</speech><head type="NOD"/></bml>'
    assert block(text).behaviors[1].location == Location(1, text.index("<head") + 1)


def test_marks_with_end_tags_stay_as_they_are() -> None:
    speech = only('<speech id="s">one <tm id="a"></tm>two <tm id="b"/>three</speech>')
    assert speech.sync_points == ("start", "a", "b", "end")


def test_the_namespace_that_the_virtual_human_toolkit_declares_is_known() -> None:
    uri = 'xmlns:sbm="http://ict.usc.edu"'
    assert isinstance(only(f'<sbm:interrupt act="b" {uri}/>'), Interrupt)
    gaze = only(f'<gaze participant="brad" target="x" sbm:joint-range="EYES" {uri}/>')
    assert isinstance(gaze, Gaze)
    assert gaze.influence is Influence.EYES


def test_an_event_may_have_the_prefix_or_its_message_as_text() -> None:
    for event in ('<sbm:event message="done 7" stroke="1"/>', "<event stroke='1'><![CDATA[done 7]]></event>"):
        emit = only(event)
        assert isinstance(emit, Emit)
        assert (emit.event, emit.content, str(emit.syncs["start"])) == ("done", "7", "1")


GENERATED = """vrSpeak brad user r7 <?xml version="1.0" encoding="utf-16"?>
<act><participant id="brad" role="actor"/><bml>
  <speech id="sp1" ref="voice_defaultTTS" type="application/ssml+xml"><mark name="T1"/>I <mark name="T2"/>
    <mark name="T2"/>am <mark name="T3"/><mark name="T3"/>late <mark name="T4"/></speech>
  <event message="vrAgentSpeech partial r7 T3 I am " stroke="sp1:T3"/>
  <sbm:event message="vrSpoke brad user r7" stroke="sp1:relax" xmlns:sbm="http://ict.usc.edu"/>
  <head type="NOD" amount="0.1" repeats="1" relax="sp1:T3" priority="1"/>
  <face type="FACS" au="1" amount="5.0" stroke="sp1:T2" priority="1"/>
</bml></act>"""
"""As generators of nonverbal behavior write requests."""


def test_a_request_of_a_generator_is_read() -> None:
    speech, partial, spoke, head, face = block(GENERATED).behaviors
    assert speech.sync_points == ("start", "T1", "T2", "T3", "T4", "end")
    assert speech.descriptions == ()
    assert (str(partial.syncs["start"]), str(spoke.syncs["start"])) == ("sp1:T3", "sp1:end")
    assert str(head.syncs["relax"]) == "sp1:T3"
    assert isinstance(face, FaceFacs)
    assert (face.amount, str(face.syncs["attackPeak"])) == (1.0, "sp1:T2")


def test_a_document_may_declare_the_encoding_that_it_had_before() -> None:
    (parsed,) = parse(b'<?xml version="1.0" encoding="utf-16"?><act><bml id="b"/></act>', Limits())
    assert parsed.block is not None


def test_of_marks_with_the_same_id_the_first_one_counts() -> None:
    (parsed,) = parse('<bml id="b"><speech id="s"><mark name="a"/>so <mark name="a"/>what</speech></bml>', Limits())
    assert not parsed.problems
    assert parsed.block is not None
    (speech,) = parsed.block.behaviors
    assert isinstance(speech, Speech)
    assert speech.text == "so what"
    assert [(mark.id, mark.char_index) for mark in speech.marks] == [("a", 0)]


def test_behaviors_may_stand_directly_in_an_act() -> None:
    own = block('<act>\n<participant id="brad"/><head type="NOD"/> <gaze target="x"/></act>')
    assert (own.id, own.played_by(["alice", "brad"])) == ("document1", "brad")
    assert [behavior.location for behavior in own.behaviors] == [Location(2, 25), Location(2, 44)]
