"""Measures the planning of a block: from its text to its pegs on the board, with the text voice."""

import asyncio
from statistics import median, quantiles
from time import perf_counter

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.server.live_scene import keep_from_ticks
from reactive_realizer.testing.pilot import RealizerPilot, block, open_pilot

AIMS = {
    "strategies.convex.20.median_ms": 8,
    "chain.10": 2,
    "chain.50": 8,
    "chain.100": 16,
    "chain.200": 32,
}

_STRATEGIES = ("smartbody", "embr", "convex")
_RUNS = {1: 60, 5: 60, 20: 40, 100: 12}
_CHAINS = {10: 30, 50: 15, 100: 9, 200: 7}
_PREPLANNED = {"bmla:preplan": "true"}

_TALK = '<speech id="b{0}"{1}><text>one <sync id="m"/>two three</text></speech>'
_SPREAD = (
    '<gesture id="b{0}" lexeme="BEAT" stroke="b{1}:m"/>',
    '<head id="b{0}" lexeme="NOD" start="b{1}:start+0.2"/>',
    '<gaze id="b{0}" target="camera" start="b{1}:start" end="b{1}:end+1"/>',
    '<wait id="b{0}" start="b{1}:end" duration="0.3"/>',
)
_CHAIN = (
    '<head id="b{0}" lexeme="NOD"{1}/>',
    '<gesture id="b{0}" lexeme="BEAT"{1}/>',
    '<wait id="b{0}" duration="1"{1}/>',
)


def measure(most: int = 100) -> dict[str, object]:
    """Medians and 99th percentiles for each strategy, ms, and medians of chains with the default strategy.

    Args:
        most: number of blocks of one kind.
    """
    sizes = {n: min(runs, most) for n, runs in _RUNS.items()}
    spread = {name: {str(n): asyncio.run(_spread_ms(name, n, sizes[n])) for n in sizes} for name in _STRATEGIES}
    return {
        "strategies": spread,
        "chain": {str(n): asyncio.run(_chain_ms(n, min(runs, most))) for n, runs in _CHAINS.items()},
    }


def spread(number: int) -> str:
    """Consecutive speeches, each with a gesture, a nod, a gaze and a pause tied to it."""
    parts = []
    for i in range(number):
        group = i - i % 5
        after = f' start="b{group - 1}:end"' if group else ""
        parts.append(_TALK.format(i, after) if i == group else _SPREAD[i - group - 1].format(i, group))
    return "".join(parts)


def chain(number: int) -> str:
    """Heads, gestures and waits in turn, each starting at the end of the previous behavior."""
    starts = (f' start="b{i - 1}:end"' if i else "" for i in range(number))
    return "".join(_CHAIN[i % 3].format(i, start) for i, start in enumerate(starts))


async def _spread_ms(strategy: str, number: int, runs: int) -> dict[str, float]:
    times = await _times(strategy, spread(number), number, runs)
    return {"median_ms": round(median(times), 3), "p99_ms": round(quantiles(times, n=100)[98], 3)}


async def _chain_ms(number: int, runs: int) -> float:
    return round(median(await _times("convex", chain(number), number, runs)), 3)


async def _times(strategy: str, inside: str, number: int, runs: int) -> list[float]:
    async with open_pilot(SceneOptions(voice="text", strategy=strategy)) as pilot:
        await pilot.advance(0.1)
        keep_from_ticks()  # as a server does
        return [await _plan(pilot, inside, number) for _ in range(runs + 1)][1:]


async def _plan(pilot: RealizerPilot, inside: str, number: int) -> float:
    """Time until the pegs of a block are on the board, ms; it is preplanned, so that it does not play."""
    pilot.perform(block("b", inside, **_PREPLANNED))
    begin = perf_counter()
    await pilot.tick()
    while not pilot.realizer.scheduler.blocks.alive[0].units:
        await pilot.tick()
    taken = 1000 * (perf_counter() - begin)
    planned = len(pilot.realizer.scheduler.blocks.alive[0].units)
    if planned != number:
        raise RuntimeError(f"{planned} of {number} behaviors were planned")
    pilot.block("clear", composition="REPLACE")
    await pilot.tick()
    while pilot.realizer.scheduler.blocks.alive:  # a big block leaves no time in this tick
        await pilot.tick()
    return taken
