"""Documents without a namespace, which are read as drafts before BML 1.0."""

from pathlib import Path

import pytest

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import (
    REFERENCE,
    Face,
    FaceFacs,
    FaceLexeme,
    Gaze,
    GazeShift,
    Gesture,
    Head,
    Pointing,
    Pose,
    Posture,
    PostureShift,
    Wait,
)
from reactive_realizer.bml.block import BehaviorBlock, Order, Parsed, Synchronize
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.extensions import Emit
from reactive_realizer.bml.markup import MarkupKind
from reactive_realizer.bml.names import BML, BMLT, Location
from reactive_realizer.bml.references import check_references
from reactive_realizer.bml.speech import RecordedSpeech, Speech
from reactive_realizer.bml.vocabulary import Composition, Influence, Mode, PosePart, Side, StanceType
from reactive_realizer.limits import Limits

OWN = Path(__file__).parents[1] / "data" / "bml" / "drafts"


def read(inside: str, attributes: str = "") -> Parsed:
    """The result of reading the block b of a draft, with the prefix bmlt declared."""
    (parsed,) = parse(f'<bml xmlns:bmlt="{BMLT}" id="b" {attributes}>{inside}</bml>', Limits())
    return parsed


def block(inside: str, attributes: str = "") -> BehaviorBlock:
    """The block, which must have no problems."""
    parsed = read(inside, attributes)
    assert parsed.block is not None
    assert not parsed.problems
    return parsed.block


WRITTEN: dict[str, tuple[type[Behavior], dict[str, object]]] = {
    '<head id="x" action="ROTATION" rotation="NOD"/>': (Head, {"lexeme": "NOD", "repetition": 1}),
    '<head id="x" action="rotation" rotation="y" repeats="3"/>': (Head, {"lexeme": "SHAKE", "repetition": 3}),
    '<head id="x" rotation="Z"/>': (Head, {"lexeme": "TILT"}),
    '<head id="x" type="TOSS"/>': (Head, {"lexeme": "TOSS"}),
    '<head id="x" lexeme="NOD"/>': (Head, {"lexeme": "NOD"}),
    '<head id="x" lexeme="Down_Aside_Right"/>': (Head, {"lexeme": "DOWN_RIGHT"}),
    '<head id="x" type="NOD" repeats="0.5"/>': (Head, {"lexeme": "NOD", "repetition": 1}),
    '<gesture id="x"><description level="1" type="t"><reference>beat=Circle</reference></description></gesture>': (
        Gesture,
        {"lexeme": "Circle"},
    ),
    '<gaze id="x" type="GAZE" offsetAngle="20"/>': (Gaze, {"target": "viewer", "offset_angle": 20.0}),
    '<gaze id="x" sbm:target-pos="1 1.5 2" sbm:joint-range="EYES CHEST"/>': (
        Gaze,
        {"target": "1 1.5 2", "influence": Influence.SHOULDER},
    ),
    '<gazeShift id="x" target="box" modality="SHOULDER"/>': (GazeShift, {"influence": Influence.SHOULDER}),
    '<face id="x" type="facs" au="1_left" amount="1"/>': (FaceFacs, {"au": 1, "side": Side.LEFT}),
    '<face id="x"><lexeme lexeme="SMILE"/></face>': (Face, {"name": "face"}),
    '<face id="x"><description type="t"><reference>affect=joy</reference></description></face>': (
        FaceLexeme,
        {"lexeme": "joy"},
    ),
    '<torso id="x" lexeme="forward"/>': (
        Posture,
        {"poses": (Pose(part=PosePart.WHOLEBODY, lexeme="LEANING_FORWARD"),)},
    ),
    '<torso id="x" lexeme="BodyRecline"/>': (
        Posture,
        {"poses": (Pose(part=PosePart.WHOLEBODY, lexeme="LEANING_BACKWARD"),)},
    ),
    '<body id="x" posture="Sulk"/>': (Posture, {"poses": (Pose(part=PosePart.WHOLEBODY, lexeme="Sulk"),)}),
    '<shoulder id="x" lexeme="UP"/>': (Posture, {"poses": (Pose(part=PosePart.ARMS, lexeme="UP"),)}),
    '<WAIT id="x" duration="1"/>': (Wait, {"duration": 1.0}),
    '<greta:torso xmlns:greta="gretaNameSpace" id="x" lexeme="Neutral"/>': (
        Posture,
        {"poses": (Pose(part=PosePart.WHOLEBODY, lexeme="WHOLEBODY_NEUTRAL"),)},
    ),
    '<gesture id="x" type="BEAT" hand="left"/>': (Gesture, {"lexeme": "BEAT", "mode": Mode.LEFT_HAND}),
    '<gesture id="x" type="LEXICALIZED" lexeme="wave" hand="BOTH"/>': (
        Gesture,
        {"lexeme": "wave", "mode": Mode.BOTH_HANDS},
    ),
    '<gesture id="x" type="point" target="box" hand="RIGHT_HAND"/>': (
        Pointing,
        {"target": "box", "mode": Mode.RIGHT_HAND, "name": "pointing"},
    ),
    '<gaze id="x" type="AT" target="box" modality="TORSO"/>': (Gaze, {"target": "box", "influence": Influence.WAIST}),
    '<gaze id="x" target="box" modality="legs"/>': (Gaze, {"influence": Influence.WHOLE}),
    '<face id="x" type="FACS" au="12" side="LEFT" amount="1"/>': (
        FaceFacs,
        {"au": 12, "side": Side.LEFT, "amount": 1.0},
    ),
    '<face id="x" au="4"/>': (FaceFacs, {"au": 4}),
    '<face id="x" type="lexicalized" lexeme="OPEN_MOUTH"/>': (FaceLexeme, {"lexeme": "OPEN_MOUTH"}),
    '<face id="x"><faceLexeme lexeme="OPEN_MOUTH"/></face>': (Face, {"amount": 0.5}),
    '<face id="x" type="happy"/>': (FaceLexeme, {"lexeme": "JOY"}),
    '<face id="x" type="Afraid" start="1" end="2"/>': (FaceLexeme, {"lexeme": "FEAR"}),
    '<posture id="x" stance="sitting"/>': (Posture, {"stance": StanceType.SITTING, "poses": ()}),
    '<posture id="x" stance="standing" shape="open" part="lower"/>': (
        Posture,
        {"stance": StanceType.STANDING, "poses": (Pose(part=PosePart.LEGS, lexeme="LEGS_OPEN"),)},
    ),
    '<posture id="x" shape="crossed" part="arms"/>': (
        Posture,
        {"stance": None, "poses": (Pose(part=PosePart.ARMS, lexeme="ARMS_CROSSED"),)},
    ),
    '<posture id="x" shape="leaning_forward"/>': (
        Posture,
        {"poses": (Pose(part=PosePart.WHOLEBODY, lexeme="LEANING_FORWARD"),)},
    ),
    '<speech id="x" type="text/plain">Hello there</speech>': (Speech, {"text": "Hello there"}),
    '<speech id="x">Hello <tm id="T1"/>there<description priority="1" type="t"/></speech>': (
        Speech,
        {"text": "Hello there", "sync_points": ("start", "T1", "end")},
    ),
    '<speech id="x"><text>Hello <tm id="t"/>there</text></speech>': (Speech, {"sync_points": ("start", "t", "end")}),
}


def test_a_behavior_of_a_draft_becomes_one_of_bml_1_0(subtests: pytest.Subtests) -> None:
    for xml, (kind, values) in WRITTEN.items():
        with subtests.test(xml):
            (behavior,) = block(xml).behaviors
            assert type(behavior) is kind
            assert {name: getattr(behavior, name) for name in values} == values


def test_the_content_of_a_description_is_not_rewritten() -> None:
    (speech,) = block(
        '<speech id="s"><text>Hi</text><description priority="1" type="t"><tm id="a"/></description></speech>'
    ).behaviors
    assert speech.descriptions[0].content == f'<tm xmlns:bmlt="{BMLT}" id="a"/>'


def test_a_draft_may_have_elements_of_bml_1_0() -> None:
    assert len(block('<gesture id="g" lexeme="BEAT" mode="LEFT_HAND"/><wait id="w" duration="1"/>').behaviors) == 2


def test_sync_points_of_drafts_may_be_spelled_with_an_underscore() -> None:
    (one, two) = block(
        '<gesture id="g" type="BEAT" stroke_start="1"/><head id="h" type="NOD" start="g:stroke_end+1"/>'
    ).behaviors
    assert list(one.syncs) == ["strokeStart"]
    assert str(two.syncs["start"]) == "g:strokeEnd+1"


def test_a_mark_keeps_its_name() -> None:
    read = block('<speech id="s">Oh <tm id="stroke_start"/>no</speech><head id="h" type="NOD" start="s:stroke_start"/>')
    assert check_references(read) == ()


def test_the_reference_of_a_synchronize_is_one_of_its_points() -> None:
    tie, order = block(
        '<head id="h" type="NOD"/><constraint><synchronize ref="4"><sync ref="h:end"/></synchronize></constraint>'
        '<constraint><after ref="1"><sync ref="h:stroke_start"/></after></constraint>'
    ).constraints
    assert isinstance(tie, Synchronize)
    assert isinstance(order, Order)
    assert [str(ref) for ref in tie.refs] == ["4", "h:end"]
    assert [str(ref) for ref in order.refs] == ["h:strokeStart"]


COMPOSITIONS = [
    ('scheduling="append"', Composition.APPEND, (), ()),
    ('scheduling="append-after(b1,b2)"', Composition.MERGE, ("b1", "b2"), ()),
    ('start="b1:end"', Composition.MERGE, ("b1",), ()),
    ('start="b1:relax" bmlt:chunkAfter="b2"', Composition.MERGE, (), ("b2", "b1")),
]


def test_the_composition_of_a_draft_is_read(subtests: pytest.Subtests) -> None:
    for written, composition, appended, chunked in COMPOSITIONS:
        with subtests.test(written):
            read = block("", written)
            assert (read.composition, read.append_after, read.chunk_after) == (composition, appended, chunked)


ELEMENTS_WITHOUT_END = ['gaze id="x" target="box"', 'posture id="x" stance="sitting"']


def test_a_gaze_or_posture_without_an_end_persists(subtests: pytest.Subtests) -> None:
    for element in ELEMENTS_WITHOUT_END:
        for end in ['relax="3"', 'end="3"']:
            with subtests.test(f"{element} {end}"):
                assert [getattr(each, "persistent", None) for each in block(f"<{element}/>").behaviors] == [True]
                assert [getattr(each, "persistent", None) for each in block(f"<{element} {end}/>").behaviors] == [False]


def test_a_constraint_on_the_end_of_a_gaze_ends_it_and_a_behavior_that_starts_there_does_not() -> None:
    tie = '<constraint><synchronize ref="b1:two:end"><sync ref="one:end"/></synchronize></constraint>'
    gazes = '<gaze id="one" target="box"/><gaze id="two" target="box"/>'
    read = block(f'{gazes}<head id="h" type="NOD" start="two:end"/>{tie}', 'bmlt:allowexternalrefs="true"')
    assert [each.persistent for each in read.behaviors if isinstance(each, Gaze)] == [False, True]


def test_nothing_persists_in_bml_1_0_and_no_shift_persists_in_a_draft() -> None:
    gaze = '<gaze id="g" target="box"/>'
    (parsed,) = parse(f'<bml xmlns="{BML}" id="b">{gaze}</bml>', Limits())
    assert parsed.block is not None
    shifts = block('<gazeShift id="g" target="box"/><postureShift id="p"><stance type="SITTING"/></postureShift>')
    assert [isinstance(each, Gaze | PostureShift) and each.persistent for each in shifts.behaviors] == [False, False]
    assert [isinstance(each, Gaze) and each.persistent for each in parsed.block.behaviors] == [False]


OUTSIDE = '<head id="h" type="NOD" start="{}"/>'


def test_a_draft_may_refer_to_behaviors_of_other_blocks_only_if_it_says_so() -> None:
    (problem,) = read(OUTSIDE.format("b1:g:end")).problems
    assert problem.id == "b:h"
    assert problem.fault.sentence.endswith(
        "this behavior belongs to another block; a draft must set bmlt:allowexternalrefs='true' to refer to it"
    )
    assert block(OUTSIDE.format("b1:g:end"), 'bmlt:allowexternalrefs="true"').external_refs


ALWAYS_ALLOWED = ["anticipators:a:stop+1", "b1:relax", "b1:end", "b:h:end", "b1:2"]


def test_blocks_anticipators_and_the_own_block_may_always_be_referenced(subtests: pytest.Subtests) -> None:
    for ref in ALWAYS_ALLOWED:
        with subtests.test(ref):
            block(OUTSIDE.format(ref))


def test_bml_1_0_may_always_refer_to_behaviors_of_other_blocks() -> None:
    (parsed,) = parse(f'<bml xmlns="{BML}" id="b"><wait id="w" start="b1:g:end"/></bml>', Limits())
    assert not parsed.problems


def only(inside: str) -> Behavior:
    """The only behavior, which is read without problems."""
    (behavior,) = block(inside).behaviors
    return behavior


SPOKEN = {
    "accent": (
        '<tm id="a"/>one <tm id="b"/>two <tm id="c"/>three<pitchaccent level="strong" start="x:b" end="x:c"/>',
        [(MarkupKind.EMPHASIS, "two ", "strong")],
    ),
    "accent on two words": (
        '<tm id="a"/>one <tm id="b"/>two <tm id="c"/><pitchaccent start="x:a" end="x:c"/>',
        [(MarkupKind.EMPHASIS, "one ", "moderate"), (MarkupKind.EMPHASIS, "two", "moderate")],
    ),
    "boundary": ('one <tm id="a"/>two<boundary start="x:a" end="x:a+0.3"/>', [(MarkupKind.BREAK, "", "0.3")]),
    "boundary of a phrase": (
        '<tm id="a"/>one <tm id="b"/>two<boundary type="LL" start="x:a" end="x:b"/>',
        [(MarkupKind.BREAK, "", "0.25")],
    ),
}


@pytest.mark.parametrize("name", SPOKEN)
def test_accents_and_boundaries_between_marks_are_prosody(name: str) -> None:
    inside, markup = SPOKEN[name]
    speech = only(f'<speech id="x">{inside}</speech>')
    assert isinstance(speech, Speech)
    spoken, plain = speech.forms
    assert isinstance(spoken, Speech)
    assert isinstance(plain, Speech)
    assert (spoken.text, spoken.marks) == (plain.text, plain.marks)
    said = [(each.kind, spoken.text[each.first : each.last], each.text or f"{each.number:g}") for each in spoken.markup]
    assert said == markup


def test_ssml_among_words_is_followed(subtests: pytest.Subtests) -> None:
    words = (
        'Come <mark name="a"/>in,<break time="300ms"/> <emphasis level="strong">do <mark name="b"/>come</emphasis> in.'
    )
    for inside in (words, f"<text>{words}</text>"):
        with subtests.test(inside):
            speech = only(f'<speech id="x" type="application/ssml+xml">{inside}</speech>')
            assert isinstance(speech, Speech)
            spoken, plain = speech.forms
            assert isinstance(spoken, Speech)
            assert isinstance(plain, Speech)
            assert spoken.text == plain.text == "Come in, do come in."
            assert [mark.id for mark in spoken.marks] == [mark.id for mark in plain.marks] == ["a", "b"]
            assert [(each.kind, each.text) for each in spoken.markup] == [
                (MarkupKind.BREAK, ""),
                (MarkupKind.EMPHASIS, "strong"),
            ]


def test_an_accent_between_unknown_marks_is_left_out_with_a_problem() -> None:
    (problem,) = read('<speech id="x">so <tm id="a"/>be it<pitchaccent start="x:a" end="x:z"/></speech>').problems
    assert problem.fault.sentence == "the speech has no inline sync point 'z'; it has a"


def test_too_many_accents_are_left_out_with_problems() -> None:
    accents = '<pitchaccent start="x:a" end="x:a"/>' * 1_001
    problems = read(f'<speech id="x"><tm id="a"/>so{accents}</speech>').problems
    assert [problem.fault.code for problem in problems] == ["too-much-markup", "unknown-element"]


def test_text_around_descriptions_keeps_its_order() -> None:
    speech = only('<speech id="x">one <description level="1" type="t"/> two <tm id="a"/>three</speech>')
    assert isinstance(speech, Speech)
    assert speech.text == "one two three"
    assert [(mark.id, mark.char_index) for mark in speech.marks] == [("a", 8)]


def test_the_text_of_a_speech_may_be_an_attribute() -> None:
    speech = only('<speech id="x" text="Hello" language="english" voice="marytts" type="SAPI4"/>')
    assert isinstance(speech, Speech)
    assert speech.text == "Hello"


def test_a_speech_file_of_smartbody_is_a_recording_with_times() -> None:
    speech = only(
        '<speech id="x" ready="0.1" relax="0.2"><text><sync id="T0" time="0"/>bye <sync id="T1" time="0.31"/></text>'
        '<description level="1" type="audio/x-wav"><file ref="bye"/></description></speech>'
    )
    recording, _ = speech.forms
    assert isinstance(recording, RecordedSpeech)
    assert recording.file_name == "bye"
    assert [(each.id, each.time) for each in recording.mark_times] == [("T0", 0.0), ("T1", 0.31)]


def test_shapes_of_the_mouth_beside_a_speech_are_not_mentioned() -> None:
    inside = '<lips viseme="Ah" start="0" end="0.2"/><curves><curve name="Ah">0 0</curve></curves>'
    speech = only(f'{inside}<speech id="x">Hi</speech>')
    assert isinstance(speech, Speech)


def test_a_number_after_the_id_of_a_speech_is_the_name_of_its_mark() -> None:
    _, gesture = block(
        '<speech id="s">so <sync id="1"/>there</speech><gesture id="g" type="BEAT" stroke="s:1"/>'
    ).behaviors
    assert gesture.syncs["stroke"].sync == "1"


def test_a_block_may_name_its_character_as_greta_does() -> None:
    assert block("", 'character="alice"').character == "alice"


def test_the_first_character_of_a_scene_stands_in_for_an_unknown_agent_of_embots() -> None:
    own = block("", 'agent="alice"')
    assert [own.played_by(scene) for scene in (["bob", "alice"], ["bob"])] == ["alice", "bob"]


def test_a_face_of_embots_is_complete_from_the_start_of_its_stroke_to_the_end() -> None:
    face = only('<face id="x" type="sad" stroke_start="1" stroke_end="2"/>')
    assert {point: str(ref) for point, ref in face.syncs.items()} == {"attackPeak": "1", "relax": "2"}


def test_what_is_before_the_start_of_a_block_comes_as_early_as_possible() -> None:
    gaze = only('<gaze id="x" start="-1.8" ready="-1.3" relax="2.6" end="3.1"/>')
    assert {point: str(ref) for point, ref in gaze.syncs.items()} == {"start": "0", "relax": "2.6", "end": "3.1"}


GRETA = "http://www.mindmakers.org/projects/BML"


def test_a_document_in_the_namespace_of_greta_is_a_draft() -> None:
    unset = 'reaction_type="NONE" reaction_duration="NONE" social_attitude="neutral"'
    speech = '<speech xmlns="" id="s" start="-0.5"><tm id="t1"/>Hello</speech>'
    torso = '<v:torso xmlns:v="VIBNameSpace" id="t" lexeme="forward" start="s:t1"/>'
    (parsed,) = parse(
        f'<bml xmlns="{GRETA}" id="b" character="Greta" composition="blend" {unset}>{speech}{torso}</bml>', Limits()
    )
    assert not parsed.problems
    assert parsed.block is not None
    assert parsed.block.composition is Composition.MERGE
    assert parsed.block.character is None
    assert [parsed.block.played_by(cast) for cast in (["alice", "Greta"], ["alice"])] == ["Greta", "alice"]
    assert [type(each) for each in parsed.block.behaviors] == [Speech, Posture]
    assert parsed.block.behaviors[0].syncs["start"].offset == 0.0


def test_a_reference_in_a_description_says_more_than_the_lexeme() -> None:
    def referred(element: str, attributes: str, reference: str) -> str | None:
        description = f'<description type="gretabml"><reference>{reference}</reference></description>'
        (behavior,) = block(f'<{element} id="x" {attributes}>{description if reference else ""}</{element}>').behaviors
        return behavior.extensions.get(REFERENCE)

    assert referred("head", 'lexeme="NOD"', "Nod_Big") == "Nod_Big"
    assert referred("gesture", 'lexeme="Circle"', "beat=Circle") == "beat=Circle"
    assert referred("gesture", "", "beat=Circle") == "beat=Circle"
    assert referred("head", 'lexeme="Down_Aside_Right"', "") == "Down_Aside_Right"
    assert referred("head", 'lexeme="Down_Aside_Right"', "DOWN_ASIDE_RIGHT") == "Down_Aside_Right"
    assert referred("torso", 'lexeme="forward"', "") == "forward"
    assert referred("head", 'lexeme="NOD"', "nod") is None
    assert referred("torso", 'lexeme="Sway"', "Sway") is None
    assert referred("torso", 'lexeme="BodyLean"', "BodyLean") == "BodyLean"


DROPPED = {
    '<gaze id="x" type="AVERT" target="box"/>': "type='AVERT' of <gaze>: not one of AT, GAZE",
    '<head id="x" action="ORIENTATION" rotation="NOD"/>': "action='ORIENTATION' of <head>: not one of ROTATION; "
    "did you mean 'ROTATION'?",
    '<head id="x" action="ROTATION"/>': "<head> requires the attribute 'lexeme'",
    '<gesture id="x" type="LEXICALIZED"/>': "<gesture> requires the attribute 'lexeme'",
    '<gesture id="x" type="POINT"/>': "<pointing> requires the attribute 'target'",
    '<gesture id="x" type="BEAT" hand="THIRD"/>': "mode='THIRD' of <gesture>: not one of LEFT_HAND, RIGHT_HAND, "
    "BOTH_HANDS",
    '<face id="x" type="EYEBROWS"/>': "type='EYEBROWS' of <face>: not one of FACS, LEXICALIZED",
    '<face id="x" type="FACS"/>': "<faceFacs> requires the attribute 'au'",
    '<posture id="x" part="lower"/>': "<posture> must contain <stance> or <pose>",
    '<posture id="x" stance="flying"/>': "type='flying' of <stance>: not one of SITTING, CROUCHING, STANDING, LYING; "
    "did you mean 'LYING'?",
    '<speech id="x"/>': "<speech> must contain <text>",
    '<constraint id="x"><synchronize ref="1"/></constraint>': "<synchronize> must contain <sync> and <sync>",
}


def test_what_bml_1_0_cannot_express_is_dropped_with_one_problem_at_its_location(subtests: pytest.Subtests) -> None:
    for bad in DROPPED:
        with subtests.test(bad):
            (parsed,) = parse(f'<bml id="b">\n {bad}\n <wait id="after"/></bml>', Limits())
            assert parsed.block is not None
            assert [each.id for each in parsed.block.behaviors] == ["after"]
            (problem,) = parsed.problems
            assert (problem.id, problem.fault.sentence, problem.fault.line) == ("b:x", DROPPED[bad], 2)


KEPT = {
    '<gesture id="x" type="BEAT" lexeme="WAVE"/>': "unknown attribute type of <gesture>",
    '<gesture id="x" type="BEAT" twoHanded="true"/>': "unknown attribute twoHanded of <gesture>",
    '<head id="x" rotation="NOD" type="SHAKE"/>': "unknown attribute type of <head>",
    '<posture id="x" stance="sitting" part="upper"/>': "unknown attribute part of <posture>",
    '<speech id="x">Hi<tm id="a" pace="2"/></speech>': "unknown attribute pace of <tm>",
    '<speech id="x">Hi<tm id="a" pace="2"> you</speech>': "unknown attribute pace of <tm>",
    '<speech id="x">Hi<mark name="a" pace="2"/></speech>': "unknown attribute pace of <mark>",
    '<speech id="x">Hi<sync id="a" pace="2"/></speech>': "unknown attribute pace of <sync>",
    '<speech id="x">Hi<sync id="a" time="1"/></speech>': "time of a has no effect",
    '<lips viseme="Ah"/><wait id="x" duration="1"/>': "lips is left out: lips follow the sound of a speech",
    '<speech id="x">Hi <b>you</b></speech>': "unknown b in <text>; known: sync",
}


def test_unknown_content_of_a_draft_is_ignored_with_one_problem(subtests: pytest.Subtests) -> None:
    for odd in KEPT:
        with subtests.test(odd):
            parsed = read(odd)
            assert parsed.block is not None
            assert len(parsed.block.behaviors) == 1
            (problem,) = parsed.problems
            assert problem.fault.sentence.startswith(KEPT[odd])


def test_composition_takes_precedence_over_scheduling() -> None:
    parsed = read("", 'scheduling="append" composition="replace"')
    (problem,) = parsed.problems
    assert problem.fault.sentence.startswith("unknown attribute scheduling of <bml>")
    assert parsed.block is not None
    assert parsed.block.composition is Composition.REPLACE


def test_an_event_of_smartbody_is_an_emit() -> None:
    parsed = read('<event message="vrSpoke brad  user" stroke="x:end"/><event id="e" message="done" start="1"/>')
    assert parsed.block is not None
    first, second = (each for each in parsed.block.behaviors if isinstance(each, Emit))
    assert (first.id, first.event, first.content, str(first.syncs["start"])) == (
        "event1",
        "vrSpoke",
        "brad  user",
        "x:end",
    )
    assert (second.id, second.event, second.content, str(second.syncs["start"])) == ("e", "done", "", "1")
    assert parsed.problems == ()


def test_an_event_of_smartbody_without_a_message_is_dropped() -> None:
    (problem,) = read('<event start="1"/>').problems
    assert problem.fault.sentence == "<emit> requires the attribute 'event'"


def test_a_block_cannot_start_at_the_stroke_of_a_behavior() -> None:
    (problem,) = read('<gesture id="g" lexeme="BEAT"/>', 'start="g:stroke"').problems
    assert problem.fault.sentence.startswith("start='g:stroke' of <bml>: a block can start at a sync point of another")


def test_rewritten_elements_keep_their_location() -> None:
    (problem,) = read('<wait id="w"/>\n <speech id="x">Hi<tm/></speech>').problems
    assert problem.fault.sentence == "<sync> requires the attribute 'id'"
    assert problem.fault.line == 2
    (parsed,) = parse('<bml id="b">\n  <posture id="p" stance="sitting"/></bml>', Limits())
    assert parsed.block is not None
    assert parsed.block.behaviors[0].location == Location(2, 3)


DRAFTED = {
    "embots_talk": "Speech Gesture",
    "greta_welcome": "Speech Head Face GazeShift",
    "smartbody_faces": "Speech FaceFacs FaceFacs Gaze Head Posture",
    "interrupts": "Interrupt Interrupt Activate",
    "neck_gaze": "Gaze",
    "nod_on_a_word": "Speech Head",
    "speech_and_gestures": "Speech Gesture Gesture Gesture",
    "stance": "Posture",
    "vienna_action_unit": "FaceFacs",
    "vienna_gaze": "Gaze",
    "vienna_speech": "Speech Head",
}


def test_a_script_in_a_draft_is_read(subtests: pytest.Subtests) -> None:
    for name in DRAFTED:
        with subtests.test(name):
            (parsed,) = parse((OWN / f"{name}.xml").read_bytes(), Limits())
            assert parsed.block is not None
            assert not parsed.problems
            assert check_references(parsed.block) == ()
            assert " ".join(type(each).__name__ for each in parsed.block.behaviors) == DRAFTED[name]


def test_the_draft_scripts_of_the_realizer_tester_are_read(shared_cases: Path, subtests: pytest.Subtests) -> None:
    suite = shared_cases / "realizertester"
    paths = sorted(path for draft in ("draft1", "viennadraft") for path in (suite / draft).rglob("*.xml"))
    assert paths
    for path in paths:
        with subtests.test(path.stem):
            (parsed,) = parse(path.read_bytes(), Limits())
            assert parsed.block is not None
            assert not parsed.problems
            assert check_references(parsed.block) == ()
