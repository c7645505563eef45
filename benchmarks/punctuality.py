"""Measures the punctuality of feedback in real time, with one and with twenty characters that always play."""

import asyncio
from itertools import count
from pathlib import Path
from statistics import quantiles
from tempfile import TemporaryDirectory

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import SystemClock
from reactive_realizer.clock.punctual_loop import run_punctually
from reactive_realizer.clock.ticker import RATE
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.feedback.feedback_manager import Report
from reactive_realizer.feedback.messages import BlockProgress, SyncPointProgress
from reactive_realizer.realizer.inputs import BmlText
from reactive_realizer.server.live_scene import LiveScene, keep_from_ticks
from reactive_realizer.testing.pilot import block

TICK_MS = 1000 / RATE

AIMS = {"1.p99_ms": 1.5 * TICK_MS, "20.p99_ms": 1.5 * TICK_MS}

_CROWDS = (1, 20)
_GOLDEN = 0.618
_APART = 0.07
"""Time between the starts of two characters, s, so that they are not synchronized."""

_CHARACTER = '[character.c{0}]\navatar = "avatars/female.glb"\nposition = [{0}, 0, 0]\n'
_INSIDE = (
    '<speech id="s" start="{0:.4f}"><text>one <sync id="m"/>two three</text></speech>'
    '<gesture id="g" lexeme="BEAT" stroke="s:m"/><head id="h" lexeme="NOD" start="s:start" end="s:end"/>'
)


def measure(seconds: float = 60.0) -> dict[str, object]:
    """The delay from the time of a sync point's peg to the sending of its feedback, ms.

    Args:
        seconds: duration of each run.
    """
    return {"tick_ms": TICK_MS} | {str(size): _lateness(size, seconds) for size in _CROWDS}


def _lateness(size: int, seconds: float) -> dict[str, float]:
    with TemporaryDirectory() as folder:
        human = Path(folder, "crowd.toml")
        human.write_text("".join(map(_CHARACTER.format, range(size))), encoding="utf-8")
        cuts = quantiles(run_punctually(_perform(human, seconds)), n=100)
    return {"p50_ms": round(cuts[49], 3), "p99_ms": round(cuts[98], 3)}


async def _perform(human: Path, seconds: float) -> list[float]:
    async with open_scene(SceneOptions(human, "text")) as scene, asyncio.TaskGroup() as group:
        keep_from_ticks()  # as a server does
        live = LiveScene(scene, SystemClock())
        crowd = _Crowd(live)
        live.realizer.feedback.listen(crowd.hear)  # after the listeners that send it
        ticking = group.create_task(live.run())
        await asyncio.sleep(seconds)
        ticking.cancel()
    return crowd.late


class _Crowd:
    """The characters of a scene; when a block ends, its character gets a new one.

    Attributes:
        late: delay of the feedback of each sync point, ms.
    """

    def __init__(self, live: LiveScene) -> None:
        self.late: list[float] = []
        self._live = live
        self._numbers = count()
        for rank, character in enumerate(live.realizer.characters):
            self._perform(character, GlobalTime(rank * _APART))

    def hear(self, report: Report) -> None:
        """Notes the delay of a sync point, or starts the next block."""
        message = report.message
        if isinstance(message, SyncPointProgress):
            self.late.append(1000 * (self._live.now - message.time))
        elif isinstance(message, BlockProgress) and message.sync == "end":
            self._perform(message.character)

    def _perform(self, character: str, at: GlobalTime = GlobalTime(0.0)) -> None:  # noqa: B008 - a float
        number = next(self._numbers)
        inside = _INSIDE.format(number * _GOLDEN % 1.0 / RATE)  # points are at quasi-random parts of a tick
        self._live.realizer.put(BmlText(block(f"b{number}", inside, characterId=character)), at)
