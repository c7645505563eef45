"""Looking (BML 1.0: gaze, gazeShift, headDirectionShift; thesis 4.2.2), seen in frames."""

import math
from itertools import pairwise

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import angle, conjugate, difference, from_euler, multiply, rotate
from reactive_realizer.embodiment.quaternion import between as shortest
from reactive_realizer.embodiment.vector import FORWARD, Vec3, add, dot, scale, subtract, unit
from reactive_realizer.engines.animation.gaze.saccade import saccade_duration, saccade_progress
from reactive_realizer.testing.pilot import open_pilot

EYES = ("l_eyeball_joint", "r_eyeball_joint")
PLATEAU = 8.7
FRAME = 0.02
FAR = 1000.0
GLANCE = 5.1
"""Degrees, by which eyes that look at nothing in particular may be aside."""


@pytest.fixture
async def pilot():
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.watch()
        await pilot.advance(0.1)
        yield pilot


# --- what is seen


def between(a: Vec3, b: Vec3) -> float:
    """The angle between two unit vectors, degrees."""
    return math.degrees(math.acos(max(-1.0, min(1.0, dot(a, b)))))


def sight(body: Body, joint: str = EYES[0]) -> Vec3:
    """Where an eye looks or the nose points."""
    return rotate(body.place(joint).rotation, FORWARD)


def miss(body: Body, target: Vec3) -> float:
    """By how much the worse of the two eyes misses a target, degrees."""
    return max(between(sight(body, eye), unit(subtract(target, body.place(eye).position))) for eye in EYES)


def place(pilot, yaw: float, pitch: float, far: float = 2.0) -> Vec3:
    """A point to the left and up as Alice sees it before she looks anywhere."""
    body = pilot.bodies()[0]
    middle = scale(add(*(body.place(eye).position for eye in EYES)), 0.5)
    return add(middle, scale(rotate(from_euler(-math.radians(pitch), math.radians(yaw), 0.0), FORWARD), far))


def put(pilot, name: str, yaw: float, pitch: float, far: float = 2.0) -> Vec3:
    """A target in a direction."""
    there = place(pilot, yaw, pitch, far)
    pilot.move(name, there)
    return there


def at(pilot, time: float) -> int:
    """The frame shown at a time."""
    return round(time / FRAME)


def speeds(shown: list[Body], joint: str = EYES[0]) -> list[float]:
    """How fast a direction turns in space from frame to frame, rad/s."""
    return [math.radians(between(sight(a, joint), sight(b, joint))) / FRAME for a, b in pairwise(shown)]


# --- the eyes


@pytest.mark.parametrize("influence", ["EYES", "HEAD", "SHOULDER", "WAIST", "WHOLE"])
async def test_the_eyes_are_on_the_target_while_the_head_still_turns_and_until_it_relaxes(pilot, influence) -> None:
    target = put(pilot, "t", 25, 10)
    pilot.block("b", f'<gaze id="g" target="t" influence="{influence}" start="0.2"/>')
    await pilot.advance(4)
    there = at(pilot, pilot.feedback.time("b:g:start") + saccade_duration(math.radians(30)) + FRAME)
    relax = at(pilot, pilot.feedback.time("b:g:relax"))
    assert max(miss(body, target) for body in pilot.bodies()[there:relax]) < 0.5


@pytest.mark.parametrize("head", ['lexeme="NOD" repetition="4" amount="1"', 'lexeme="SHAKE" repetition="4" amount="1"'])
async def test_the_eyes_stay_on_the_target_while_the_head_nods_and_shakes(pilot, head) -> None:
    target = put(pilot, "t", -15, 5)
    pilot.block("b", f'<gaze id="g" target="t" start="0" end="8"/><head id="h" {head} start="g:ready"/>')
    await pilot.advance(6)
    shown = pilot.bodies()[at(pilot, 0.5) : at(pilot, 6)]
    noses = [sight(body, "skullbase") for body in shown]
    assert max(between(a, noses[0]) for a in noses) > 3
    assert max(miss(body, target) for body in shown) < 0.5


async def test_the_eyes_are_there_before_the_head_and_it_overtakes_them_not(pilot) -> None:
    target = put(pilot, "t", 30, 0)
    pilot.block("b", '<gaze id="g" target="t" start="0"/>')
    await pilot.advance(2)
    shown = pilot.bodies()[at(pilot, pilot.feedback.time("b:g:start")) :]
    arrived = next(i for i, body in enumerate(shown) if miss(body, target) < 0.5)
    assert between(sight(shown[arrived], "skullbase"), FORWARD) < 3
    ready = at(pilot, pilot.feedback.time("b:g:ready") - pilot.feedback.time("b:g:start"))
    turns = [angle(body.rotation(EYES[0])) for body in shown[arrived:ready]]
    # They glide back in the head as it catches up (thesis 4.2.2).
    assert all(later < earlier + 0.01 for earlier, later in pairwise(turns))
    assert turns[-1] < 0.3 * turns[0]


@pytest.mark.parametrize("degrees", [3, 8, 15, 25, 35])
async def test_a_saccade_takes_time_in_proportion_to_its_way_and_keeps_below_the_plateau(pilot, degrees) -> None:
    put(pilot, "t", degrees, 0, FAR)
    pilot.block("b", '<gaze id="g" target="t" influence="EYES" start="0.5"/>')
    await pilot.advance(1.2)
    shown = pilot.bodies()[at(pilot, pilot.feedback.time("b:g:start")) :]
    goal = sight(shown[-1])
    amplitude = between(sight(shown[0]), goal)
    left = [1.0 - saccade_progress(math.radians(amplitude), i * FRAME) for i in range(10)]
    assert [between(sight(body), goal) for body in shown[:10]] == pytest.approx([amplitude * p for p in left], abs=0.05)
    assert left.index(0.0) == math.ceil((0.021 + 0.0022 * amplitude) / FRAME)
    assert max(speeds(shown)) < PLATEAU


async def test_the_eyes_stay_on_the_target_while_a_head_that_is_hurried_falls_behind(pilot) -> None:
    target = put(pilot, "t", 38, 0)
    pilot.block("b", '<gaze id="g" target="t" influence="WAIST" start="0" ready="0.06" relax="1" end="1.5"/>')
    await pilot.advance(1)
    shown = pilot.bodies()
    there = at(pilot, pilot.feedback.time("b:g:start") + saccade_duration(math.radians(40)) + FRAME)
    assert max(miss(body, target) for body in shown[there:]) < 0.5
    assert max(angle(difference(a.rotation("vc4"), b.rotation("vc4"))) for a, b in pairwise(shown)) < 0.17


async def test_what_the_eyes_cannot_reach_they_come_to_with_the_head(pilot) -> None:
    target = put(pilot, "t", 100, 10)
    pilot.block("b", '<gaze id="g" target="t" influence="SHOULDER" start="0" end="4"/>')
    await pilot.advance(3)
    shown = pilot.bodies()
    assert max(math.degrees(angle(body.rotation(eye))) for body in shown for eye in EYES) < 40.6
    assert miss(shown[at(pilot, 2)], target) < 0.5


async def test_a_gaze_ends_with_a_saccade_and_the_head_follows(pilot) -> None:
    put(pilot, "t", 30, -30)
    pilot.block("b", '<gaze id="g" target="t" start="0"/>')
    await pilot.advance(4)
    shown = pilot.bodies()
    relax, end = (at(pilot, pilot.feedback.time(f"b:g:{sync}")) for sync in ("relax", "end"))
    back = relax + 10
    assert math.degrees(angle(shown[relax - 1].rotation(EYES[0]))) > 15
    assert math.degrees(angle(shown[back].rotation(EYES[0]))) < GLANCE
    assert between(sight(shown[back], "skullbase"), FORWARD) > 10
    assert between(sight(shown[end + 1], "skullbase"), FORWARD) < 2


# --- the head


@pytest.mark.parametrize(("yaw", "pitch"), [(40, 0), (-40, 0), (0, 30), (0, -30), (40, 25), (-40, 25)])
async def test_the_head_turns_by_nine_tenths_to_the_side_by_three_tenths_up_and_rolls_by_donders_law(
    pilot, yaw, pitch
) -> None:
    put(pilot, "t", yaw, pitch, FAR)
    pilot.block("b", '<gaze id="g" target="t" start="0" end="4"/>')
    await pilot.advance(2)
    first, last = (body.place("skullbase").rotation for body in (pilot.bodies()[4], pilot.bodies()[-1]))
    _, x, y, z = multiply(last, conjugate(first))
    whole = shortest(FORWARD, unit(subtract(place(pilot, yaw, pitch, FAR), place(pilot, 0, 0, 0.0))))
    # A figure that breathes is never quite still.
    assert (x, y, z) == pytest.approx((0.3 * whole[1], 0.9 * whole[2], -0.15 * whole[1] * whole[2]), abs=0.012)


async def test_where_the_head_ends_does_not_depend_on_where_it_came_from(pilot) -> None:
    put(pilot, "first", -40, 25)
    put(pilot, "second", 35, 20)
    gazes = '<gaze id="a" target="first" start="0" end="3"/><gaze id="b" target="second" start="{}" end="{}"/>'
    pilot.block("b", gazes.format(3.0, 6.0))
    await pilot.advance(5)
    around = pilot.bodies()[-1].place("skullbase").rotation
    async with open_pilot(SceneOptions(voice="text")) as other:
        other.watch()
        await other.advance(0.1)
        put(other, "second", 35, 20)
        other.block("b", '<gaze id="b" target="second" start="3" end="6"/>')
        await other.advance(5)
        straight = other.bodies()[-1].place("skullbase").rotation
    assert math.degrees(angle(difference(around, straight))) < 0.1


async def test_the_head_turns_about_one_axis_and_fastest_half_way(pilot) -> None:
    put(pilot, "t", 50, 20)
    pilot.block("b", '<gaze id="g" target="t" start="0" ready="1" end="4"/>')
    await pilot.advance(1.2)
    shown = pilot.bodies()
    start, ready = (at(pilot, pilot.feedback.time(f"b:g:{sync}")) for sync in ("start", "ready"))
    first = shown[start].place("skullbase").rotation
    turns = [difference(first, body.place("skullbase").rotation) for body in shown[start : ready + 1]]
    axes = [unit(turn[1:]) for turn in turns[15:]]
    assert max(between(axis, axes[-1]) for axis in axes) < 4
    steps = [angle(b) - angle(a) for a, b in pairwise(turns)]
    assert abs(steps.index(max(steps)) - len(steps) / 2) <= 2
    assert max(steps) == pytest.approx(1.875 * angle(turns[-1]) / len(steps), rel=0.1)


@pytest.mark.parametrize(
    ("influence", "joints"),
    [
        ("EYES", set()),
        ("HEAD", {"vc4", "skullbase"}),
        ("SHOULDER", {"vt10", "vt6", "vc4", "skullbase"}),
        ("WAIST", {"vl5", "vt10", "vt6", "vc4", "skullbase"}),
        ("WHOLE", {"vl5", "vt10", "vt6", "vc4", "skullbase"}),
    ],
)
async def test_an_influence_turns_its_joints_and_no_others(pilot, influence, joints) -> None:
    put(pilot, "t", 60 if joints else 20, 0)
    pilot.block("b", f'<gaze id="g" target="t" influence="{influence}" start="0" end="4"/>')
    await pilot.advance(2)
    first, last = pilot.bodies()[4], pilot.bodies()[-1]
    spine = ("vl5", "vt10", "vt6", "vc4", "skullbase", "l_hip", "r_hip", "HumanoidRoot")
    turned = {joint for joint in spine if angle(difference(first.rotation(joint), last.rotation(joint))) > 0.05}
    assert turned == joints


async def test_a_behavior_may_say_how_much_each_group_of_joints_does(pilot) -> None:
    put(pilot, "t", 40, 0)
    weights = {"back": 0.5, "chest": 0, "neck": 0.25, "head": 0.25, "eyes": 1}
    said = "".join(f'<bmlt:parameter name="{name}" value="{weight}"/>' for name, weight in weights.items())
    pilot.block("b", f'<gaze id="g" target="t" start="0" end="4">{said}</gaze>')
    await pilot.advance(2)
    assert not pilot.feedback.warnings
    first, last = pilot.bodies()[4], pilot.bodies()[-1]
    turns = {
        joint: math.degrees(angle(difference(first.rotation(joint), last.rotation(joint))))
        for joint in ("vl5", "vt10", "vt6", "vc4", "skullbase")
    }
    assert turns == pytest.approx({"vl5": 18, "vt10": 0, "vt6": 0, "vc4": 9, "skullbase": 9}, abs=1.0)


async def test_the_weights_of_a_gaze_are_changed_while_it_plays(pilot) -> None:
    target = put(pilot, "t", 30, 0)
    pilot.block(
        "b",
        '<gaze id="g" target="t" start="0" end="6"/>'
        '<bmla:parametervaluechange id="p" target="b:g" paramId="head" start="2" end="3">'
        '<bmla:trajectory type="linear" targetValue="0"/></bmla:parametervaluechange>',
    )
    await pilot.advance(4)
    shown = pilot.bodies()
    assert not pilot.feedback.warnings
    assert math.degrees(angle(shown[at(pilot, 1.9)].rotation("skullbase"))) > 10
    assert math.degrees(angle(shown[-1].rotation("skullbase"))) < 2
    assert max(speeds(shown[at(pilot, 1.9) :], "skullbase")) < 0.6
    assert max(miss(body, target) for body in shown[at(pilot, 1.9) :]) < 0.5


# --- where to


OFFSETS = [
    ("RIGHT", -1, 0),
    ("LEFT", 1, 0),
    ("UP", 0, 1),
    ("DOWN", 0, -1),
    ("UPRIGHT", -1, 1),
    ("UPLEFT", 1, 1),
    ("DOWNRIGHT", -1, -1),
    ("DOWNLEFT", 1, -1),
]


@pytest.mark.parametrize(("side", "left", "up"), OFFSETS)
async def test_an_offset_is_so_many_degrees_to_its_side(pilot, side, left, up) -> None:
    put(pilot, "t", 10, 5, FAR)
    offset = f'offsetAngle="12" offsetDirection="{side}"'
    pilot.block("b", f'<gaze id="g" target="t" {offset} start="0" end="4"/>')
    await pilot.advance(2)
    looks = sight(pilot.bodies()[-1])
    toward = unit(subtract(place(pilot, 10, 5, FAR), place(pilot, 0, 0, 0.0)))
    assert between(looks, toward) == pytest.approx(12, abs=0.1)
    before, after = ((math.degrees(math.atan2(x, z)), math.degrees(math.asin(y))) for x, y, z in (toward, looks))
    assert [round((b - a) / 12) for a, b in zip(before, after, strict=True)] == [left, up]


async def test_a_target_that_moves_is_followed_if_the_gaze_is_dynamic_and_only_then(pilot) -> None:
    for follow in ("true", "false"):
        pilot.move("t", place(pilot, 0, 0))
        pilot.block(f"b-{follow}", f'<gaze id="g" target="t" bmlt:dynamic="{follow}" start="0" end="4"/>')
        await pilot.advance(1)
        first = len(pilot.bodies())
        for degrees in range(1, 21):
            there = place(pilot, degrees, 0)
            pilot.move("t", there)
            await pilot.advance(0.04)
        missed = [miss(pilot.bodies()[-1], there), miss(pilot.bodies()[-1], place(pilot, 0, 0))]
        assert (missed[0] < 0.5) == (follow == "true")
        assert (missed[1] < 0.5) == (follow == "false")
        assert max(speeds(pilot.bodies()[first:])) < 2
        await pilot.advance(4)


async def test_whether_a_gaze_is_dynamic_has_to_be_said_by_yes_or_no(pilot) -> None:
    pilot.move("t", place(pilot, 0, 0))
    pilot.block("b", '<gaze id="g" target="t" bmlt:dynamic="TRUE"/><gaze id="h" target="t" bmlt:dynamic="maybe"/>')
    await pilot.advance(0.1)
    assert pilot.feedback.warnings == [("b:h", "CANNOT_CREATE_BEHAVIOR")]
    assert "dynamic='maybe' is neither true nor false" in pilot.feedback.of("warningFeedback")[0].element.text


@pytest.mark.parametrize(("shift", "joint"), [("gazeShift", EYES[0]), ("headDirectionShift", "skullbase")])
async def test_a_dynamic_shift_goes_on_following_when_it_has_ended(pilot, shift, joint) -> None:
    put(pilot, "t", 20, 0, FAR)
    pilot.block("b", f'<{shift} id="s" target="t" bmlt:dynamic="true" start="0"/>')
    await pilot.advance(2)
    there = put(pilot, "t", -20, 0, FAR)
    await pilot.advance(2)
    toward = unit(subtract(there, place(pilot, 0, 0, 0.0)))
    assert between(sight(pilot.bodies()[-1], joint), toward) < 3


async def test_a_target_that_jumps_is_caught_by_a_saccade_and_a_turn_of_the_head(pilot) -> None:
    put(pilot, "t", -25, 0)
    pilot.block("b", '<gaze id="g" target="t" bmlt:dynamic="true" start="0" end="6"/>')
    await pilot.advance(2)
    there = put(pilot, "t", 35, 10)
    await pilot.advance(1)
    shown = pilot.bodies()
    assert miss(shown[-1], there) < 0.5
    assert max(speeds(shown)) < PLATEAU + 0.2
    # A jump of 60 degrees takes the head as long as a gaze takes at first.
    assert 1.5 < max(speeds(shown, "skullbase")) < 5


async def test_a_target_that_is_gone_is_still_looked_at_where_it_was(pilot) -> None:
    there = put(pilot, "t", 25, 0)
    pilot.block("b", '<gaze id="g" target="t" bmlt:dynamic="true" start="0" end="4"/>')
    await pilot.advance(1)
    pilot.move("t", None)
    await pilot.advance(1)
    assert miss(pilot.bodies()[-1], there) < 0.5


async def test_a_static_gaze_looks_where_its_target_is_when_it_begins(pilot) -> None:
    put(pilot, "t", -25, 0)
    pilot.block("b", '<gaze id="g" target="t" start="1" end="4"/>')
    await pilot.advance(0.5)
    there = put(pilot, "t", 25, 0)
    await pilot.advance(2)
    assert miss(pilot.bodies()[-1], there) < 0.5


async def test_figures_look_at_each_other_and_at_each_others_joints(tests_data) -> None:
    two = SceneOptions(human=tests_data / "humans" / "two.toml", voice="text")
    async with open_pilot(two) as pilot:
        pilot.watch()
        alice, bob = pilot.realizer.characters
        gaze = '<gaze id="g" target="{}" bmlt:dynamic="true" influence="WAIST" start="0" end="4"/>'
        pilot.block("a", gaze.format(f"{bob}:r_shoulder"), characterId=alice)
        pilot.block("b", gaze.format(f"{alice}:skullbase"), characterId=bob)
        await pilot.advance(2)
        hers, his = pilot.bodies(alice)[-1], pilot.bodies(bob)[-1]
    assert miss(hers, his.place("r_shoulder").position) < 0.5
    assert miss(his, hers.place("skullbase").position) < 0.5


async def test_a_figure_may_look_at_its_own_hand_as_far_as_it_can(pilot) -> None:
    pilot.block("b", '<gaze id="g" target="alice:l_wrist" bmlt:dynamic="true" start="0" end="4"/>')
    await pilot.advance(2)
    body = pilot.bodies()[-1]
    # A hand that hangs is below and behind the eyes.
    assert miss(body, body.place("l_wrist").position) < 10


@pytest.mark.parametrize("element", ["gaze", "gazeShift", "headDirectionShift"])
async def test_what_is_not_there_cannot_be_looked_at(pilot, element) -> None:
    pilot.block("b", f'<{element} id="g" target="nobody" start="0"/>')
    await pilot.advance(1)
    assert pilot.feedback.warnings == [("b:g", "NO_SUCH_TARGET")]


@pytest.mark.parametrize(("yaw", "pitch", "far"), [(180, 0, 2), (0, 0, 0), (0, 0, 0.02), (0, 90, 1), (0, -90, 1)])
@pytest.mark.parametrize("element", ['gaze influence="WAIST"', "headDirectionShift"])
async def test_wherever_a_target_is_the_figure_stays_in_one_piece(pilot, element, yaw, pitch, far) -> None:
    put(pilot, "t", yaw, pitch, far)
    pilot.block("b", f'<{element} id="g" target="t" start="0"/>')
    await pilot.advance(2.5)
    for frame in pilot.frames["alice"]:
        assert np.linalg.norm(frame.rotations, axis=1) == pytest.approx(1.0)
    assert pilot.feedback.reached("b:g:end")


# --- what stays


async def test_a_gaze_shift_stays_and_a_gaze_comes_back_to_it_by_a_saccade(pilot) -> None:
    rest, glance = put(pilot, "rest", 20, 0), put(pilot, "glance", -15, 10)
    pilot.block("b", '<gazeShift id="s" target="rest" start="0" end="0.6"/><gaze id="g" target="glance" start="2"/>')
    await pilot.advance(6)
    shown = pilot.bodies()
    relax = pilot.feedback.time("b:g:relax")
    assert miss(shown[at(pilot, 1.9)], rest) < 0.5
    assert miss(shown[at(pilot, relax - 0.1)], glance) < 0.5
    assert miss(shown[at(pilot, relax + 0.2)], rest) < 0.5
    assert miss(shown[-1], rest) < 0.5
    assert between(sight(shown[-1], "skullbase"), sight(shown[at(pilot, 1.9)], "skullbase")) < 1.5
    assert max(speeds(shown)) < PLATEAU + 0.2
    assert not pilot.feedback.warnings


async def test_a_glance_of_the_eyes_leaves_the_head_to_the_gaze_below(pilot) -> None:
    put(pilot, "rest", 25, 0)
    glance = put(pilot, "glance", 5, 0)
    gaze = '<gaze id="g" target="glance" influence="EYES" start="2" end="3"/>'
    pilot.block("b", f'<gazeShift id="s" target="rest" start="0" end="0.6"/>{gaze}')
    await pilot.advance(4)
    shown = pilot.bodies()
    assert miss(shown[at(pilot, 2.5)], glance) < 0.5
    noses = [sight(body, "skullbase") for body in shown[at(pilot, 1.5) :]]
    assert max(between(nose, noses[0]) for nose in noses) < 1.5


async def test_of_two_shifts_the_later_one_stays_and_a_block_that_replaces_all_ends_it(pilot) -> None:
    put(pilot, "one", 20, 0)
    two = put(pilot, "two", -20, 0)
    pilot.block("a", '<gazeShift id="s" target="one" start="0" end="0.5"/>')
    await pilot.advance(1)
    pilot.block("b", '<gazeShift id="s" target="two" start="0" end="0.5"/>')
    await pilot.advance(2)
    assert miss(pilot.bodies()[-1], two) < 0.5
    assert not pilot.feedback.warnings
    pilot.block("c", composition="REPLACE")
    await pilot.advance(2)
    assert between(sight(pilot.bodies()[-1]), FORWARD) < 2 + GLANCE
    assert max(speeds(pilot.bodies())) < PLATEAU + 0.2


async def test_a_shift_of_the_eyes_alone_leaves_the_head(pilot) -> None:
    target = put(pilot, "t", 20, 0)
    pilot.block("b", '<gazeShift id="s" target="t" influence="EYES" start="0"/>')
    await pilot.advance(2)
    assert miss(pilot.bodies()[-1], target) < 0.5
    assert between(sight(pilot.bodies()[-1], "skullbase"), FORWARD) < 2


async def test_the_direction_of_the_head_is_shifted_without_the_eyes(pilot) -> None:
    target = put(pilot, "t", 35, 10, FAR)
    pilot.block("b", '<headDirectionShift id="s" target="t" start="0" end="0.8"/>')
    await pilot.advance(3)
    body = pilot.bodies()[-1]
    toward = unit(subtract(target, place(pilot, 0, 0, 0.0)))
    assert between(sight(body, "skullbase"), toward) < 2
    assert math.degrees(angle(body.rotation(EYES[0]))) < GLANCE
    assert not pilot.feedback.warnings


async def test_a_gaze_looks_elsewhere_than_the_head_was_turned_and_gives_it_back(pilot) -> None:
    put(pilot, "side", 35, 0, FAR)
    front = put(pilot, "front", 0, 0)
    pilot.block("b", '<headDirectionShift id="s" target="side" start="0" end="0.8"/>')
    pilot.block("c", '<gaze id="g" target="front" influence="EYES" start="2" end="4"/>')
    await pilot.advance(3)
    assert miss(pilot.bodies()[-1], front) < 0.5
    assert between(sight(pilot.bodies()[-1], "skullbase"), FORWARD) > 30
    await pilot.advance(2)
    assert math.degrees(angle(pilot.bodies()[-1].rotation(EYES[0]))) < GLANCE


async def test_of_shifts_of_the_head_and_of_gaze_the_latest_has_the_head(pilot) -> None:
    for name, yaw in (("first", 30), ("second", 5), ("third", -25)):
        put(pilot, name, yaw, 0, FAR)
    shifts = (
        '<headDirectionShift id="a" target="first" start="0" end="0.6"/>'
        '<gazeShift id="b" target="second" start="1" end="1.6"/>'
        '<headDirectionShift id="c" target="third" start="2" end="2.6"/>'
    )
    pilot.block("b", shifts)
    await pilot.advance(4)
    shown = pilot.bodies()
    heads = [sight(shown[at(pilot, time)], "skullbase") for time in (0.95, 1.95, 3.9)]
    # The eyes do their part of the gaze shift.
    assert [math.degrees(math.atan2(x, z)) for x, _, z in heads] == pytest.approx([30, 4.5, -25], abs=3)
    assert between(sight(shown[-1]), unit(subtract(place(pilot, 5, 0, FAR), place(pilot, 0, 0, 0.0)))) < 0.5
    assert max(speeds(shown, "skullbase")) < 3


async def test_the_head_may_be_turned_while_the_eyes_look_at_something(pilot) -> None:
    front = put(pilot, "front", 5, 0)
    put(pilot, "side", -25, 0)
    shift = '<headDirectionShift id="s" target="side" start="1" end="2"/>'
    pilot.block("b", f'<gaze id="g" target="front" start="0" end="4"/>{shift}')
    await pilot.advance(1.9)
    shown = pilot.bodies()
    assert max(miss(body, front) for body in shown[at(pilot, 0.6) :]) < 0.5
    assert between(sight(shown[-1], "skullbase"), FORWARD) > 20
    assert not pilot.feedback.warnings


# --- the lids


def lids(pilot, *morphs: str) -> list[float]:
    """The weights of morphs in the last frame."""
    names = pilot.realizer.characters["alice"].humanoid.avatar.morphs
    return [float(pilot.frames["alice"][-1].weights[names.index(morph)]) for morph in morphs]


@pytest.mark.parametrize(
    ("pitch", "morph", "other"), [(25, "eyeLookUp", "eyeLookDown"), (-25, "eyeLookDown", "eyeLookUp")]
)
async def test_the_lids_go_with_the_eyes(pilot, pitch, morph, other) -> None:
    put(pilot, "t", 0, pitch)
    pilot.block("b", '<gaze id="g" target="t" influence="EYES" start="0" end="4"/>')
    await pilot.advance(1)
    both = [f"{morph}Left", f"{morph}Right"]
    assert lids(pilot, *both) == pytest.approx([0.6, 0.6], abs=0.05)
    assert lids(pilot, f"{other}Left", f"{other}Right") == [0, 0]
