"""What eyes do with the gazes of their figure."""

import math
from itertools import pairwise

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from reactive_realizer.bml.words import Influence
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import EYES
from reactive_realizer.embodiment.quaternion import angle, from_axis_angle, from_euler, rotate
from reactive_realizer.embodiment.vector import FORWARD
from reactive_realizer.engines.animation.gaze.eyes import EYE_RANGE, listing
from reactive_realizer.engines.animation.gaze.lids import with_lids
from reactive_realizer.engines.animation.gaze.looking import Looking
from reactive_realizer.engines.animation.gaze.saccade import saccade_progress

from .gazing import between, gaze, miss, target_at, way

FRAME = 0.02


def after(looking: Looking, gazes, body: Body, frames: int, start: float = 0.0) -> list[Body]:
    """The body with its eyes, frame by frame."""
    return [
        body.posed(looking.eyes(start + i * FRAME, gazes if isinstance(gazes, list) else gazes(i), body, {}))
        for i in range(frames)
    ]


def looked(body: Body) -> tuple:
    return rotate(body.place(EYES[0]).rotation, FORWARD)


@settings(derandomize=True, max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(st.floats(-38, 38), st.floats(-38, 38))
def test_an_eye_does_not_roll_about_its_line_of_sight(yaw, pitch):
    _, _, _, roll = listing((1.0, 0.0, 0.0, 0.0), way(yaw, pitch))
    assert roll == pytest.approx(0.0, abs=1e-12)


def test_an_eye_turns_forty_degrees_and_a_half_aside_and_down():
    head = from_euler(0.1, 0.3, 0.0)
    for target in (way(120, -10), way(-170, -60), way(0, -80), way(60, -60)):
        assert angle(listing(head, target)) == pytest.approx(EYE_RANGE)
    assert math.degrees(EYE_RANGE) == pytest.approx(40.5, abs=0.1)


def test_and_thirty_up_where_its_lid_is_highest():
    straight = from_euler(0.0, 0.0, 0.0)
    ranges = [math.degrees(angle(listing(straight, way(yaw, pitch)))) for yaw, pitch in ((0, 80), (60, 60), (89, 1))]
    assert ranges == pytest.approx([30.0, 31.5, 40.5], abs=1.0)
    assert ranges == sorted(ranges)
    for pitch, raised in ((29, 0.97), (31, 1.0), (80, 1.0)):
        turns = dict.fromkeys(EYES, listing(straight, way(0, pitch)))
        assert with_lids(turns, {})["eyeWideLeft"] == pytest.approx(raised, abs=0.01)


def test_both_eyes_are_on_something_near(skeleton):
    body = Body(skeleton)
    target = target_at(body, 5, -10, 0.3)
    last = after(Looking(), [gaze(body, target)], body, 20)[-1]
    assert all(miss(last, eye, target) < 1e-3 for eye in EYES)
    assert between(*(rotate(last.place(eye).rotation, FORWARD) for eye in EYES)) > 5


def test_they_hold_it_while_the_head_turns_nods_and_leans(skeleton):
    still = Body(skeleton)
    target = target_at(still, 15, 5)
    looking, looks = Looking(), [gaze(still, target)]
    after(looking, looks, still, 20)
    for i in range(50):
        turn = from_axis_angle((1.0, 0.0, 0.0), 0.25 * math.sin(0.4 * i))
        moved = still.posed(
            {"skullbase": turn, "vc4": from_euler(0.0, 0.01 * i, 0.0), "vl5": from_euler(0.002 * i, 0, 0)}
        )
        seen = moved.posed(looking.eyes(0.4 + i * FRAME, looks, moved, {}))
        assert all(miss(seen, eye, target) < 1e-3 for eye in EYES)


def test_they_get_there_by_a_saccade(skeleton):
    body = Body(skeleton)
    target = target_at(body, 20, 0, 1000.0)
    looking = Looking()
    after(looking, [], body, 2)
    angles = [miss(shown, EYES[0], target) for shown in after(looking, [gaze(body, target)], body, 6, 2 * FRAME)]
    # 20 degrees take 65 ms.
    left = [20 * (1 - saccade_progress(math.radians(20), frame * FRAME)) for frame in range(6)]
    assert angles == pytest.approx(left, abs=0.01)
    assert left[3] > 0.05
    assert left[4] == 0.0


def test_a_gaze_that_gives_way_and_comes_back_does_so_by_saccades(skeleton):
    body = Body(skeleton)
    left, right = (gaze(body, target_at(body, yaw, 0)) for yaw in (15, -15))

    def gazes(frame: int) -> list:
        return [left, right] if 20 <= frame < 50 else [left]

    bodies = after(Looking(), gazes, body, 80)
    yaws = [math.degrees(math.atan2(*(looked(shown)[i] for i in (0, 2)))) for shown in bodies]
    assert yaws[19] > 14
    assert yaws[49] < -14
    assert yaws[79] > 14
    steps = [between(looked(a), looked(b)) for a, b in pairwise(bodies)]
    assert max(steps) < math.degrees(8.7) * FRAME + 0.1


def test_a_slow_target_is_followed_and_a_jump_is_a_saccade(skeleton):
    body = Body(skeleton)
    at = [target_at(body, 0, 0)]
    looking, looks = Looking(), [gaze(body, lambda: at[0])]
    after(looking, looks, body, 10)
    for i in range(40):
        at[0] = target_at(body, 0.5 * i, 0)
        (shown,) = after(looking, looks, body, 1, 0.2 + i * FRAME)
        assert miss(shown, EYES[0], at[0]) < 1e-3
    at[0] = target_at(body, -15, 0)
    misses = [miss(shown, EYES[0], at[0]) for shown in after(looking, looks, body, 8, 1.0)]
    assert misses[0] > 20
    assert misses == sorted(misses, reverse=True)
    assert misses[-1] < 1e-3


def test_a_target_that_jumps_again_in_the_middle_of_a_saccade_does_not_carry_them_along(skeleton):
    body = Body(skeleton)
    at = [target_at(body, -20, 0)]
    looking, looks = Looking(), [gaze(body, lambda: at[0])]
    bodies = after(looking, looks, body, 10)
    for i, yaw in enumerate((20, 20, -30, -30, -30, -30, -30, -30, -30)):
        at[0] = target_at(body, yaw, 0)
        bodies += after(looking, looks, body, 1, 0.2 + i * FRAME)
    assert max(between(looked(a), looked(b)) for a, b in pairwise(bodies)) < math.degrees(8.7) * FRAME + 0.1
    assert miss(bodies[-1], EYES[0], at[0]) < 1e-3


def test_behind_a_target_that_is_too_quick_they_fall_and_catch_up(skeleton):
    body = Body(skeleton)
    at = [target_at(body, -35, 0)]
    looking, looks = Looking(), [gaze(body, lambda: at[0])]
    after(looking, looks, body, 10)
    misses = []
    for i in range(12):
        at[0] = target_at(body, -35 + 6.0 * i, 0)
        (shown,) = after(looking, looks, body, 1, 0.2 + i * FRAME)
        misses.append(miss(shown, EYES[0], at[0]))
    assert 1 < max(misses) < 7
    assert sum(each < 0.01 for each in misses) > 3


def test_weights_of_the_eyes_leave_them_on_the_way(skeleton):
    body = Body(skeleton)
    for weight, degrees in ((1.0, 20), (0.5, 10), (0.0, 0)):
        half = gaze(body, target_at(body, 20, 0, 1000.0), eyes=weight)
        assert between(looked(after(Looking(), [half], body, 20)[-1]), FORWARD) == pytest.approx(degrees, abs=0.1)


def test_a_gaze_of_little_weight_lies_over_the_one_below(skeleton):
    body = Body(skeleton)
    below, above = gaze(body, target_at(body, 20, 0, 1e3)), gaze(body, target_at(body, -20, 0, 1e3), eyes=0.25)
    assert between(looked(after(Looking(), [below, above], body, 20)[-1]), way(10, 0)) < 0.1


@pytest.mark.parametrize("far", [0.0, 0.001, 0.05])
def test_something_at_the_eyes_themselves_does_them_no_harm(skeleton, far):
    body = Body(skeleton)
    for shown in after(Looking(), [gaze(body, target_at(body, 0, 0, far), Influence.EYES)], body, 5):
        assert all(math.isfinite(part) for eye in EYES for part in shown.rotation(eye))


def test_they_rest_as_they_are_told(skeleton):
    body = Body(skeleton)
    aside = dict.fromkeys(EYES, from_euler(0.01, 0.02, 0.0))
    shown = Looking().eyes(0.0, [], body, aside)
    assert all(between(rotate(shown[eye], FORWARD), rotate(aside[eye], FORWARD)) < 1e-4 for eye in EYES)


@pytest.mark.parametrize("closed", [0.0, 0.4])
def test_a_lid_goes_with_its_eye_as_far_as_it_is_open(closed):
    down, up = from_euler(EYE_RANGE, 0.0, 0.0), from_euler(-0.2, 0.0, 0.0)
    weights = with_lids(dict(zip(EYES, (down, up), strict=True)), {"eyeBlinkLeft": closed})
    assert weights["eyeBlinkLeft"] == closed
    assert weights["eyeLookDownLeft"] == pytest.approx((1 - closed) * math.sin(EYE_RANGE) / EYE_RANGE)
    assert weights["eyeLookUpRight"] == pytest.approx(math.sin(0.2) / math.sin(math.radians(30)))
    assert "eyeLookDownRight" not in weights


def test_with_a_large_turn_of_gaze_people_blink(skeleton):
    body = Body(skeleton)
    for degrees, blinks in ((30, []), (36, [2 * FRAME])):
        large: list[float] = []
        looking = Looking(large.append)
        after(looking, [], body, 2)
        after(looking, [gaze(body, target_at(body, degrees, 0, 1000.0))], body, 20, 2 * FRAME)
        assert large == blinks


def test_saccades_and_blinks_begin_when_a_gaze_did_and_not_with_the_next_frame(skeleton):
    body, begun = Body(skeleton), 0.033
    target = target_at(body, 36, 0, 1000.0)
    large: list[float] = []
    looking = Looking(large.append)
    after(looking, [], body, 2)
    looking.notice(begun)
    looking.notice(0.01)
    angles = [miss(shown, EYES[0], target) for shown in after(looking, [gaze(body, target)], body, 4, 2 * FRAME)]
    done = [saccade_progress(math.radians(36), (2 + frame) * FRAME - begun) for frame in range(4)]
    assert angles == pytest.approx([36 * (1 - part) for part in done], abs=0.01)
    assert large == [begun]


def test_what_nobody_noticed_begins_with_its_frame(skeleton):
    body = Body(skeleton)
    looking, looks = Looking(), [gaze(body, target_at(body, 20, 0, 1000.0))]
    looking.notice(0.01)
    after(looking, [], body, 2)
    (first,) = after(looking, looks, body, 1, 2 * FRAME)
    assert between(looked(first), FORWARD) < 1e-4
