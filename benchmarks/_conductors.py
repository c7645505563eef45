"""Crowds of conductors, whose cost `benchmarks.physics` measures."""

import asyncio
import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.ticker import FRAME_EVERY, RATE
from reactive_realizer.server.live_scene import keep_from_ticks
from reactive_realizer.testing.pilot import RealizerPilot, block

_CHARACTER = '[character.c{0}]\navatar = "avatars/female.glb"\nposition = [{0}, 0, 0]\nsimulation_steps = {1}\n'
_CONDUCTING = (
    '<bmlt:controller id="legs" class="BalanceController"/>'
    '<bmlt:controller id="arm" class="CompoundController" name="leftarmhang"/>'
    + "".join(
        f'<bmlt:procanimation id="b{n}" name="conduct-3-beat" mode="RIGHT_HAND" start="{2 * n}" end="{2 * n + 2}"/>'
        for n in range(10)
    )
)
_BEGUN = 1.0
"""Time after which all conductors are in motion, s."""


def tick_times(size: int, steps: int, threads: tuple[int, ...], frames: int) -> list[float]:
    """Return the median time of a tick of a crowd of conductors, us, for each of some numbers of threads.

    The right arm of each beats, the left one hangs loosely, and the legs balance. Half of the ticks show a frame. All
    work of the realizer is measured, from its inputs to its frames.

    Args:
        size: of the crowd.
        steps: of the simulations in a tick.
        threads: that simulate.
        frames: measured for each number of threads.
    """
    with TemporaryDirectory() as folder:
        human = Path(folder, "conductors.toml")
        human.write_text("".join(_CHARACTER.format(number, steps) for number in range(size)), encoding="utf-8")
        return asyncio.run(_conduct(human, threads, frames))


async def _conduct(human: Path, threads: tuple[int, ...], frames: int) -> list[float]:
    async with open_scene(SceneOptions(human, "text")) as scene:
        pilot = RealizerPilot(scene)
        for character in scene.realizer.characters:
            pilot.perform(block(f"b-{character}", _CONDUCTING, characterId=character))
        await pilot.advance(_BEGUN)
        keep_from_ticks()  # as a server does
        times = [await _median_tick(pilot, number, frames) for number in threads]
        if pilot.feedback.of("fall"):
            raise RuntimeError("a conductor has fallen: the times are not those of conductors")
        return times


async def _median_tick(pilot: RealizerPilot, threads: int, frames: int) -> float:
    with ThreadPoolExecutor(threads) as pool:
        asyncio.get_running_loop().set_default_executor(pool)
        times = []
        for _ in range(frames):
            begin = perf_counter()
            await pilot.advance(FRAME_EVERY / RATE)
            times.append(1e6 * (perf_counter() - begin) / FRAME_EVERY)
    return median(times)


def cores() -> int:
    """Return the number of processor cores."""
    return os.cpu_count() or 1
