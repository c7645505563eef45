"""Measures how smoothly a figure moves and walks in random scenes, and the range and depth of its arms."""

import asyncio
from collections.abc import Awaitable, Callable, Sequence

import numpy as np

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.testing.motion_laws import arm_ranges, foot_slide, hand_depth, worst_motion
from reactive_realizer.testing.motion_scenes import play_scene, play_walk
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

AIMS = {
    "wrist_m_s2.p99": 60,
    "wrist_rad_s2.p99": 300,
    "head_deg_s.p99": 400,
    "hand_depth_cm.p99": 1,
    "pronation_deg": 85,
    "supination_deg": 85,
    "radial_deg": 25,
    "ulnar_deg": 35,
    "walking.wrist_m_s2.p99": 60,
    "walking.foot_slide_cm.p99": 1,
}

_PERCENTILES = {"p50": 50, "p90": 90, "p99": 99, "max": 100}


Play = Callable[[int, RealizerPilot], Awaitable[None]]


def measure(scenes: int = 200) -> dict[str, object]:
    """Percentiles over the scenes of the worst value in each, and the furthest that the arms turn in any of them.

    Args:
        scenes: number of scenes, and of walks; the first ones are always the same.
    """
    worst, ranges, walks = [], [], []
    for seed in range(scenes):
        bodies, avatar = asyncio.run(_bodies(play_scene, seed))
        worst.append({**worst_motion(bodies), "hand_depth_cm": 100.0 * hand_depth(bodies, avatar)})
        ranges.append(arm_ranges(bodies))
        walk, _ = asyncio.run(_bodies(play_walk, seed))
        walks.append({"wrist_m_s2": worst_motion(walk)["wrist_m_s2"], "foot_slide_cm": 100.0 * foot_slide(walk)})
    return {
        **{law: _percentiles([each[law] for each in worst]) for law in worst[0]},
        **{name: max(each[name] for each in ranges) for name in ranges[0]},
        "walking": {law: _percentiles([each[law] for each in walks]) for law in walks[0]},
    }


async def _bodies(play: Play, seed: int) -> tuple[list[Body], Avatar]:
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        await play(seed, pilot)
        figure, *_ = pilot.realizer.characters.values()
        return pilot.bodies(), figure.humanoid.avatar


def _percentiles(values: Sequence[float]) -> dict[str, float]:
    return {name: round(float(np.percentile(values, part)), 1) for name, part in _PERCENTILES.items()}
