"""Measures load: how long ticks of a live scene are delayed while much arrives, starts or moves at once."""

import asyncio
from collections.abc import Awaitable, Callable
from itertools import cycle, islice, product
from statistics import quantiles
from time import thread_time
from typing import NamedTuple

from benchmarks import _viewers
from benchmarks.scheduling import chain, spread
from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import SystemClock
from reactive_realizer.clock.punctual_loop import run_punctually
from reactive_realizer.clock.ticker import RATE, tick_time
from reactive_realizer.server.intake import Intake
from reactive_realizer.server.live_scene import LiveScene, keep_from_ticks
from reactive_realizer.testing.pilot import block

AIMS = {
    **{
        f"tick_p99_ms.{load}": 10
        for load in ("chain_1000", "burst_50_blocks", "parallel_1000", "predict_1000", "postures_20")
    },
    "viewers_200.cpu_share": 0.2,
    "viewers_500.late_p99_ms": 20,
}

_SETTLING = 0.3
"""Time until a scene has started, s."""

_AHEAD = 10.0
"""Time from now to the predicted point, s: it is always ahead."""

_AUDIENCES = {"viewers_200": (200, 1, 0), "viewers_500": (500, 1, 500), "characters_10": (100, 10, 500)}
"""The number of viewers and of characters, and the least number of viewers allowed for a result."""

_STANCES = ("STANDING", "SITTING", "CROUCHING", "LYING")
_ARMS = ("AKIMBO", "CROSSED", "SPREAD", "FORWARD", "NEUTRAL")

Load = Callable[[Intake, int, float], Awaitable[object]]


def measure(seconds: float = 4.0, behaviors: int = 1000, viewers: int = 500) -> dict[str, object]:
    """The 99th percentile of the delay from the time of a tick until it has been played, ms, for each load.

    A skipped tick is played with the late one that covers it. ``nothing`` is the delay without a load, which is due to
    the machine. ``tick_cpu_ms`` is the processor time of the longest tick, without threads.

    Args:
        seconds: time for which each load is observed from its arrival, s.
        behaviors: their number in a load.
        viewers: most sockets that receive frames from a server; without 500, only ``viewers_200`` has a result.
    """
    ticks = {name: run_punctually(_ticks(load, behaviors, seconds)) for name, load in _LOADS.items()}
    watched = {
        name: _viewers.measure(min(number, viewers), 2.5 * seconds, characters)
        if viewers >= least
        else dict.fromkeys(_viewers.NUMBERS)
        for name, (number, characters, least) in _AUDIENCES.items()
    }
    return {
        "tick_p99_ms": {name: _p99_ms(played) for name, played in ticks.items()},
        "tick_cpu_ms": {name: round(1000 * max(played.work, default=0.0), 1) for name, played in ticks.items()},
        **watched,
    }


async def _nothing(intake: Intake, behaviors: int, seconds: float) -> None:
    await asyncio.sleep(seconds)


async def _chain(intake: Intake, behaviors: int, seconds: float) -> None:
    await intake.blocks(block("b", chain(behaviors)))
    await asyncio.sleep(seconds)


async def _burst(intake: Intake, behaviors: int, seconds: float) -> None:
    """Blocks of 20 behaviors that arrive at once."""
    await asyncio.gather(*(intake.blocks(block(f"b{i}", spread(20))) for i in range(behaviors // 20)))
    await asyncio.sleep(seconds)


async def _parallel(intake: Intake, behaviors: int, seconds: float) -> None:
    """Behaviors that begin together, and end together."""
    waits = (f'<wait id="w{i}" duration="1"/>' for i in range(behaviors))
    await intake.blocks(block("b", "".join(waits)))
    await asyncio.sleep(seconds)


async def _predict(intake: Intake, behaviors: int, seconds: float) -> None:
    """Behaviors that wait for a point, which is predicted again for every tick."""
    intake.predict({"anticipator": "partner", "sync": "hit", "in": _AHEAD})
    starts = (f'start="anticipators:partner:hit + {i / behaviors}"' for i in range(behaviors))
    waits = (f'<wait id="w{i}" duration="1" {start}/>' for i, start in enumerate(starts))
    await intake.blocks(block("b", "".join(waits)))
    for i in range(round(seconds * RATE)):
        intake.predict({"anticipator": "partner", "sync": "hit", "in": _AHEAD + i % 2})
        await asyncio.sleep(1 / RATE)


async def _postures(intake: Intake, behaviors: int, seconds: float) -> None:
    """Blocks with changes of posture, which look for ways of the arms around the body: one for 50 behaviors."""
    shift = '<postureShift id="s"><stance type="{}"/><pose part="ARMS" lexeme="ARMS_{}"/></postureShift>'
    changes = islice(cycle(product(_STANCES, _ARMS)), behaviors // 50)
    await asyncio.gather(*(intake.blocks(block(f"b{i}", shift.format(*each))) for i, each in enumerate(changes)))
    await asyncio.sleep(seconds)


_LOADS: dict[str, Load] = {
    "nothing": _nothing,
    "chain_1000": _chain,
    "burst_50_blocks": _burst,
    "parallel_1000": _parallel,
    "predict_1000": _predict,
    "postures_20": _postures,
}


class _Played(NamedTuple):
    """The ticks of a load.

    Attributes:
        delays: of each tick, also of those that were left out, s.
        work: processor time of the main thread for each tick, s.
    """

    delays: list[float]
    work: list[float]


async def _ticks(load: Load, behaviors: int, seconds: float) -> _Played:
    played = _Played([], [])

    async def run(live: LiveScene) -> None:
        keep_from_ticks()
        async for tick in live.ticker.ticks():
            began = thread_time()
            await live.step(tick)
            played.work.append(thread_time() - began)
            played.delays.extend(live.now - tick_time(number) for number in (*tick.left_out, tick.number))

    async with open_scene(SceneOptions(voice="text")) as scene, asyncio.TaskGroup() as group:
        live = LiveScene(scene, SystemClock())
        ticking = group.create_task(run(live))
        await asyncio.sleep(_SETTLING)
        played.delays.clear()
        played.work.clear()
        await load(Intake(live), behaviors, seconds)
        ticking.cancel()
    return played


def _p99_ms(played: _Played) -> float:
    return round(1000 * quantiles(played.delays, n=100)[98], 1)
