"""Key poses: what the joints do in the frames, when the points come, and what is said of what cannot be."""

import math

import numpy as np
import pytest

from reactive_realizer.bml.names import BML
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import angle, difference, rotate
from reactive_realizer.embodiment.vector import Vec3, add, distance, dot, subtract, unit
from reactive_realizer.engines.animation.key_poses.elbow import flexion
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

FRAMES = 50
"""Frames per second."""


def document(inside: str, id_: str = "b") -> str:
    spaces = f'xmlns="{BML}" xmlns:rr="urn:reactive-realizer:1" xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt"'
    return f'<bml {spaces} id="{id_}">{inside}</bml>'


def poses(id_: str, group: str, *inside: str, more: str = "") -> str:
    return f'<rr:keyPoses id="{id_}" group="{group}" {more}>{"".join(inside)}</rr:keyPoses>'


def pose(time: float, goals: str, hold: float = 0.0, id_: str = "") -> str:
    name = f'id="{id_}"' if id_ else ""
    return f'<rr:keyPose {name} time="{time}" hold="{hold}">{goals}</rr:keyPose>'


def from_pelvis(body: Body, joint: str) -> Vec3:
    return subtract(body.transform(joint).position, body.transform("HumanoidRoot").position)


def at(pilot: RealizerPilot, seconds: float) -> Body:
    return pilot.bodies()[round(seconds * FRAMES)]


HERE = (-0.16, 0.13, 0.25)
THERE = (-0.25, 0.3, 0.25)
"""m; so far from the body that the forearm need not keep clear of the waist."""


def place(target: Vec3, more: str = "") -> str:
    return f'<rr:position target="{target[0]} {target[1]} {target[2]}" {more}/>'


async def test_a_hand_is_at_its_places_at_their_times_and_stays_for_their_holds() -> None:
    arm = poses("k", "RIGHT_ARM", pose(0.6, place(HERE), 0.4, "here"), pose(1.6, place(THERE), 0.3, "there"))
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(arm.replace("group", 'start="0.4" group', 1)))
        await pilot.advance(4)
        points = {sync: pilot.feedback.time(f"b:k:{sync}") for sync in ("start", "here", "there", "relax", "end")}
        assert points == pytest.approx({"start": 0.4, "here": 1.0, "there": 2.0, "relax": 2.3, "end": 2.3})
        for time in (1.02, 1.2, 1.38):
            assert distance(from_pelvis(at(pilot, time), "r_wrist"), HERE) < 0.001
        for time in (2.02, 2.28):
            assert distance(from_pelvis(at(pilot, time), "r_wrist"), THERE) < 0.001
        assert distance(from_pelvis(at(pilot, 1.7), "r_wrist"), HERE) > 0.05
        rest = from_pelvis(at(pilot, 0.0), "r_wrist")
        assert distance(from_pelvis(at(pilot, 3.9), "r_wrist"), rest) < 0.02
        assert pilot.feedback.warnings == []


async def test_a_pose_that_moves_takes_its_hand_with_it() -> None:
    arm = poses("k", "RIGHT_ARM", pose(0.6, place(HERE)), pose(1.2, place(THERE), id_="there"), pose(1.8, place(HERE)))
    tied = arm.replace("group", 'there="anticipators:music:beat" group', 1)
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.predict("music", "beat", 1.5)
        pilot.perform(document(tied))
        await pilot.advance(0.8)
        pilot.predict("music", "beat", 2.2)
        await pilot.advance(2)
        assert pilot.feedback.time("b:k:there") == pytest.approx(2.2)
        assert distance(from_pelvis(at(pilot, 2.2), "r_wrist"), THERE) < 0.01


@pytest.mark.parametrize(
    ("goal", "joint", "offset"),
    [('joint="r_index3"', "r_index3", (0.0, 0.0, 0.0)), ('offset="0 -0.1 0"', "r_wrist", (0.0, -0.1, 0.0))],
)
async def test_any_point_of_a_hand_can_be_brought_to_a_place(goal: str, joint: str, offset: Vec3) -> None:
    palm = '<rr:orientation axis="PALM" direction="1 0 0"/>'
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(poses("k", "RIGHT_ARM", pose(0.8, place(HERE, goal) + palm, 0.4))))
        await pilot.advance(1.2)
        body = at(pilot, 1.0)
        point = add(from_pelvis(body, joint), rotate(body.transform(joint).rotation, offset))
        assert distance(point, HERE) < 0.005


async def test_palms_and_fingers_point_where_they_should_while_the_hand_stays() -> None:
    up = '<rr:orientation axis="PALM" direction="0 1 0"/><rr:orientation axis="FINGERS" direction="-1 0 2"/>'
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(poses("k", "RIGHT_ARM", pose(0.8, place(HERE) + up, 0.4))))
        await pilot.advance(1.2)
        body = at(pilot, 1.0)
        hand = body.transform("r_wrist").rotation
        along = unit(rotate(hand, body.skeleton.offset("r_middle1")))
        across = rotate(hand, subtract(body.skeleton.offset("r_index1"), body.skeleton.offset("r_pinky1")))
        assert abs(dot(along, (0.0, 1.0, 0.0))) < 0.1
        assert abs(dot(unit(across), (0.0, 1.0, 0.0))) < 0.1
        assert dot(along, unit((-1.0, 0.0, 2.0))) > 0.9
        assert distance(from_pelvis(body, "r_wrist"), HERE) < 0.001


async def test_a_swivel_turns_the_elbow_out_and_leaves_the_hand() -> None:
    for group, side, outward in (("RIGHT_ARM", "r", -1.0), ("LEFT_ARM", "l", 1.0)):
        target = (outward * abs(HERE[0]), HERE[1], HERE[2])
        two = (pose(0.8, place(target), 0.2), pose(1.6, place(target) + '<rr:swivel angle="50"/>', 0.4))
        async with open_pilot() as pilot:
            pilot.watch()
            pilot.perform(document(poses("k", group, *two)))
            await pilot.advance(2)
            before, after = at(pilot, 0.9), at(pilot, 1.8)
            assert distance(from_pelvis(after, f"{side}_wrist"), target) < 0.001
            elbows = [from_pelvis(each, f"{side}_elbow")[0] for each in (before, after)]
            assert outward * (elbows[1] - elbows[0]) > 0.05


async def test_the_head_looks_at_a_place_and_tilts() -> None:
    look = poses("k", "HEAD_NECK", pose(0.6, '<rr:lookAt target="-7.5 8 10"/>', 0.4))
    tilt = poses("t", "HEAD", pose(0.6, '<rr:orientation axis="CROWN" direction="-0.3 1 0"/>', 0.4), more='start="2"')
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(look + tilt))
        await pilot.advance(3)
        face = rotate(at(pilot, 0.9).transform("skullbase").rotation, (0.0, 0.0, 1.0))
        assert dot(face, unit((-7.5, 7.4, 10.0))) > 0.98
        crown = rotate(at(pilot, 2.9).transform("skullbase").rotation, (0.0, 1.0, 0.0))
        assert crown == pytest.approx(unit((-0.3, 1.0, 0.0)), abs=0.05)


def orientation(axis: str, direction: Vec3, more: str = "") -> str:
    return f'<rr:orientation axis="{axis}" direction="{direction[0]} {direction[1]} {direction[2]}" {more}/>'


def axis_of(body: Body, joint: str, axis: Vec3) -> Vec3:
    return rotate(body.transform(joint).rotation, axis)


def collarbone(body: Body, side: str) -> Vec3:
    return unit(axis_of(body, f"{side}_sternoclavicular", body.skeleton.offset(f"{side}_shoulder")))


async def test_the_chest_turns_and_the_trunk_bows_as_far_as_asked_for() -> None:
    turned, bowed = unit((0.5, 0.0, 1.0)), unit((0.0, 1.0, 0.7))
    both = orientation("SPINE", bowed) + orientation("CHEST", (0.3, -0.7, 1.0))
    two = (pose(0.8, orientation("CHEST", turned), 0.4), pose(2, both, 0.4))
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(poses("k", "TRUNK", *two)))
        await pilot.advance(3.5)
        assert dot(axis_of(at(pilot, 1.0), "vt6", (0.0, 0.0, 1.0)), turned) > 0.998
        assert dot(axis_of(at(pilot, 2.2), "vt6", (0.0, 1.0, 0.0)), bowed) > 0.998
        chest = axis_of(at(pilot, 2.2), "vt6", (0.0, 0.0, 1.0))
        assert math.atan2(chest[0], chest[2]) == pytest.approx(math.atan2(0.3, 1.0), abs=0.05)
        lower, upper = (
            angle(difference(at(pilot, 0.0).rotation(joint), at(pilot, 2.2).rotation(joint)))
            for joint in ("vl5", "vt6")
        )
        assert lower > upper > 0.1
        assert distance(from_pelvis(at(pilot, 3.4), "vt6"), from_pelvis(at(pilot, 0.0), "vt6")) < 0.01
        assert pilot.feedback.warnings == []


async def test_a_direction_of_a_lower_joint_of_the_spine_leaves_those_above_it_alone() -> None:
    lower = pose(0.8, orientation("SPINE", (0.0, 1.0, 0.3), 'joint="vl5"'), 0.4)
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(poses("k", "TRUNK", lower)))
        await pilot.advance(1.2)
        body = at(pilot, 1.0)
        assert dot(axis_of(body, "vl5", (0.0, 1.0, 0.0)), unit((0.0, 1.0, 0.3))) > 0.998
        assert angle(difference(at(pilot, 0.0).rotation("vt10"), body.rotation("vt10"))) < 0.01


@pytest.mark.parametrize(("way", "most"), [((0, -0.2, 1), 80), ((0, 0, -1), 20), ((1, 0, 0), 30)])
async def test_a_trunk_bends_no_further_than_a_spine_does(way: Vec3, most: float) -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(poses("k", "TRUNK", pose(1, orientation("SPINE", way), 0.4))))
        await pilot.advance(1.4)
        bend = math.degrees(math.acos(axis_of(at(pilot, 1.2), "vt6", (0.0, 1.0, 0.0))[1]))
        assert bend == pytest.approx(most, abs=4)


async def test_shoulders_go_up_together_or_one_alone() -> None:
    up = orientation("SHOULDER", (1.0, 0.0, 0.0))
    down = orientation("SHOULDER", (-1.0, -0.8, 0.0), 'joint="r_sternoclavicular"')
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(poses("k", "SHOULDERS", pose(0.6, up, 0.3), pose(1.5, down, 0.3))))
        await pilot.advance(2)
        before, raised, one = (at(pilot, time) for time in (0.0, 0.8, 1.7))
        assert dot(collarbone(raised, "l"), (1.0, 0.0, 0.0)) > 0.995
        assert dot(collarbone(raised, "r"), (-1.0, 0.0, 0.0)) > 0.995
        wrists = [from_pelvis(body, "l_wrist")[1] for body in (before, raised)]
        assert wrists[1] - wrists[0] > 0.02
        assert collarbone(one, "r")[1] < collarbone(before, "r")[1] - 0.05
        assert collarbone(one, "l")[1] == pytest.approx(collarbone(before, "l")[1], abs=0.05)


async def test_a_collarbone_turns_no_further_than_it_can() -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(poses("k", "SHOULDERS", pose(0.6, orientation("SHOULDER", (0.0, 1.0, 0.0)), 0.3))))
        await pilot.advance(1)
        for side in "lr":
            way = math.acos(dot(collarbone(at(pilot, 0.0), side), collarbone(at(pilot, 0.8), side)))
            assert way == pytest.approx(math.radians(30), abs=0.05)


def sight(body: Body, eye: str = "l") -> Vec3:
    return axis_of(body, f"{eye}_eyeball_joint", (0.0, 0.0, 1.0))


async def test_eyes_are_at_their_places_at_their_times_and_get_there_by_saccades() -> None:
    place_, way = (-0.3, 0.4, 0.9), unit((0.0, 0.3, 1.0))
    two = (pose(0.6, '<rr:lookAt target="-0.3 0.4 0.9"/>', 0.4, "low"), pose(1.5, orientation("SIGHT", way), 0.3))
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(poses("k", "EYES", *two)))
        await pilot.advance(3)
        assert pilot.feedback.time("b:k:low") == pytest.approx(0.6)
        assert pilot.feedback.time("b:k:end") == pytest.approx(1.8)
        for time in (0.64, 0.98, 1.3):
            body = at(pilot, time)
            toward = subtract(place_, from_pelvis(body, "l_eyeball_joint"))
            assert dot(sight(body), unit(toward)) > 0.9995
        for time in (1.54, 1.78):
            assert dot(sight(at(pilot, time)), way) > 0.999
        turns = [dot(sight(at(pilot, time)), sight(at(pilot, time + 0.02))) for time in np.arange(0, 2.5, 0.02)]
        assert sum(each < 0.99999 for each in turns) < 25
        assert angle(difference(at(pilot, 0.0).rotation("skullbase"), at(pilot, 1.0).rotation("skullbase"))) < 0.05
        assert dot(sight(at(pilot, 2.9)), sight(at(pilot, 0.0))) > 0.99
        assert pilot.feedback.warnings == []


async def test_one_eye_moves_alone() -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(poses("k", "RIGHT_EYE", pose(0.5, orientation("SIGHT", (0.4, 0.0, 1.0)), 0.5))))
        await pilot.advance(1)
        assert dot(sight(at(pilot, 0.8), "r"), unit((0.4, 0.0, 1.0))) > 0.999
        assert dot(sight(at(pilot, 0.8), "l"), sight(at(pilot, 0.0), "l")) > 0.99


async def test_eyes_keep_to_their_place_above_an_earlier_gaze_and_below_a_later_one() -> None:
    eyes = poses("k", "EYES", pose(0.5, orientation("SIGHT", (0.3, 0.0, 1.0)), 3), more='start="1"')
    early = '<gaze id="e" target="viewer" start="0" end="2.4"/>'
    late = '<gaze id="l" target="viewer" influence="EYES" start="2.5" end="6"/>'
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(early + eyes + late))
        await pilot.advance(5)
        assert dot(sight(at(pilot, 0.9)), unit((0.3, 0.0, 1.0))) < 0.98
        assert dot(sight(at(pilot, 2.0)), unit((0.3, 0.0, 1.0))) > 0.999
        assert dot(sight(at(pilot, 3.2)), unit((0.3, 0.0, 1.0))) < 0.98


async def test_a_place_that_eyes_cannot_see_is_named() -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(poses("k", "EYES", pose(0.5, '<rr:lookAt target="2 0.6 0.1"/>', 0.5))))
        await pilot.advance(1)
        (warning,) = pilot.feedback.of("warningFeedback")
        assert warning.id == "b:k"
        assert "degrees short of its target" in warning.text


@pytest.mark.parametrize(
    ("group", "goal", "why"),
    [
        ("EYES", '<rr:pose name="hands_fist"/>', "EYES have no pose; possible are lookAt, orientation"),
        ("EYES", orientation("FACE", (0, 0, 1)), "EYES have no orientation of FACE; possible are SIGHT"),
        ("TRUNK", '<rr:lookAt target="0 0 1"/>', "TRUNK have no lookAt"),
        ("TRUNK", orientation("CHEST", (0, 0, 1), 'joint="l_knee"'), "no orientation of l_knee; possible are vl5"),
        ("SHOULDERS", orientation("CHEST", (0, 0, 1)), "no orientation of CHEST; possible are SHOULDER"),
        ("RIGHT_ARM", orientation("PALM", (0, 0, 1), 'joint="r_elbow"'), "of r_elbow; possible are r_wrist"),
        ("HEAD", orientation("FACE", (0, 0, 1), 'joint="vc4"'), "orientation of vc4; possible are skullbase"),
    ],
)
async def test_what_a_part_of_the_body_cannot_have_is_named(group: str, goal: str, why: str) -> None:
    async with open_pilot() as pilot:
        pilot.perform(document(poses("k", group, pose(0.5, goal))))
        await pilot.advance(0.1)
        assert why in pilot.feedback.of("warningFeedback")[0].text


async def test_hands_take_the_shapes_of_stored_poses_by_their_influence() -> None:
    fist = pose(0.5, '<rr:pose name="hands_fist"/>', 0.4)
    half = pose(0.5, '<rr:pose name="hands_fist" influence="0.5"/>', 0.4)
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(poses("r", "RIGHT_HAND", fist) + poses("l", "LEFT_HAND", half)))
        await pilot.advance(1)
        rest, closed = at(pilot, 0.0), at(pilot, 0.8)
        whole, part = (angle(difference(rest.rotation(name), closed.rotation(name))) for name in ("r_ring2", "l_ring2"))
        assert whole > 1.0
        assert part == pytest.approx(0.5 * whole, rel=0.1)


async def test_key_poses_lie_above_what_plays_on_their_limbs_and_leave_the_rest_alone() -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.block("g", '<gesture id="both" lexeme="OFFER" mode="BOTH_HANDS" end="5"/>')
        await pilot.advance(2)
        pilot.perform(document(poses("k", "RIGHT_ARM", pose(0.5, place(HERE), 1.0)), "now"))
        await pilot.advance(1)
        assert pilot.feedback.warnings == []
        assert distance(from_pelvis(at(pilot, 2.8), "r_wrist"), HERE) < 0.001
        left = [from_pelvis(at(pilot, time), "l_wrist") for time in (1.9, 2.8)]
        assert distance(*left) < 0.02
        await pilot.advance(3)
        assert pilot.feedback.status("g") == "DONE"


async def test_fades_bring_a_motion_in_and_out_by_its_weight() -> None:
    arm = poses("k", "RIGHT_ARM", pose(0.1, place(HERE), 2.0), more='fadeIn="1" fadeOut="1"')
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(arm))
        await pilot.advance(4)
        gaps = [distance(from_pelvis(at(pilot, time), "r_wrist"), HERE) for time in (0.5, 1.1, 2.0, 2.6, 3.4)]
        assert gaps[0] > 0.05
        assert max(gaps[1:3]) < 0.005
        assert gaps[3] > 0.05
        assert pilot.feedback.time("b:k:relax") == pytest.approx(2.1)
        assert pilot.feedback.time("b:k:end") == pytest.approx(3.1)


async def test_a_time_warp_changes_the_course_of_a_hand_and_not_its_times() -> None:
    halfway = {}
    for warp in ("", 'warp="EXP" steepness="3"', 'warp="EXP" steepness="0.4"'):
        two = (pose(0.6, place(HERE), 0.4), pose(2.0, place(THERE), 0.2, "there"))
        async with open_pilot() as pilot:
            pilot.watch()
            pilot.perform(document(poses("k", "RIGHT_ARM", *two, more=warp)))
            await pilot.advance(2.3)
            halfway[warp] = distance(from_pelvis(at(pilot, 1.5), "r_wrist"), HERE) / math.dist(HERE, THERE)
            assert distance(from_pelvis(at(pilot, 2.1), "r_wrist"), THERE) < 0.002
            assert pilot.feedback.time("b:k:there") == pytest.approx(2.0)
    natural, soon, late = halfway.values()
    assert natural == pytest.approx(0.5, abs=0.1)
    assert soon > 0.75
    assert late < 0.35


def around(center: Vec3, radius: float, curve: str) -> list[str]:
    """Eight key poses on a circle, a quarter of a second apart, and the first one again."""
    x, y, z = center
    turns = [math.pi * number / 4 for number in range(9)]
    places = [(x + radius * math.cos(turn), y + radius * math.sin(turn), z) for turn in turns]
    return [
        pose(0.6 + 0.25 * number, place(each)).replace("time", f"{curve} time") for number, each in enumerate(places)
    ]


async def test_a_hand_passes_key_poses_on_a_curve_without_stopping_and_a_tension_of_1_stops_it() -> None:
    slowest, bumpiest = [], []
    for curve in ('tension="0"', 'tension="1"'):
        async with open_pilot() as pilot:
            pilot.watch()
            pilot.perform(document(poses("k", "RIGHT_ARM", *around((-0.15, 0.25, 0.3), 0.12, curve))))
            await pilot.advance(2.7)
            assert pilot.feedback.warnings == []
            way = np.array([from_pelvis(body, "r_wrist") for body in pilot.bodies()])
        for number, turn in enumerate(np.arange(8) * math.pi / 4):
            there = (-0.15 + 0.12 * math.cos(turn), 0.25 + 0.12 * math.sin(turn), 0.3)
            frames = way[round((0.6 + 0.25 * number) * FRAMES) - 1 :][:3]
            assert min(np.linalg.norm(frames - there, axis=1)) < 0.006
        inner = way[round(0.85 * FRAMES) : round(2.35 * FRAMES)]
        slowest.append(FRAMES * np.linalg.norm(np.diff(inner, axis=0), axis=1).min())
        off = np.hypot(inner[:, 0] + 0.15, inner[:, 1] - 0.25) - 0.12
        bumpiest.append(np.abs(off).max())
    assert slowest[0] > 0.3
    assert slowest[1] < 0.1
    assert bumpiest[0] < 0.5 * bumpiest[1]


@pytest.mark.parametrize("seed", range(6))
async def test_elbows_do_not_bend_backward_on_a_curve(seed: int) -> None:
    random = np.random.default_rng(seed)
    lows, highs = (-0.45, -0.2, 0.1), (0.1, 0.75, 0.6)
    poses_ = [pose(0.7 + 0.5 * number, place(tuple(random.uniform(lows, highs)))) for number in range(5)]
    wide = 'tension="-1" bias="{}"'
    curved = [each.replace("time", f"{wide.format(random.choice((-1, 0, 1)))} time") for each in poses_]
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(poses("k", "RIGHT_ARM", *curved)))
        await pilot.advance(3)
        bends = [flexion("r", body.rotation("r_elbow"), body.skeleton) for body in pilot.bodies()]
        assert min(bends) > -math.radians(1.0)


async def test_with_bias_a_hand_passes_its_place_before_it_turns_back() -> None:
    furthest = {}
    for curve in ('bias="1"', 'bias="0"'):
        there = pose(1.2, place(THERE)).replace("time", f"{curve} time")
        async with open_pilot() as pilot:
            pilot.watch()
            pilot.perform(document(poses("k", "RIGHT_ARM", pose(0.6, place(HERE)), there, pose(1.8, place(HERE)))))
            await pilot.advance(2)
            way = np.array([from_pelvis(at(pilot, time), "r_wrist") for time in np.arange(0.6, 1.81, 1 / FRAMES)])
        chord = np.subtract(THERE, HERE)
        furthest[curve] = ((way - HERE) @ chord / (chord @ chord)).max()
        assert distance(tuple(way[round(0.6 * FRAMES)]), THERE) < 0.005
    assert furthest['bias="0"'] == pytest.approx(1.0, abs=0.01)
    assert furthest['bias="1"'] > 1.03


async def test_power_straightens_the_way_of_a_hand_and_has_it_pass_its_place_before_it_is_there() -> None:
    curves, furthest = [], []
    for power in (-1, 0, 1):
        there = pose(1.4, place(HERE), 0.3, "there").replace("time", f'power="{power}" time')
        async with open_pilot() as pilot:
            pilot.watch()
            pilot.perform(document(poses("k", "RIGHT_ARM", pose(0.8, place(THERE)), there)))
            await pilot.advance(2)
            assert pilot.feedback.warnings == []
            way = np.array([from_pelvis(at(pilot, time), "r_wrist") for time in np.arange(0.8, 1.71, 1 / FRAMES)])
        chord = np.subtract(HERE, THERE)
        shares = (way - THERE) @ chord / (chord @ chord)
        curves.append(np.linalg.norm(way - THERE - np.outer(shares, chord), axis=1).max())
        furthest.append(shares.max())
        assert shares[-3:] == pytest.approx(1.0, abs=0.01)
    assert curves[2] < curves[1] < curves[0]
    assert furthest[2] > max(furthest[:2]) + 0.01


async def test_goals_that_cannot_be_met_are_named_with_their_lines_and_the_others_are_met() -> None:
    inside = f"""
        <rr:keyPoses id="k" group="RIGHT_ARM"><rr:keyPose time="0.6" hold="0.4">
        {place(HERE)}
        <rr:lookAt target="0 0 1"/>
        <rr:pose name="hands_hoof"/>
        <rr:position target="0 0 0" joint="l_wrist"/>
        <rr:orientation axis="CROWN" direction="0 1 0"/>
        <rr:orientation axis="PALM" direction="0 0 0"/>
        </rr:keyPose></rr:keyPoses>
        <rr:keyPoses id="bad" group="TRUNK"><rr:keyPose time="1"><rr:swivel angle="3"/></rr:keyPose></rr:keyPoses>"""
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(inside))
        await pilot.advance(2)
        told = [(message.id, message.text) for message in pilot.feedback.of("warningFeedback")]
        assert [text.partition(" column")[0] for id_, text in told if id_ == "b:k"] == [
            f"line {line}," for line in (4, 5, 6, 7, 8)
        ]
        assert any(id_ == "b:bad" and "TRUNK have no swivel" in text for id_, text in told)
        assert distance(from_pelvis(at(pilot, 0.8), "r_wrist"), HERE) < 0.001


@pytest.mark.parametrize(
    ("group", "goals", "line", "why"),
    [
        ("RIGHT_ARM", (place(THERE), place(HERE)), 1, "position has no effect: a later one of this key pose counts"),
        ("RIGHT_ARM", ('<rr:swivel angle="9"/>', place(HERE), '<rr:swivel angle="0"/>'), 1, "swivel has no effect"),
        (
            "RIGHT_ARM",
            (place(HERE), *(orientation(axis, (0, 0, 1)) for axis in ("PALM", "FINGERS", "THUMB"))),
            4,
            "orientation has no effect: two others of this key pose come before it",
        ),
        (
            "HEAD",
            (orientation("FACE", (1, 0, 1)), '<rr:lookAt target="0 0.6 1"/>'),
            1,
            "orientation has no effect: the face looks at a place",
        ),
        ("EYES", ('<rr:lookAt target="0 0.6 1"/>', orientation("SIGHT", (0, 0, 1))), 1, "lookAt has no effect"),
        ("SHOULDERS", (orientation("SHOULDER", (1, 0, 0)), orientation("SHOULDER", (1, 0, 0.1))), 1, "no effect"),
    ],
)
async def test_goals_without_effect_beside_others_are_named(
    group: str, goals: tuple[str, ...], line: int, why: str
) -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(poses("k", group, pose(0.6, "\n".join(goals), 0.4))))
        await pilot.advance(1)
        (warning,) = pilot.feedback.of("warningFeedback")
        assert f"line {line}," in warning.text
        assert why in warning.text
        if group == "RIGHT_ARM":
            assert distance(from_pelvis(at(pilot, 0.8), "r_wrist"), HERE) < 0.001


async def test_a_hand_that_cannot_reach_its_place_goes_as_near_as_it_can_and_says_so() -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(poses("k", "RIGHT_ARM", pose(1, place((-0.3, -0.4, 0.9)), 0.4))))
        await pilot.advance(1.5)
        (warning,) = pilot.feedback.of("warningFeedback")
        assert warning.id == "b:k"
        assert "r_wrist cannot reach its goal" in warning.text
        arm = [at(pilot, 1.2).transform(joint).position for joint in ("r_shoulder", "r_wrist")]
        assert distance(*arm) > 0.4


@pytest.mark.parametrize(
    ("group", "goals", "joint", "direction", "axis"),
    [
        ("RIGHT_ARM", place(HERE) + '<rr:orientation axis="FINGERS" direction="0 0 -1"/>', "r_wrist", (0, 0, -1), None),
        ("HEAD", '<rr:orientation axis="FACE" direction="0 0 -1"/>', "skullbase", (0, 0, -1), (0, 0, 1)),
        ("HEAD", '<rr:orientation axis="CROWN" direction="1 0 0"/>', "skullbase", (1, 0, 0), (0, 1, 0)),
        ("HEAD_NECK", '<rr:lookAt target="0 0.6 -2"/>', "skullbase", (0, 0, -1), (0, 0, 1)),
        ("TRUNK", '<rr:orientation axis="CHEST" direction="0 0 -1"/>', "vt6", (0, 0, -1), (0, 0, 1)),
        ("SHOULDERS", '<rr:orientation axis="SHOULDER" direction="0 1 0"/>', "l_sternoclavicular", (0, 1, 0), None),
    ],
)
async def test_a_joint_that_cannot_turn_to_its_direction_says_once_how_much_is_missing(
    group: str, goals: str, joint: str, direction: Vec3, axis: Vec3 | None
) -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(poses("k", group, pose(1, goals, 0.4))))
        await pilot.advance(0.9)
        assert pilot.feedback.warnings == []
        await pilot.advance(1)
        (warning,) = pilot.feedback.of("warningFeedback")
        assert warning.id == "b:k"
        assert f"{joint} cannot turn to its direction in k at phase" in warning.text
        if axis is not None:
            told = float(warning.text.rpartition("it is ")[2].split()[0])
            shown = rotate(at(pilot, 1.2).transform(joint).rotation, axis)
            assert math.degrees(math.acos(dot(shown, direction))) == pytest.approx(told, abs=6.0)


async def test_directions_that_joints_have_are_not_told() -> None:
    hand = place(HERE) + '<rr:orientation axis="PALM" direction="0 -1 0"/>'
    face = '<rr:orientation axis="FACE" direction="0.4 0 1"/>'
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(
            document(poses("k", "RIGHT_ARM", pose(1, hand, 0.4)) + poses("f", "HEAD_NECK", pose(1, face, 0.4)))
        )
        await pilot.advance(2)
        assert pilot.feedback.warnings == []
