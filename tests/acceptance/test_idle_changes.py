"""Changes of idle animation: how often and how deep a character breathes, blinks, glances and shifts its weight."""

from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import BML
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

FRAMES = 50
"""Frames per second."""


def document(*changes: str) -> str:
    inside = "".join(f'<rr:idleChange id="c{number}" {change}/>' for number, change in enumerate(changes))
    return f'<bml xmlns="{BML}" xmlns:rr="urn:reactive-realizer:1" id="b">{inside}</bml>'


def breath(pilot: RealizerPilot, begin: float, end: float) -> np.ndarray:
    """How far the shoulders are raised, rad, in frames between two times."""
    bodies = pilot.bodies()[round(begin * FRAMES) : round(end * FRAMES)]
    return np.array([-2.0 * body.rotation("r_sternoclavicular")[3] for body in bodies])


def breaths(pilot: RealizerPilot, begin: float, end: float) -> int:
    air = breath(pilot, begin, end)
    return int(((air[1:-1] > air[:-2]) & (air[1:-1] >= air[2:])).sum())


def blinks(pilot: RealizerPilot, begin: float, end: float) -> int:
    frames = next(iter(pilot.frames.values()))[round(begin * FRAMES) : round(end * FRAMES)]
    character = next(iter(pilot.realizer.characters.values()))
    lid = character.humanoid.avatar.morphs.index("eyeBlinkLeft")
    shut = np.array([frame.weights[lid] > 0.5 for frame in frames])
    return int((shut[1:] & ~shut[:-1]).sum())


def glances(pilot: RealizerPilot, begin: float, end: float) -> int:
    """How often the left eye jumps by more than a degree in a tenth of a second, there and back, between two times."""
    bodies = pilot.bodies()[round(begin * FRAMES) : round(end * FRAMES)]
    turns = np.degrees([2.0 * np.array(body.rotation("l_eyeball_joint")[1:3]) for body in bodies])
    jumps = np.linalg.norm(turns[5:] - turns[:-5], axis=1) > 1.0
    return int((jumps[1:] & ~jumps[:-1]).sum()) // 2


def lids(pilot: RealizerPilot, begin: float, end: float) -> float:
    """How far a lid is closed at most between two times."""
    lid = next(iter(pilot.realizer.characters.values())).humanoid.avatar.morphs.index("eyeBlinkLeft")
    frames = next(iter(pilot.frames.values()))[round(begin * FRAMES) : round(end * FRAMES)]
    return float(max(frame.weights[lid] for frame in frames))


def sides(pilot: RealizerPilot, begin: float, end: float) -> np.ndarray:
    """How far the pelvis is to the left of the middle, m, in frames between two times."""
    bodies = pilot.bodies()[round(begin * FRAMES) : round(end * FRAMES)]
    pelvis, left, right = (
        np.array([body.transform(joint).position[0] for body in bodies])
        for joint in ("HumanoidRoot", "l_ankle", "r_ankle")
    )
    return np.asarray(pelvis - 0.5 * (left + right))


def shifts(pilot: RealizerPilot, begin: float, end: float) -> int:
    """How often the weight goes to the other foot between two times."""
    left = sides(pilot, begin, end) > 0.0
    return int((left[1:] != left[:-1]).sum())


async def test_breaths_become_as_frequent_and_as_deep_as_asked_for_and_stay_so() -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        await pilot.advance(8)
        pilot.perform(
            document('parameter="BREATHING_RATE" value="60" end="1"', 'parameter="BREATHING_DEPTH" value="2"')
        )
        await pilot.advance(17)
        assert breaths(pilot, 0, 8) <= 3
        assert breaths(pilot, 10, 25) == pytest.approx(15, abs=2)
        assert breath(pilot, 10, 25).max() > 1.5 * breath(pilot, 0, 8).max()
        assert pilot.feedback.status("b") == "DONE"
        assert pilot.feedback.time("b:c0:end") == pytest.approx(9.0)


async def test_blinks_become_more_frequent_and_none_at_0() -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document('parameter="BLINK_RATE" value="60" end="0.1"'))
        await pilot.advance(20)
        pilot.perform(document('parameter="BLINK_RATE" value="0" end="0.1"').replace('id="b"', 'id="d"'))
        await pilot.advance(20)
        assert 12 <= blinks(pilot, 0, 20) <= 28
        assert blinks(pilot, 21, 40) == 0


async def test_glances_become_more_frequent_and_none_at_0() -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document('parameter="GLANCE_RATE" value="60" end="0.1"'))
        await pilot.advance(40)
        pilot.perform(document('parameter="GLANCE_RATE" value="0" end="0.1"').replace('id="b"', 'id="d"'))
        await pilot.advance(30)
    assert glances(pilot, 10, 40) >= 20
    assert glances(pilot, 45, 70) == 0


async def test_blinks_close_the_lids_as_far_as_asked_for() -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document('parameter="BLINK_DEPTH" value="0.4" end="0.1"'))
        await pilot.advance(20)
    assert 0.3 < lids(pilot, 0.2, 20) < 0.45


async def test_the_weight_shifts_as_often_and_as_far_as_asked_for_and_not_at_0() -> None:
    often = document('parameter="WEIGHT_SHIFT_RATE" value="20" end="1"')
    far = document('parameter="WEIGHT_SHIFT_DEPTH" value="2" end="1"').replace('id="b"', 'id="far"')
    never = document('parameter="WEIGHT_SHIFT_RATE" value="0" end="0.2"').replace('id="b"', 'id="never"')
    async with open_pilot() as pilot:
        pilot.watch()
        for each in (often, far, never):
            pilot.perform(each)
            await pilot.advance(30)
        assert shifts(pilot, 0, 30) == pytest.approx(10, abs=2)
        assert np.abs(sides(pilot, 35, 60)).max() > 1.4 * np.abs(sides(pilot, 0, 30)).max()
        assert np.ptp(sides(pilot, 62, 90)) < 0.002
        assert pilot.feedback.warnings == []


async def test_a_behavior_shifts_the_weight_to_the_foot_that_it_names_and_it_stays_there() -> None:
    asked = '<rr:weightShift id="w" side="-1" start="1"/><rr:weightShift id="v" side="0.8" start="w:end+3"/>'
    still = '<rr:idleChange id="c" parameter="WEIGHT_SHIFT_RATE" value="0" end="0.1"/>'
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(f'<bml xmlns="{BML}" xmlns:rr="urn:reactive-realizer:1" id="b">{still}{asked}</bml>')
        await pilot.advance(12)
        assert pilot.feedback.time("b:w:end") == pytest.approx(2.8)
        assert sides(pilot, 2.9, 5.7).max() < -0.02
        assert sides(pilot, 7.7, 12).min() > 0.015
        speeds = np.diff(sides(pilot, 0, 12)) * FRAMES
        assert np.abs(np.diff(speeds)).max() < 0.004


async def test_the_event_of_an_anticipator_triggers_a_shift_which_follows_it_until_it_begins() -> None:
    shift = '<rr:weightShift id="w" side="1" start="anticipators:partner:nod"/>'
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.predict("partner", "nod", 2.0)
        pilot.perform(f'<bml xmlns="{BML}" xmlns:rr="urn:reactive-realizer:1" id="b">{shift}</bml>')
        await pilot.advance(1.0)
        pilot.predict("partner", "nod", 3.0)
        await pilot.advance(5)
        assert np.ptp(sides(pilot, 0, 3)) < 0.002
        assert sides(pilot, 4.9, 6).min() > 0.02


async def test_a_weight_shift_that_is_interrupted_stops_softly() -> None:
    there, back = (f'<rr:weightShift id="w" side="{side}" start="0" end="4"/>' for side in (-1, 1))
    async with open_pilot() as pilot:
        pilot.watch()
        for inside, id_, time in ((there, "there", 5), (back, "back", 2)):
            pilot.perform(f'<bml xmlns="{BML}" xmlns:rr="urn:reactive-realizer:1" id="{id_}">{inside}</bml>')
            await pilot.advance(time)
        pilot.block("all", composition="REPLACE")
        await pilot.advance(3)
    assert sides(pilot, 4, 5).max() < -0.02
    assert np.abs(np.diff(np.diff(sides(pilot, 5, 10)) * FRAMES)).max() < 0.004
    assert np.ptp(sides(pilot, 8, 10)) < 0.002
    assert sides(pilot, 8, 10).max() < 0.02


async def test_a_character_that_sits_has_no_weight_to_shift() -> None:
    async with open_pilot() as pilot:
        pilot.perform(
            f'<bml xmlns="{BML}" xmlns:rr="urn:reactive-realizer:1" id="b"><postureShift id="p">'
            '<stance type="SITTING"/></postureShift><rr:weightShift id="w" side="1" start="p:end"/></bml>'
        )
        await pilot.advance(1)
        assert "no weight on its feet to shift while SITTING" in pilot.feedback.of("warningFeedback")[0].text


async def test_a_value_beyond_what_a_body_does_is_refused_with_its_limit() -> None:
    async with open_pilot() as pilot:
        pilot.perform(document('parameter="WEIGHT_SHIFT_DEPTH" value="3"'))
        await pilot.advance(0.1)
        assert "WEIGHT_SHIFT_DEPTH is at most 2.00, not 3.00" in pilot.feedback.of("warningFeedback")[0].text


async def test_a_later_change_takes_over_and_a_replacement_of_everything_returns_to_usual() -> None:
    deep, shallow = (
        'parameter="BREATHING_DEPTH" value="{}" start="{}" end="{}"'.format(*each) for each in ((4, 0, 6), (0, 1, 2))
    )
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(document(deep, shallow))
        await pilot.advance(10)
        assert breath(pilot, 3, 10).max() < 0.002
        pilot.block("all", composition="REPLACE")
        await pilot.advance(6)
        assert breath(pilot, 11, 16).max() > 0.01


async def test_a_character_without_idle_animation_says_so(tmp_path: Path) -> None:
    human = tmp_path / "human.toml"
    human.write_text('[character.alice]\navatar = "avatars/female.glb"\nidle = false\n')
    async with open_pilot(SceneOptions(human, voice="text")) as pilot:
        pilot.perform(document('parameter="BLINK_RATE" value="3"'))
        await pilot.advance(1)
        assert "no idle animation" in pilot.feedback.of("warningFeedback")[0].text


@pytest.mark.parametrize(
    ("change", "word"), [('parameter="SWEATING" value="1"', "SWEATING"), ('value="1"', "parameter")]
)
async def test_an_unknown_parameter_is_refused(change: str, word: str) -> None:
    async with open_pilot() as pilot:
        pilot.perform(document(change))
        await pilot.advance(0.1)
        assert word in pilot.feedback.of("warningFeedback")[0].text
