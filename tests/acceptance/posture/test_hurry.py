"""Changes of stance in too little time, in exported frames."""

from itertools import pairwise

import numpy as np
import pytest

from reactive_realizer.embodiment.speed_limit import ROOT_SPEED
from reactive_realizer.embodiment.vector import distance
from reactive_realizer.testing.pilot import RealizerPilot

from .soles import FRAME, heights, planted
from .standing import SIT

STANCES = ("SITTING", "LYING", "STANDING", "CROUCHING", "LYING", "SITTING", "STANDING")


def fastest(pilot: RealizerPilot) -> float:
    """The fastest that the root was, m/s."""
    return max(distance(a.root, b.root) for a, b in pairwise(pilot.bodies())) / FRAME


async def test_nothing_jumps_on_the_way_between_stances(either: RealizerPilot) -> None:
    stances = ("SITTING", "CROUCHING", "LYING", "STANDING")
    shifts = (
        f'<postureShift id="{s}" start="{3 * i}"><stance type="{s}"/></postureShift>' for i, s in enumerate(stances)
    )
    either.block("b", "".join(shifts))
    await either.advance(15)
    assert either.feedback.warnings == []
    joints = ("HumanoidRoot", "skullbase", "l_knee", "r_knee", "l_wrist", "r_ankle")
    ways = [
        distance(a.transform(j).position, b.transform(j).position) for a, b in pairwise(either.bodies()) for j in joints
    ]
    assert max(ways) < 0.06


@pytest.mark.parametrize("lasts", [0.3, 0.5, 0.8])
@pytest.mark.parametrize("stance", ["SITTING", "CROUCHING", "LYING"])
async def test_a_hurried_posture_keeps_the_limit_of_the_root_and_the_feet_above_the_ground(
    alternating: RealizerPilot, stance: str, lasts: float
) -> None:
    alternating.block("b", f'<posture id="p" start="0" end="{lasts}"><stance type="{stance}"/></posture>')
    await alternating.advance(2)
    assert fastest(alternating) < 1.001 * ROOT_SPEED
    assert heights(alternating.bodies()).min() > -0.001


async def test_postures_in_quick_succession_keep_the_feet_above_the_ground(either: RealizerPilot) -> None:
    for number, stance in enumerate(STANCES):
        shift = f'<postureShift id="s" start="0" end="0.3"><stance type="{stance}"/></postureShift>'
        either.block(f"b{number}", shift)
        await either.advance(0.4)
    await either.advance(2)
    assert fastest(either) < 1.001 * ROOT_SPEED
    assert heights(either.bodies()).min() > -0.001


@pytest.mark.parametrize("lasts", [0.3, 0.5, 0.8])
async def test_the_knees_bend_for_a_root_that_lags_behind(alternating: RealizerPilot, lasts: float) -> None:
    alternating.block("b", f'<posture id="p" start="0" end="{lasts}">{SIT}</posture>')
    await alternating.advance(2)
    assert planted(alternating.bodies()) < 0.01
    assert heights(alternating.bodies()).max() < 0.005


async def test_a_figure_that_cannot_follow_keeps_its_feet_below_the_pelvis(either: RealizerPilot) -> None:
    rows = "0 0 0 0 1 0 0 0  1 0 0 5 1 0 0 0"
    interpolator = f'<SkeletonInterpolator xmlns="" parts="HumanoidRoot" encoding="T1R">{rows}</SkeletonInterpolator>'
    either.block("b", f'<bmlt:keyframe id="k">{interpolator}</bmlt:keyframe>')
    await either.advance(1)
    ahead = [either.path(f"{side}_ankle")[:, 2] for side in "lr"]
    assert np.abs(ahead).max() < 0.35
    assert fastest(either) < 1.001 * ROOT_SPEED
