"""Runs the examples and prints a trace.

They run on a virtual clock, as fast as possible; with ``--watch``, in real time, with the viewer at
http://127.0.0.1:8088.
"""

import asyncio
import sys
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from fnmatch import fnmatch
from pathlib import Path

from aiohttp import web

from reactive_realizer.assembly.scene import Scene, SceneOptions, open_scene
from reactive_realizer.bml.names import OWN
from reactive_realizer.clock.clock import ManualClock, SystemClock
from reactive_realizer.server.app import create_app
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.security import Security
from reactive_realizer.testing.feedback_list import FeedbackMessage
from reactive_realizer.testing.pilot import RealizerPilot

HUMAN = Path(__file__).with_name("example_scene.toml")
PORT = 8088


class ExampleScene(RealizerPilot):
    """A pilot that prints events of interest to a planner.

    Args:
        scene: the characters and anticipators.
        shown: the sync points to print when they are reached, as ``block:behavior:sync``; ``*`` is a wildcard.
    """

    def __init__(self, scene: Scene, shown: tuple[str, ...]) -> None:
        super().__init__(scene)
        self._shown = shown
        self._printed = 0

    def log(self, text: str, time: float | None = None) -> None:
        """Print a line with a time (s), by default that of the next tick."""
        print(f"{self.now if time is None else time:6.2f}  {text}")

    async def until(self, time: float) -> None:
        """Play all ticks before a time, s."""
        while self.now < time - 1e-9:
            await self.tick()

    async def tick(self) -> None:
        """Play one tick and print its feedback."""
        await super().tick()
        for message in self.feedback.messages[self._printed :]:
            self._print(message)
        self._printed = len(self.feedback.messages)

    def _print(self, message: FeedbackMessage) -> None:
        if message.kind == "warningFeedback":
            self.log(f"  warning of {message.id}: {message.text}", message.time)
        elif message.kind.endswith("Progress") and any(fnmatch(message.id, shown) for shown in self._shown):
            word = message.element.get(f"{{{OWN}}}text")
            self.log(f"  {message.id}" + ("" if word is None else f', the last word was "{word}"'), message.global_time)


class WatchedExample(ExampleScene):
    """An example that plays in real time, for the viewer."""

    def __init__(self, live: LiveScene, clock: ManualClock, shown: tuple[str, ...]) -> None:
        super().__init__(live.scene, shown)
        self._live = live
        self._clock = clock
        self._pace = SystemClock()

    async def tick(self) -> None:
        """Wait for the time of the tick, and play it."""
        await self._pace.wait_until(self.now)
        await self._clock.wait_until(self.now)
        await super().tick()
        self._live.board.publish()


@asynccontextmanager
async def open_example(*shown: str, voice: str = "text") -> AsyncIterator[ExampleScene]:
    """Open the scene of an example; with the viewer, speech is audible."""
    watched = "--watch" in sys.argv
    async with open_scene(SceneOptions(HUMAN, "espeak" if watched else voice)) as scene:
        if watched:
            async with _open_page(scene, shown) as example:
                yield example
        else:
            yield ExampleScene(scene, shown)


@asynccontextmanager
async def _open_page(scene: Scene, shown: tuple[str, ...]) -> AsyncIterator[ExampleScene]:
    clock = ManualClock()
    live = LiveScene(scene, clock)
    runner = web.AppRunner(create_app(live, Security()))
    await runner.setup()
    try:
        await web.TCPSite(runner, "127.0.0.1", PORT).start()
        await asyncio.to_thread(input, f"Open http://127.0.0.1:{PORT}, and press Enter. ")
        yield WatchedExample(live, clock, shown)
    finally:
        await runner.cleanup()
