"""Gestures of EMBOTS: hands are where the file says at their sync points, and what plays of wrong files."""

from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.vector import Vec3, distance, subtract
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

FRAMES = 50
"""Frames per second."""
BINDING = """<gesturebinding><MotionUnitSpec type="gesture">
  <parametermap><parameter src="lexeme" dst="name"/></parametermap>
  <MotionUnit type="EMBRScript"/>
</MotionUnitSpec></gesturebinding>"""
HUMAN = '[character.alice]\navatar = "avatars/female.glb"\nidle = 0\nbindings = { gesture = "lexicon.xml" }\n'
POINTS = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")

Open = Callable[..., AbstractAsyncContextManager[RealizerPilot]]


def arm(side: str, x: float) -> str:
    target = f"{x};-0.25;0.15"
    return f"BEGIN POSITION_CONSTRAINT\nBODY_GROUP:{side}arm\nJOINT:{side}hand\nTARGET:{target}\nEND\n"


def script(*poses: tuple[str, int, int, str]) -> str:
    written = (
        f"BEGIN K_POSE # SYNC:{label}\nTIME_POINT:+{time}\nHOLD:{hold}\n{inside}END\n"
        for label, time, hold, inside in poses
    )
    return f"BEGIN K_POSE_SEQUENCE\n{''.join(written)}END\n"


SWEEP = script(
    ("start", 100, 0, arm("r", -0.2)),
    ("ready", 700, 100, arm("r", -0.05)),
    ("stroke_end", 1300, 200, arm("r", -0.3)),
    ("end", 2000, 0, arm("r", -0.2)),
)
LEFT = script(("ready", 700, 500, arm("l", 0.1)))
BOTH = script(("ready", 700, 100, arm("r", -0.1) + arm("l", 0.1)), ("stroke_end", 1200, 0, arm("l", 0.3)))
HASTY = script(("ready", 20, 0, arm("r", -0.05)), ("stroke_end", 40, 0, arm("r", -0.4)))


@pytest.fixture
def lexicon(tmp_path: Path) -> Open:
    """Opens a scene with gestures in files by their names."""

    @asynccontextmanager
    async def open_(**files: str) -> AsyncIterator[RealizerPilot]:
        (tmp_path / "lexicon.xml").write_text(BINDING, encoding="utf-8")
        (tmp_path / "human.toml").write_text(HUMAN, encoding="utf-8")
        for name, text in files.items():
            (tmp_path / f"{name}.embr").write_text(text, encoding="utf-8")
        async with open_pilot(SceneOptions(tmp_path / "human.toml", "text", (tmp_path,))) as pilot:
            pilot.watch()
            yield pilot

    return open_


def hand(body: Body, side: str) -> Vec3:
    return subtract(body.transform(f"{side}_wrist").position, body.transform("HumanoidRoot").position)


def at(pilot: RealizerPilot, point: str) -> Body:
    return pilot.bodies()[round(FRAMES * pilot.feedback.time(f"b:g:{point}"))]


async def test_points_are_reported_at_the_times_of_the_file(lexicon: Open) -> None:
    async with lexicon(sweep_RH=SWEEP) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="sweep" start="0.2"/>')
        await pilot.advance(4)
    told = pilot.feedback
    assert told.warnings == []
    assert [each for each in told.progress if each.startswith("b:g:")] == [f"b:g:{point}" for point in POINTS]
    times = [told.time(f"b:g:{point}") - 0.2 for point in POINTS[:-1]]
    assert times == pytest.approx([0.0, 0.6, 0.7, 0.7, 1.2, 1.4], abs=1e-6)


async def test_the_hand_sweeps_to_the_side_during_the_stroke_and_hangs_afterwards(lexicon: Open) -> None:
    async with lexicon(sweep_RH=SWEEP) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="sweep" start="0.2"/>')
        await pilot.advance(4)
    before, ready, done, after = (hand(at(pilot, point), "r") for point in ("start", "ready", "strokeEnd", "end"))
    assert ready[0] - done[0] == pytest.approx(0.25, abs=0.05)
    assert abs(ready[1] - done[1]) < 0.03
    assert distance(before, after) < 0.03


async def test_the_stroke_follows_the_point_to_which_it_is_tied(lexicon: Open) -> None:
    async with lexicon(sweep_RH=SWEEP) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="sweep" strokeStart="2" strokeEnd="4"/>')
        await pilot.advance(6)
    assert pilot.feedback.time("b:g:strokeEnd") == 4.0
    middle, end = pilot.bodies()[3 * FRAMES], at(pilot, "strokeEnd")
    assert 0.05 < distance(hand(middle, "r"), hand(end, "r")) < 0.2


async def test_a_mode_selects_the_file_and_a_group_without_goals_keeps_its_pose(lexicon: Open) -> None:
    async with lexicon(sweep_RH=SWEEP, sweep_LH=LEFT, sweep_2H=BOTH) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="sweep" mode="BOTH_HANDS"/>')
        await pilot.advance(4)
        pilot.block("c", '<gesture id="g" lexeme="sweep" mode="LEFT_HAND"/>')
        await pilot.advance(3)
    ready, done = at(pilot, "ready"), at(pilot, "strokeEnd")
    assert distance(hand(ready, "r"), hand(done, "r")) < 0.01
    assert distance(hand(ready, "l"), hand(done, "l")) > 0.1
    assert pilot.feedback.time("c:g:relax") - pilot.feedback.time("c:g:ready") == pytest.approx(0.5)


async def test_a_way_takes_the_time_that_people_need(lexicon: Open) -> None:
    async with lexicon(hasty=HASTY) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="hasty"/>')
        await pilot.advance(4)
    told = pilot.feedback
    assert told.time("b:g:ready") - told.time("b:g:start") > 0.15
    assert told.time("b:g:strokeEnd") - told.time("b:g:ready") > 0.1


async def test_a_wrong_file_is_named_with_its_line_and_what_can_be_read_plays(lexicon: Open) -> None:
    async with lexicon(broken=SWEEP.replace("-0.3;-0.25;0.15", "-0.3;-0.25"), empty="TIME_RESET") as pilot:
        pilot.block(
            "b", '<gesture id="g" lexeme="broken"/><gesture id="h" lexeme="empty"/><gesture id="i" lexeme="x"/>'
        )
        await pilot.advance(4)
    told = {message.id: message.text for message in pilot.feedback.of("warningFeedback")}
    assert "broken.embr, line 26" in told["b:g"]
    assert "empty.embr" in told["b:h"]
    assert "there is no asset named 'x.embr'" in told["b:i"]
    assert pilot.feedback.time("b:g:end") > 1.0
