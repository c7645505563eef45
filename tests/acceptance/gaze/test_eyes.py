"""Eyes in gazes (BML 1.0: gaze; thesis 4.2.2), in frames."""

import math
from itertools import pairwise

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.quaternion import angle, difference, rotate
from reactive_realizer.embodiment.vector import FORWARD
from reactive_realizer.engines.animation.gaze.eye_controller import saccade_duration, saccade_progress
from reactive_realizer.engines.animation.gaze.eyes import EYE_RANGE
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .seen import EYES, FAR, FRAME, GLANCE, PLATEAU, at, between, miss, put, sight, speeds


@pytest.mark.parametrize("influence", ["EYES", "HEAD", "SHOULDER", "WAIST", "WHOLE"])
async def test_the_eyes_are_on_the_target_while_the_head_still_turns_and_until_it_relaxes(
    pilot: RealizerPilot, influence: str
) -> None:
    target = put(pilot, "t", 25, 10)
    pilot.block("b", f'<gaze id="g" target="t" influence="{influence}" start="0.2"/>')
    await pilot.advance(4)
    there = at(pilot, pilot.feedback.time("b:g:start") + saccade_duration(math.radians(30)) + FRAME)
    relax = at(pilot, pilot.feedback.time("b:g:relax"))
    assert max(miss(body, target) for body in pilot.bodies()[there:relax]) < 0.5


async def test_a_gaze_in_the_first_frame_sets_out_from_rest() -> None:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.watch()
        pilot.block("b", '<gaze id="g" target="bluebox" influence="EYES" start="0"/>')
        await pilot.advance(0.2)
        target = (-1.2, 1.2, 1.5)  # in the default scene
        misses = [miss(body, target) for body in pilot.bodies()]
        assert misses[0] > 10
        assert misses[0] > misses[1] > misses[2] > misses[-1]
        assert misses[-1] < 3  # it is almost out of the range of the eyes


@pytest.mark.parametrize("head", ['lexeme="NOD" repetition="4" amount="1"', 'lexeme="SHAKE" repetition="4" amount="1"'])
async def test_the_eyes_stay_on_the_target_while_the_head_nods_and_shakes(pilot: RealizerPilot, head: str) -> None:
    target = put(pilot, "t", -15, 5)
    pilot.block("b", f'<gaze id="g" target="t" start="0" end="8"/><head id="h" {head} start="g:ready"/>')
    await pilot.advance(6)
    shown = pilot.bodies()[at(pilot, 0.5) : at(pilot, 6)]
    noses = [sight(body, "skullbase") for body in shown]
    assert max(between(a, noses[0]) for a in noses) > 3
    assert max(miss(body, target) for body in shown) < 0.5


async def test_the_eyes_arrive_before_the_head_and_it_does_not_overshoot(pilot: RealizerPilot) -> None:
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
async def test_the_duration_of_a_saccade_is_linear_and_its_speed_is_limited(pilot: RealizerPilot, degrees: int) -> None:
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


async def test_the_eyes_stay_on_the_target_while_a_hurried_head_falls_behind(pilot: RealizerPilot) -> None:
    target = put(pilot, "t", 38, 0)
    pilot.block("b", '<gaze id="g" target="t" influence="WAIST" start="0" ready="0.06" relax="1" end="1.5"/>')
    await pilot.advance(1)
    shown = pilot.bodies()
    there = at(pilot, pilot.feedback.time("b:g:start") + saccade_duration(math.radians(40)) + FRAME)
    assert max(miss(body, target) for body in shown[there:]) < 0.5
    assert max(angle(difference(a.rotation("vc4"), b.rotation("vc4"))) for a, b in pairwise(shown)) < 0.17


async def test_the_eyes_reach_a_far_target_with_the_head(pilot: RealizerPilot) -> None:
    target = put(pilot, "t", 100, 10)
    pilot.block("b", '<gaze id="g" target="t" influence="SHOULDER" start="0" end="4"/>')
    await pilot.advance(3)
    shown = pilot.bodies()
    assert max(math.degrees(angle(body.rotation(eye))) for body in shown for eye in EYES) < 40.6
    assert miss(shown[at(pilot, 2)], target) < 0.5


async def test_a_gaze_ends_with_a_saccade_and_the_head_follows(pilot: RealizerPilot) -> None:
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


def lids(pilot: RealizerPilot, *morphs: str) -> list[float]:
    """The weights of morphs in the last frame."""
    names = pilot.realizer.characters["alice"].humanoid.avatar.morphs
    return [float(pilot.frames["alice"][-1].weights[names.index(morph)]) for morph in morphs]


@pytest.mark.parametrize(
    ("pitch", "morph", "other", "weight"),
    [
        (15, "eyeLookUp", "eyeLookDown", 0.52),
        (35, "eyeLookUp", "eyeLookDown", 1),
        (-25, "eyeLookDown", "eyeLookUp", 0.6),
    ],
)
async def test_the_lids_follow_the_eyes(
    pilot: RealizerPilot, pitch: int, morph: str, other: str, weight: float
) -> None:
    put(pilot, "t", 0, pitch)
    pilot.block("b", '<gaze id="g" target="t" influence="EYES" start="0" end="4"/>')
    await pilot.advance(1)
    both = [f"{morph}Left", f"{morph}Right"]
    assert lids(pilot, *both) == pytest.approx([weight, weight], abs=0.05)
    assert lids(pilot, f"{other}Left", f"{other}Right") == [0, 0]


async def test_a_lid_follows_its_eye_within_the_same_frame(pilot: RealizerPilot) -> None:
    put(pilot, "t", 0, -25)
    pilot.block("b", '<gaze id="g" target="t" influence="EYES" start="0.2" end="4"/>')
    await pilot.advance(0.5)
    lid = pilot.realizer.characters["alice"].humanoid.avatar.morphs.index("eyeLookDownLeft")
    lowered = [float(frame.weights[lid]) for frame in pilot.frames["alice"]]
    looks = [max(0.0, -rotate(body.rotation(EYES[0]), FORWARD)[1] / EYE_RANGE) for body in pilot.bodies()]
    assert lowered == pytest.approx(looks, abs=1e-6)
    # While the eye is on its way, too.
    assert sum(0.01 < weight < 0.59 for weight in lowered) >= 3
