"""Documents without a namespace: what the drafts of BML wrote otherwise."""

from pathlib import Path

import pytest

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Gaze, Gesture, Head, Pointing, Speech
from reactive_realizer.bml.block import BehaviorBlock, Parsed
from reactive_realizer.bml.constraint import Order, Synchronize
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.face import Face, FaceFacs, FaceLexeme
from reactive_realizer.bml.names import BML, BMLT, Location
from reactive_realizer.bml.posture import Pose, Posture, PostureShift
from reactive_realizer.bml.references import check_references
from reactive_realizer.bml.words import Composition, Influence, Mode, PosePart, Side, StanceType
from reactive_realizer.limits import Limits

OWN = Path(__file__).parents[1] / "data" / "bml" / "drafts"
CASES = Path(__file__).parents[3] / "shared" / "cases" / "realizertester"
PEERS = [path for draft in ("draft1", "viennadraft") for path in sorted((CASES / draft).rglob("*.xml"))]


def read(inside: str, attributes: str = "") -> Parsed:
    """What came of the block b of a draft; the prefix bmlt is declared."""
    (parsed,) = parse(f'<bml xmlns:bmlt="{BMLT}" id="b" {attributes}>{inside}</bml>', Limits())
    return parsed


def block(inside: str, attributes: str = "") -> BehaviorBlock:
    """The same where nothing is wrong with it."""
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


@pytest.mark.parametrize("xml", WRITTEN)
def test_what_a_draft_writes_is_a_behavior_of_bml_1_0(xml: str) -> None:
    kind, values = WRITTEN[xml]
    (behavior,) = block(xml).behaviors
    assert type(behavior) is kind
    assert {name: getattr(behavior, name) for name in values} == values


def test_a_description_stays_as_it_is_written() -> None:
    (speech,) = block(
        '<speech id="s"><text>Hi</text><description priority="1" type="t"><tm id="a"/></description></speech>'
    ).behaviors
    assert speech.descriptions[0].content == f'<tm xmlns:bmlt="{BMLT}" id="a"/>'


def test_a_draft_has_the_elements_of_bml_1_0_too() -> None:
    assert len(block('<gesture id="g" lexeme="BEAT" mode="LEFT_HAND"/><wait id="w" duration="1"/>').behaviors) == 2


def test_sync_points_may_be_spelled_with_an_underscore() -> None:
    (one, two) = block(
        '<gesture id="g" type="BEAT" stroke_start="1"/><head id="h" type="NOD" start="g:stroke_end+1"/>'
    ).behaviors
    assert list(one.syncs) == ["strokeStart"]
    assert str(two.syncs["start"]) == "g:strokeEnd+1"


def test_a_mark_keeps_the_name_that_it_has() -> None:
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


@pytest.mark.parametrize(
    ("written", "composition", "appended", "chunked"),
    [
        ('scheduling="append"', Composition.APPEND, (), ()),
        ('scheduling="append-after(b1,b2)"', Composition.MERGE, ("b1", "b2"), ()),
        ('start="b1:end"', Composition.MERGE, ("b1",), ()),
        ('start="b1:relax" bmlt:chunkAfter="b2"', Composition.MERGE, (), ("b2", "b1")),
    ],
)
def test_a_block_says_how_it_joins_others_in_the_words_of_the_drafts(
    written: str, composition: Composition, appended: tuple[str, ...], chunked: tuple[str, ...]
) -> None:
    read = block("", written)
    assert (read.composition, read.append_after, read.chunk_after) == (composition, appended, chunked)


@pytest.mark.parametrize("end", ['relax="3"', 'end="3"'])
@pytest.mark.parametrize("element", ['gaze id="x" target="box"', 'posture id="x" stance="sitting"'])
def test_a_gaze_or_posture_of_which_nothing_says_the_end_persists(element: str, end: str) -> None:
    assert [getattr(each, "persistent", None) for each in block(f"<{element}/>").behaviors] == [True]
    assert [getattr(each, "persistent", None) for each in block(f"<{element} {end}/>").behaviors] == [False]


def test_a_tie_to_its_end_is_an_end_and_what_begins_there_is_none() -> None:
    tie = '<constraint><synchronize ref="b1:two:end"><sync ref="one:end"/></synchronize></constraint>'
    gazes = '<gaze id="one" target="box"/><gaze id="two" target="box"/>'
    read = block(f'{gazes}<head id="h" type="NOD" start="two:end"/>{tie}', 'bmlt:allowexternalrefs="true"')
    assert [each.persistent for each in read.behaviors if isinstance(each, Gaze)] == [False, True]


def test_nothing_persists_in_bml_1_0_and_no_shift_in_a_draft() -> None:
    gaze = '<gaze id="g" target="box"/>'
    (parsed,) = parse(f'<bml xmlns="{BML}" id="b">{gaze}</bml>', Limits())
    assert parsed.block is not None
    shifts = block('<gazeShift id="g" target="box"/><postureShift id="p"><stance type="SITTING"/></postureShift>')
    assert [isinstance(each, Gaze | PostureShift) and each.persistent for each in shifts.behaviors] == [False, False]
    assert [isinstance(each, Gaze) and each.persistent for each in parsed.block.behaviors] == [False]


OUTSIDE = '<head id="h" type="NOD" start="{}"/>'


def test_behaviors_of_other_blocks_may_be_named_where_the_block_says_so() -> None:
    (problem,) = read(OUTSIDE.format("b1:g:end")).problems
    assert problem.id == "b:h"
    assert problem.fault.sentence.endswith(
        "a behavior of another block; a draft has to say bmlt:allowexternalrefs='true'"
    )
    assert block(OUTSIDE.format("b1:g:end"), 'bmlt:allowexternalrefs="true"').external_refs


@pytest.mark.parametrize("ref", ["anticipators:a:stop+1", "b1:relax", "b1:end", "b:h:end", "b1:2"])
def test_blocks_anticipators_and_the_own_block_may_always_be_named(ref: str) -> None:
    block(OUTSIDE.format(ref))


def test_bml_1_0_names_behaviors_of_other_blocks_without_saying_so() -> None:
    (parsed,) = parse(f'<bml xmlns="{BML}" id="b"><wait id="w" start="b1:g:end"/></bml>', Limits())
    assert not parsed.problems


DROPPED = {
    '<gaze id="x" type="AVERT" target="box"/>': "type='AVERT' of <gaze>: known are AT",
    '<head id="x" action="ORIENTATION" rotation="NOD"/>': "action='ORIENTATION' of <head>: known are ROTATION",
    '<head id="x" action="ROTATION"/>': "<head> needs the attribute 'lexeme'",
    '<gesture id="x" type="LEXICALIZED"/>': "<gesture> needs the attribute 'lexeme'",
    '<gesture id="x" type="POINT"/>': "<pointing> needs the attribute 'target'",
    '<gesture id="x" type="BEAT" hand="THIRD"/>': "mode='THIRD' of <gesture>: known are LEFT_HAND, RIGHT_HAND, "
    "BOTH_HANDS",
    '<face id="x" type="EYEBROWS"/>': "type='EYEBROWS' of <face>: known are FACS, LEXICALIZED",
    '<face id="x" type="FACS"/>': "<faceFacs> needs the attribute 'au'",
    '<posture id="x" part="lower"/>': "<posture> needs <stance> or <pose> in it",
    '<posture id="x" stance="flying"/>': "type='flying' of <stance>: known are SITTING, CROUCHING, STANDING, LYING",
    '<speech id="x"/>': "<speech> needs <text> in it",
    '<constraint id="x"><synchronize ref="1"/></constraint>': "<synchronize> needs <sync> and <sync> in it",
}


@pytest.mark.parametrize("bad", DROPPED)
def test_what_cannot_be_said_in_bml_1_0_is_dropped_with_one_problem_in_its_place(bad: str) -> None:
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
    '<speech id="x" type="application/ssml+xml">Hi</speech>': "unknown attribute type of <speech>",
    '<speech id="x">Hi <b>you</b></speech>': "unknown b in <text>; known are sync",
}


@pytest.mark.parametrize("odd", KEPT)
def test_what_is_not_known_is_passed_over_with_one_problem(odd: str) -> None:
    parsed = read(odd)
    assert parsed.block is not None
    assert len(parsed.block.behaviors) == 1
    (problem,) = parsed.problems
    assert problem.fault.sentence.startswith(KEPT[odd])


def test_a_composition_comes_before_a_scheduling() -> None:
    parsed = read("", 'scheduling="append" composition="replace"')
    (problem,) = parsed.problems
    assert problem.fault.sentence.startswith("unknown attribute scheduling of <bml>")
    assert parsed.block is not None
    assert parsed.block.composition is Composition.REPLACE


def test_a_start_of_a_block_elsewhere_is_not_understood() -> None:
    (problem,) = read("", 'start="g:stroke"').problems
    assert problem.fault.sentence.startswith("unknown attribute start of <bml>")


def test_what_is_made_anew_stands_where_it_was_written() -> None:
    (problem,) = read('<wait id="w"/>\n <speech id="x">Hi<tm/></speech>').problems
    assert problem.fault.sentence == "<sync> needs the attribute 'id'"
    assert problem.fault.line == 2
    (parsed,) = parse('<bml id="b">\n  <posture id="p" stance="sitting"/></bml>', Limits())
    assert parsed.block is not None
    assert parsed.block.behaviors[0].location == Location(2, 3)


DRAFTED = {
    "interrupts": "Interrupt Interrupt Activate",
    "neck_gaze": "Gaze",
    "nod_on_a_word": "Speech Head",
    "speech_and_gestures": "Speech Gesture Gesture",
    "stance": "Posture",
    "vienna_action_unit": "FaceFacs",
    "vienna_speech": "Speech Head",
}


@pytest.mark.parametrize("name", DRAFTED)
def test_a_script_of_our_own_is_read(name: str) -> None:
    (parsed,) = parse((OWN / f"{name}.xml").read_bytes(), Limits())
    assert parsed.block is not None
    assert not parsed.problems
    assert check_references(parsed.block) == ()
    assert " ".join(type(each).__name__ for each in parsed.block.behaviors) == DRAFTED[name]


@pytest.mark.skipif(not PEERS, reason="the scripts of the RealizerTester are not at hand")
@pytest.mark.parametrize("path", PEERS, ids=lambda path: path.stem)
def test_a_script_of_the_drafts_of_the_realizer_tester_is_read(path: Path) -> None:
    (parsed,) = parse(path.read_bytes(), Limits())
    assert parsed.block is not None
    assert not parsed.problems
    assert check_references(parsed.block) == ()
