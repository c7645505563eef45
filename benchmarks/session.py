"""Measures a long session for growth in time and memory: 1 000 small blocks, one after the other."""

import asyncio
import gc
import tracemalloc
from time import perf_counter

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.ticker import Tick, tick_time
from reactive_realizer.realizer.inputs import BmlText
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.testing.pilot import block

AIMS: dict[str, float] = {}

_INSIDE = '<speech id="s"><text>hm</text></speech><head id="h" lexeme="NOD" start="s:start" end="s:end"/>'


def measure(blocks: int = 1000) -> dict[str, object]:
    """Time for the first and the last hundred blocks, and the memory that a block retains.

    Args:
        blocks: number of blocks; with fewer than 200, the times are those of the first and the last half.
    """
    part = min(100, blocks // 2)
    return asyncio.run(_durations(blocks, part)) | {
        "retained_bytes_per_block": asyncio.run(_retained(blocks, part)),
    }


async def _durations(blocks: int, part: int) -> dict[str, object]:
    async with open_scene(SceneOptions(voice="text")) as scene:
        session = _Session(scene.realizer)
        times = [await session.perform(part) for _ in range(blocks // part)]
    return {"first_100_ms": round(times[0], 1), "last_100_ms": round(times[-1], 1)}


async def _retained(blocks: int, part: int) -> float:
    """Bytes retained by each block, including its name."""
    async with open_scene(SceneOptions(voice="text")) as scene:
        session = _Session(scene.realizer)
        await session.perform(part)
        tracemalloc.start()
        before = _traced()
        await session.perform(blocks - part)
        after = _traced()
        tracemalloc.stop()
    return round((after - before) / (blocks - part), 1)


def _traced() -> int:
    gc.collect()
    return tracemalloc.get_traced_memory()[0]


class _Session:
    """Plays blocks one after the other."""

    def __init__(self, realizer: Realizer) -> None:
        self._realizer = realizer
        self._tick = 0
        self._block = 0

    async def perform(self, blocks: int) -> float:
        """The time for a number of blocks, ms."""
        begin = perf_counter()
        for _ in range(blocks):
            self._block += 1
            self._realizer.put(BmlText(block(f"b{self._block}", _INSIDE)))
            await self._step()
            while self._realizer.scheduler.blocks.alive:
                await self._step()
        return 1000 * (perf_counter() - begin)

    async def _step(self) -> None:
        await self._realizer.step(Tick(self._tick, tick_time(self._tick - 1), frame=False))
        self._tick += 1
