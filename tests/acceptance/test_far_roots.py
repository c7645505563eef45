"""Motions that displace the figure: the way back, and the limit."""

from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

STANDING, LOWEST = 0.88, 0.75
"""m above the ground: the pelvis of who stands, and of who walks."""


def walk(far: float, seconds: float) -> str:
    """Root and nothing else, straight ahead, m."""
    rows = f"0 0 0 0 1 0 0 0  {seconds} 0 0 {far} 1 0 0 0"
    interpolator = f'<SkeletonInterpolator xmlns="" parts="HumanoidRoot" encoding="T1R">{rows}</SkeletonInterpolator>'
    return f'<bmlt:keyframe id="k">{interpolator}</bmlt:keyframe>'


async def walked(pilot: RealizerPilot, far: float, seconds: float, after: float) -> list[Body]:
    """The figure in each frame, in the world."""
    pilot.watch()
    pilot.block("b", walk(far, seconds))
    await pilot.advance(seconds + after)
    return pilot.bodies("alice")


@pytest.mark.parametrize(("far", "seconds"), [(2.0, 2.0), (5.0, 5.0), (5.0, 1.0)])
async def test_a_figure_that_moved_away_steps_back_upright(far: float, seconds: float) -> None:
    async with open_pilot() as pilot:
        bodies = await walked(pilot, far, seconds, 8.0)
    pelvis = [body.transform("HumanoidRoot").position for body in bodies]
    assert pelvis[-1] == pytest.approx((0.0, STANDING, 0.0), abs=0.05)
    assert min(y for _, y, _ in pelvis) > LOWEST
    feet = [[body.transform(f"{side}_ankle").position for side in "lr"] for body in bodies]
    assert max(abs(left[2] - right[2]) for left, right in feet) < 0.85, "no straddling"
    lifted = [y for pair in feet for _, y, _ in pair]
    assert max(lifted) - min(lifted) > 0.05, "feet are lifted"


@pytest.mark.parametrize(("far", "takes"), [(0.5, 1.6), (2.0, 3.2), (6.0, 6.3)])
async def test_the_way_back_takes_three_seconds_or_longer_at_walking_speed(far: float, takes: float) -> None:
    async with open_pilot() as pilot:
        bodies = await walked(pilot, far, far, takes)
    assert bodies[-1].root[2] == pytest.approx(0.0, abs=0.05)


async def test_a_motion_that_outruns_the_figure_fades_out_from_the_figure() -> None:
    async with open_pilot() as pilot:
        bodies = await walked(pilot, 9.0, 1.0, 7.0)
    ahead = [body.transform("HumanoidRoot").position[2] for body in bodies]
    assert max(ahead) < 2.2
    assert ahead[-1] == pytest.approx(0.0, abs=0.05)


async def test_the_displacement_of_the_root_is_limited() -> None:
    async with open_pilot() as pilot:
        await walked(pilot, 10.1, 1.0, 1.0)
        assert pilot.feedback.warnings == [("b:k", "CANNOT_CREATE_BEHAVIOR")]


async def test_a_formula_that_moves_the_root_too_far_ends_its_behavior(
    tmp_path: Path,
) -> None:
    far = '<EndEffector target="root" local="true" translation="0;0;1e300*t"/>'
    (tmp_path / "far.xml").write_text(f'<ProcAnimation prefDuration="1">{far}</ProcAnimation>')
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,))) as pilot:
        pilot.watch()
        pilot.block("b", '<bmlt:procanimation id="k" name="far"/>')
        await pilot.advance(2.0)
        assert pilot.feedback.warnings == [("b:k", "EXECUTION_FAILURE")]
        assert max(abs(frame.root[2]) for frame in pilot.frames["alice"]) < 0.1
