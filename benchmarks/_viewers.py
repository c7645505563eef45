"""Measures what viewers cost: a server in its own process, and sockets that receive its frames."""

import asyncio
import json
import os
from pathlib import Path
from tempfile import TemporaryDirectory
from urllib.request import urlopen

from yarl import URL

from benchmarks._served import served
from reactive_realizer.clock.punctual_loop import run_punctually
from reactive_realizer.clock.ticker import FRAME_EVERY, RATE

_BINARY, _PING = 0x82, 0x89
"""First bytes of messages in one piece (RFC 6455, 5.2)."""
_PONG = bytes((0x8A, 0x80, 0, 0, 0, 0))
"""A message of a client, masked by zeros."""

NUMBERS = ("cpu_share", "frames_arrived", "late_p99_ms")
"""Names of the figures of an audience."""

_SETTLING = 1.0
"""Time after which the last viewer receives frames, s."""


def measure(viewers: int, seconds: float, characters: int = 1) -> dict[str, float]:
    """The share of a core that the server takes, the share of the frames that arrive, and the lateness of ticks.

    Args:
        viewers: number of sockets.
        seconds: duration of the run, after all have connected.
        characters: their number; all breathe and blink, and do nothing else.
    """
    with TemporaryDirectory() as folder:
        human = Path(folder, "human.toml")
        limits = f"clients = {viewers}\nconnections = {viewers + 10}\n"
        cast = "".join(f"[character.c{n}]\nposition = [{n}, 0, 0]\n" for n in range(characters))
        human.write_text(f"{cast}[limits]\n{limits}", encoding="utf-8")
        return run_punctually(_measure(human, viewers, seconds))


async def _measure(human: Path, viewers: int, seconds: float) -> dict[str, float]:
    async with served(human, "text") as (address, pid):
        loop = asyncio.get_running_loop()
        connecting = (
            loop.create_connection(lambda: _Viewer(address), str(address.host), int(address.port or 0))
            for _ in range(viewers)
        )
        watching = [viewer for _, viewer in [await each for each in connecting]]
        await asyncio.sleep(_SETTLING)
        used, seen, begin = _cpu_seconds(pid), sum(each.messages for each in watching), loop.time()
        await asyncio.sleep(seconds)
        used, seen = _cpu_seconds(pid) - used, sum(each.messages for each in watching) - seen
        elapsed = loop.time() - begin
        late = await asyncio.to_thread(_late_p99_ms, address)
        for each in watching:
            each.leave()
    sent = viewers * elapsed * RATE / FRAME_EVERY
    arrived = round(min(1.0, seen / sent), 4)
    return dict(zip(NUMBERS, (round(used / elapsed, 4), arrived, late), strict=True))


def _late_p99_ms(address: URL) -> float:
    """The lateness of the last thousand ticks, ms."""
    with urlopen(str(address / "status")) as answer:
        late: float = json.load(answer)["ticks"]["late_p99_ms"]
        return late


def _cpu_seconds(pid: int) -> float:
    """The processor time of a process, s (proc(5))."""
    fields = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class _Viewer(asyncio.Protocol):
    """A socket that receives frames, and counts them; it does as little as it can, because it runs beside the server.

    Attributes:
        messages: number of binary messages.
    """

    def __init__(self, address: URL) -> None:
        self.messages = 0
        self._address = address
        self._data = bytearray()
        self._open = False

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        assert isinstance(transport, asyncio.WriteTransport)
        self._transport = transport
        transport.write(
            f"GET /ws?streams=frames HTTP/1.1\r\nHost: {self._address.authority}\r\nUpgrade: websocket\r\n"
            "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n".encode()
        )

    def data_received(self, data: bytes) -> None:
        self._data += data
        if not self._open:
            _, end, rest = self._data.partition(b"\r\n\r\n")
            if not end:
                return
            self._open, self._data = True, rest
        while (size := _message_size(self._data)) is not None and len(self._data) >= size:
            self.messages += self._data[0] == _BINARY
            if self._data[0] == _PING:  # it has no contents, nor needs its answer any
                self._transport.write(_PONG)
            del self._data[:size]

    def leave(self) -> None:
        self._transport.abort()


def _message_size(data: bytearray) -> int | None:
    """The size of the first message with its header (RFC 6455, 5.2), None if its header has not arrived."""
    if len(data) < 4:
        return None
    length = data[1] & 0x7F
    if length < 126:
        return 2 + length
    if length == 126:
        return 4 + int.from_bytes(data[2:4])
    return None if len(data) < 10 else 10 + int.from_bytes(data[2:10])
