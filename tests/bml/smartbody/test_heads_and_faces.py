"""Movements of the head, and faces, of SmartBody."""

import pytest

from reactive_realizer.bml.behaviors import Face, FaceFacs, Head, HeadDirectionShift
from reactive_realizer.bml.extensions import FaceFap
from reactive_realizer.bml.vocabulary import Side

from .reading import behaviors, only, read, told


def test_a_nod_lasts_as_its_velocity_and_its_repeats_say() -> None:
    head = only('<head id="h" type="NOD" repeats="3" velocity="2" amount="0.2"/>')
    assert isinstance(head, Head)
    assert (head.repetition, head.amount, str(head.syncs["end"])) == (3, 0.2, "h:start+0.75")
    assert only('<head type="NOD" velocity="1"/>').syncs == {}


def test_a_head_that_is_oriented_turns_to_its_target() -> None:
    shift = only('<head id="h" type="ORIENT" target="bob" start="1" amount="1"/>')
    assert isinstance(shift, HeadDirectionShift)
    assert (shift.target, str(shift.syncs["start"])) == ("bob", "1")


@pytest.mark.parametrize("given", ["", 'direction="LEFT" angle="20"'])
def test_a_head_without_a_target_to_turn_to_is_left_out_and_says_so(given: str) -> None:
    parsed = read(f'<act><bml><head id="h" type="ORIENT" {given}/><head id="n" type="NOD"/></bml></act>')
    assert parsed.block is not None
    assert [each.id for each in parsed.block.behaviors] == ["n"]
    (problem,) = parsed.problems
    assert problem.fault.sentence == (
        "<head type='ORIENT'> requires a target to which the head turns; SmartBody leaves it out too"
    )


def test_a_tied_end_has_precedence_over_a_velocity() -> None:
    assert str(only('<head id="h" type="NOD" velocity="2" end="3"/>').syncs["end"]) == "3"


def test_the_period_of_a_waggle_gives_its_duration() -> None:
    assert str(only('<head id="h" type="WAGGLE" sbm:period="0.5"/>').syncs["end"]) == "h:start+1.5"


def test_parameters_of_waggles_shape_their_waves() -> None:
    waggle = only('<head type="WAGGLE" sbm:warp="0.5" sbm:accel="1.5" sbm:pitch="0" sbm:decay="0.7" sbm:axis="0"/>')
    wave = {"warp": "0.5", "accel": "1.5", "pitch": "0", "decay": "0.7"}
    assert waggle.parameters == {"wave": "1", **wave}
    assert waggle.syncs.keys() == {"end"}
    assert only('<head type="wiggle" sbm:accel="1"/>').parameters == {"wave": "1", "accel": "1"}
    assert only('<head type="WIGGLE" sbm:smooth="0.4"/>').parameters == {}


def test_parameters_of_waves_have_no_effect_on_other_movements() -> None:
    (sentence,) = told('<head type="NOD" sbm:warp="0.5" sbm:decay="1"/>')
    assert sentence == "sbm:warp, sbm:decay of SmartBody has no effect on <head> here"


@pytest.mark.parametrize(("written", "point"), [('ready="1"', "1"), ('stroke="2"', "2"), ('ready="1" stroke="2"', "1")])
def test_a_face_is_complete_at_its_ready_or_its_stroke(written: str, point: str) -> None:
    face = only(f'<face type="facs" au="1" {written} stroke_end="3" relax="4"/>')
    assert {name: str(ref) for name, ref in face.syncs.items()} == {"relax": "4", "attackPeak": point}


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
        "relax": "f:start+1.6",
        "end": "f:start+2",
    }


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


def test_a_movement_of_the_head_with_an_amount_below_0_begins_the_other_way() -> None:
    written = ('type="nod" amount="-0.2"', 'type="SHAKE" amount="-0.3"', 'type="TOSS" amount="-3"')
    heads = [only(f"<head {each}/>") for each in written]
    read = [(head.lexeme, head.amount) for head in heads if isinstance(head, Head)]
    assert read == [("UP", 0.2), ("SHAKE", 0.3), ("DOWN", 1.0)]
