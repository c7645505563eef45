"""The eyes: geometry, saccades, lids, and the combination of gazes."""

import math
from collections.abc import Callable
from itertools import pairwise

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from reactive_realizer.bml.vocabulary import Influence
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import EYES
from reactive_realizer.embodiment.quaternion import angle, from_axis_angle, from_euler, rotate
from reactive_realizer.embodiment.vector import FORWARD, Vec3
from reactive_realizer.engines.animation.gaze.eye_controller import (
    PEAK_VELOCITY,
    EyeController,
    saccade_duration,
    saccade_progress,
)
from reactive_realizer.engines.animation.gaze.eyes import EYE_RANGE, lid_weights, listing
from reactive_realizer.engines.animation.motions.gaze import GazeMotionUnit

from .gazes import between, gaze, miss, target_at, way

FRAME = 0.02


def after(
    looking: EyeController,
    gazes: list[GazeMotionUnit] | Callable[[int], list[GazeMotionUnit]],
    body: Body,
    frames: int,
    start: float = 0.0,
) -> list[Body]:
    """The body with its eyes, frame by frame."""
    return [
        body.posed(
            looking.eyes(GlobalTime(start + i * FRAME), gazes if isinstance(gazes, list) else gazes(i), body, {})
        )
        for i in range(frames)
    ]


def looked(body: Body) -> Vec3:
    return rotate(body.transform(EYES[0]).rotation, FORWARD)


@settings(derandomize=True, max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(st.floats(-38, 38), st.floats(-38, 38))
def test_an_eye_does_not_roll_about_its_line_of_sight(yaw: float, pitch: float) -> None:
    _, _, _, roll = listing((1.0, 0.0, 0.0, 0.0), way(yaw, pitch))
    assert roll == pytest.approx(0.0, abs=1e-12)


def test_an_eye_turns_40_5_degrees_aside_and_down() -> None:
    head = from_euler(0.1, 0.3, 0.0)
    for target in (way(120, -10), way(-170, -60), way(0, -80), way(60, -60)):
        assert angle(listing(head, target)) == pytest.approx(EYE_RANGE)
    assert math.degrees(EYE_RANGE) == pytest.approx(40.5, abs=0.1)


def test_an_eye_turns_30_degrees_up_with_its_lid_fully_raised() -> None:
    straight = from_euler(0.0, 0.0, 0.0)
    ranges = [math.degrees(angle(listing(straight, way(yaw, pitch)))) for yaw, pitch in ((0, 80), (60, 60), (89, 1))]
    assert ranges == pytest.approx([30.0, 31.5, 40.5], abs=1.0)
    assert ranges == sorted(ranges)
    for pitch, raised in ((29, 0.97), (31, 1.0), (80, 1.0)):
        turns = dict.fromkeys(EYES, listing(straight, way(0, pitch)))
        assert lid_weights(turns)["eyeWideLeft"] == pytest.approx(raised, abs=0.01)


def test_both_eyes_converge_on_a_near_target(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    target = target_at(body, 5, -10, 0.3)
    last = after(EyeController(), [gaze(body, target)], body, 20)[-1]
    assert all(miss(last, eye, target) < 1e-3 for eye in EYES)
    assert between(*(rotate(last.transform(eye).rotation, FORWARD) for eye in EYES)) > 5


def test_eyes_stay_on_the_target_while_the_head_moves(skeleton: Skeleton) -> None:
    still = Body(skeleton)
    target = target_at(still, 15, 5)
    looking, looks = EyeController(), [gaze(still, target)]
    after(looking, looks, still, 20)
    for i in range(50):
        turn = from_axis_angle((1.0, 0.0, 0.0), 0.25 * math.sin(0.4 * i))
        moved = still.posed(
            {"skullbase": turn, "vc4": from_euler(0.0, 0.01 * i, 0.0), "vl5": from_euler(0.002 * i, 0, 0)}
        )
        seen = moved.posed(looking.eyes(GlobalTime(0.4 + i * FRAME), looks, moved, {}))
        assert all(miss(seen, eye, target) < 1e-3 for eye in EYES)


def test_eyes_reach_a_target_by_a_saccade(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    target = target_at(body, 20, 0, 1000.0)
    looking = EyeController()
    after(looking, [], body, 2)
    angles = [miss(shown, EYES[0], target) for shown in after(looking, [gaze(body, target)], body, 6, 2 * FRAME)]
    # 20 degrees take 65 ms.
    left = [20 * (1 - saccade_progress(math.radians(20), frame * FRAME)) for frame in range(6)]
    assert angles == pytest.approx(left, abs=0.01)
    assert left[3] > 0.05
    assert left[4] == 0.0


def test_eyes_switch_between_gazes_by_saccades(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    left, right = (gaze(body, target_at(body, yaw, 0)) for yaw in (15, -15))

    def gazes(frame: int) -> list[GazeMotionUnit]:
        return [left, right] if 20 <= frame < 50 else [left]

    bodies = after(EyeController(), gazes, body, 80)
    yaws = [math.degrees(math.atan2(*(looked(shown)[i] for i in (0, 2)))) for shown in bodies]
    assert yaws[19] > 14
    assert yaws[49] < -14
    assert yaws[79] > 14
    steps = [between(looked(a), looked(b)) for a, b in pairwise(bodies)]
    assert max(steps) < math.degrees(8.7) * FRAME + 0.1


def test_eyes_follow_a_slow_target_and_jump_by_a_saccade(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    at = [target_at(body, 0, 0)]
    looking, looks = EyeController(), [gaze(body, lambda: at[0])]
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


def test_a_target_that_jumps_during_a_saccade_starts_a_new_saccade(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    at = [target_at(body, -20, 0)]
    looking, looks = EyeController(), [gaze(body, lambda: at[0])]
    bodies = after(looking, looks, body, 10)
    for i, yaw in enumerate((20, 20, -30, -30, -30, -30, -30, -30, -30)):
        at[0] = target_at(body, yaw, 0)
        bodies += after(looking, looks, body, 1, 0.2 + i * FRAME)
    assert max(between(looked(a), looked(b)) for a, b in pairwise(bodies)) < math.degrees(8.7) * FRAME + 0.1
    assert miss(bodies[-1], EYES[0], at[0]) < 1e-3


def test_eyes_fall_behind_a_fast_target_and_catch_up(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    at = [target_at(body, -35, 0)]
    looking, looks = EyeController(), [gaze(body, lambda: at[0])]
    after(looking, looks, body, 10)
    misses = []
    for i in range(12):
        at[0] = target_at(body, -35 + 6.0 * i, 0)
        (shown,) = after(looking, looks, body, 1, 0.2 + i * FRAME)
        misses.append(miss(shown, EYES[0], at[0]))
    assert 1 < max(misses) < 7
    assert sum(each < 0.01 for each in misses) > 3


def test_partial_eye_weights_leave_the_eyes_short_of_the_target(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    for weight, degrees in ((1.0, 20), (0.5, 10), (0.0, 0)):
        half = gaze(body, target_at(body, 20, 0, 1000.0), eyes=weight)
        assert between(looked(after(EyeController(), [half], body, 20)[-1]), FORWARD) == pytest.approx(degrees, abs=0.1)


def test_a_gaze_with_a_small_weight_lies_over_the_one_below(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    below, above = gaze(body, target_at(body, 20, 0, 1e3)), gaze(body, target_at(body, -20, 0, 1e3), eyes=0.25)
    assert between(looked(after(EyeController(), [below, above], body, 20)[-1]), way(10, 0)) < 0.1


@pytest.mark.parametrize("far", [0.0, 0.001, 0.05])
def test_a_target_at_the_eyes_is_harmless(skeleton: Skeleton, far: float) -> None:
    body = Body(skeleton)
    for shown in after(EyeController(), [gaze(body, target_at(body, 0, 0, far), Influence.EYES)], body, 5):
        assert all(math.isfinite(part) for eye in EYES for part in shown.rotation(eye))


def test_eyes_without_a_target_have_their_resting_rotation(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    aside = dict.fromkeys(EYES, from_euler(0.01, 0.02, 0.0))
    shown = EyeController().eyes(GlobalTime(0.0), [], body, aside)
    assert all(between(rotate(shown[eye], FORWARD), rotate(aside[eye], FORWARD)) < 1e-4 for eye in EYES)


def test_a_lid_follows_its_eye() -> None:
    down, up = from_euler(EYE_RANGE, 0.0, 0.0), from_euler(-0.2, 0.0, 0.0)
    weights = lid_weights(dict(zip(EYES, (down, up), strict=True)))
    assert weights["eyeLookDownLeft"] == pytest.approx(math.sin(EYE_RANGE) / EYE_RANGE)
    assert weights["eyeLookUpRight"] == pytest.approx(math.sin(0.2) / math.sin(math.radians(30)))
    assert "eyeLookDownRight" not in weights


def test_a_large_gaze_turn_comes_with_a_blink(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    for degrees, blinks in ((30, []), (36, [2 * FRAME])):
        large: list[float] = []
        looking = EyeController(large.append)
        after(looking, [], body, 2)
        after(looking, [gaze(body, target_at(body, degrees, 0, 1000.0))], body, 20, 2 * FRAME)
        assert large == blinks


def test_saccades_and_blinks_start_with_the_gaze_and_not_with_the_next_frame(skeleton: Skeleton) -> None:
    body, begun = Body(skeleton), 0.033
    target = target_at(body, 36, 0, 1000.0)
    large: list[float] = []
    looking = EyeController(large.append)
    after(looking, [], body, 2)
    looking.note_change(GlobalTime(begun))
    looking.note_change(GlobalTime(0.01))
    angles = [miss(shown, EYES[0], target) for shown in after(looking, [gaze(body, target)], body, 4, 2 * FRAME)]
    done = [saccade_progress(math.radians(36), (2 + frame) * FRAME - begun) for frame in range(4)]
    assert angles == pytest.approx([36 * (1 - part) for part in done], abs=0.01)
    assert large == [begun]


def test_an_unannounced_change_starts_with_its_frame(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    looking, looks = EyeController(), [gaze(body, target_at(body, 20, 0, 1000.0))]
    looking.note_change(GlobalTime(0.01))
    after(looking, [], body, 2)
    (first,) = after(looking, looks, body, 1, 2 * FRAME)
    assert between(looked(first), FORWARD) < 1e-4


amplitudes = st.floats(1e-6, math.pi)
equation = settings(derandomize=True, max_examples=80, deadline=None)


def velocity(amplitude: float, time: float) -> float:
    step = 1e-6
    before, after = (saccade_progress(amplitude, time + way) for way in (-step, step))
    return amplitude * (after - before) / (2 * step)


@pytest.mark.parametrize(("degrees", "milliseconds"), [(0, 21), (5, 32), (10, 43), (20, 65), (40, 109)])
def test_the_duration_is_linear_in_the_amplitude(degrees: float, milliseconds: int) -> None:
    assert 1000 * saccade_duration(math.radians(degrees)) == pytest.approx(milliseconds)


@equation
@given(amplitudes, st.floats(0, 1))
def test_a_saccade_is_symmetric(amplitude: float, share: float) -> None:
    duration = saccade_duration(amplitude)
    passed = share * duration
    whole = saccade_progress(amplitude, passed) + saccade_progress(amplitude, duration - passed)
    assert whole == pytest.approx(1.0, abs=1e-9)


@equation
@given(amplitudes, st.floats(0.02, 0.98))
def test_a_saccade_is_monotonic_and_within_the_peak_velocity(amplitude: float, share: float) -> None:
    assert -1e-6 <= velocity(amplitude, share * saccade_duration(amplitude)) <= PEAK_VELOCITY * (1 + 1e-4)


@pytest.mark.parametrize(("degrees", "peak"), [(2, 158), (5, 312), (10, 465), (15, 498.5), (40, 498.5), (90, 498.5)])
def test_the_peak_velocity_grows_with_the_amplitude_up_to_the_plateau(degrees: float, peak: float) -> None:
    amplitude = math.radians(degrees)
    fastest = max(velocity(amplitude, i / 100 * saccade_duration(amplitude)) for i in range(1, 100))
    assert math.degrees(fastest) == pytest.approx(peak, rel=0.01)


def test_it_starts_and_ends_at_rest() -> None:
    for degrees in (1, 10, 40):
        amplitude = math.radians(degrees)
        assert saccade_progress(amplitude, 0.0) == 0.0
        assert saccade_progress(amplitude, saccade_duration(amplitude)) == 1.0
        assert velocity(amplitude, 1e-6) < 0.01
        assert saccade_progress(amplitude, 99.0) == 1.0
