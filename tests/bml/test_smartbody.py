"""SmartBody's requests, elements and attributes, which are read as behaviors of BML 1.0 and its extensions."""

import json
from pathlib import Path

import pytest

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import REACH, Face, FaceFacs, Gaze, Gesture, Head, Locomotion, Pointing, Wait
from reactive_realizer.bml.block import BehaviorBlock, Parsed
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.extensions import Emit, FaceFap, Interrupt, Keyframe, Noise
from reactive_realizer.bml.idle_change import IdleChange, IdleParameter
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.references import check_references
from reactive_realizer.bml.vocabulary import Influence, Mode, OffsetDirection, Side
from reactive_realizer.limits import Limits

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


def read(text: str) -> Parsed:
    (parsed,) = parse(text, Limits(), "document1")
    return parsed


def block(text: str) -> BehaviorBlock:
    """The block of a document, which has no problems."""
    parsed = read(text)
    assert parsed.block is not None
    assert parsed.problems == ()
    assert check_references(parsed.block) == ()
    return parsed.block


def only(inside: str) -> Behavior:
    """The only behavior of an act, which has no problems."""
    (behavior,) = block(f"<act><bml>{inside}</bml></act>").behaviors
    return behavior


def told(inside: str) -> list[str]:
    return [each.fault.sentence for each in read(f"<act><bml>{inside}</bml></act>").problems]


def cast(text: str) -> str:
    return block(text).played_by(["alice", "brad", "rachel"])


# --- requests


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


def test_marks_with_the_same_id_apart_from_each_other_are_told() -> None:
    (problem,) = read('<bml><speech id="s"><mark name="a"/>so <mark name="a"/>what</speech></bml>').problems
    assert problem.fault.code == "duplicate-id"


def test_behaviors_may_stand_directly_in_an_act() -> None:
    own = block('<act>\n<participant id="brad"/><head type="NOD"/> <gaze target="x"/></act>')
    assert (own.id, own.played_by(["alice", "brad"])) == ("document1", "brad")
    assert [behavior.location for behavior in own.behaviors] == [Location(2, 25), Location(2, 44)]


# --- gaze


def gaze(attributes: str) -> Gaze:
    behavior = only(f'<gaze id="g" target="x" {attributes}/>')
    assert isinstance(behavior, Gaze)
    return behavior


@pytest.mark.parametrize(
    ("joints", "influence", "still"),
    [
        ("EYES", Influence.EYES, []),
        ("NECK EYES", Influence.HEAD, []),
        ("EYES CHEST", Influence.SHOULDER, []),
        ("BACK EYES", Influence.WAIST, []),
        ("neck", Influence.HEAD, ["head", "eyes"]),
        ("CHEST BACK", Influence.WAIST, ["neck", "head", "eyes"]),
    ],
)
def test_joints_turn_from_the_lowest_to_the_highest_of_a_range(
    joints: str, influence: Influence, still: list[str]
) -> None:
    read = gaze(f'sbm:joint-range="{joints}"')
    assert (read.influence, dict(read.parameters)) == (influence, dict.fromkeys(still, "0"))


@pytest.mark.parametrize(
    ("direction", "offset", "angle"),
    [
        ('direction="UPLEFT" angle="12"', OffsetDirection.UPLEFT, 12.0),
        ('direction="DOWN"', OffsetDirection.DOWN, 30.0),
        ('direction="POLAR 90" angle="5"', OffsetDirection.RIGHT, 5.0),
        ('direction="POLAR 300" angle="5"', OffsetDirection.UPLEFT, 5.0),
    ],
)
def test_a_direction_is_an_offset_by_an_angle_of_30_degrees_unless_it_says_otherwise(
    direction: str, offset: OffsetDirection, angle: float
) -> None:
    read = gaze(direction)
    assert (read.offset_direction, read.offset_angle) == (offset, angle)


def test_a_direction_that_is_none_drops_the_gaze() -> None:
    for direction in ("POLAR 1.2.3", "POLAR", "POLAR nan", "sideways"):
        (sentence,) = told(f'<gaze target="x" direction="{direction}"/>')
        assert sentence.startswith(f"offsetDirection='{direction}' of <gaze>: not one of RIGHT")
    assert gaze('direction="POLAR 1e300"').offset_angle == 30.0


def test_an_angle_without_a_direction_has_no_effect_as_in_smartbody() -> None:
    assert gaze('angle="40"').offset_angle == 0.0


def test_a_time_hint_or_a_fade_is_the_time_of_the_turn() -> None:
    for name in ("time-hint", "fade-in"):
        assert str(gaze(f'sbm:{name}="0.8" start="2"').syncs["ready"]) == "g:start+0.8"


def test_a_target_may_be_a_joint_of_smartbody_skeletons() -> None:
    read = only('<gaze target="brad:eyeball_left"/>')
    assert isinstance(read, Gaze)
    assert read.target == "brad:l_eyeball_joint"


@pytest.mark.parametrize(("written", "speed"), [("400", "400"), ("200 1000", "200"), ("50 150 1000", "200")])
def test_the_speed_of_the_joints_is_a_limit_for_the_head(written: str, speed: str) -> None:
    assert gaze(f'sbm:joint-speed="{written}" sbm:joint-smooth="0.2"').parameters == {"speed": speed}


def test_a_roll_tilts_the_head() -> None:
    assert gaze('sbm:roll="-10"').parameters == {"roll": "-10"}


def test_a_gaze_without_a_target_fades_out_to_the_viewer() -> None:
    gaze = only('<gaze id="g" sbm:handle="h" sbm:fade-out="0.7" start="2"/>')
    assert isinstance(gaze, Gaze)
    assert (gaze.target, str(gaze.syncs["ready"])) == ("viewer", "g:start+0.7")


def test_what_a_gaze_cannot_do_is_told_in_one_warning() -> None:
    (sentence,) = told('<gaze target="x" sbm:priority-joint="EYES" sbm:fade-out="1" sbm:handle="h"/>')
    assert sentence == "sbm:priority-joint, sbm:fade-out of SmartBody has no effect on <gaze> here"


# --- head, face, gestures, clips, walking


def test_a_nod_lasts_as_its_velocity_and_its_repeats_say() -> None:
    head = only('<head id="h" type="NOD" repeats="3" velocity="2" amount="0.2"/>')
    assert isinstance(head, Head)
    assert (head.repetition, head.amount, str(head.syncs["end"])) == (3, 0.2, "h:start+0.75")
    assert only('<head type="NOD" velocity="1"/>').syncs == {}


def test_a_tied_end_has_precedence_over_a_velocity() -> None:
    assert str(only('<head id="h" type="NOD" velocity="2" end="3"/>').syncs["end"]) == "3"


def test_the_period_of_a_waggle_gives_its_duration() -> None:
    assert str(only('<head id="h" type="WAGGLE" sbm:period="0.5"/>').syncs["end"]) == "h:start+1.5"


def test_parameters_of_waggles_without_a_counterpart_are_told() -> None:
    (sentence,) = told('<head type="WAGGLE" sbm:warp="0.5" sbm:accel="1.5" sbm:axis="0"/>')
    assert sentence == "sbm:warp, sbm:accel of SmartBody has no effect on <head> here"


@pytest.mark.parametrize(("written", "point"), [('ready="1"', "1"), ('stroke="2"', "2"), ('ready="1" stroke="2"', "1")])
def test_a_face_is_complete_at_its_ready_or_its_stroke(written: str, point: str) -> None:
    face = only(f'<face type="facs" au="1" {written} stroke_end="3" relax="4"/>')
    assert {name: str(ref) for name, ref in face.syncs.items()} == {"relax": "4", "attackPeak": point}


def test_a_movement_of_the_head_with_an_amount_below_0_begins_the_other_way() -> None:
    written = ('type="nod" amount="-0.2"', 'type="SHAKE" amount="-0.3"', 'type="TOSS" amount="-3"')
    heads = [only(f"<head {each}/>") for each in written]
    read = [(head.lexeme, head.amount) for head in heads if isinstance(head, Head)]
    assert read == [("UP", 0.2), ("SHAKE", 0.3), ("DOWN", 1.0)]


def test_a_viseme_is_one_of_mpeg_4() -> None:
    viseme = only('<face id="f" type="viseme" viseme="PBM" amount="0.5" start="1" stroke="2"/>')
    assert isinstance(viseme, FaceFap)
    assert (viseme.fap, viseme.viseme_select1, viseme.viseme_blend) == ("viseme", 1, 32)
    assert list(viseme.syncs) == ["start", "attackPeak"]
    (sentence,) = told('<face type="viseme" viseme="growl"/>')
    assert sentence.startswith("viseme='growl' of <face>: not one of _, SIL, PBM")


def test_ramps_of_a_face_tie_its_points() -> None:
    face = only('<face id="f" type="facs" au="1" sbm:rampup="0.2" sbm:rampdown="0.4" sbm:duration="2"/>')
    assert isinstance(face, FaceFacs)
    assert {point: str(ref) for point, ref in face.syncs.items()} == {
        "attackPeak": "f:start+0.2",
        "relax": "f:end-0.4",
        "end": "f:start+2",
    }


@pytest.mark.parametrize(
    ("written", "lexeme"),
    [
        ('lexeme="METAPHORIC" type="OBLIGATION"', "CHOP"),
        ('lexeme="DEICTIC" type="me"', "SELF"),
        ('lexeme="BEAT" type="RHYTHM"', "BEAT"),
        ('lexeme="EMBLEM" type="SALUTE"', "SALUTE"),
    ],
)
def test_a_class_of_gestures_with_a_type_is_a_lexeme(written: str, lexeme: str) -> None:
    gesture = only(f'<gesture {written} mode="LEFT_HAND"/>')
    assert isinstance(gesture, Gesture)
    assert (gesture.lexeme, gesture.mode) == (lexeme, Mode.LEFT_HAND)


def test_a_hold_of_a_gesture_ties_its_points() -> None:
    gesture = only('<gesture id="g" lexeme="BEAT" poststroke_hold="1.5"/>')
    assert str(gesture.syncs["relax"]) == "g:strokeEnd+1.5"


@pytest.mark.parametrize(
    "written",
    [
        '<gesture name="Brad@Chop" lexeme="BEAT"/>',
        '<animation name="Brad@Chop" priority="5" speed="1"/>',
        '<sbm:animation name="Brad@Chop"/>',
        '<blend name="Brad@Chop"/>',
        '<sbm:states name="Brad@Chop"/>',
    ],
)
def test_what_names_a_clip_plays_it(written: str) -> None:
    clip = only(written)
    assert isinstance(clip, Keyframe)
    assert clip.animation == "Brad@Chop"


def test_the_mixture_of_a_blend_is_told() -> None:
    (sentence,) = told('<blend name="step" x="1" y="0" sbm:wrap-mode="Once"/>')
    assert sentence == "x, y, sbm:wrap-mode of SmartBody has no effect on <blend> here"


def test_a_way_has_a_speed_a_distance_and_a_direction_to_face() -> None:
    way = only('<locomotion target="1 2" type="basic" manner="jog" speed="2" proximity="0.4" facing="90"/>')
    assert isinstance(way, Locomotion)
    assert (way.target, way.manner) == ("1 2", "RUN")
    assert dict(way.parameters) == {"speed": "2", "distance": "0.4", "facing": "90"}


# --- reaching


@pytest.mark.parametrize(
    ("action", "reach"),
    [("", "TOUCH"), ("touch", "TOUCH"), ("pick-up", "TAKE"), ("Put-Down", "PUT"), ("point-at", None)],
)
def test_a_reach_is_a_pointing_whose_hand_touches_takes_or_puts(action: str, reach: str | None) -> None:
    pointing = only(f'<sbm:reach target="box" sbm:action="{action}" sbm:handle="h" sbm:foot-ik="true"/>')
    assert isinstance(pointing, Pointing)
    assert (pointing.target, pointing.extensions.get(REACH)) == ("box", reach)


def test_a_reach_has_a_hand_a_place_and_a_duration() -> None:
    pointing = only('<sbm:reach sbm:target-pos="1 1.2 0" sbm:reach-type="left" sbm:reach-duration="2"/>')
    assert isinstance(pointing, Pointing)
    assert (pointing.target, pointing.mode) == ("1 1.2 0", Mode.LEFT_HAND)
    assert dict(pointing.parameters) == {"postStrokeHoldDuration": "2"}


@pytest.mark.parametrize(
    "finishes",
    [
        '<sbm:reach sbm:action="touch" target="box" sbm:reach-finish="true" stroke="1"/>',
        '<sbm:reach sbm:action="put-down"/>',
        '<sbm:grab sbm:handle="h" sbm:grab-state="return"/>',
    ],
)
def test_what_only_ends_a_reach_does_nothing_but_has_times(finishes: str) -> None:
    assert isinstance(only(finishes), Wait)


def test_a_grab_takes_its_target() -> None:
    assert only('<sbm:grab target="box"/>').extensions[REACH] == "TAKE"


def test_a_constraint_of_a_wrist_touches_its_target_with_that_hand() -> None:
    touch = only('<sbm:constraint id="c" effector="l_wrist" target="box" sbm:fade-in="0.5" sbm:fade-out="1" end="4"/>')
    assert isinstance(touch, Pointing)
    assert (touch.mode, touch.extensions[REACH]) == (Mode.LEFT_HAND, "TOUCH")
    assert {point: str(ref) for point, ref in touch.syncs.items()} == {
        "end": "4",
        "ready": "c:start+0.5",
        "relax": "c:end-1",
        "start": "0",
    }


def test_a_constraint_of_a_foot_stays_for_engines_of_plug_ins() -> None:
    assert only('<sbm:constraint effector="l_forefoot" target="box"/>').namespace == "urn:smartbody"


# --- several behaviors for one, and one for several


def behaviors(inside: str) -> tuple[Behavior, ...]:
    return block(f"<act><bml>{inside}</bml></act>").behaviors


def test_action_units_with_the_same_times_are_one_face() -> None:
    units = '<face type="facs" au="1_left" amount="1" start="1" priority="2"/>\n<face type="facs" au="10" start="1"/>'
    (face, other) = behaviors(units + '<face type="facs" au="26" amount="0.2" start="2"/>')
    assert isinstance(face, Face)
    assert (face.amount, str(face.syncs["start"])) == (1.0, "1")
    parts = [(part.au, part.side, part.amount) for part in face.parts if isinstance(part, FaceFacs)]
    assert parts == [(1, Side.LEFT, 1.0), (10, Side.BOTH, 0.5)]
    assert isinstance(other, FaceFacs)


def test_action_units_with_ids_stay_apart() -> None:
    units = behaviors('<face id="a" type="facs" au="1"/><face id="b" type="facs" au="2"/>')
    assert [unit.id for unit in units] == ["a", "b"]


def test_noise_turns_each_of_its_joints_and_persists() -> None:
    noises = behaviors('<sbm:noise id="n" sbm:joint-range="l_shoulder spine3" sbm:scale="0.1" sbm:frequency="0.5"/>')
    assert {each.joint: each.id for each in noises if isinstance(each, Noise) and each.persistent} == {
        "l_shoulder": "n",
        "vt6": "noise1",
    }
    for noise in noises:
        assert noise.parameters == {
            **{f"baseamplitude{axis}": "0.1" for axis in "xyz"},
            **{f"basefreq{axis}": "0.5" for axis in "xyz"},
        }


def test_one_behavior_becomes_no_more_than_a_limit_of_them() -> None:
    many = " ".join(f"joint{number}" for number in range(10_000))
    assert len(behaviors(f'<sbm:noise sbm:joint-range="{many}" id="n"/>')) == 50
    assert len(behaviors(f'<locomotion target="{"1 2 " * 5_000}"/>')) == 1


def test_behaviors_that_are_joined_or_split_stay_required() -> None:
    own = block(
        '<act><bml><required><face type="facs" au="1"/><face type="facs" au="2"/><sbm:noise sbm:joint-range="a b"/>'
        "</required></bml></act>"
    )
    assert [type(each) for each in own.behaviors] == [Face, Noise, Noise]
    assert all(each.required for each in own.behaviors)


def test_noise_with_an_end_ends() -> None:
    (noise,) = behaviors('<sbm:noise sbm:joint-range="l_elbow" end="3"/>')
    assert not noise.persistent
    assert noise.parameters["baseamplitudex"] == "0.02"


def test_noise_that_is_switched_off_is_told() -> None:
    assert told('<sbm:noise sbm:joint-range="l_elbow" enable="false"/>')[0].startswith("enable of SmartBody")


def test_joints_of_a_gesture_have_noise_while_it_holds() -> None:
    noise_of = 'sbm:joint-range="l_shoulder l_elbow" sbm:scale="0.04"'
    *noises, gesture = behaviors(f'<gesture id="g" lexeme="BEAT" relax="5" {noise_of}/>')
    assert isinstance(gesture, Gesture)
    assert sorted(each.joint for each in noises if isinstance(each, Noise)) == ["l_elbow", "l_shoulder"]
    for noise in noises:
        assert {point: str(ref) for point, ref in noise.syncs.items()} == {"start": "g:strokeEnd", "end": "g:relax"}
    assert len(behaviors(f'<gesture lexeme="BEAT" {noise_of}/>')) == 1


def test_a_reach_may_walk_to_its_target_first() -> None:
    reach, walk = sorted(
        behaviors('<sbm:reach target="box" sbm:use-locomotion="true" start="2"/>'),
        key=lambda each: -len(each.sync_points),
    )
    assert isinstance(walk, Locomotion)
    assert (walk.target, str(walk.syncs["start"]), dict(walk.parameters)) == ("box", "2", {"distance": "0.4"})
    assert isinstance(reach, Pointing)
    assert str(reach.syncs["start"]) == f"{walk.id}:end"


def test_a_way_along_several_points_is_several_ways() -> None:
    ways = behaviors('<locomotion id="l" target="0 1 1 1 1 -.5" speed="2" facing="0" start="3"/><wait start="l:end"/>')
    read = {way.id: way for way in ways if isinstance(way, Locomotion)}
    assert {way.target: str(way.syncs["start"]) for way in read.values()} == {
        "0 1": "3",
        "1 1": "locomotion1:end",
        "1 -.5": "locomotion2:end",
    }
    assert read["l"].target == "1 -.5"
    assert dict(read["l"].parameters) == {"speed": "2", "facing": "0"}
    assert dict(read["locomotion1"].parameters) == {"speed": "2"}
    assert len(behaviors('<locomotion target="1 0 1"/>')) == len(behaviors('<locomotion target="a b c d"/>')) == 1


def test_a_gesture_with_its_stroke_at_0_starts_as_early_as_possible() -> None:
    assert list(only('<gesture lexeme="BEAT" stroke="0" relax="2"/>').syncs) == ["relax"]
    assert list(only('<gesture lexeme="BEAT" stroke="0" start="0"/>').syncs) == ["stroke", "start"]


@pytest.mark.parametrize(
    ("written", "rate"), [('mode="talk"', 14.8), ('mode="listen"', 7.2), ('mode="think"', 20.0), ('finish="true"', 0.0)]
)
def test_a_mode_of_saccades_is_a_rate_of_glances(written: str, rate: float) -> None:
    change = only(f"<saccade {written}/>")
    assert isinstance(change, IdleChange)
    assert (change.parameter, change.value) == (IdleParameter.GLANCE_RATE, rate)


def test_single_saccades_and_unknown_modes_are_told() -> None:
    (sentence,) = told('<saccade mode="talk" magnitude="10" direction="45"/>')
    assert sentence.startswith("magnitude, direction of SmartBody has no effect on <saccade>")
    (sentence,) = told('<saccade mode="sing"/>')
    assert sentence.startswith("mode='sing' of <saccade>: not one of listen, talk, think")


def test_groups_and_priorities_make_no_difference() -> None:
    assert isinstance(only('<head type="NOD" group="g" priority="3"/>'), Head)


def test_a_number_that_is_none_drops_its_behavior() -> None:
    (sentence,) = told('<head type="NOD" velocity="fast"/>')
    assert sentence == "velocity='fast' of <head>: not a finite number"


def test_an_element_that_is_not_known_stays_for_engines_of_plug_ins() -> None:
    assert only('<sbm:quickdraw id="q" anim="draw"/>').namespace == "urn:smartbody"


# --- scripts of SmartBody's own examples

NOT_WHOLE = {
    "SBBmlProcessor.cpp": "unexpected text",
    "FacialMovementDemo.py": "unexpected text",
    "InitCharacterBehaviorBMLMapping.py": "start='$ready_time' of <faceFacs>",
}
"""Pieces of programs that are no BML as they stand, and what is said of them."""
WITHOUT_COUNTERPART = {
    "locomotionBlendCEGUI.py": "y, mode, sbm:schedule-mode, sbm:wrap-mode",
    "KinectSimpleDemo.py": "x, y, sbm:wrap-mode",
    "OgreDemo.js": "x, y",
    "MeCtBodyReachState.cpp": "sbm:release-pawn",
}
"""Attributes in SmartBody's examples that nothing here corresponds to."""


def test_the_scripts_of_smartbody_are_read(shared_cases: Path, subtests: pytest.Subtests) -> None:
    said = NOT_WHOLE | WITHOUT_COUNTERPART
    for line in (shared_cases / "smartbody" / "snippets.jsonl").read_text().splitlines():
        script = json.loads(line)
        name = script["source"].rpartition("/")[2]
        with subtests.test(script["bml"]):
            parsed = read(f"<act>{script['bml']}</act>")
            assert parsed.block is not None
            for problem in parsed.problems:
                assert problem.fault.sentence.startswith(said[name])
