"""Plays hours of virtual time: how many objects are alive after each hour, and whether a chain of blocks drifts."""

import asyncio
import gc
from math import ceil

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.feedback.feedback_manager import Report
from reactive_realizer.feedback.messages import BlockProgress
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

AIMS = {"drift_s": 0.0}

_HOUR, _BEAT = 3600.0, 5.0
"""Durations of an hour, and of each block of the chain, s."""

_CHAIN = f'<wait id="w" duration="{_BEAT}"/>'
_TALK = """
    <speech id="s"><text>Number <sync id="m"/>{0}, please.</text></speech>
    <gesture id="g" lexeme="BEAT" stroke="s:m"/>
    <head id="h" lexeme="NOD" start="anticipators:t:hit{1}"/>
    <wait id="w" event="asked" max-wait="0.5"/><bmla:emit id="e" event="asked" start="s:end"/>
    <gaze id="z" target="bluebox"/>
"""


def measure(hours: float = 0.05) -> dict[str, object]:
    """Objects alive after each hour, or at the end, and how far (s) a block of the chain starts from its time at most.

    Args:
        hours: of virtual time; each takes two minutes on an idle core.
    """
    return asyncio.run(_measure(hours))


async def _measure(hours: float) -> dict[str, object]:
    objects: dict[str, int] = {}
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        chain = _Chain(pilot.realizer)
        number = 0
        for hour in range(1, ceil(hours) + 1):
            while pilot.now < min(hour, hours) * _HOUR:
                _send(pilot, number)
                number += 1
                await pilot.advance(_BEAT)
                pilot.feedback.clear()
                pilot.sounds.clear()
            gc.collect()
            objects[str(hour)] = len(gc.get_objects())
    return {"blocks": 2 * number, "objects": objects, "drift_s": chain.drift}


def _send(pilot: RealizerPilot, number: int) -> None:
    """Send the next block of the chain, and one that talks; every tenth one is replaced before it ends."""
    pilot.block(f"chain{number}", _CHAIN, composition=f"APPEND-AFTER(chain{number - 1})" if number else "MERGE")
    pilot.predict("t", f"hit{number % 50}", pilot.now + 1.0)
    pilot.block(f"talk{number}", _TALK.format(number, number % 50))
    if number % 10 == 9:
        pilot.block(f"stop{number}", **{"bmla:interrupt": f"talk{number}"})


class _Chain:
    """Listens to the starts of the blocks of the chain.

    Attributes:
        drift: how late or early one of them started at most, s.
    """

    def __init__(self, realizer: Realizer) -> None:
        self.drift = 0.0
        realizer.feedback.listen(self._hear)

    def _hear(self, report: Report) -> None:
        message = report.message
        if isinstance(message, BlockProgress) and message.sync == "start" and message.block.startswith("chain"):
            self.drift = max(self.drift, abs(message.time - _BEAT * int(message.block.removeprefix("chain"))))
