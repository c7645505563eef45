"""How soon a planner hears of what it asked for, from a server in a process of its own, over a socket on loopback."""

import asyncio
import sys
from asyncio.subprocess import PIPE
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from statistics import quantiles
from time import perf_counter

import aiohttp

from reactive_realizer.clock.ticker import RATE
from reactive_realizer.testing.pilot import block

TICK_MS = 1000 / RATE

AIMS = {"predict_ms.p99": TICK_MS + 3, "activate_ms.p99": TICK_MS + 3}

_SERVE = (sys.executable, "-m", "reactive_realizer", "serve", "--voice", "text", "--port", "0")
_FAR = 3600.0
_GOLDEN = 0.618

_WAITING = block("waiting", '<gesture id="clap" lexeme="BEAT" stroke="anticipators:partner:hit"/>')
_WAIT = '<wait id="w" duration="0.05"/>'


def measure(runs: int = 300) -> dict[str, object]:
    """From sending to hearing, ms, median and one in a hundred: a new time of a predicted point, and an activation."""
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


async def _anywhen(number: int) -> float:
    """Wait until anywhere between two ticks: feedback, which comes with a tick, is no moment like any other."""
    await asyncio.sleep(number * _GOLDEN % 1.0 / RATE)
    return perf_counter()


@asynccontextmanager
async def _server() -> AsyncIterator[str]:
    """The address of a server on the air."""
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
    """Somebody who asks, and waits for what comes of it."""

    def __init__(self, socket: aiohttp.ClientWebSocketResponse) -> None:
        self._socket = socket
        self._now = 0.0

    @classmethod
    @asynccontextmanager
    async def connected(cls, address: str) -> AsyncIterator["_Planner"]:
        """At the other end of a socket."""
        async with aiohttp.ClientSession(address) as session, session.ws_connect("/ws?streams=feedback") as socket:
            yield cls(socket)

    async def prepare(self) -> None:
        """A gesture is to meet a point far ahead, which is predicted from then on."""
        self._now = (await self._socket.receive_json())["time"]
        await self._send(type="bml", xml=_WAITING)
        await self._hear("predictionFeedback", 'id="waiting"')

    async def predict(self, number: int) -> float:
        """A new time for a point that a gesture waits for, until the gesture is predicted anew; s."""
        begin = await _anywhen(number)
        await self._send(type="predict", anticipator="partner", sync="hit", time=self._now + _FAR + number)
        await self._hear("predictionFeedback", 'id="waiting"')
        return perf_counter() - begin

    async def activate(self, number: int) -> float:
        """A preplanned block, until its first sync point is reached; s."""
        await self._send(type="bml", xml=block(f"p{number}", _WAIT, **{"bmla:preplan": "true"}))
        await self._hear(f'id="p{number}"', "PENDING")
        begin = await _anywhen(number)
        await self._send(type="bml", xml=block(f"a{number}", **{"bmla:onStart": f"p{number}"}))
        await self._hear(f'id="p{number}:w:start"')
        return perf_counter() - begin

    async def _send(self, **message: object) -> None:
        await self._socket.send_json(message)

    async def _hear(self, *parts: str) -> None:
        """Wait for feedback that holds all of these."""
        while True:
            message = await self._socket.receive_json()
            if message["type"] == "error":
                raise RuntimeError(message["message"])
            if message["type"] == "feedback" and all(part in message["xml"] for part in parts):
                return
