"""Locomotion, in frames and feedback: where figures go, and how."""

import math

import numpy as np
import pytest

from reactive_realizer.embodiment.vector import subtract
from reactive_realizer.testing.motion_laws import foot_slide, worst_motion
from reactive_realizer.testing.pilot import RealizerPilot

from .tracks import deepest, flights, heading, knees, pelvis, place, speeds


def go(target: str = "door", *, manner: str = "WALK", syncs: str = "", **parameters: object) -> str:
    inside = "".join(f'<bmlt:parameter name="{name}" value="{value}"/>' for name, value in parameters.items())
    return f'<locomotion id="w" target="{target}" manner="{manner}" {syncs}>{inside}</locomotion>'


WAYS = {
    "ahead": go(),
    "to the side": go("3 1"),
    "behind": go("-1 -2"),
    "a step": go("0 0.3"),
    "a step aside": go("0.4 0"),
    "a turn": go("0 0", facing=150),
    "in a hurry": go(syncs='end="2.8"'),
    "slowly": go("0 1", speed=0.3),
    "running": go("0 7", manner="RUN"),
    "to the left": go("1.2 0", manner="STRAFE"),
    "backward": go("0 -1", manner="STRAFE"),
}


# --- where


async def test_a_figure_walks_to_half_a_meter_from_a_target_and_faces_it(either: RealizerPilot) -> None:
    either.block("b", go("2 0 3", distance=0.5))
    await either.advance(6)
    last = either.bodies("alice")[-1]
    x, z = place(last)
    assert math.hypot(2.0 - x, 3.0 - z) == pytest.approx(0.5, abs=0.03)
    assert heading(last) == pytest.approx(math.degrees(math.atan2(2.0, 3.0)), abs=2.0)


@pytest.mark.parametrize(
    ("way", "there", "faces"),
    [
        (go(), (0.0, 3.5), 0.0),
        (go("1 2"), (1.0, 2.0), 26.6),
        (go("1 7 2"), (1.0, 2.0), 26.6),
        (go(distance=2), (0.0, 2.0), 0.0),
        (go("1 2", facing=-90), (1.0, 2.0), -90.0),
        (go("", direction=90, way=1.5), (1.5, 0.0), 90.0),
        (go("1 0", manner="STRAFE"), (1.0, 0.0), 0.0),
        (go("0 0", facing=180), (0.0, 0.0), 180.0),
    ],
)
async def test_a_figure_arrives_where_its_target_and_its_parameters_say(
    pilot: RealizerPilot, way: str, there: tuple[float, float], faces: float
) -> None:
    await arrives(pilot, way, there, faces)


@pytest.mark.parametrize(
    ("way", "there", "faces"), [(go("bob"), (3.0, 0.1), 88.6), (go(facing="bob"), (0.0, 3.5), 131.2)]
)
async def test_a_figure_goes_to_another_one_or_faces_it_in_the_end(
    pair: RealizerPilot, way: str, there: tuple[float, float], faces: float
) -> None:
    await arrives(pair, way, there, faces)


async def arrives(pilot: RealizerPilot, way: str, there: tuple[float, float], faces: float) -> None:
    pilot.block("b", way)
    await pilot.advance(7)
    last = pilot.bodies("alice")[-1]
    assert place(last) == pytest.approx(there, abs=0.04)
    assert abs(math.remainder(heading(last) - faces, 360.0)) < 2.0
    assert pilot.feedback.warnings == []


async def test_a_figure_stays_where_it_has_gone(pilot: RealizerPilot) -> None:
    pilot.block("a", go("1.5 2"))
    pilot.block("b", '<gaze id="g" target="door"/><gesture id="h" lexeme="BEAT"/>', composition="APPEND")
    await pilot.advance(7)
    pilot.block("c", composition="REPLACE")
    await pilot.advance(1)
    assert place(pilot.bodies("alice")[-1]) == pytest.approx((1.5, 2.0), abs=0.04)
    eyes = pilot.realizer.world.position("alice")
    assert eyes is not None
    assert (eyes[0], eyes[2]) == pytest.approx((1.5, 2.0), abs=0.15)


async def test_ways_of_one_block_begin_where_those_before_end_and_are_planned_so(pilot: RealizerPilot) -> None:
    pilot.block("b", '<locomotion id="to" target="0 2"/><locomotion id="back" target="0 0" start="to:end"/>')
    await pilot.advance(9)
    told = pilot.feedback
    assert told.warnings == []
    assert told.time("b:back:end") - told.time("b:back:start") > 2.0
    assert np.hypot(*np.array(pilot.bodies()[-1].root)[[0, 2]]) < 0.1


async def test_a_second_way_begins_where_the_first_one_ends_and_is_planned_so(pilot: RealizerPilot) -> None:
    pilot.block("a", go("0 2"))
    pilot.block("b", go("0 3"), composition="APPEND")
    await pilot.advance(0.1)
    assert pilot.feedback.predicted("b:w:end") - pilot.feedback.predicted("b:w:start") < 2.0
    await pilot.advance(6)
    assert place(pilot.bodies("alice")[-1]) == pytest.approx((0.0, 3.0), abs=0.04)


# --- how


@pytest.mark.parametrize("way", WAYS)
async def test_feet_that_stand_do_not_slide_or_sink_into_the_ground_and_the_pelvis_neither_jerks_nor_drops(
    pilot: RealizerPilot, way: str
) -> None:
    pilot.block("b", WAYS[way])
    await pilot.advance(6)
    shown = pilot.bodies("alice")
    assert foot_slide(shown) < 0.01
    assert deepest(shown) < 0.002
    track = pelvis(shown)
    change = np.diff(track, n=2, axis=0) / 0.02**2
    hurries = way in ("running", "in a hurry")
    assert np.linalg.norm(change[:, [0, 2]], axis=1).max() < (16.0 if hurries else 8.0)
    assert abs(change[:, 1]).max() < 32.0
    assert np.ptp(track[:, 1]) < (0.13 if hurries else 0.1)


async def test_speed_eases_in_and_out_around_a_steady_walk(pilot: RealizerPilot) -> None:
    pilot.block("b", go("0 5"))
    await pilot.advance(7)
    fast = speeds(pilot.bodies("alice"))
    start, end = (round(50 * pilot.feedback.time(f"b:w:{point}")) for point in ("start", "end"))
    steady = fast[start + 60 : end - 70]
    assert steady.min() > 1.1
    assert steady.max() < 1.35
    assert fast[start : start + 5].max() < 0.2
    assert fast[end - 3 :].max() < 0.3


async def test_one_foot_is_always_on_the_ground_in_walking_and_both_leave_it_in_running(pilot: RealizerPilot) -> None:
    pilot.block("a", go("0 4"))
    await pilot.advance(6)
    assert flights(pilot.bodies("alice")) == 0
    pilot.block("b", go("0 -6", manner="RUN"))
    await pilot.advance(6)
    assert flights(pilot.bodies("alice")) > 10


@pytest.mark.parametrize(
    ("manner", "speed", "steps"), [("WALK", 1.2, 1.9), ("WALK", 1.8, 2.4), ("RUN", 2.8, 2.75), ("RUN", 4.0, 2.9)]
)
async def test_a_figure_makes_as_many_steps_a_second_as_people(
    either: RealizerPilot, manner: str, speed: float, steps: float
) -> None:
    """Running: P. R. Cavanagh and R. Kram (Medicine and Science in Sports and Exercise 21, 1989)."""
    either.block("b", go("0 14", manner=manner, speed=speed))
    await either.advance(5)
    bodies = either.bodies("alice")[100:200]
    ahead = [subtract(*(body.transform(f"{side}_ankle").position for side in "lr"))[2] for body in bodies]
    crossings = np.flatnonzero(np.diff(np.sign(ahead)))
    assert 50.0 / np.diff(crossings).mean() == pytest.approx(steps, rel=0.1)


@pytest.mark.parametrize(("manner", "lowest_together"), [("WALK", False), ("RUN", True)])
async def test_the_pelvis_is_lowest_with_the_feet_apart_in_walking_and_over_a_foot_in_running(
    pilot: RealizerPilot, manner: str, lowest_together: bool
) -> None:
    pilot.block("b", go("0 8", manner=manner))
    await pilot.advance(9)
    shown = pilot.bodies("alice")
    start, end = (round(50 * pilot.feedback.time(f"b:w:{point}")) for point in ("start", "end"))
    steady = shown[start + 60 : end - 70]
    apart = [abs(subtract(*(body.transform(f"{side}_ankle").position for side in "lr"))[2]) for body in steady]
    together, lower = np.corrcoef(apart, pelvis(steady)[:, 1])[0, 1] > 0.5, np.ptp(pelvis(steady)[:, 1])
    assert together == lowest_together
    assert 0.03 < lower < 0.08


async def test_knees_bend_most_in_the_air_and_are_straight_again_in_the_end(pilot: RealizerPilot) -> None:
    pilot.block("b", go("0 4"))
    await pilot.advance(7)
    bends = knees(pilot.bodies("alice"))
    assert 45.0 < bends.max() < 75.0
    assert bends[-1].max() < 3.0


async def test_each_arm_swings_with_the_foot_of_the_other_side(pilot: RealizerPilot) -> None:
    pilot.block("b", go("0 5"))
    await pilot.advance(4)
    walking = pilot.bodies("alice")[100:]
    hand, foot = (
        [body.transform(joint).position[2] - body.root[2] for body in walking] for joint in ("l_wrist", "r_ankle")
    )
    assert np.corrcoef(hand, foot)[0, 1] > 0.8
    assert np.ptp(hand) > 0.15


async def test_gestures_gaze_and_pointing_go_on_above(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        go("0 4") + '<gesture id="g" lexeme="BEAT" start="1.5"/><pointing id="p" target="hill" start="2"/>'
        '<speech id="s"><text>Come with me, it is not far.</text></speech>',
    )
    await pilot.advance(7)
    assert pilot.feedback.warnings == []
    assert all(pilot.feedback.reached(f"b:{id_}:end") for id_ in "wgps")


# --- when


async def test_a_way_takes_its_length_over_its_speed_and_ends_with_both_feet_together(pilot: RealizerPilot) -> None:
    pilot.block("b", go("0 6", speed=1.5))
    await pilot.advance(8)
    taken = pilot.feedback.time("b:w:end") - pilot.feedback.time("b:w:start")
    assert taken == pytest.approx(6.0 / 1.5 + 1.0, abs=0.1)
    shown = pilot.bodies("alice")[round(50 * pilot.feedback.time("b:w:end")) + 1]
    left, right = (shown.transform(f"{side}_ankle").position for side in "lr")
    assert left[2] == pytest.approx(right[2], abs=0.01)


async def test_a_figure_arrives_at_the_time_to_which_its_end_is_tied(pilot: RealizerPilot) -> None:
    pilot.predict("partner", "ready", 5.0)
    pilot.block("b", go("0 3", syncs='end="anticipators:partner:ready"'))
    await pilot.advance(2)
    pilot.predict("partner", "ready", 4.2)
    await pilot.advance(4)
    assert pilot.feedback.time("b:w:end") == pytest.approx(4.2)
    assert place(pilot.bodies("alice")[212]) == pytest.approx((0.0, 3.0), abs=0.04)


async def test_what_has_too_little_time_starts_later_or_loses_its_tie(pilot: RealizerPilot) -> None:
    pilot.block("b", go("0 4", syncs='start="0" end="1"'))
    await pilot.advance(5)
    assert [text for _, text in pilot.feedback.warnings] == ["IMPOSSIBLE_TO_SCHEDULE"]
    assert pilot.feedback.time("b:w:end") > 1.8


# --- live


async def test_a_target_that_moves_is_followed_and_the_end_moves_with_it(pilot: RealizerPilot) -> None:
    pilot.block("b", go() + '<gesture id="g" lexeme="BEAT" start="w:end"/>')
    await pilot.advance(2)
    planned = pilot.feedback.predicted("b:w:end")
    pilot.move("door", (2.0, 1.0, 5.0))
    await pilot.advance(7)
    assert place(pilot.bodies("alice")[-1]) == pytest.approx((1.75, 4.57), abs=0.15)
    assert pilot.feedback.time("b:w:end") > planned + 0.5
    assert pilot.feedback.time("b:g:start") == pilot.feedback.time("b:w:end")
    assert foot_slide(pilot.bodies("alice")) < 0.01


async def test_a_speed_that_changes_on_the_way_changes_the_time_of_arrival(pilot: RealizerPilot) -> None:
    pilot.block("b", go("0 8"))
    await pilot.advance(2)
    planned = pilot.feedback.predicted("b:w:end")
    pilot.block(
        "c",
        '<bmla:parametervaluechange id="p" target="b:w" paramId="speed">'
        '<bmla:trajectory type="instant" targetValue="1.9"/></bmla:parametervaluechange>',
    )
    await pilot.advance(7)
    assert pilot.feedback.time("b:w:end") < planned - 1.0
    assert speeds(pilot.bodies("alice")).max() > 1.7
    assert foot_slide(pilot.bodies("alice")) < 0.01


@pytest.mark.parametrize("time", [0.6, 0.9, 1.3, 1.8, 2.0, 2.25])
async def test_an_interrupted_figure_comes_to_rest_on_both_feet(pilot: RealizerPilot, time: float) -> None:
    pilot.block("b", go("0 6"))
    await pilot.advance(time)
    pilot.block("c", composition="REPLACE")
    await pilot.advance(2.5)
    shown = pilot.bodies("alice")
    assert pilot.feedback.status("b") == "INTERRUPTED"
    assert np.ptp(pelvis(shown[-20:]), axis=0).max() < 0.01
    left, right = (shown[-1].transform(f"{side}_ankle").position for side in "lr")
    assert left[2] == pytest.approx(right[2], abs=0.01)
    assert foot_slide(shown) < 0.01
    assert place(shown[-1])[1] - place(shown[round(50 * time)])[1] < 1.3


# --- bad input


@pytest.mark.parametrize(
    ("way", "warning", "says"),
    [
        (go("nowhere"), "NO_SUCH_TARGET", "there is no target 'nowhere'"),
        (go("1e30 0"), "NO_SUCH_TARGET", "the limit is 100 m"),
        (go("1 inf"), "NO_SUCH_TARGET", "there is no target '1 inf'"),
        (go("1 1 1 1"), "NO_SUCH_TARGET", "there is no target '1 1 1 1'"),
        (go("alice:l_wrist"), "NO_SUCH_TARGET", "it is the character itself"),
        (go(""), "NO_SUCH_TARGET", "name a target, or a direction"),
        (go(manner="FLY"), "CANNOT_CREATE_BEHAVIOR", "available: WALK, RUN, STRAFE"),
        (go(speed=0), "CANNOT_CREATE_BEHAVIOR", "the parameter speed must be a number from 0.2 to 4.5, not '0'"),
        (go(speed=1000), "CANNOT_CREATE_BEHAVIOR", "the parameter speed must be a number from 0.2 to 4.5, not '1000'"),
        (go(distance=-1), "CANNOT_CREATE_BEHAVIOR", "the parameter distance"),
        (go(facing="nobody"), "NO_SUCH_TARGET", "there is no target 'nobody'"),
    ],
)
async def test_what_nobody_can_walk_to_is_refused_and_the_rest_plays(
    pilot: RealizerPilot, way: str, warning: str, says: str
) -> None:
    pilot.block("b", way + '<head id="h" lexeme="NOD"/>')
    await pilot.advance(2)
    assert pilot.feedback.warnings == [("b:w", warning)]
    assert says in pilot.feedback.of("warningFeedback")[0].text
    assert pilot.feedback.status("b") == "DONE"


async def test_a_figure_that_sits_does_not_walk(pilot: RealizerPilot) -> None:
    pilot.block("a", '<postureShift id="s"><stance type="SITTING"/></postureShift>')
    await pilot.advance(3)
    pilot.block("b", go())
    await pilot.advance(1)
    assert pilot.feedback.warnings == [("b:w", "CANNOT_CREATE_BEHAVIOR")]
    assert place(pilot.bodies("alice")[-1]) == pytest.approx((0.0, 0.0), abs=0.1)


async def test_a_target_under_the_ground_or_above_it_is_approached(pilot: RealizerPilot) -> None:
    pilot.move("door", (1.0, -50.0, 1.0))
    pilot.block("b", go(distance=0))
    await pilot.advance(4)
    assert place(pilot.bodies("alice")[-1]) == pytest.approx((1.0, 1.0), abs=0.04)


async def test_a_target_that_is_removed_is_where_it_was_last(pilot: RealizerPilot) -> None:
    pilot.block("b", go())
    await pilot.advance(1.5)
    pilot.move("door", None)
    await pilot.advance(5)
    assert place(pilot.bodies("alice")[-1]) == pytest.approx((0.0, 3.5), abs=0.04)


@pytest.mark.parametrize(
    "way",
    [go("1 1 1.5", distance=0.5, speed=2), go("1 1 1.5", distance=0.5, manner="RUN"), go("0 -2", speed=1.6)],
    ids=["fast, to the side", "running, to the side", "fast, to the back"],
)
async def test_a_figure_in_a_hurry_that_turns_does_not_sink_to_its_knees(either: RealizerPilot, way: str) -> None:
    either.block("b", way)
    await either.advance(5)
    assert either.feedback.reached("b:w:end")
    heights = [body.transform("HumanoidRoot").position[1] for body in either.bodies("alice")]
    assert min(heights) > heights[0] - 0.15
    assert np.abs(np.diff(heights, 2)).max() / 0.02**2 < 32.0
    assert worst_motion(either.bodies("alice"))["wrist_m_s2"] < 60.0


async def test_a_foot_comes_down_within_reach_of_its_leg_while_a_figure_speeds_up(pilot: RealizerPilot) -> None:
    pilot.block("b", go("-3.27 -2.82", manner="RUN", speed=3.3))
    await pilot.advance(5)
    assert foot_slide(pilot.bodies("alice")) < 0.005


async def test_a_figure_that_first_runs_on_the_other_way_arrives_when_it_says_and_goes_no_faster(
    either: RealizerPilot,
) -> None:
    either.block("a", go("3.4 -0.9", manner="RUN", speed=2.8))
    await either.advance(1.7)
    either.block("b", go("-3.3 0", speed=1.5), composition="REPLACE")
    await either.advance(0.3)
    expected = either.feedback.predicted("b:w:end")
    await either.advance(7)
    shown = either.bodies("alice")
    assert either.feedback.time("b:w:end") == pytest.approx(expected, abs=0.3)
    assert place(shown[round(50 * either.feedback.time("b:w:end")) + 1]) == pytest.approx((-3.3, 0.0), abs=0.05)
    assert speeds(shown)[140:].max() < 1.5 * 1.1
    assert foot_slide(shown) < 0.005
    assert either.feedback.warnings == []


async def test_a_second_way_soon_after_the_first_one_begins_without_a_jump(either: RealizerPilot) -> None:
    ways = '<locomotion id="to" target="0 1"/><locomotion id="on" target="0 2" start="to:end+0.56"/>'
    either.block("b", ways)
    await either.advance(4)
    since = round(50 * either.feedback.time("b:on:start"))
    change = np.diff(pelvis(either.bodies("alice"))[since - 10 : since + 4], n=2, axis=0) / 0.02**2
    assert np.linalg.norm(change, axis=1).max() < 4.0


async def test_a_figure_that_comes_in_a_curve_faces_the_way_that_it_came_and_turns_no_further(
    pilot: RealizerPilot,
) -> None:
    pilot.block("a", go("-2.07 1.52", manner="RUN", speed=3.37))
    await pilot.advance(1.39)
    pilot.block("b", go("-3.14 1.55", manner="RUN", speed=3.47), composition="REPLACE")
    await pilot.advance(5)
    assert pilot.feedback.time("b:w:end") < 3.5
    assert min(heading(body) for body in pilot.bodies("alice")) > -95.0


async def test_a_figure_that_is_there_before_its_time_comes_to_rest_smoothly(pilot: RealizerPilot) -> None:
    await pilot.advance(0.34)
    pilot.block("a", go("-2.07 1.52", manner="RUN", speed=3.37))
    await pilot.advance(1.39)
    pilot.block("b", go("-3.14 1.55", manner="RUN", speed=3.47), composition="REPLACE")
    await pilot.advance(5)
    turns = np.diff(np.unwrap([heading(body) for body in pilot.bodies("alice")], period=360.0), n=2)
    assert abs(turns).max() < 1.0


async def test_a_figure_that_is_late_comes_to_rest_smoothly(pilot: RealizerPilot) -> None:
    pilot.block("a", go("2.79 -3.19", manner="RUN", speed=3.0))
    await pilot.advance(1.86)
    pilot.block("b", go("-0.79 -0.36", manner="STRAFE", speed=0.7, syncs='end="3.8"'), composition="REPLACE")
    await pilot.advance(7)
    assert pilot.feedback.warnings == [("b:w", "EXECUTION_FAILURE")]
    ways = np.diff(pelvis(pilot.bodies("alice"))[:, [0, 2]], n=2, axis=0) / 0.02**2
    assert np.linalg.norm(ways, axis=1).max() < 12.0
