"""Measures waiting: posts to engines and processor time of a live scene in which all characters wait for an event."""

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import SystemClock
from reactive_realizer.clock.punctual_loop import run_punctually
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.engine.effects import Play
from reactive_realizer.engine.engine_task import EngineTask
from reactive_realizer.realizer.inputs import BmlText
from reactive_realizer.server.live_scene import LiveScene, keep_from_ticks
from reactive_realizer.testing.pilot import block

AIMS = {"posts_per_s": 0.0}

_CROWDS = (0, 1, 100)
_SETTLING = 1.0
"""Time after which all blocks are planned, s."""

_CHARACTER = '[character.c{0}]\navatar = "avatars/female.glb"\nposition = [{0}, 0, 0]\n'
_INSIDE = (
    '<speech id="s" start="anticipators:partner:stop"><text>one <sync id="m"/>two three</text></speech>'
    '<gesture id="g" lexeme="BEAT" stroke="s:m"/><head id="h" lexeme="NOD" start="s:start" end="s:end"/>'
)


def measure(seconds: float = 10.0, most: int = 100) -> dict[str, object]:
    """Posts a second with one waiting character, and the processor time, ms a second, with numbers of them.

    With 0, one character has nothing to do.

    Args:
        seconds: duration of each run.
        most: greatest number of characters; the results of greater ones are None.
    """
    runs = {size: _wait(size, seconds) if size <= most else (None, None) for size in _CROWDS}
    return {
        "posts_per_s": runs[1][0],
        "cpu_ms_per_s": {str(size): cpu for size, (_, cpu) in runs.items()},
    }


def _wait(size: int, seconds: float) -> tuple[float, float]:
    with TemporaryDirectory() as folder:
        human = Path(folder, "crowd.toml")
        human.write_text("".join(map(_CHARACTER.format, range(max(1, size)))), encoding="utf-8")
        return run_punctually(_measure(human, size, seconds))


async def _measure(human: Path, size: int, seconds: float) -> tuple[float, float]:
    async with open_scene(SceneOptions(human, "text")) as scene, asyncio.TaskGroup() as group:
        keep_from_ticks()  # as a server does
        live = LiveScene(scene, SystemClock())
        for rank in range(size):
            live.realizer.put(BmlText(block(f"b{rank}", _INSIDE, characterId=f"c{rank}")))
        ticking = group.create_task(live.run())
        await asyncio.sleep(_SETTLING + 0.02 * size)
        with _counted_posts() as posts:
            begin = process_time()
            await asyncio.sleep(seconds)
            used = process_time() - begin
        ticking.cancel()
    return round(len(posts) / seconds, 2), round(1000 * used / seconds, 3)


@contextmanager
def _counted_posts() -> Iterator[list[int]]:
    """The numbers of the ticks that are posted to engines meanwhile."""
    posts: list[int] = []
    post = EngineTask.post

    def counted(task: EngineTask, tick: Tick) -> "asyncio.Future[Play]":
        posts.append(tick.number)
        return post(task, tick)

    EngineTask.post = counted  # type: ignore[method-assign, assignment]
    try:
        yield posts
    finally:
        EngineTask.post = post  # type: ignore[method-assign]
