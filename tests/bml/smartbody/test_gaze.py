"""Gazes and saccades of SmartBody."""

import pytest

from reactive_realizer.bml.behaviors import Gaze
from reactive_realizer.bml.glance import Glance
from reactive_realizer.bml.idle_change import IdleChange, IdleParameter
from reactive_realizer.bml.vocabulary import Influence, OffsetDirection

from .reading import only, read, told


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


@pytest.mark.parametrize("name", ["time-hint", "fade-in", "fade-out"])
def test_a_time_of_minus_1_is_none_as_in_smartbody(name: str) -> None:
    assert set(gaze(f'sbm:{name}="-1" end="3"').syncs) == {"end"}


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


def test_a_gaze_at_a_target_fades_out_before_its_end() -> None:
    read = gaze('sbm:fade-out="0.7" end="4"')
    assert {point: str(ref) for point, ref in read.syncs.items()} == {"end": "4", "relax": "3.3"}
    assert str(gaze('sbm:fade-out="0.7" start="1" end="g:start+3"').syncs["relax"]) == "g:start+2.3"
    assert str(gaze('sbm:fade-out="0.7" relax="2" end="4"').syncs["relax"]) == "2"


@pytest.mark.parametrize(
    ("element", "times"),
    [
        ('gaze target="t"', 'start="1" end="3" sbm:fade-out="2"'),
        ('gaze target="t"', 'end="3" sbm:fade-out="3.5"'),
        ('gaze target="t"', 'start="s:x" end="s:x+3" sbm:fade-out="5"'),
        ('sbm:constraint effector="r_wrist" target="t"', 'end="3" sbm:fade-out="3"'),
        ('face type="facs" au="1"', 'start="1" end="3" sbm:rampdown="2.5"'),
    ],
)
def test_a_fade_that_is_longer_than_its_behavior_is_told_and_the_end_stays(element: str, times: str) -> None:
    speech = '<speech id="s"><text>Look <sync id="x"/>here</text></speech>'
    parsed = read(f'<act><bml>{speech}<{element} id="g" {times}/></bml></act>')
    (sentence,) = (each.fault.sentence for each in parsed.problems)
    assert sentence.endswith("would fade out before it starts")
    assert parsed.block is not None
    (syncs,) = (each.syncs for each in parsed.block.behaviors if each.id == "g")
    assert "relax" not in syncs
    assert str(syncs["end"]) in {"3", "s:x+3"}


@pytest.mark.parametrize("joints", ["", 'sbm:joint-range="NECK EYES"', 'sbm:joint-range="EYES CHEST"'])
def test_eyes_that_point_at_the_target_first_are_those_of_any_gaze(joints: str) -> None:
    read, plain = gaze(f'sbm:priority-joint="EYES" {joints}'), gaze(joints)
    assert (read.influence, read.parameters) == (plain.influence, plain.parameters)
    assert gaze('sbm:priority-joint="neck" sbm:joint-range="NECK CHEST"').influence is Influence.SHOULDER


def test_what_a_gaze_cannot_do_is_told_in_one_warning() -> None:
    (sentence,) = told('<gaze target="x" sbm:priority-joint="NECK" sbm:fade-out="1" sbm:handle="h"/>')
    assert sentence == "sbm:fade-out, sbm:priority-joint of SmartBody has no effect on <gaze> here"


def test_joints_that_no_gaze_has_are_told() -> None:
    (sentence,) = told('<gaze target="x" sbm:joint-range="TOES"/>')
    assert sentence == "sbm:joint-range of SmartBody has no effect on <gaze> here"


@pytest.mark.parametrize(
    ("written", "rate"), [('mode="talk"', 14.8), ('mode="listen"', 7.2), ('mode="think"', 20.0), ('finish="true"', 0.0)]
)
def test_a_mode_of_saccades_is_a_rate_of_glances(written: str, rate: float) -> None:
    change = only(f"<saccade {written}/>")
    assert isinstance(change, IdleChange)
    assert (change.parameter, change.value) == (IdleParameter.GLANCE_RATE, rate)


@pytest.mark.parametrize(
    ("written", "left", "up"),
    [
        ('magnitude="10" direction="0"', -10.0, 0.0),
        ('magnitude="10" direction="90"', 0.0, 10.0),
        ('magnitude="10" direction="180" mode="talk"', 10.0, 0.0),
        ('magnitude="-10" direction="90"', 0.0, -10.0),
        ('direction="270"', 0.0, -3.0),
        ('magnitude="10"', -7.071, 7.071),
        ('sbm:duration="0.2"', -2.121, 2.121),
    ],
)
def test_a_single_saccade_is_a_glance(written: str, left: float, up: float) -> None:
    """Without a magnitude by 3 degrees, and without a direction to the right and up."""
    glance = only(f"<saccade {written}/>")
    assert isinstance(glance, Glance)
    assert (glance.left, glance.up) == pytest.approx((left, up), abs=1e-6)


def test_a_saccade_stays_aside_for_its_duration() -> None:
    glance = only('<saccade id="s" magnitude="5" sbm:duration="0.4" start="1" stroke="2"/>')
    assert {point: str(ref) for point, ref in glance.syncs.items()} == {"start": "1", "end": "s:start+0.4"}


def test_what_saccades_cannot_be_is_told() -> None:
    (sentence,) = told('<saccade mode="talk" angle-limit="10"/>')
    assert sentence.startswith("angle-limit of SmartBody has no effect on <saccade>")
    (sentence,) = told('<saccade mode="sing"/>')
    assert sentence.startswith("mode='sing' of <saccade>: not one of listen, talk, think")
    (sentence,) = told('<saccade magnitude="90"/>')
    assert sentence == "magnitude='90' of <saccade>: not between -40 and 40"
