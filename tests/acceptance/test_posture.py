"""Posture, postureShift and idle life (BML 1.0), from BML to feedback and frames."""

import math
from itertools import pairwise

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import angle, difference, rotate
from reactive_realizer.embodiment.vector import UP, distance, subtract
from reactive_realizer.engine.lexicon import words_of
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import open_pilot

SIT = '<stance type="SITTING"/>'
STAND = '<stance type="STANDING"/>'
CROSSED = '<pose part="ARMS" lexeme="ARMS_CROSSED"/>'
FEET = ("l_ankle", "r_ankle")


@pytest.fixture
async def pilot():
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.watch()
        yield pilot


def body(pilot, time: float) -> Body:
    """What was shown at a time, s."""
    return pilot.bodies()[round(time * 50)]


def apart(a: Body, b: Body, joint: str) -> float:
    """The angle between two bodies' rotations of a joint, degrees."""
    return math.degrees(angle(difference(a.rotation(joint), b.rotation(joint))))


def sits(shown: Body) -> bool:
    """Whether the thighs are level."""
    hip, knee = (shown.place(joint).position for joint in ("l_hip", "l_knee"))
    return abs(hip[1] - knee[1]) < 0.06


def crossed(shown: Body) -> bool:
    """Whether the wrists are on the other sides."""
    return shown.place("l_wrist").position[0] < 0.0 < shown.place("r_wrist").position[0]


# --- postures


async def test_a_posture_comes_holds_and_goes_back(pilot) -> None:
    pilot.block("b", f'<posture id="p" start="1" ready="2" relax="4" end="5">{CROSSED}</posture>')
    await pilot.advance(6)
    assert pilot.feedback.progress == ["b:start", "b:p:start", "b:p:ready", "b:p:relax", "b:relax", "b:p:end", "b:end"]
    assert [crossed(body(pilot, time)) for time in (0.9, 2.1, 3.9, 5.1)] == [False, True, True, False]
    assert apart(body(pilot, 5.5), body(pilot, 0.5), "l_shoulder") < 2.0


async def test_a_posture_without_times_takes_its_own(pilot) -> None:
    pilot.block("b", f'<posture id="p">{CROSSED}</posture>')
    await pilot.advance(8)
    start, ready, relax, end = (pilot.feedback.time(f"b:p:{sync}") for sync in ("start", "ready", "relax", "end"))
    assert 0.6 < ready - start < 1.1
    assert relax - ready == pytest.approx(2 * (ready - start))
    assert end - relax == pytest.approx(ready - start)


async def test_a_shift_stays_and_a_posture_returns_to_it(pilot) -> None:
    pilot.block("b", f'<postureShift id="s">{SIT}</postureShift><posture id="p" start="3" end="7">{CROSSED}</posture>')
    await pilot.advance(20)
    assert pilot.feedback.progress[-1] == "b:end"
    for time in (2.9, 5.0, 8.0, 19.9):
        assert sits(body(pilot, time)), time
    assert crossed(body(pilot, 5.0))
    assert not crossed(body(pilot, 8.0))


GETTING_UP = 1.61
"""s that standing up from a chair takes."""


async def test_getting_up_takes_its_time_whatever_else_was_tried_out_before(pilot) -> None:
    pilot.block("a", f'<postureShift id="s">{SIT}</postureShift>')
    await pilot.advance(3)
    assert words_of(pilot.realizer.characters["alice"].engines)
    pilot.block("b", f'<postureShift id="s">{STAND}</postureShift>')
    await pilot.advance(3)
    assert pilot.feedback.time("b:s:end") - pilot.feedback.time("b:s:start") == pytest.approx(GETTING_UP, abs=0.02)


async def test_getting_up_takes_its_time_also_if_it_is_planned_together_with_sitting_down(pilot) -> None:
    pilot.block(
        "b", f'<postureShift id="down">{SIT}</postureShift><postureShift id="up" start="3">{STAND}</postureShift>'
    )
    await pilot.advance(6)
    assert pilot.feedback.time("b:up:end") - pilot.feedback.time("b:up:start") == pytest.approx(GETTING_UP, abs=0.02)


async def test_a_shift_of_a_block_that_could_not_be_planned_is_not_expected(pilot) -> None:
    nobody = '<required><gesture id="g" lexeme="NOBODY_KNOWS"/></required>'
    pilot.block("a", f'<postureShift id="s">{SIT}</postureShift>{nobody}')
    await pilot.advance(0.1)
    assert not pilot.feedback.reached("a:start")
    pilot.block("b", f'<postureShift id="s">{SIT}</postureShift>')
    await pilot.advance(3)
    assert pilot.feedback.time("b:s:end") - pilot.feedback.time("b:s:start") == pytest.approx(GETTING_UP, abs=0.02)


async def test_a_later_shift_keeps_what_it_does_not_name(pilot) -> None:
    pilot.block("a", f'<postureShift id="s">{CROSSED}</postureShift>')
    await pilot.advance(2)
    pilot.block("b", f'<postureShift id="s">{SIT}</postureShift>')
    await pilot.advance(3)
    assert crossed(body(pilot, 4.9))
    assert sits(body(pilot, 4.9))


async def test_to_replace_everything_is_to_stand_as_at_first(pilot) -> None:
    pilot.block("a", f'<postureShift id="s">{SIT}{CROSSED}</postureShift>')
    await pilot.advance(3)
    pilot.block("b", composition="REPLACE")
    await pilot.advance(3)
    first, last = body(pilot, 0.02), body(pilot, 5.9)
    assert first.root == pytest.approx(last.root, abs=0.05)
    assert max(apart(first, last, joint) for joint in ("l_shoulder", "r_elbow", "l_wrist")) < 2.0


async def test_a_shift_that_is_cut_leaves_the_posture_of_before(pilot) -> None:
    pilot.block("a", f'<postureShift id="s" end="2">{SIT}</postureShift>')
    await pilot.advance(1.2)
    pilot.block("b", '<bmla:interrupt id="i" target="a"/>')
    await pilot.advance(3)
    assert body(pilot, 1.1).root[1] < -0.05
    assert body(pilot, 4.0).root[1] == pytest.approx(0.0, abs=0.03)


async def test_sitting_down_takes_longer_than_crossing_the_arms(pilot) -> None:
    pilot.block("a", f'<postureShift id="s">{SIT}</postureShift>')
    pilot.block("b", f'<postureShift id="s">{CROSSED}</postureShift>', composition="APPEND")
    await pilot.advance(6)
    sitting, crossing = (pilot.feedback.time(f"{b}:s:end") - pilot.feedback.time(f"{b}:s:start") for b in "ab")
    assert 1.4 < sitting < 2.2
    assert 0.5 < crossing < 1.1


async def test_one_stance_has_one_owner(pilot) -> None:
    pilot.block("a", f'<posture id="p" start="0" end="4">{CROSSED}</posture>')
    await pilot.advance(0.5)
    pilot.block("b", f'<posture id="p">{SIT}</posture>')
    await pilot.advance(6)
    ((about, _),) = pilot.feedback.warnings
    assert about == "b:p"
    assert not any(map(sits, pilot.bodies()))


async def test_a_posture_of_a_draft_without_an_end_goes_on_and_gives_way_to_the_next(pilot) -> None:
    pilot.perform(f'<bml id="a"><posture id="p">{SIT}</posture></bml>')
    await pilot.advance(20)
    assert not pilot.feedback.reached("a:p:end")
    assert sits(body(pilot, 19.9))
    pilot.block("b", f'<posture id="p" start="0" end="4">{STAND}</posture>')
    await pilot.advance(7)
    assert body(pilot, 22.0).root[1] == pytest.approx(0.0, abs=0.03)
    assert sits(body(pilot, 26.9))


@pytest.mark.parametrize(
    ("children", "says"),
    [
        ('<pose part="ARMS" lexeme="ARMS_WINGED"/>', "ARMS_AKIMBO, ARMS_CROSSED"),
        ('<stance type="CROUCHING"/><pose part="LEGS" lexeme="LEGS_CROSSED"/>', "CROUCHING"),
        ('<pose part="LEGS" lexeme="ARMS_CROSSED"/>', "arms_crossed"),
    ],
)
async def test_a_posture_that_cannot_be_is_dropped_and_says_why(pilot, children, says) -> None:
    pilot.block("b", f'<posture id="p">{children}</posture><head id="n" lexeme="NOD"/>')
    await pilot.advance(3)
    (line,) = pilot.feedback.of("warningFeedback")
    assert (line.id, line.element.get("type")) == ("b:p", "CANNOT_CREATE_BEHAVIOR")
    assert says in line.element.text
    assert pilot.feedback.reached("b:n:end")


DRAFT = '<bml id="a"><posture id="p" stance="sitting" shape="crossed" part="arms" end="4"/></bml>'


async def test_a_posture_of_a_draft_says_its_shape_and_part(pilot) -> None:
    pilot.perform(DRAFT)
    await pilot.advance(6)
    assert pilot.feedback.warnings == []
    assert any(crossed(shown) and sits(shown) for shown in pilot.bodies())


SWITCH = """
<postureShift id="one" start="1"><stance type="STANDING"/><pose part="ARMS" lexeme="ARMS_FORWARD"/></postureShift>
<postureShift id="two" start="4"><stance type="STANDING"/><pose part="ARMS" lexeme="ARMS_SPREAD"/></postureShift>
"""


def reach(shown: Body) -> tuple[float, float]:
    """How far the left wrist is to the side of and in front of the shoulder, m."""
    x, _, z = subtract(shown.place("l_wrist").position, shown.place("l_shoulder").position)
    return x, z


async def test_arms_go_forward_and_then_apart(pilot) -> None:
    pilot.block("b", SWITCH)
    await pilot.advance(8)
    forward, spread = reach(body(pilot, 3.9)), reach(body(pilot, 7.9))
    assert forward[1] > 0.35 > 0.1 > abs(forward[0])
    assert spread[0] > 0.35 > 0.1 > abs(spread[1])


async def test_the_peers_switch_of_postures_plays(pilot, shared_cases) -> None:
    pilot.perform((shared_cases / "asap" / "bml" / "postureshift.xml").read_bytes())
    await pilot.advance(10)
    assert pilot.feedback.warnings == []
    assert reach(body(pilot, 5.9))[1] > 0.35
    assert reach(body(pilot, 9.9))[0] > 0.35


# --- feet


def planted(pilot, start: float = 0.0) -> float:
    """The furthest that a foot was from where it stood at first, m."""
    shown = pilot.bodies()[round(start * 50) :]
    return max(distance(each.place(foot).position, shown[0].place(foot).position) for each in shown for foot in FEET)


def flat(pilot) -> float:
    """The steepest that a sole was, degrees."""
    ups = (rotate(each.place(foot).rotation, UP)[1] for each in pilot.bodies() for foot in FEET)
    return max(math.degrees(math.acos(min(1.0, up))) for up in ups)


async def test_the_feet_stay_where_they_are_while_a_figure_sits_down_and_gets_up(pilot) -> None:
    pilot.block("b", f'<posture id="p" start="0.5">{SIT}</posture>')
    await pilot.advance(10)
    assert any(map(sits, pilot.bodies()))
    assert planted(pilot) < 0.003
    assert flat(pilot) < 0.5


async def test_the_feet_stay_where_they_are_when_sitting_down_is_cut_short(pilot) -> None:
    pilot.block("a", f'<postureShift id="s">{SIT}</postureShift>')
    await pilot.advance(0.9)
    pilot.block("b", composition="REPLACE")
    await pilot.advance(3)
    assert planted(pilot) < 0.003


async def test_the_feet_stay_where_they_are_while_the_weight_goes_from_one_to_the_other(pilot) -> None:
    await pilot.advance(60)
    pelvis = [each.root[0] for each in pilot.bodies()]
    assert max(pelvis) - min(pelvis) > 0.025
    assert planted(pilot) < 0.003
    assert flat(pilot) < 0.5


async def test_a_figure_steps_with_one_foot_at_a_time_and_lifts_it(pilot) -> None:
    pilot.block("b", '<postureShift id="s" end="2"><pose part="LEGS" lexeme="LEGS_OPEN"/></postureShift>')
    await pilot.advance(3)
    heights = np.array([[each.place(foot).position[1] for foot in FEET] for each in pilot.bodies()])
    lifted = heights - heights[0] > 0.003
    assert lifted.any(axis=0).all()
    assert not lifted.all(axis=1).any()
    assert (heights > heights[0] - 0.003).all()


async def test_nothing_jumps_on_the_way_between_stances(pilot) -> None:
    stances = ("SITTING", "CROUCHING", "LYING", "STANDING")
    shifts = (
        f'<postureShift id="{s}" start="{3 * i}"><stance type="{s}"/></postureShift>' for i, s in enumerate(stances)
    )
    pilot.block("b", "".join(shifts))
    await pilot.advance(15)
    assert pilot.feedback.warnings == []
    joints = ("HumanoidRoot", "skullbase", "l_knee", "r_knee", "l_wrist", "r_ankle")
    ways = [distance(a.place(j).position, b.place(j).position) for a, b in pairwise(pilot.bodies()) for j in joints]
    assert max(ways) < 0.06


# --- with gestures


async def test_a_gesture_goes_out_of_crossed_arms_and_comes_back_to_them(pilot) -> None:
    pilot.block("a", f'<postureShift id="s">{CROSSED}</postureShift>')
    await pilot.advance(2)
    pilot.block("b", '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND"/>')
    await pilot.advance(4)
    stroke = pilot.feedback.time("b:g:stroke")
    assert not crossed(body(pilot, stroke))
    assert apart(body(pilot, stroke), body(pilot, 1.9), "l_shoulder") < 2.0
    assert apart(body(pilot, 5.9), body(pilot, 1.9), "r_shoulder") < 2.0
    assert crossed(body(pilot, 5.9))


async def test_who_sits_gestures_in_front_of_the_same_chest(pilot) -> None:
    gesture = '<gesture id="g" lexeme="OFFER" mode="RIGHT_HAND"/>'
    pilot.block("a", gesture)
    await pilot.advance(5)
    pilot.block("b", f'<postureShift id="s">{SIT}</postureShift>')
    await pilot.advance(3)
    pilot.block("c", gesture)
    await pilot.advance(5)
    ways = []
    for block in "ac":
        shown = body(pilot, pilot.feedback.time(f"{block}:g:stroke"))
        ways.append(subtract(shown.place("r_wrist").position, shown.place("r_shoulder").position))
    assert distance(*ways) < 0.05


# --- idle life


HUMAN = """
[character.still]
idle = false
[character.alive]
position = [1, 0, 0]
"""


async def test_whether_a_character_has_idle_life_is_true_or_false(tmp_path) -> None:
    file = tmp_path / "one.toml"
    file.write_text('[character.still]\nidle = "no"')
    with pytest.raises(RealizerError, match=r"character\.still\.idle"):
        async with open_pilot(SceneOptions(file, voice="text")):
            pass


async def test_a_character_may_be_without_idle_life(tmp_path) -> None:
    file = tmp_path / "two.toml"
    file.write_text(HUMAN)
    async with open_pilot(SceneOptions(file, voice="text")) as pilot:
        pilot.watch()
        await pilot.advance(20)
        still, alive = pilot.frames["still"], pilot.frames["alive"]
        assert all(np.array_equal(frame.rotations, still[0].rotations) for frame in still)
        assert all(not frame.weights.any() for frame in still)
        assert not np.array_equal(alive[0].rotations, alive[500].rotations)


async def frames_of(seed: int) -> list[bytes]:
    async with open_pilot(SceneOptions(voice="text", seed=seed)) as pilot:
        pilot.watch()
        await pilot.advance(15)
        return [frame.rotations.tobytes() + frame.root.tobytes() for frame in pilot.frames["alice"]]


async def test_the_same_seed_gives_the_same_life_and_another_one_another() -> None:
    assert await frames_of(1) == await frames_of(1)
    assert await frames_of(1) != await frames_of(2)


async def test_who_sits_does_not_shift_the_weight(pilot) -> None:
    pilot.block("a", f'<postureShift id="s">{SIT}</postureShift>')
    await pilot.advance(60)
    roots = {tuple(np.round(each.root, 6)) for each in pilot.bodies()[150:]}
    assert len(roots) == 1


def sole(shown: Body) -> float:
    """How much higher than in standing its lowest foot is, m."""
    standing = Body(shown.skeleton)
    joints = (f"{side}_{joint}" for side in "lr" for joint in ("ankle", "midtarsal"))
    return min(shown.place(joint).position[1] - standing.place(joint).position[1] for joint in joints)


@pytest.mark.parametrize("stance", ["SITTING", "CROUCHING", "LYING"])
async def test_however_hurried_a_posture_is_no_foot_goes_into_the_ground(pilot, stance) -> None:
    pilot.block("b", f'<posture id="p" start="0" end="0.5"><stance type="{stance}"/></posture>')
    await pilot.advance(2)
    assert min(map(sole, pilot.bodies())) > -0.01


async def test_nor_does_one_when_postures_chase_each_other(pilot) -> None:
    for number, stance in enumerate(("SITTING", "LYING", "STANDING", "CROUCHING", "LYING", "SITTING", "STANDING")):
        shift = f'<postureShift id="s" start="0" end="0.3"><stance type="{stance}"/></postureShift>'
        pilot.block(f"b{number}", shift)
        await pilot.advance(0.4)
    await pilot.advance(2)
    assert min(map(sole, pilot.bodies())) > -0.01


CROSSED_LEGS = '<pose part="LEGS" lexeme="LEGS_CROSSED"/>'
CROUCH = '<stance type="CROUCHING"/>'


async def test_what_cannot_be_kept_in_another_stance_is_left_out_and_is_there_again_after_it(pilot) -> None:
    pilot.block("a", f'<postureShift id="s" end="2">{SIT}{CROSSED_LEGS}{CROSSED}</postureShift>')
    await pilot.advance(3)
    pilot.block("b", f'<posture id="p" start="0" ready="2" relax="4" end="6">{CROUCH}</posture>')
    await pilot.advance(8)
    assert pilot.feedback.warnings == []
    assert "b:p:end" in pilot.feedback.progress
    assert body(pilot, 6.0).root[1] < -0.45, "lower than a seat"
    assert crossed(body(pilot, 6.0)), "arms can"
    assert apart(body(pilot, 10.5), body(pilot, 2.9), "r_hip") < 2.0


async def test_a_pose_whose_stance_never_comes_is_left_out(pilot) -> None:
    pilot.block("a", f'<postureShift id="s" end="2">{CROUCH}</postureShift>')
    await pilot.advance(3)
    pilot.block("b", f'<postureShift id="s" start="0" end="3">{SIT}</postureShift>')
    pilot.block("c", f'<posture id="p">{CROSSED_LEGS}</posture>', composition="APPEND")
    await pilot.advance(1)
    pilot.block("d", '<bmla:interrupt id="i" target="b"/>')
    await pilot.advance(8)
    assert pilot.feedback.warnings == []
    assert "c:p:end" in pilot.feedback.progress
