"""The speed limits of a figure."""

import math
from importlib.resources import files
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body, JointRotations, Skeleton
from reactive_realizer.embodiment.feet import depth, grounded, soles
from reactive_realizer.embodiment.joints import LEGS
from reactive_realizer.embodiment.quaternion import (
    IDENTITY,
    angle,
    difference,
    from_axis_angle,
    from_euler,
    multiply,
    rotate,
)
from reactive_realizer.embodiment.speed_limit import SpeedLimit, slowed
from reactive_realizer.embodiment.vector import UP, Vec3, distance, length, subtract
from reactive_realizer.testing.motion_laws import accelerations

SKELETON = Avatar.read(Path(str(files("reactive_realizer"))) / "assets" / "avatars" / "male.glb").skeleton
FRAME = 0.02
WRISTS = ("l_wrist", "r_wrist")

radians = st.floats(-3.0, 3.0)
MOVING = ("vl5", "vt6", "l_sternoclavicular", "l_shoulder", "l_elbow", "r_shoulder", "r_elbow", "skullbase")
pose = st.fixed_dictionaries({joint: st.builds(from_euler, radians, radians, radians) for joint in MOVING})


def body(pose: JointRotations | None = None, root: Vec3 = (0.0, 0.0, 0.0)) -> Body:
    return Body(SKELETON, pose or {}, root)


def followed(begin: Body, *calls: tuple[Body, int]) -> list[Body]:
    """The bodies that a limit shows, frame by frame, when it gets each body for a number of frames."""
    limit, shown = SpeedLimit(begin), [begin]
    for wanted, frames in calls:
        shown += [limit(wanted, FRAME) for _ in range(frames)]
    return shown


def steps(shown: list[Body], joint: str) -> list[float]:
    """The movement of a joint from each frame to the next, m."""
    return [distance(a.transform(joint).position, b.transform(joint).position) for a, b in pairwise(shown)]


@settings(max_examples=50)
@given(pose, pose)
def test_no_wrist_moves_5_cm_in_20_ms(begin: JointRotations, wanted: JointRotations) -> None:
    shown = followed(body(begin), (body(wanted), 6))
    for wrist in WRISTS:
        assert max(steps(shown, wrist)) < 0.05


def test_a_small_step_passes_unchanged() -> None:
    wanted = {joint: from_axis_angle((1.0, 0.0, 0.0), 0.003) for joint in MOVING}
    limited = SpeedLimit(body())(body(wanted), FRAME)
    assert {joint: limited.rotation(joint) for joint in MOVING} == wanted


def test_a_distant_pose_is_reached_and_kept() -> None:
    wanted = {"l_shoulder": from_axis_angle((1.0, 0.0, 0.0), -2.5), "skullbase": from_axis_angle((0.0, 1.0, 0.0), 1.0)}
    shown = followed(body(), (body(wanted), 60), (body(), 60))
    for joint, goal in wanted.items():
        assert shown[60].rotation(joint) == pytest.approx(goal)
        assert shown[-1].rotation(joint) == pytest.approx(IDENTITY)


def test_the_head_stays_within_the_limit_of_a_neck() -> None:
    limited = SpeedLimit(body())(body({"skullbase": from_axis_angle((0.0, 1.0, 0.0), 1.5)}), FRAME)
    assert angle(limited.rotation("skullbase")) == pytest.approx(8.0 * FRAME)


def test_the_sign_of_a_quaternion_has_no_effect_on_the_limit() -> None:
    turned = from_axis_angle((1.0, 0.0, 0.0), 0.4)
    w, x, y, z = from_axis_angle((1.0, 0.0, 0.0), 0.41)
    assert slowed({"l_elbow": turned}, {"l_elbow": (-w, -x, -y, -z)}, FRAME) == {"l_elbow": (-w, -x, -y, -z)}


@settings(max_examples=25)
@given(st.lists(st.tuples(pose, st.integers(1, 4)), min_size=2, max_size=3))
def test_the_acceleration_of_a_wrist_is_limited(calls: list[tuple[JointRotations, int]]) -> None:
    shown = followed(body(), *((body(wanted), frames) for wanted, frames in calls))
    for wrist in WRISTS:
        moved = [0.0, *steps(shown, wrist)]
        assert max(after - before for before, after in pairwise(moved)) < 0.0151


@settings(max_examples=10)
@given(pose)
def test_a_wrist_reaches_its_goal_without_overshooting(wanted: JointRotations) -> None:
    shown = followed(body(), (body(wanted), 60))
    shares = [angle(difference(each.rotation("r_elbow"), wanted["r_elbow"])) for each in shown]
    assert all(after < before + 1e-9 for before, after in pairwise(shares))
    assert shares[-1] < 1e-6


def swerves(shown: list[Body], wrist: str) -> float:
    """The largest change of the velocity of a wrist relative to the root from a frame to the next, m/s²."""
    places = np.array([subtract(each.transform(wrist).position, each.root) for each in shown])
    return float(np.linalg.norm(np.diff(places, 2, axis=0), axis=1).max()) / FRAME**2


def test_a_wrist_that_reverses_slows_down_first() -> None:
    there = {"r_elbow": from_axis_angle((1.0, 0.0, 0.0), -2.0)}
    shown = followed(body(), (body(there), 5), (body(), 30))
    moved = steps(shown, "r_wrist")
    assert moved[0] < 0.0151
    assert moved[4] > 0.04, "at full speed"
    assert swerves(shown, "r_wrist") < 56.0
    assert shown[-1].rotation("r_elbow") == pytest.approx(IDENTITY)


@pytest.mark.parametrize("turn", [(0.0, 0.0, 1.0), (0.0, 1.0, 0.0)])
def test_a_wrist_that_turns_aside_at_once_is_carried_on(turn: Vec3) -> None:
    ahead = {"l_shoulder": from_axis_angle((1.0, 0.0, 0.0), -1.5), "l_elbow": from_axis_angle((1.0, 0.0, 0.0), -0.8)}
    aside = {**ahead, "l_shoulder": multiply(from_axis_angle(turn, 1.0), ahead["l_shoulder"])}
    shown = followed(body(), (body(ahead), 12), (body(aside), 40))
    assert swerves(shown, "l_wrist") < 56.0
    assert all(shown[-1].rotation(joint) == pytest.approx(goal) for joint, goal in aside.items())


def test_fingertips_move_less_than_3_cm_by_a_turn_of_the_wrist() -> None:
    shown = followed(body(), (body({"r_wrist": from_axis_angle((1.0, 0.0, 0.0), 1.5)}), 1))
    assert steps(shown, "r_middle3")[0] < 0.03


def test_the_root_stays_below_2_m_per_second_and_carries_the_arms() -> None:
    shown = followed(body(), (body(root=(0.3, -0.4, 0.0)), 20))
    places = [each.root for each in shown]
    assert max(distance(a, b) for a, b in pairwise(places)) == pytest.approx(0.04)
    assert length(places[5]) == pytest.approx(0.2)
    assert places[-1] == (0.3, -0.4, 0.0)
    assert steps(shown, "r_wrist")[0] == pytest.approx(0.04)


def test_an_arm_takes_up_what_a_pelvis_that_goes_up_and_down_would_add_to_its_swerve() -> None:
    bent = {"l_elbow": from_axis_angle((1.0, 0.0, 0.0), -0.8)}
    low, high = ({**bent, "l_shoulder": from_axis_angle((1.0, 0.0, 0.0), turn)} for turn in (-0.5, -1.5))
    heights = [0.02 * (math.cos(0.2 * math.pi * number) - 1.0) for number in range(100)]
    goals = (body((high, low)[number // 12 % 2], (0.0, height, 0.0)) for number, height in enumerate(heights))
    shown = followed(body(), *((goal, 1) for goal in goals))
    assert accelerations(shown, "HumanoidRoot").max() > 15.0
    assert accelerations(shown, "l_wrist").max() < 56.0


def sunk(shown: Body) -> float:
    """The depth of the lowest foot below the ground, m."""
    return depth(shown, soles(SKELETON))


def bent(knees: float, root: float) -> Body:
    turns = {"hip": -0.5 * knees, "knee": knees, "ankle": -0.5 * knees}
    pose = {f"{side}_{joint}": from_euler(turn, 0.0, 0.0) for side in "lr" for joint, turn in turns.items()}
    return body(pose, (0.0, root, 0.0))


def test_getting_up_too_fast_does_not_push_the_feet_into_the_ground() -> None:
    low = grounded(bent(2.0, 0.0))
    shown = followed(low, (body(), 40))
    assert max(map(sunk, shown)) < 0.001
    assert shown[-1].root == (0.0, 0.0, 0.0)


def test_feet_may_be_requested_below_the_ground() -> None:
    shown = followed(body(), (bent(0.0, -0.3), 40))
    assert sunk(shown[-1]) == pytest.approx(0.3)
    assert steps(shown, "HumanoidRoot")[0] == pytest.approx(0.04)


def squat(knees: float) -> Body:
    return grounded(bent(knees, 0.0))


def slid(shown: list[Body]) -> float:
    """The largest distance of an ankle from its first position, m."""
    ankles = ("l_ankle", "r_ankle")
    return max(distance(b.transform(j).position, shown[0].transform(j).position) for b in shown for j in ankles)


def test_knees_compensate_for_a_root_that_lags_behind() -> None:
    low, high = squat(2.0), squat(0.3)
    for begin, end in ((low, high), (high, low)):
        shown = followed(begin, (end, 40))
        assert slid(shown) < 0.001
        assert max(map(sunk, shown)) < 0.001
        assert max(steps(shown, "HumanoidRoot")) < 1.001 * 2.0 * FRAME
        assert shown[-1].root == end.root


def test_a_leg_is_slowed_as_a_whole_so_that_its_sole_stays_level() -> None:
    kneeling = bent(2.4, 0.0)
    shown = followed(body(), (kneeling, 3))
    for each in shown:
        assert rotate(each.transform("l_ankle").rotation, UP)[1] > 0.9999
    assert (
        max(angle(difference(a.rotation("l_knee"), b.rotation("l_knee"))) for a, b in pairwise(shown)) < 15.01 * FRAME
    )


def test_feet_out_of_reach_stay_below_the_pelvis() -> None:
    ahead = followed(body(), (body(root=(0.0, 0.0, 5.0)), 30))
    assert max(abs(b.transform("l_ankle").position[2] - b.transform("l_hip").position[2]) for b in ahead) < 0.15
    assert max(map(sunk, ahead)) < 0.001


def test_a_figure_without_legs_is_limited_too() -> None:
    kept = [joint for joint in SKELETON.joints if joint not in LEGS]
    parents = [-1 if (above := SKELETON.parent(joint)) is None else kept.index(above) for joint in kept]
    bust = Skeleton(tuple(kept), tuple(parents), tuple(map(SKELETON.offset, kept)))
    assert SpeedLimit(Body(bust))(Body(bust, {}, (0.3, 0.0, 0.0)), FRAME).root == pytest.approx((0.04, 0.0, 0.0))


lower = st.fixed_dictionaries(
    {joint: st.builds(from_euler, *[st.floats(-1.5, 1.5)] * 3) for joint in ("HumanoidRoot", *sorted(LEGS))}
)
places = st.tuples(*[st.floats(-0.5, 0.5)] * 3)


@settings(max_examples=50)
@given(st.lists(st.tuples(lower, places, st.integers(1, 10)), min_size=2, max_size=4))
def test_the_root_keeps_its_limit_for_any_request(calls: list[tuple[JointRotations, Vec3, int]]) -> None:
    shown = followed(body(), *((body(pose, root), frames) for pose, root, frames in calls))
    assert max(steps(shown, "HumanoidRoot")) < 1.001 * 2.0 * FRAME
    for joint, most in {"HumanoidRoot": 4.0, **dict.fromkeys(LEGS, 15.0)}.items():
        turned = (angle(difference(a.rotation(joint), b.rotation(joint))) for a, b in pairwise(shown))
        assert max(turned) < 1.001 * most * FRAME
