"""Nuclei of EMBRScript: which key poses they mean, and what is wrong with them."""

import math

import pytest

from reactive_realizer.bml.embr.reader import read
from reactive_realizer.bml.key_poses import KeyPoses, PositionGoal
from reactive_realizer.limits import Limits

PLACES = ("-0.1;-0.3;0.1", "-0.3;-0.3;0.3")


def nucleus(id_: str = "1", **values: object) -> str:
    lines = [f"{name}:{value}" for name, value in values.items()]
    return "\n".join(["BEGIN NUCLEUS", f"NUCLEUS_ID:{id_}", *lines, "END", ""])


def pose(time: int, target: str, hold: int = 0, nucleus: str | None = "1", group: str = "rarm") -> str:
    named = f"NUCLEUS:{nucleus}\n" if nucleus else ""
    constraint = f"BEGIN POSITION_CONSTRAINT\nBODY_GROUP:{group}\nJOINT:rhand\nTARGET:{target}\nEND"
    return f"BEGIN K_POSE\nTIME_POINT:+{time}\nHOLD:{hold}\n{named}{constraint}\nEND\n"


def sequence(*poses: str) -> str:
    return f"BEGIN K_POSE_SEQUENCE\n{''.join(poses)}END\n"


def two(hold: int = 100) -> str:
    """A hand at a place without a nucleus, then at two of the nucleus 1, then back."""
    return sequence(
        pose(500, PLACES[0], 0, None),
        pose(1000, PLACES[1], hold),
        pose(1500, PLACES[0]),
        pose(3000, PLACES[0], 0, None),
    )


def arms(text: str, faults: int = 0) -> list[KeyPoses]:
    (parsed,) = read(text, Limits(), "d")
    assert len(parsed.problems) == faults, parsed.problems
    assert parsed.block is not None
    return [each for each in parsed.block.behaviors if isinstance(each, KeyPoses)]


def times(arm: KeyPoses) -> list[float]:
    return [pose.time for pose in arm.poses]


def target(arm: KeyPoses, number: int) -> tuple[float, ...]:
    (goal,) = arm.poses[number].goals
    assert isinstance(goal, PositionGoal)
    return goal.target


def test_a_nucleus_of_zeros_changes_nothing_and_may_come_last() -> None:
    (plain,) = arms(two().replace("NUCLEUS:1\n", ""))
    for text in (nucleus() + two(), two() + nucleus(POWER=0)):
        (arm,) = arms(text)
        assert arm.poses == plain.poses


@pytest.mark.parametrize("value", [-0.2, 0.5, 1.0])
def test_temporal_extent_changes_the_ways_to_its_poses_and_moves_what_follows_if_it_must(value: float) -> None:
    (arm,) = arms(nucleus(TEMPORAL_EXT=value) + two())
    first, second = (duration + 1.5 * value * math.log(1 + duration) for duration in (0.5, 0.4))
    assert times(arm)[:3] == pytest.approx([0.5, 0.5 + first, 0.5 + first + 0.1 + second], abs=1e-6)
    assert times(arm)[3] == pytest.approx(max(3.0, times(arm)[2] + 0.04), abs=1e-6)
    assert arm.poses[2].hold == pytest.approx(max(0.0, 1.5 - times(arm)[2]), abs=1e-6), "a pause, if it is early"


@pytest.mark.parametrize("value", [-1.0, 0.5, 1.0])
def test_one_box_of_all_hands_and_sequences_is_scaled_about_its_center(value: float) -> None:
    left = sequence(pose(600, "0.3;-0.3;0.2", group="larm"))
    right = sequence(pose(500, PLACES[0]), pose(1000, "-0.1;-0.4;0.4"))
    one, other = arms(nucleus(SPATIAL_EXT=value) + right + left)
    center, size = (0.1, 0.25, 0.35), 1 + 0.5 * value  # to the left, up, ahead
    for where, given in zip(
        (target(one, 0), target(one, 1), target(other, 0)),
        ((-0.1, 0.1, 0.3), (-0.1, 0.4, 0.4), (0.3, 0.2, 0.3)),
        strict=True,
    ):
        assert where == pytest.approx([c + size * (g - c) for c, g in zip(center, given, strict=True)], abs=1e-5)


@pytest.mark.parametrize("value", [0.5, 1.0])
def test_power_adds_a_pose_in_the_opposite_direction_with_a_hold_once_and_speeds_up(value: float) -> None:
    (arm,) = arms(nucleus(POWER=value) + two())
    assert len(arm.poses) == 5
    assert target(arm, 1) == pytest.approx([-0.1 + 0.02 * value, 0.1 - 0.02 * value, 0.3], abs=1e-6)
    assert arm.poses[1].hold == pytest.approx(0.3 * value)
    begin = 0.5 + 0.2 * value + 0.3 * value
    assert times(arm)[2:4] == pytest.approx(
        [begin + 0.5 / (1 + 0.2 * value), begin + 0.1 + 0.9 / (1 + 0.2 * value)], abs=1e-6
    )
    assert [pose.power for pose in arm.poses] == [0.0, 0.0, value, value, 0.0]


def test_a_movement_from_an_unknown_place_has_no_back_swing() -> None:
    (arm,) = arms(nucleus(POWER=1) + sequence(pose(500, PLACES[0])))
    assert len(arm.poses) == 1


def test_fluidity_takes_from_holds_or_has_the_hand_rest_at_each_pose() -> None:
    fluid, halting = (arms(nucleus(FLUIDITY=value) + two(400))[0] for value in (1, -1))
    assert [fluid.poses[number].hold for number in (1, 2)] == pytest.approx([0.1, 1.5 - times(fluid)[2]])
    assert halting.poses[1].hold == pytest.approx(0.7)
    assert halting.poses[2].hold == pytest.approx(0.3)


def test_fluidity_of_one_pose_takes_from_its_hold_and_the_way_to_the_next_pose_takes_longer() -> None:
    poses = (pose(500, PLACES[0], 0, None), pose(1000, PLACES[1], 400), pose(2000, PLACES[0], 0, None))
    plain, fluid, halting = (arms(nucleus(FLUIDITY=value) + sequence(*poses))[0] for value in (0, 0.5, -1))
    assert times(plain) == times(fluid) == times(halting)
    assert [arm.poses[1].hold for arm in (plain, fluid, halting)] == pytest.approx([0.4, 0.25, 0.7])


def test_one_pose_without_a_hold_has_no_pause_that_fluidity_could_shorten() -> None:
    poses = (pose(1000, PLACES[1]), pose(2000, PLACES[0], 0, None))
    plain, fluid, halting = (arms(nucleus(FLUIDITY=value) + sequence(*poses))[0] for value in (0, 1, -1))
    assert fluid.poses == plain.poses
    assert halting.poses[0].hold == pytest.approx(0.3)


def curves(*poses: str, more: str = "") -> list[dict[str, float]]:
    (arm,) = arms(more + sequence(*poses))
    return [each.curve for each in arm.poses]


STILL: dict[str, float] = {}
NEUTRAL = {"tension": 0.0, "bias": 0.0}


def test_the_hand_passes_poses_on_a_curve_and_stops_for_holds_and_at_the_end() -> None:
    one, other = PLACES
    away = "-0.2;-0.4;0.1"
    three = pose(500, one, 0, None), pose(1000, other, 0, None), pose(1500, away, 0, None)
    assert curves(*three) == [NEUTRAL, NEUTRAL, STILL]
    assert curves(three[0], pose(1000, other, 100, None), three[2]) == [NEUTRAL, STILL, STILL]


def test_the_hand_stops_where_a_pose_is_repeated_and_where_a_time_warp_begins_or_ends() -> None:
    one, other = PLACES
    assert curves(pose(500, other, 0, None), *(pose(time, one, 0, None) for time in (1000, 1500))) == [
        NEUTRAL,
        STILL,
        STILL,
    ]
    four = [pose(500 * number, PLACES[number % 2], 0, None) for number in range(1, 5)]
    four[2] = four[2].replace("TARGET", "TIME_WARP:EXP;2\nTARGET")
    assert curves(*four) == [NEUTRAL, STILL, STILL, STILL]
    assert curves(*four[:2]).count(NEUTRAL) == 1
    warped = f"BEGIN K_POSE_SEQUENCE\nTIME_WARP:TAN;0.2\n{four[0]}{four[1]}END\n"
    assert all(each.curve == STILL for each in arms(warped)[0].poses)


def test_fingers_stop_at_each_shape() -> None:
    shapes = [
        f"BEGIN K_POSE\nTIME_POINT:+{time}\nBEGIN POSE_TARGET\nBODY_GROUP:rhand\nPOSE_KEY:{key}\nEND\nEND\n"
        for time, key in ((500, "hands_fist"), (1000, "hands_index"))
    ]
    assert curves(*shapes) == [STILL, STILL]


def test_power_is_the_tension_and_the_bias_of_the_curve_and_fluidity_below_0_stops_the_hand_at_each_pose() -> None:
    poses = pose(500, PLACES[0]), pose(1000, PLACES[1]), pose(1500, PLACES[0])
    assert curves(*poses, more=nucleus(POWER=-0.4))[:2] == [{"tension": -0.4, "bias": -0.4}] * 2
    assert curves(*poses, more=nucleus(FLUIDITY=1)) == [NEUTRAL, NEUTRAL, STILL]
    assert curves(*poses, more=nucleus(FLUIDITY=-0.2)) == [STILL, STILL, STILL]


@pytest.mark.parametrize(
    ("values", "power"),
    [({"POWER": 3}, 1.0), ({"POWER": "-1e9"}, -1.0), ({"POWER": "strong"}, 0.0), ({"POWER": "nan"}, 0.0)],
)
def test_a_value_that_is_none_is_named_and_the_nearest_is_taken(values: dict[str, object], power: float) -> None:
    (arm,) = arms(nucleus("1", **values) + two(), faults=1)
    assert max((pose.power for pose in arm.poses), key=abs) == power


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (two().replace("NUCLEUS:1", "NUCLEUS:7", 1) + nucleus(), "there is no NUCLEUS 7; known are 1"),
        ("BEGIN NUCLEUS\nPOWER:1\nEND\n" + sequence(pose(500, PLACES[0], nucleus=None)), "NUCLEUS needs NUCLEUS_ID"),
    ],
)
def test_a_nucleus_that_cannot_be_used_is_named_with_its_line(text: str, words: str) -> None:
    (parsed,) = read(text, Limits(), "d")
    (problem,) = parsed.problems
    assert problem.fault.sentence == words
    assert problem.fault.line
    assert parsed.block is not None
