"""Gestures and clips of SmartBody."""

import pytest

from reactive_realizer.bml.behaviors import Gesture
from reactive_realizer.bml.block import Order
from reactive_realizer.bml.extensions import Keyframe, ParameterValueChange
from reactive_realizer.bml.vocabulary import Mode

from .reading import behaviors, block, only, read, told

ONE_AT_A_TIME = {"replacementgroup": "blends"}


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


def test_the_mixture_of_a_blend_is_a_parameter() -> None:
    mixed = only('<blend name="step" x="1" y="-0.5" sbm:wrap-mode="Once"/>')
    assert mixed.parameters == {"x": "1", "y": "-0.5"} | ONE_AT_A_TIME
    assert only('<gesture name="step" x="0.2"/>').parameters == {"x": "0.2"}
    (sentence,) = told('<blend name="step" x="far"/>')
    assert sentence == "x='far' of <blend>: not a finite number"


@pytest.mark.parametrize(
    ("written", "loops"),
    [
        ('<blend name="step"/>', True),
        ('<sbm:states name="step" sbm:schedule-mode="Now"/>', True),
        ('<blend name="step" sbm:wrap-mode="Once"/>', False),
        ('<blend name="step" stroke="2"/>', False),
        ('<animation name="step"/>', False),
        ('<animation name="step" loop="true"/>', True),
        ('<sbm:animation name="step" sbm:wrap-mode="Loop"/>', True),
        ('<states name="step" loop="false"/>', False),
    ],
)
def test_states_and_blends_are_loops_unless_they_ask_for_one_round(written: str, loops: bool) -> None:
    clip = only(written)
    assert clip.parameters.get("loop", "false") == str(loops).lower()
    assert clip.persistent is loops


@pytest.mark.parametrize(
    ("written", "parameters"),
    [
        ('<blend name="a" stroke="1"/>', ONE_AT_A_TIME),
        ('<sbm:states name="a" sbm:wrap-mode="Once"/>', ONE_AT_A_TIME),
        ('<animation name="a"/>', {}),
        ('<blend name="a" sbm:blend-mode="Additive" stroke="1"/>', {"additive": "true"}),
        ('<blend name="a" sbm:partial-joint="r_shoulder" stroke="1"/>', {"below": "r_shoulder"}),
    ],
)
def test_states_and_blends_of_the_whole_body_play_over_each_other(written: str, parameters: dict[str, str]) -> None:
    assert only(written).parameters == parameters


def test_a_loop_with_a_duration_or_an_end_does_not_persist() -> None:
    assert str(only('<blend id="b" name="step" sbm:duration="2.5"/>').syncs["end"]) == "b:start+2.5"
    assert not only('<blend name="step" sbm:duration="2.5"/>').persistent
    assert not only('<animation name="step" loop="true" end="4"/>').persistent


@pytest.mark.parametrize(
    "written",
    [
        '<animation name="sway" sbm:additive="true"/>',
        '<sbm:animation name="sway" additive="true"/>',
        '<blend name="sway" sbm:wrap-mode="once" sbm:blend-mode="Additive"/>',
        '<gesture name="sway" sbm:additive="true"/>',
    ],
)
def test_a_clip_may_be_added_to_other_motion(written: str) -> None:
    assert only(written).parameters == {"additive": "true"}


def test_a_gesture_with_its_stroke_at_0_starts_as_early_as_possible() -> None:
    assert list(only('<gesture lexeme="BEAT" stroke="0" relax="2"/>').syncs) == ["relax"]
    assert list(only('<gesture lexeme="BEAT" stroke="0" start="0"/>').syncs) == ["stroke", "start"]


@pytest.mark.parametrize(
    "as_here",
    [
        '<animation name="Brad@Chop" loop="false" overlay="false" sbm:additive="false" speed="1.0"/>',
        '<blend name="Brad@Chop" mode="schedule" sbm:wrap-mode="Once" sbm:blend-mode="Overwrite"/>',
        '<sbm:states name="Brad@Chop" sbm:schedule-mode="Now" sbm:wrap-mode="Once"/>',
    ],
)
def test_what_asks_for_how_clips_play_anyway_is_not_told(as_here: str) -> None:
    clip = only(as_here)
    assert isinstance(clip, Keyframe)
    assert dict(clip.parameters) in ({}, ONE_AT_A_TIME)


def test_a_clip_may_be_that_of_a_part_of_the_body() -> None:
    clip = only('<blend name="wave" sbm:partial-joint="JtSpineB" sbm:wrap-mode="Once"/>')
    assert clip.parameters == {"below": "vt10"}


def test_what_clips_cannot_do_is_told() -> None:
    (sentence,) = told('<blend name="step" sbm:schedule-mode="Queued" sbm:transition-length="1"/>')
    assert sentence == "sbm:schedule-mode, sbm:transition-length of SmartBody has no effect on <blend> here"


def test_an_update_of_a_blend_of_its_block_changes_the_parameters_of_that_blend() -> None:
    blends = '<blend name="run"/><blend id="walks" name="walk" x="0"/><blend name="run"/>'
    _, _, _, *changes = behaviors(f'{blends}<blend id="u" mode="update" name="walk" x="0.5" y="20" start="2" end="3"/>')
    assert [type(change) for change in changes] == [ParameterValueChange] * 2
    assert [(each.target, each.parameter, each.trajectory.target_value) for each in changes] == [  # type: ignore[attr-defined]
        ("walks", "x", 0.5),
        ("walks", "y", 20.0),
    ]
    assert [str(change.syncs["start"]) for change in changes] == ["2", "2"]
    assert changes[0].id == "u"


def test_an_update_of_a_blend_with_a_parameter_that_is_no_number_is_told() -> None:
    (sentence,) = told('<blend name="walk"/><blend mode="update" name="walk" x="far"/>')
    assert sentence == "x='far' of <blend>: not a finite number"


@pytest.mark.parametrize("before", ["", '<blend id="r" name="run"/>', '<animation id="r" name="walk"/>'])
def test_an_update_of_a_blend_that_its_block_does_not_contain_plays_over_the_one_that_plays(before: str) -> None:
    (sentence,) = told(f'{before}<blend id="w" mode="update" name="walk" y="20"/>')
    assert sentence.startswith("mode='update' names no behavior that it changes, so this blend plays over the one")


def test_an_update_of_a_blend_of_another_block_says_once_what_changes_it() -> None:
    update = '<blend mode="update" name="walk" sbm:schedule-mode="Now" sbm:wrap-mode="Loop" y="20"/>'
    (sentence,) = told(update)
    assert sentence.startswith("mode='update' names no behavior that it changes, so this blend plays over the one")
    parsed = read(f"<act><bml>{update}</bml></act>")
    assert parsed.block is not None
    assert parsed.block.behaviors[0].parameters == {"loop": "true", "y": "20"} | ONE_AT_A_TIME


@pytest.mark.parametrize(
    "first",
    [
        '<blend name="a" sbm:wrap-mode="Once"/>',
        '<sbm:animation name="a"/>',
        '<blend name="a" sbm:duration="3"/>',
        '<states name="a" end="4"/>',
    ],
)
def test_a_clip_that_is_queued_starts_when_the_one_before_it_ends(first: str) -> None:
    clips = behaviors(f'{first}<blend name="b" sbm:wrap-mode="Once" sbm:schedule-mode="Queued" start="0"/>')
    (queued,) = (clip for clip in clips if isinstance(clip, Keyframe) and clip.animation == "b")
    (before,) = (clip.id for clip in clips if isinstance(clip, Keyframe) and clip.animation == "a")
    assert str(queued.syncs["start"]) == f"{before}:end"


def test_a_clip_that_is_queued_with_a_start_of_its_own_comes_after_both() -> None:
    queued = '<blend id="b" name="b" sbm:schedule-mode="Queued" start="s:end+1"/>'
    read = block(f'<act><bml><speech id="s">Up</speech><animation id="a" name="a"/>{queued}</bml></act>')
    afters = [(str(each.ref), *map(str, each.refs)) for each in read.constraints if isinstance(each, Order)]
    assert afters == [("a:end", "b:start"), ("s:end+1", "b:start")]
    (syncs,) = (clip.syncs for clip in read.behaviors if clip.id == "b")
    assert syncs == {}


def test_a_start_of_a_queued_clip_that_is_no_reference_is_told() -> None:
    (sentence,) = told('<animation name="a"/><animation name="b" sbm:schedule-mode="Queued" start="x y"/>')
    assert sentence.startswith("start='x y' of <keyframe>: not a sync reference")


def test_a_clip_that_is_queued_behind_a_loop_is_told() -> None:
    (sentence,) = told('<blend name="a"/><blend name="b" sbm:schedule-mode="Queued"/>')
    assert sentence == "sbm:schedule-mode of SmartBody has no effect on <blend> here"


@pytest.mark.parametrize("duration", ["0", "0.0", "-2", "nan", "inf", "long"])
def test_a_duration_that_no_clip_can_have_drops_it_and_no_other_clip_waits_for_its_end(duration: str) -> None:
    clips = f'<animation id="a" name="a" loop="true" duration="{duration}"/><blend id="b" name="b" end="2"'
    parsed = read(f'<act><bml>{clips} sbm:schedule-mode="Queued"/></bml></act>')
    refused, left_out = (each.fault.sentence for each in parsed.problems)
    assert refused.startswith(f"duration='{duration}' of <animation>: not ")
    assert left_out == "sbm:schedule-mode of SmartBody has no effect on <blend> here"
    assert parsed.block is not None
    (queued,) = parsed.block.behaviors
    assert {point: str(ref) for point, ref in queued.syncs.items()} == {"end": "2"}


def test_a_duration_of_minus_1_is_none_as_in_smartbody() -> None:
    assert only('<animation name="a" loop="true" sbm:duration="-1"/>').persistent
    (sentence,) = told('<blend name="a" duration="-1.0"/><blend name="b" sbm:schedule-mode="Queued"/>')
    assert sentence == "sbm:schedule-mode of SmartBody has no effect on <blend> here"


def test_an_animation_has_a_speed() -> None:
    assert only('<animation name="Brad@Chop" speed="1.5"/>').parameters == {"speed": "1.5"}
    (sentence,) = told('<animation name="Brad@Chop" speed="0"/>')
    assert sentence == "speed='0' of <animation>: not between 0.05 and 20"


def test_parameters_of_a_motion_may_be_written_as_in_drafts() -> None:
    clip = only('<animation name="Brad@Chop"><param name="mirror" value="true"/></animation>')
    assert clip.parameters == {"mirror": "true"}
    gesture = only('<gesture lexeme="BEAT"><param name="spatialExtent" value="0.5"/></gesture>')
    assert gesture.parameters == {"spatialExtent": "0.5"}
