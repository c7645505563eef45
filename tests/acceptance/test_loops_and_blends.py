"""Clips that are played over and over, added to other motion, or mixed by parameters, in frames and feedback."""

from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from reactive_realizer.embodiment.quaternion import Quat, angle, conjugate, multiply
from reactive_realizer.testing.pilot import RealizerPilot

from .conftest import OpenStill

Array = npt.NDArray[np.float64]


def clip(*rows: tuple[float, float], joint: str = "l_shoulder", points: str = "") -> str:
    """A clip in which a joint turns about x, by an angle (rad) at each time (s)."""
    keys = "\n".join(f"{time} 1 0 0 {turn}" for time, turn in rows)
    return (
        f'<SkeletonInterpolator parts="{joint}" rotationEncoding="axisangles" encoding="R">'
        f"{points}\n{keys}</SkeletonInterpolator>"
    )


def act(inside: str) -> str:
    return f"<act><bml id='b'>{inside}</bml></act>"


def about_x(pilot: RealizerPilot, since: float = 0.0, until: float = 1e9) -> Array:
    """The turn of the shoulder about x in each frame between two times (s), rad."""
    rotations = np.array(
        [
            body.rotation("l_shoulder")
            for body, frame in zip(pilot.bodies(), pilot.frames["alice"], strict=True)
            if since <= frame.time < until
        ]
    )
    turns: Array = 2.0 * np.arctan2(rotations[:, 1], rotations[:, 0])
    return turns


@pytest.fixture
def assets(tmp_path: Path) -> Path:
    (tmp_path / "wave.xml").write_text(clip((0.0, -0.2), (0.5, -1.0), (1.0, -0.2)))
    (tmp_path / "rise.xml").write_text(clip((0.0, -0.2), (1.0, -0.9)))
    (tmp_path / "low.xml").write_text(
        clip((0.0, 0.0), (1.0, -0.5), (2.0, 0.0), points='<KeyPosition id="top" time="1"/>')
    )
    (tmp_path / "high.xml").write_text(
        clip((0.0, 0.0), (1.5, -1.5), (4.0, 0.0), points='<KeyPosition id="top" time="1.5"/>')
    )
    (tmp_path / "lift.blend.xml").write_text(
        '<Blend><Motion file="low.xml" at="0"/><Motion file="high.xml" at="10"/></Blend>'
    )
    return tmp_path


async def test_a_loop_goes_on_until_it_is_interrupted(open_still: OpenStill, assets: Path) -> None:
    async with open_still(assets) as pilot:
        pilot.perform(act('<animation id="a" name="wave" loop="true"/>'))
        await pilot.advance(6)
        assert not pilot.feedback.reached("b:a:end")
        pilot.block("stop", "", composition="REPLACE")
        await pilot.advance(2)
        still = about_x(pilot, since=7.5)
        rounds = [about_x(pilot, second, second + 1.0) for second in (1.0, 2.0, 3.0, 4.0)]
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:a:end") == pytest.approx(6.0, abs=0.02)
    for each in rounds:
        assert each.min() == pytest.approx(-1.0, abs=0.05)
        assert each.max() == pytest.approx(-0.2, abs=0.05)
    assert np.ptp(still) < 0.02


async def test_a_loop_ends_at_its_end(open_still: OpenStill, assets: Path) -> None:
    async with open_still(assets) as pilot:
        pilot.perform(act('<blend id="a" name="wave" start="0.5" end="3.2"/>'))
        await pilot.advance(5)
    assert pilot.feedback.time("b:a:end") - pilot.feedback.time("b:a:start") == pytest.approx(2.7)
    assert pilot.feedback.status("b") == "DONE"


async def test_a_loop_goes_from_its_last_pose_to_its_first_without_a_jump(open_still: OpenStill, assets: Path) -> None:
    async with open_still(assets) as pilot:
        pilot.perform(act('<animation id="a" name="rise" loop="true"/>'))
        await pilot.advance(5)
        turning = about_x(pilot, since=1.5)
    assert np.abs(np.diff(turning)).max() < 0.1  # a jump back would be one of 0.7
    assert turning.min() < -0.6
    assert turning.max() == pytest.approx(-0.2, abs=0.05)


async def test_a_loop_may_be_quicker(open_still: OpenStill, assets: Path) -> None:
    async with open_still(assets) as pilot:
        pilot.perform(act('<animation id="a" name="wave" loop="true" speed="2"/>'))
        await pilot.advance(4)
        turning = about_x(pilot, since=1.0)
    ups = np.count_nonzero((turning[1:] < -0.6) & (turning[:-1] >= -0.6))
    assert ups == 6


async def test_an_additive_clip_is_added_to_a_gesture(open_still: OpenStill, assets: Path) -> None:
    plain = '<gesture id="g" lexeme="BEAT" mode="LEFT_HAND" start="0" end="3"/>'

    async def shown(inside: str) -> dict[float, Quat]:
        async with open_still(assets) as pilot:
            pilot.perform(act(inside))
            await pilot.advance(2)
            assert pilot.feedback.warnings == []
            times = [float(frame.time) for frame in pilot.frames["alice"]]
            return dict(zip(times, (body.rotation("l_shoulder") for body in pilot.bodies()), strict=True))

    alone = await shown(plain)
    added = await shown(plain + '<animation name="wave" sbm:additive="true" start="0.5" end="1.5"/>')
    between = {time: angle(multiply(conjugate(turn), added[time])) for time, turn in alone.items()}
    assert max(turn for time, turn in between.items() if time < 0.5) < 0.02
    assert max(between.values()) == pytest.approx(0.8, abs=0.05)
    assert max(turn for time, turn in between.items() if time > 1.9) < 0.01


async def test_a_clip_of_a_part_of_the_body_leaves_the_rest_alone(open_still: OpenStill, assets: Path) -> None:
    both = clip((0.0, 0.0), (1.0, -1.0), (2.0, 0.0)).replace("l_shoulder", "l_shoulder r_shoulder")
    for row in ("0.0 1 0 0 0.0", "1.0 1 0 0 -1.0", "2.0 1 0 0 0.0"):
        both = both.replace(row, f"{row} {row.partition(' ')[2]}")
    (assets / "both.xml").write_text(both)
    async with open_still(assets) as pilot:
        pilot.perform(act('<blend name="both" sbm:partial-joint="l_sternoclavicular" sbm:wrap-mode="Once" start="0"/>'))
        await pilot.advance(3)
        right = np.array([body.rotation("r_shoulder") for body in pilot.bodies()])
        assert np.ptp(right, axis=0).max() < 0.02
        assert about_x(pilot).min() == pytest.approx(-1.0, abs=0.03)
        assert pilot.feedback.warnings == []
        pilot.perform(act('<blend id="odd" name="both" sbm:partial-joint="tail" sbm:wrap-mode="Once"/>'))
        await pilot.advance(1)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "this character lacks tail" in warning.text


# --- blends


async def test_parameters_of_a_blend_say_how_much_each_clip_counts(open_still: OpenStill, assets: Path) -> None:
    """A quarter of the way from the low to the high clip; the points of both coincide."""
    async with open_still(assets) as pilot:
        pilot.perform(act('<blend id="a" name="lift" x="2.5" sbm:wrap-mode="Once" start="0.5"/>'))
        await pilot.advance(5)
        turning = about_x(pilot)
    assert pilot.feedback.warnings == []
    start = pilot.feedback.time("b:a:start")
    assert pilot.feedback.time("b:a:top") - start == pytest.approx(1.125)
    assert pilot.feedback.time("b:a:end") - start == pytest.approx(2.5)
    assert turning.min() == pytest.approx(-0.75, abs=0.03)


@pytest.mark.parametrize(("x", "least"), [("-3", -0.5), ("0", -0.5), ("10", -1.5), ("99", -1.5)])
async def test_beyond_its_clips_a_blend_is_the_nearest_one(
    open_still: OpenStill, assets: Path, x: str, least: float
) -> None:
    async with open_still(assets) as pilot:
        pilot.perform(act(f'<blend id="a" name="lift" x="{x}" sbm:wrap-mode="Once" start="0.5"/>'))
        await pilot.advance(5)
        assert about_x(pilot).min() == pytest.approx(least, abs=0.03)


async def test_a_parameter_changes_a_loop_while_it_plays(open_still: OpenStill, assets: Path) -> None:
    change = """<bmla:parametervaluechange id="p" target="b:a" paramId="x" start="0" end="1">
        <bmla:trajectory type="linear" targetValue="10"/>
      </bmla:parametervaluechange>"""
    async with open_still(assets) as pilot:
        pilot.perform(act('<blend id="a" name="lift" x="0"/>'))
        await pilot.advance(6)
        pilot.block("c", change)
        await pilot.advance(12)
    assert pilot.feedback.warnings == []
    assert about_x(pilot, 1.0, 6.0).min() == pytest.approx(-0.5, abs=0.03)
    assert about_x(pilot, 8.0).min() == pytest.approx(-1.5, abs=0.05)
    assert np.abs(np.diff(about_x(pilot, 0.5))).max() < 0.1


@pytest.mark.parametrize(("start", "least_before"), [("5.1", -0.5), ("0", -1.5)])
async def test_an_update_changes_the_blend_of_its_block_while_it_plays(
    open_still: OpenStill, assets: Path, start: str, least_before: float
) -> None:
    async with open_still(assets) as pilot:
        pilot.perform(act(f'<blend name="lift" x="0"/><blend mode="update" name="lift" x="10" start="{start}"/>'))
        await pilot.advance(14)
    assert pilot.feedback.warnings == []
    assert about_x(pilot, 1.0, 5.1).min() == pytest.approx(least_before, abs=0.05)
    assert about_x(pilot, 5.1).min() == pytest.approx(-1.5, abs=0.05)
    assert np.abs(np.diff(about_x(pilot, 0.5))).max() < 0.12


async def test_a_blend_plays_over_a_loop_of_its_block_or_of_one_before(open_still: OpenStill, assets: Path) -> None:
    async with open_still(assets) as pilot:
        pilot.perform(act('<blend name="lift" x="0"/><blend name="lift" x="10" start="4"/>'))
        await pilot.advance(9)
        pilot.perform(act('<blend name="wave"/>').replace("'b'", "'c'"))
        await pilot.advance(4)
    spoken = [warning.text for warning in pilot.feedback.of("warningFeedback")]
    assert all("it is still waiting" in text for text in spoken)
    assert about_x(pilot, 0.0, 4.0).min() == pytest.approx(-0.5, abs=0.03)
    assert about_x(pilot, 4.0, 9.0).min() == pytest.approx(-1.5, abs=0.05)
    assert about_x(pilot, 10.0).min() == pytest.approx(-1.0, abs=0.05)


async def test_a_blend_of_two_parameters_has_cells(open_still: OpenStill, assets: Path) -> None:
    (assets / "none.xml").write_text(clip((0.0, 0.0), (2.0, 0.0)))
    (assets / "way.blend.xml").write_text(
        """<Blend>
          <Motion id="n" file="none.xml" at="0 0"/><Motion id="l" file="low.xml" at="1 0"/>
          <Motion id="h" file="high.xml" at="0 1"/>
          <Cell motions="n l h"/>
        </Blend>"""
    )
    async with open_still(assets) as pilot:
        pilot.perform(act('<blend id="a" name="way" x="0" y="1" sbm:wrap-mode="Once" start="0.5"/>'))
        await pilot.advance(6)
        assert about_x(pilot).min() == pytest.approx(-1.5, abs=0.03)


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        ("<Blend/>", "it needs 1 to 50 motions"),
        ("<Mix/>", "the file should begin with <Blend>"),
        ('<Blend><Clip file="low.xml"/></Blend>', "known are Motion, Cell"),
        (
            '<Blend><Motion file="low.xml" at="1"/><Motion file="high.xml" at="1"/></Blend>',
            "two motions are at the same",
        ),
        ('<Blend><Motion file="low.xml" at="one"/></Blend>', "at='one': these are not numbers"),
        ('<Blend><Motion file="low.xml" at="1 2"/></Blend>', "cells are needed with two or three parameters"),
        ('<Blend><Motion file="low.xml" at="1"/><Motion file="high.xml"/></Blend>', "at needs as many numbers"),
        ('<Blend><Motion file="low.xml"/><Motion file="high.xml"/></Blend>', "at needs as many numbers"),
        ('<Blend><Motion id="a" file="low.xml" at="1 2"/><Cell motions="a"/></Blend>', "it needs 3 motions"),
        ('<Blend><Motion id="a" file="low.xml" at="1 2"/><Cell motions="b"/></Blend>', "no motion with the id 'b'"),
        ('<Blend><Motion id="a" file="low.xml" at="1 2"/><Cell motions="a a a"/></Blend>', "a cell is flat"),
        ('<Blend><Motion file="low.xml" times="1 0.5"/></Blend>', "from 0 on and increasing"),
        ('<Blend><Motion file="low.xml" times="2.5"/></Blend>', "2.5 s is not between its ends"),
        (
            '<Blend><Motion file="low.xml" at="0"/><Motion file="head.xml" at="1"/></Blend>',
            "it shares no joint with the",
        ),
        ('<Blend><Motion file="odd.blend.xml"/></Blend>', "the file should begin with <SkeletonInterpolator>"),
        ('<Blend><Motion file="nowhere.xml"/></Blend>', "nowhere.xml"),
    ],
)
async def test_a_blend_that_cannot_be_used_is_told(
    open_still: OpenStill, assets: Path, content: str, reason: str
) -> None:
    (assets / "odd.blend.xml").write_text(content)
    (assets / "head.xml").write_text(clip((0.0, 0.0), (1.0, 0.1), joint="skullbase"))
    async with open_still(assets) as pilot:
        pilot.perform(act('<blend id="a" name="odd" sbm:wrap-mode="Once"/>'))
        await pilot.advance(1)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert reason in warning.text
    assert warning.id == "b:a"


async def test_times_of_motions_may_correspond_instead_of_their_points(open_still: OpenStill, assets: Path) -> None:
    """Between the times, the clips are played evenly: the top of the mix is where it is in both."""
    (assets / "timed.blend.xml").write_text(
        '<Blend><Motion file="low.xml" at="0" times="1"/><Motion file="high.xml" at="1" times="1.5"/></Blend>'
    )
    async with open_still(assets) as pilot:
        pilot.perform(act('<blend id="a" name="timed" x="0.5" sbm:wrap-mode="Once" start="0.5"/>'))
        await pilot.advance(5)
        assert about_x(pilot).min() == pytest.approx(-1.0, abs=0.03)
