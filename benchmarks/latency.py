"""Measures latency: the time from a request to its feedback, with a server process and a socket on loopback.

Each request is alone. In particular, predictions are sent less often than the realizer reports those of one block, so
that no report waits for this rate: what is measured is the way over the socket, and the wait for the next tick.
"""

import asyncio
import sys
from asyncio.subprocess import PIPE
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from statistics import quantiles
from time import perf_counter

import aiohttp

from reactive_realizer.clock.ticker import RATE
from reactive_realizer.limits import Limits
from reactive_realizer.testing.pilot import block

TICK_MS = 1000 / RATE

AIMS = {"predict_ms.p99": TICK_MS + 3, "activate_ms.p99": TICK_MS + 3}

_SERVE = (sys.executable, "-m", "reactive_realizer", "serve", "--voice", "text", "--port", "0")
_FAR = 3600.0
_APART = 1.2 / Limits().predictions_per_second
"""Time between two predictions, s: a fifth longer than that between two reports of predictions of a block."""
_GOLDEN = 0.618

_WAITING = block("waiting", '<gesture id="clap" lexeme="BEAT" stroke="anticipators:partner:hit"/>')
_WAIT = '<wait id="w" duration="0.05"/>'


def measure(runs: int = 300) -> dict[str, object]:
    """Median and 99th percentile, ms, for the prediction of a point and for an activation."""
    return {"tick_ms": TICK_MS} | asyncio.run(_measure(runs))


async def _measure(runs: int) -> dict[str, object]:
    async with _server() as address, _Planner.connected(address) as planner:
        await planner.prepare()
        return {
            "predict_ms": await _times(planner.predict, runs),
            "activate_ms": await _times(planner.activate, runs),
        }


async def _times(ask: Callable[[int], Awaitable[float]], runs: int) -> dict[str, float]:
    cuts = quantiles([await ask(number) for number in range(runs)], n=100)
    return {"p50": round(1000 * cuts[49], 3), "p99": round(1000 * cuts[98], 3)}


async def _between_ticks(number: int) -> float:
    """Waits for a quasi-random part of a tick, so that requests are not synchronized with it; returns the time, s."""
    await asyncio.sleep(number * _GOLDEN % 1.0 / RATE)
    return perf_counter()


@asynccontextmanager
async def _server() -> AsyncIterator[str]:
    """Starts a server, and gives its address."""
    process = await asyncio.create_subprocess_exec(*_SERVE, stderr=PIPE)
    assert process.stderr is not None
    try:
        async for line in process.stderr:
            if b"serving on" in line:
                yield line.decode().split()[-1]
                break
        else:
            raise RuntimeError("the server ended before it served")
    finally:
        process.terminate()
        await process.communicate()


class _Planner:
    """A planner that sends a request and waits for its feedback."""

    def __init__(self, socket: aiohttp.ClientWebSocketResponse) -> None:
        self._socket = socket
        self._now = 0.0

    @classmethod
    @asynccontextmanager
    async def connected(cls, address: str) -> AsyncIterator["_Planner"]:
        """Connects to a server."""
        async with aiohttp.ClientSession(address) as session, session.ws_connect("/ws?streams=feedback") as socket:
            yield cls(socket)

    async def prepare(self) -> None:
        """Sends a gesture with a stroke at an anticipator's point."""
        self._now = (await self._socket.receive_json())["time"]
        await self._send(type="bml", xml=_WAITING)
        await self._hear("predictionFeedback", 'id="waiting"')

    async def predict(self, number: int) -> float:
        """Time from a single prediction of that point to the new prediction of the gesture, s."""
        await asyncio.sleep(_APART)
        begin = await _between_ticks(number)
        await self._send(type="predict", anticipator="partner", sync="hit", time=self._now + _FAR + number)
        await self._hear("predictionFeedback", 'id="waiting"')
        return perf_counter() - begin

    async def activate(self, number: int) -> float:
        """Time from the activation of a preplanned block to its first sync point, s."""
        await self._send(type="bml", xml=block(f"p{number}", _WAIT, **{"bmla:preplan": "true"}))
        await self._hear(f'id="p{number}"', "PENDING")
        begin = await _between_ticks(number)
        await self._send(type="bml", xml=block(f"a{number}", **{"bmla:onStart": f"p{number}"}))
        await self._hear(f'id="p{number}:w:start"')
        return perf_counter() - begin

    async def _send(self, **message: object) -> None:
        await self._socket.send_json(message)

    async def _hear(self, *parts: str) -> None:
        """Waits for a feedback message that contains all of these parts."""
        while True:
            message = await self._socket.receive_json()
            if message["type"] == "error":
                raise RuntimeError(message["message"])
            if message["type"] == "feedback" and all(part in message["xml"] for part in parts):
                return
