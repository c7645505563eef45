"""What SmartBody's elements do in frames."""

from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from reactive_realizer.testing.pilot import RealizerPilot

from .conftest import OpenStill

CLIP = """<SkeletonInterpolator parts="l_shoulder" rotationEncoding="quaternions" encoding="R">
0 1 0 0 0
0.5 0.5 -0.866 0 0
1 1 0 0 0
</SkeletonInterpolator>"""


def act(inside: str) -> str:
    return f"<act><bml>{inside}</bml></act>"


def weights(pilot: RealizerPilot, morph: str) -> npt.NDArray[np.float64]:
    """The weight of a morph target in each frame."""
    (character,) = pilot.realizer.characters.values()
    number = character.humanoid.avatar.morphs.index(morph)
    return np.array([frame.weights[number] for frame in pilot.frames["alice"]])


def turns(pilot: RealizerPilot, joint: str) -> npt.NDArray[np.float64]:
    """The rotation of a joint in each frame, (F, 4)."""
    return np.array([body.rotation(joint) for body in pilot.bodies()])


async def test_action_units_of_the_mouth_are_shown_together(open_still: OpenStill) -> None:
    units = ("10", "26", "1_left")
    async with open_still() as pilot:
        pilot.perform(act("".join(f'<face type="facs" au="{unit}" amount="0.8" end="3"/>' for unit in units)))
        await pilot.advance(3)
    assert pilot.feedback.warnings == []
    for morph in ("jawOpen", "mouthUpperUpLeft", "browInnerUp"):
        assert weights(pilot, morph).max() > 0.2


async def test_noise_goes_on_after_everything_else(open_still: OpenStill) -> None:
    async with open_still() as pilot:
        pilot.perform(act('<sbm:noise sbm:joint-range="l_shoulder" sbm:scale="0.3" sbm:frequency="1"/>'))
        await pilot.advance(8)
        shown = turns(pilot, "l_shoulder")
        still = turns(pilot, "r_shoulder")
    assert np.ptp(shown[300:], axis=0).max() > 0.02
    assert np.ptp(still[300:], axis=0).max() < 0.005


async def test_a_character_walks_to_a_thing_picks_it_up_and_puts_it_down(open_still: OpenStill) -> None:
    async with open_still() as pilot:
        pilot.move("cup", (0.0, 1.1, 1.5))
        pilot.perform(act('<sbm:reach sbm:action="pick-up" sbm:use-locomotion="true" target="cup"/>'))
        await pilot.advance(6)
        carried = pilot.realizer.world.position("cup")
        pilot.perform(act('<sbm:reach sbm:action="put-down" sbm:target-pos="-0.2 1.1 1.5"/>'))
        await pilot.advance(4)
    assert pilot.feedback.warnings == []
    assert carried is not None
    assert carried[1] < 0.9
    assert pilot.realizer.world.position("cup") == (-0.2, 1.1, 1.5)


@pytest.mark.parametrize(
    "dropped", ['<sbm:grab sbm:release-pawn="true"/>', '<sbm:reach sbm:action="put-down" sbm:reach-finish="true"/>']
)
async def test_a_hand_lets_go_of_what_it_carries_wherever_it_is(open_still: OpenStill, dropped: str) -> None:
    async with open_still() as pilot:
        pilot.move("cup", (-0.2, 1.15, 0.4))
        pilot.perform(act('<sbm:reach sbm:action="pick-up" target="cup"/>'))
        await pilot.advance(5)
        carried = pilot.realizer.world.position("cup")
        pilot.perform(act(dropped))
        await pilot.advance(0.5)
        pilot.perform(act('<sbm:reach sbm:action="touch" target="-0.2 1.15 0.4"/>'))
        await pilot.advance(1)
        left = pilot.realizer.world.position("cup")
    assert pilot.feedback.warnings == []
    assert carried is not None
    assert left == pytest.approx(carried, abs=0.01)


@pytest.mark.parametrize("element", ["animation", "gesture", "blend", "sbm:states"])
async def test_what_names_a_clip_plays_the_file_of_that_name(
    open_still: OpenStill, tmp_path: Path, element: str
) -> None:
    folder = tmp_path / "clips"
    folder.mkdir()
    (folder / "Brad@Raise.xml").write_text(CLIP)
    async with open_still(folder) as pilot:
        pilot.perform(act(f'<{element} name="Brad@Raise"/>'))
        await pilot.advance(2)
        raised = turns(pilot, "l_shoulder")
    assert pilot.feedback.warnings == []
    assert np.abs(raised[:, 1]).max() > 0.5


MOTION = """SkMotion
channels 2
l_shoulder Quat
l_elbow Quat
frames 3
kt 0 fr 0 0 -1.5 0 -0.2 0
kt 0.5 fr 0 0 0.5 0 -0.2 0
kt 1.5 fr 0 0 -1.5 0 -0.2 0
ready time: 0.4
emphasis time: 0.5
relax time: 0.9
"""


async def test_the_emphasis_of_a_motion_is_where_the_stroke_is_tied(open_still: OpenStill, tmp_path: Path) -> None:
    (tmp_path / "Brad@Raise.skm").write_text(MOTION)
    async with open_still(tmp_path) as pilot:
        speech = '<speech id="s">Up with <mark name="w"/>all your hands</speech>'
        pilot.perform(act(f'{speech}<animation id="a" name="Brad@Raise" stroke="s:w+1"/>'))
        await pilot.advance(3)
        told, raised = pilot.feedback, turns(pilot, "l_shoulder")
    assert told.warnings == []
    stroke = told.time("document1:a:stroke")
    assert stroke == told.time("document1:s:w") + 1.0
    assert np.argmax(np.abs(raised[:, 3])) == pytest.approx(50 * stroke, abs=2)


@pytest.mark.parametrize(("speed", "duration"), [("2", 0.75), ("0.5", 3.0)])
async def test_an_animation_plays_at_its_speed(
    open_still: OpenStill, tmp_path: Path, speed: str, duration: float
) -> None:
    (tmp_path / "Brad@Raise.skm").write_text(MOTION)
    async with open_still(tmp_path) as pilot:
        pilot.perform(act(f'<animation id="a" name="Brad@Raise" speed="{speed}"/>'))
        await pilot.advance(4)
        start, end = (pilot.feedback.time(f"document1:a:{point}") for point in ("start", "end"))
    assert pilot.feedback.warnings == []
    assert end - start == pytest.approx(duration, abs=0.011)


async def test_a_clip_that_is_queued_starts_when_the_one_before_it_ends(open_still: OpenStill, tmp_path: Path) -> None:
    (tmp_path / "Brad@Raise.skm").write_text(MOTION)
    queued = '<animation id="b" name="Brad@Raise" sbm:schedule-mode="Queued"/>'
    async with open_still(tmp_path) as pilot:
        pilot.perform(act(f'<animation id="a" name="Brad@Raise" start="0.5"/>{queued}'))
        await pilot.advance(5)
    assert pilot.feedback.warnings == []
    assert (
        pilot.feedback.time("document1:b:start")
        == pilot.feedback.time("document1:a:end")
        == pytest.approx(2.0, abs=0.011)
    )


@pytest.mark.parametrize("strategy", ["convex", "embr", "smartbody"])
@pytest.mark.parametrize(("own", "start"), [("5", 5.0), ("0.5", 1.5)])
async def test_a_clip_that_is_queued_starts_no_sooner_than_its_own_start(
    open_still: OpenStill, tmp_path: Path, own: str, start: float, strategy: str
) -> None:
    (tmp_path / "Brad@Raise.skm").write_text(MOTION)
    queued = f'<animation id="b" name="Brad@Raise" sbm:schedule-mode="Queued" start="{own}"/>'
    async with open_still(tmp_path, strategy=strategy) as pilot:
        pilot.perform(act(f'<animation id="a" name="Brad@Raise"/>{queued}'))
        await pilot.advance(8)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("document1:b:start") == pytest.approx(start, abs=0.011)


async def test_a_gaze_that_fades_out_is_on_its_target_until_then(open_still: OpenStill) -> None:
    async with open_still() as pilot:
        pilot.move("aside", (1.0, 1.6, 1.0))
        pilot.perform(act('<gaze id="g" target="aside" start="0" end="4" sbm:fade-out="1.5"/>'))
        await pilot.advance(5)
        aside = np.abs(turns(pilot, "skullbase")[:, 2])
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("document1:g:relax") == pytest.approx(2.5)
    assert aside[120] == pytest.approx(aside[75], abs=0.02)
    assert 0.2 * aside[120] < aside[160] < 0.8 * aside[120]
    assert aside[-1] < 0.05


@pytest.mark.parametrize("fade", ["2", "5", "1.98"])
async def test_a_gaze_with_a_fade_that_is_too_long_keeps_its_end(open_still: OpenStill, fade: str) -> None:
    async with open_still() as pilot:
        pilot.move("aside", (1.0, 1.6, 1.0))
        pilot.perform(act(f'<gaze id="g" target="aside" start="1" end="3" sbm:fade-out="{fade}"/>'))
        await pilot.advance(5)
    assert len(pilot.feedback.warnings) == 1
    assert pilot.feedback.time("document1:g:end") == pytest.approx(3.0)


async def test_the_posture_of_a_body_may_be_the_first_frame_of_a_motion(open_still: OpenStill, tmp_path: Path) -> None:
    (tmp_path / "Brad@Idle02.skm").write_text(MOTION.replace("kt 0 fr 0 0 -1.5", "kt 0 fr 0 0 -0.9"))
    async with open_still(tmp_path) as pilot:
        pilot.perform(act('<body posture="Brad@Idle02"/>'))
        await pilot.advance(3)
        shown = turns(pilot, "l_shoulder")
    assert pilot.feedback.warnings == []
    assert 2.0 * np.degrees(np.arcsin(shown[-1, 3])) == pytest.approx(90.0 - np.degrees(0.9), abs=3.0)


async def head_turns(open_still: OpenStill, attributes: str) -> npt.NDArray[np.float64]:
    """The turn of the head while a movement plays, down and to the left, rad, (F, 2)."""
    async with open_still() as pilot:
        pilot.perform(act(f'<head id="h" {attributes} end="3"/>'))
        await pilot.advance(3.5)
        joints = (turns(pilot, "skullbase"), turns(pilot, "vc4"))
    assert pilot.feedback.warnings == []
    return sum((2.0 * np.arcsin(turn[:, 1:3] * np.sign(turn[:, :1])) for turn in joints), np.zeros(2))


def peaks(way: npt.NDArray[np.float64]) -> list[float]:
    """The greatest values of a course, in order."""
    inner = range(1, len(way) - 1)
    return [float(way[i]) for i in inner if way[i - 1] < way[i] >= way[i + 1] and way[i] > 0.002]


async def test_a_wiggle_nods_and_dies_away_in_smaller_nods(open_still: OpenStill) -> None:
    down, left = (await head_turns(open_still, 'type="WIGGLE" sbm:warp="1" sbm:accel="1.5" amount="0.5"')).T
    largest, *others = peaks(down)
    assert np.degrees(largest) == pytest.approx(18.0, abs=3.0)
    assert others
    assert max(others) < 0.4 * largest
    assert down.min() > -0.1 * largest
    assert np.abs(left).max() < 0.01


@pytest.mark.parametrize(("pitch", "sides"), [("1", {"left"}), ("0", {"left", "right"}), ("-1", {"right"})])
async def test_the_pitch_of_a_waggle_says_to_which_sides_it_goes(
    open_still: OpenStill, pitch: str, sides: set[str]
) -> None:
    down, left = (await head_turns(open_still, f'type="WAGGLE" sbm:pitch="{pitch}" amount="0.5"')).T
    far = {"left": np.degrees(left.max()), "right": np.degrees(-left.min())}
    assert {side for side, angle in far.items() if angle > 3.0} == sides
    assert {side for side, angle in far.items() if angle > 1.0} == sides
    assert np.abs(down).max() < 0.01
