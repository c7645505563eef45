"""Hands of SmartBody that go to a target, and ways."""

import pytest

from reactive_realizer.bml.behaviors import REACH, Locomotion, Pointing, Wait
from reactive_realizer.bml.release import Release
from reactive_realizer.bml.vocabulary import Mode

from .reading import behaviors, only, read, told


def test_a_way_has_a_speed_a_distance_and_a_direction_to_face() -> None:
    way = only('<locomotion target="1 2" type="basic" manner="jog" speed="2" proximity="0.4" facing="90"/>')
    assert isinstance(way, Locomotion)
    assert (way.target, way.manner) == ("1 2", "RUN")
    assert dict(way.parameters) == {"speed": "2", "distance": "0.4", "facing": "90"}


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
        '<sbm:grab sbm:handle="h" sbm:grab-state="return"/>',
    ],
)
def test_what_only_ends_a_reach_does_nothing_but_has_times(finishes: str) -> None:
    assert isinstance(only(finishes), Wait)


@pytest.mark.parametrize(
    ("releases", "mode"),
    [
        ('<sbm:grab sbm:handle="h" sbm:release-pawn="true" stroke="1"/>', Mode.BOTH_HANDS),
        ('<sbm:grab sbm:release-pawn="TRUE" sbm:grab-type="left"/>', Mode.LEFT_HAND),
        ('<sbm:reach sbm:action="put-down" sbm:reach-finish="true" target="box"/>', Mode.BOTH_HANDS),
        ('<sbm:reach sbm:action="put-down" sbm:reach-type="right"/>', Mode.RIGHT_HAND),
        ('<sbm:constraint effector="r_wrist" sbm:handle="h" sbm:fade-out="0.5"/>', Mode.RIGHT_HAND),
        ('<sbm:constraint sbm:handle="h"/>', Mode.BOTH_HANDS),
    ],
)
def test_hands_let_go_of_what_they_carry_or_hold_on_to(releases: str, mode: Mode) -> None:
    release = only(releases)
    assert isinstance(release, Release)
    assert (release.mode, dict(release.syncs)) == (mode, {})


def test_a_grab_takes_its_target() -> None:
    assert only('<sbm:grab target="box"/>').extensions[REACH] == "TAKE"


def test_a_constraint_of_a_wrist_holds_its_target_with_that_hand_until_its_end() -> None:
    touch = only('<sbm:constraint id="c" effector="l_wrist" target="box" sbm:fade-in="0.5" sbm:fade-out="1" end="4"/>')
    assert isinstance(touch, Pointing)
    assert (touch.mode, touch.extensions[REACH], touch.persistent) == (Mode.LEFT_HAND, "HOLD", False)
    assert {point: str(ref) for point, ref in touch.syncs.items()} == {
        "end": "4",
        "ready": "c:start+0.5",
        "relax": "3",
        "start": "0",
    }


def test_a_constraint_without_an_end_persists() -> None:
    touch = only('<sbm:constraint id="c" effector="l_wrist" target="box" sbm:fade-in="0.5" sbm:fade-out="1"/>')
    assert touch.persistent
    assert {point: str(ref) for point, ref in touch.syncs.items()} == {"ready": "c:start+0.5"}


@pytest.mark.parametrize(("effector", "mode"), [("JtWristRt", Mode.RIGHT_HAND), ("l_thumb3", Mode.LEFT_HAND)])
def test_a_constraint_may_name_a_joint_of_a_hand_in_any_skeleton_of_smartbody(effector: str, mode: Mode) -> None:
    touch = only(f'<sbm:constraint effector="{effector}" target="box"/>')
    assert isinstance(touch, Pointing)
    assert touch.mode is mode


@pytest.mark.parametrize(
    ("written", "what"),
    [
        ('effector="l_forefoot"', "the place of 'l_forefoot'"),
        ('effector="tail"', "the place of 'tail'"),
        ("", "the place of no effector"),
        ('effector="r_wrist" sbm:constraint-type="rot"', "the 'rot' of 'r_wrist'"),
    ],
)
def test_a_constraint_of_something_else_stays_for_engines_of_plug_ins_and_is_told(written: str, what: str) -> None:
    constraint = f'<sbm:constraint {written} target="box"/>'
    (sentence,) = told(constraint)
    assert sentence.startswith(f"a constraint of {what} is left to plug-ins: here, constraints are of the place of a")
    block = read(f"<act><bml>{constraint}</bml></act>").block
    assert block is not None
    assert [each.namespace for each in block.behaviors] == ["urn:smartbody"]


def test_a_fade_of_minus_1_is_none_as_in_smartbody() -> None:
    constraint = only('<sbm:constraint effector="r_wrist" target="box" sbm:fade-in="-1" sbm:fade-out="-1.0" end="3"/>')
    assert {point: str(ref) for point, ref in constraint.syncs.items()} == {"start": "0", "end": "3"}


@pytest.mark.parametrize("fade", ["-2", "nan", "soon"])
def test_a_constraint_with_a_bad_fade_is_refused_with_one_message(fade: str) -> None:
    (sentence,) = told(
        f'<sbm:constraint effector="r_wrist" target="box" sbm:fade-in="{fade}" sbm:fade-out="1" end="3"/>'
    )
    assert sentence.startswith(f"fade-in='{fade}' of <constraint>: not ")


def test_a_reach_may_walk_to_its_target_first() -> None:
    reach, walk = sorted(
        behaviors('<sbm:reach target="box" sbm:use-locomotion="true" start="2"/>'),
        key=lambda each: -len(each.sync_points),
    )
    assert isinstance(walk, Locomotion)
    assert (walk.target, str(walk.syncs["start"]), dict(walk.parameters)) == ("box", "2", {"distance": "0.4"})
    assert isinstance(reach, Pointing)
    assert str(reach.syncs["start"]) == f"{walk.id}:end"


def test_an_unknown_action_and_an_unknown_hand_of_a_reach_are_named() -> None:
    reach = '<sbm:reach target="bluebox" sbm:action="juggle" sbm:reach-type="foot"/>'
    (sentence,) = told(reach)
    assert sentence == "sbm:action, sbm:reach-type of SmartBody has no effect on <reach> here"


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
