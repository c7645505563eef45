"""Gaze as a motion."""

import math
from itertools import pairwise

import pytest

from reactive_realizer.bml.vocabulary import Influence, OffsetDirection
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, angle, difference, from_axis_angle
from reactive_realizer.embodiment.vector import subtract, unit
from reactive_realizer.engines.animation.gaze.eyes import EyeSockets, GazeTarget
from reactive_realizer.engines.animation.motion_unit import Moment
from reactive_realizer.engines.animation.motions.gaze import GAZE_SHIFT, HEAD_SHIFT

from .bodies import shown
from .gazes import between, gaze, target_at, way


def apart(a: Quat, b: Quat) -> float:
    return angle(difference(a, b))


def test_a_gaze_starts_from_the_current_head_and_ends_in_the_layers_below_without_a_jump(skeleton: Skeleton) -> None:
    aside = {"skullbase": from_axis_angle((0.0, 1.0, 0.0), -0.5), "vc4": IDENTITY}
    begun, below = Body(skeleton, aside), Body(skeleton)
    unit_ = gaze(below, target_at(below, 45, 5))
    unit_.start(begun)
    assert shown(unit_, 0.0, begun)["skullbase"] == pytest.approx(aside["skullbase"])
    assert shown(unit_, 1.0, below)["skullbase"] == pytest.approx(IDENTITY)
    poses = [shown(unit_, i / 200, below)["skullbase"] for i in range(201)]
    steps = [apart(a, b) for a, b in pairwise(poses)]
    assert max(steps) < 0.06
    assert steps[0] < 1e-3 > steps[-1]


def test_the_head_accelerates_and_decelerates_symmetrically(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    unit_ = gaze(body, target_at(body, 40, 10))
    unit_.start(body)
    ready = unit_.key_positions["ready"]
    turns = [angle(shown(unit_, ready * i / 50, body)["skullbase"]) for i in range(51)]
    steps = [b - a for a, b in pairwise(turns)]
    assert steps == pytest.approx(steps[::-1], abs=1e-6)
    assert max(steps) == pytest.approx(1.875 * turns[-1] / 50, rel=0.01)


def test_a_shift_reaches_its_target_at_its_end_and_stays(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    for course in (GAZE_SHIFT, HEAD_SHIFT):
        unit_ = gaze(body, target_at(body, 40, 10), course=course)
        unit_.start(body)
        last = unit_.pose(Moment(1.0, GlobalTime(9.0), body))
        assert last.weight == 1.0
        assert unit_.persists_as is not None
        assert angle(last.rotations["skullbase"]) > 0.2
        assert unit_.looks(1.0)


def test_the_eyes_leave_first(skeleton: Skeleton) -> None:
    unit_ = gaze(Body(skeleton), target_at(Body(skeleton), 0, 0))
    assert unit_.looks(0.0)
    assert unit_.looks(0.74)
    assert not unit_.looks(0.75)


def test_the_head_follows_a_target_and_tells_when_it_jumps(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    at = [target_at(body, 20, 0)]
    unit_ = gaze(body, lambda: at[0])
    unit_.start(body)

    def head(frame: int) -> Quat:
        return unit_.pose(Moment(0.5, GlobalTime(0.02 * frame), body)).rotations["skullbase"]

    followed, jumps = head(0), []
    for i in range(1, 20):
        at[0] = target_at(body, 20 - 0.5 * i, 0)
        followed = head(i)
        jumps.append(unit_.jumped)
    assert apart(followed, gaze(body, at[0]).pose(Moment(0.5, GlobalTime(0.0), body)).rotations["skullbase"]) < 1e-9
    at[0] = target_at(body, -30, 0)
    turned = head(20)
    jumps.append(unit_.jumped)
    assert apart(turned, gaze(body, at[0]).pose(Moment(0.5, GlobalTime(0.0), body)).rotations["skullbase"]) < 1e-9
    head(21)
    assert [*jumps, unit_.jumped] == [*[False] * 19, True, False]


def test_weights_may_change_while_it_plays(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    unit_ = gaze(body, target_at(body, 30, 0), Influence.WAIST)
    before = unit_.pose(Moment(0.5, GlobalTime(0.0), body)).rotations
    unit_.parameters = {**unit_.parameters, "back": 0.0}
    later = unit_.pose(Moment(0.5, GlobalTime(0.0), body)).rotations
    assert "vl5" in before
    assert "vl5" not in later
    assert set(unit_.ranges) == {"back", "chest", "neck", "head", "eyes"}


@pytest.mark.parametrize("target", [(0, 0), (40, 0), (0, 50), (-60, -30)])
@pytest.mark.parametrize(
    ("side", "left", "up"),
    [
        (OffsetDirection.RIGHT, -1, 0),
        (OffsetDirection.LEFT, 1, 0),
        (OffsetDirection.UP, 0, 1),
        (OffsetDirection.DOWN, 0, -1),
        (OffsetDirection.UPRIGHT, -1, 1),
        (OffsetDirection.UPLEFT, 1, 1),
        (OffsetDirection.DOWNRIGHT, -1, -1),
        (OffsetDirection.DOWNLEFT, 1, -1),
    ],
)
def test_an_offset_is_an_angle_from_the_target_as_the_figure_sees_it(
    skeleton: Skeleton, side: OffsetDirection, left: int, up: int, target: tuple[int, int]
) -> None:
    eyes = EyeSockets.of(Body(skeleton)).middle
    point = GazeTarget(lambda: target_at(Body(skeleton), *target), 20.0, side).point(eyes)
    toward = unit(subtract(point, eyes))
    assert between(toward, way(*target)) == pytest.approx(20.0, abs=1e-3)
    yaw, pitch = math.degrees(math.atan2(toward[0], toward[2])), math.degrees(math.asin(toward[1]))
    if left:
        assert (yaw - target[0]) * left > 5
    if up:
        assert (pitch - target[1]) * up > 5


def test_an_offset_from_straight_above_is_defined(skeleton: Skeleton) -> None:
    eyes = EyeSockets.of(Body(skeleton)).middle
    point = GazeTarget(lambda: target_at(Body(skeleton), 0, 90), 30.0, OffsetDirection.DOWN).point(eyes)
    assert between(unit(subtract(point, eyes)), way(0, 60)) < 0.01


def test_an_offset_from_a_target_between_the_eyes_is_that_target(skeleton: Skeleton) -> None:
    eyes = EyeSockets.of(Body(skeleton)).middle
    assert GazeTarget(lambda: eyes, 30.0, OffsetDirection.LEFT).point(eyes) == eyes
