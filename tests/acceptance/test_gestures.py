"""Gestures, from BML to frames: choice of the hand, start and return."""

from pathlib import Path
from random import Random

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.quaternion import angle, difference
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

BEAT = '<gesture id="{}" lexeme="BEAT" {} start="{}" end="{}"/>'
RIGHT, LEFT, BOTH = (f'mode="{mode}_HAND{"S" * (mode == "BOTH")}"' for mode in ("RIGHT", "LEFT", "BOTH"))
POINT = '<pointing id="p" target="bluebox" {}/>'
FASTEST_STEP = 0.05
"""m between two frames: `speed_limit.WRIST_SPEED` for 20 ms."""

BINDING = """
<gesturebinding>
  <MotionUnitSpec type="gesture">
    <constraints><constraint name="lexeme" value="SHOW"/></constraints>
    <parameterdefaults><parameterdefault name="postStrokeHoldDuration" value="3"/></parameterdefaults>
    <MotionUnit type="Gesture" file="procanimation/offer_right.xml"/>
  </MotionUnitSpec>
  <MotionUnitSpec type="gesture">
    <constraints><constraint name="lexeme" value="SHOW"/></constraints>
    <parameterdefaults>
      <parameterdefault name="postStrokeHoldDuration" value="0"/>
      <parameterdefault name="mirror" value="true"/>
    </parameterdefaults>
    <MotionUnit type="Gesture" file="procanimation/offer_right.xml"/>
  </MotionUnitSpec>
</gesturebinding>
"""


@pytest.fixture
async def watched(pilot: RealizerPilot) -> RealizerPilot:
    pilot.watch()
    return pilot


def moved(pilot: RealizerPilot, side: str) -> float:
    """How far a wrist went away from where it was in the first frame, m."""
    path = pilot.path(f"{side}_wrist")
    return float(np.linalg.norm(path - path[0], axis=1).max())


def largest_step(pilot: RealizerPilot) -> float:
    paths = (pilot.path(f"{side}_wrist") for side in "lr")
    return max(float(np.linalg.norm(np.diff(path, axis=0), axis=1).max()) for path in paths)


def height(pilot: RealizerPilot, side: str, time: float) -> float:
    """Of a wrist in the last frame up to a time, m."""
    times = [frame.time for frame in pilot.frames["alice"]]
    return float(pilot.path(f"{side}_wrist")[int(np.searchsorted(times, time, "right")) - 1][1])


# --- several motions for one behavior (thesis 8.17)


async def test_a_gesture_without_a_mode_uses_the_right_hand(watched: RealizerPilot) -> None:
    watched.block("b", BEAT.format("g", "", 0, 2))
    await watched.advance(2.5)
    assert moved(watched, "r") > 0.2
    assert moved(watched, "l") < 0.02


async def test_a_gesture_uses_the_left_hand_while_the_right_one_is_busy(watched: RealizerPilot) -> None:
    watched.block("busy", POINT.format(RIGHT + ' start="0" end="6"'))
    watched.block("b", BEAT.format("g", "", 1.5, 3.5))
    await watched.advance(7)
    assert watched.feedback.warnings == []
    assert watched.feedback.time("b:g:end") == 3.5
    assert moved(watched, "l") > 0.2


async def test_two_simultaneous_gestures_use_different_hands(watched: RealizerPilot) -> None:
    watched.block("b", BEAT.format("one", "", 0, 2) + BEAT.format("two", "", 0, 2))
    await watched.advance(2.5)
    assert watched.feedback.warnings == []
    assert moved(watched, "r") > 0.2 < moved(watched, "l")


async def test_a_gesture_is_dropped_with_a_warning_if_both_hands_are_busy(watched: RealizerPilot) -> None:
    watched.block("busy", BEAT.format("g", BOTH, 0, 3))
    watched.block("b", BEAT.format("g", "", 1, 2.5))
    await watched.advance(4)
    assert watched.feedback.warnings == [("b:g", "IMPOSSIBLE_TO_SCHEDULE")]


async def test_a_requested_hand_is_not_exchanged(watched: RealizerPilot) -> None:
    watched.block("busy", BEAT.format("g", RIGHT, 0, 3))
    watched.block("b", BEAT.format("g", RIGHT, 1, 2.5))
    await watched.advance(4)
    assert watched.feedback.warnings == [("b:g", "IMPOSSIBLE_TO_SCHEDULE")]


async def test_the_hand_is_chosen_when_the_gesture_starts(watched: RealizerPilot) -> None:
    watched.block("busy", BEAT.format("g", RIGHT, 0, 4))
    watched.block("b", BEAT.format("g", "", 2, 4))
    await watched.advance(1)
    watched.perform('<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="now" composition="REPLACE"/>')
    watched.block("c", BEAT.format("g", "", 1, 3))
    await watched.advance(4)
    assert watched.feedback.warnings == []
    assert moved(watched, "l") < 0.02


@pytest.mark.parametrize(("end", "hand"), [("3", "r"), ("1.4", "l")])
async def test_the_shortest_motion_plays_if_time_is_short(tmp_path: Path, end: str, hand: str) -> None:
    (tmp_path / "gesturebinding.xml").write_text(BINDING)
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,))) as pilot:
        pilot.watch()
        pilot.block("b", f'<gesture id="g" lexeme="SHOW" start="0" end="{end}"/>')
        await pilot.advance(4)
        assert pilot.feedback.warnings == []
        assert pilot.feedback.time("b:g:end") == float(end)
        assert moved(pilot, hand) > 0.15
        assert moved(pilot, "lr".replace(hand, "")) < 0.02


# --- a running gesture whose times move


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("what", ['gesture lexeme="BEAT"', 'pointing target="greensphere"'])
async def test_repeated_retiming_of_a_running_gesture_causes_no_jump(
    watched: RealizerPilot, what: str, seed: int
) -> None:
    random = Random(seed)
    for name in ("stroke", "end"):
        watched.predict("test", name, {"stroke": 1.5, "end": 3.0}[name])
    watched.block(
        "b",
        f'<{what} id="g" {BOTH} start="0.2" stroke="anticipators:test:stroke" end="anticipators:test:end"/>',
    )
    await watched.tick()
    while watched.now < 6:
        await watched.advance(random.choice((0.05, 0.1, 0.2, 0.4)))
        stroke = watched.now + random.uniform(0.05, 1.2)
        watched.predict("test", "stroke", stroke)
        watched.predict("test", "end", stroke + random.uniform(0.4, 2.0))
    await watched.advance(4)
    told = watched.feedback
    assert told.time("b:g:stroke") < told.time("b:g:end")
    assert 0.005 < largest_step(watched) < FASTEST_STEP
    for side in "lr":
        path = watched.path(f"{side}_wrist")
        assert np.linalg.norm(path[-1] - path[0]) < 0.03


async def test_a_delayed_stroke_slows_the_preparation_down(watched: RealizerPilot) -> None:
    watched.predict("test", "hit", 1.2)
    watched.block("b", f'<gesture id="g" lexeme="BEAT" {RIGHT} start="0.2" stroke="anticipators:test:hit"/>')
    await watched.advance(0.7)
    halfway = height(watched, "r", 0.7)
    watched.predict("test", "hit", 2.4)
    await watched.advance(5)
    rising = [height(watched, "r", 0.7 + 0.04 * i) for i in range(20)]
    assert rising == pytest.approx(sorted(rising), abs=0.003)
    assert rising[0] == pytest.approx(halfway, abs=0.02)
    assert watched.feedback.time("b:g:stroke") == 2.4


# --- one after the other (thesis 12.1)


@pytest.mark.parametrize("first", [f'<gesture id="g" lexeme="BEAT" {RIGHT}/>', POINT.format(RIGHT)])
@pytest.mark.parametrize("second", [f'<gesture id="g" lexeme="OFFER" {RIGHT}/>', POINT.format(RIGHT)])
async def test_the_next_chunk_starts_from_the_retracting_hand(watched: RealizerPilot, first: str, second: str) -> None:
    watched.block("one", first)
    watched.block("two", second, **{"bmla:chunkAfter": "one"})
    await watched.tick()
    which, other = ("p" if "pointing" in block else "g" for block in (first, second))
    planned = watched.feedback.predicted(f"two:{other}:ready") - watched.feedback.predicted(f"two:{other}:start")
    await watched.advance(8)
    told = watched.feedback
    assert told.warnings == []
    assert told.time(f"two:{other}:start") == told.time(f"one:{which}:relax") == told.time(f"one:{which}:end")
    assert abs(told.time(f"two:{other}:ready") - told.time(f"two:{other}:start") - planned) > 0.05
    assert largest_step(watched) < FASTEST_STEP


async def test_a_hand_that_the_next_gesture_does_not_use_retracts_completely(
    watched: RealizerPilot,
) -> None:
    watched.block("one", BEAT.format("g", BOTH, 0, 3))
    watched.block("two", POINT.format(RIGHT + ' ready="2.6" relax="4"'), **{"bmla:chunkAfter": "one"})
    await watched.advance(8)
    assert largest_step(watched) < FASTEST_STEP
    rest = height(watched, "l", 0.0)
    assert height(watched, "l", watched.feedback.time("two:p:relax")) == pytest.approx(rest, abs=0.02)
    assert height(watched, "r", watched.feedback.time("two:p:relax")) > rest + 0.1


async def test_a_gesture_over_crossed_arms_returns_to_crossed_arms(watched: RealizerPilot) -> None:
    watched.block(
        "base", '<postureShift id="s" start="0" end="1.5"><pose part="ARMS" lexeme="ARMS_CROSSED"/></postureShift>'
    )
    await watched.advance(3)
    crossed = [watched.path(f"{side}_wrist")[-1] for side in "lr"]
    watched.block("b", BEAT.format("g", RIGHT, 0, 2) + POINT.format(LEFT + ' start="2.5" end="5"'))
    await watched.advance(7)
    assert watched.feedback.warnings == []
    assert largest_step(watched) < FASTEST_STEP
    for side, before in zip("lr", crossed, strict=True):
        path = watched.path(f"{side}_wrist")
        assert np.linalg.norm(path[150:] - before, axis=1).max() > 0.15
        assert np.linalg.norm(path[-1] - before) < 0.03


async def test_the_preparation_of_a_gesture_depends_on_the_posture(
    watched: RealizerPilot,
) -> None:
    watched.block("one", f'<gesture id="g" lexeme="BEAT" {RIGHT}/>')
    await watched.advance(4)
    watched.block(
        "base", '<postureShift id="s" start="0" end="1.5"><pose part="ARMS" lexeme="ARMS_CROSSED"/></postureShift>'
    )
    await watched.advance(3)
    watched.block("two", f'<gesture id="g" lexeme="BEAT" {RIGHT}/>')
    await watched.advance(4)
    told = watched.feedback
    hanging, crossed = (told.time(f"{block}:g:ready") - told.time(f"{block}:g:start") for block in ("one", "two"))
    assert crossed < hanging - 0.05


@pytest.mark.parametrize("named", ["RIGHT_HAND", "LEFT_HAND"])
async def test_a_gesture_without_a_hand_leaves_the_hand_that_a_later_one_of_the_block_names(
    pilot: RealizerPilot, named: str
) -> None:
    pilot.block(
        "b",
        '<gesture id="any" lexeme="BEAT" start="0" end="4"/>'
        f'<gesture id="named" lexeme="BEAT" mode="{named}" start="1" end="3"/>',
    )
    await pilot.advance(5)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:named:end") == pytest.approx(3)
    assert pilot.feedback.time("b:any:end") == pytest.approx(4)


async def test_a_gesture_without_a_hand_uses_its_first_choice_if_a_later_one_starts_after_it(
    pilot: RealizerPilot,
) -> None:
    pilot.watch()
    pilot.block(
        "b",
        '<gesture id="any" lexeme="BEAT" start="0" end="2"/>'
        '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND" start="2"/>',
    )
    await pilot.advance(1.2)
    first, last = pilot.bodies()[0], pilot.bodies()[-1]
    assert angle(difference(first.rotation("r_elbow"), last.rotation("r_elbow"))) > 0.2
    assert angle(difference(first.rotation("l_elbow"), last.rotation("l_elbow"))) < 0.1
