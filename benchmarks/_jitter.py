"""A socket with jitter: a relay before a server that holds up what it sends."""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from random import Random

from yarl import URL


@asynccontextmanager
async def jittery(address: URL, jitter: float) -> AsyncIterator[URL]:
    """Another address of a server. What it sends from there is late by 0 to `jitter` s, evenly, and stays in order."""
    random = Random(1)

    async def take(reader: asyncio.StreamReader, held: asyncio.Queue[tuple[float, bytes]], most: float) -> None:
        data = b"to begin"
        while data:
            try:
                data = await reader.read(65536)
            except ConnectionError:
                data = b""
            held.put_nowait((asyncio.get_running_loop().time() + random.uniform(0.0, most), data))

    async def give(held: asyncio.Queue[tuple[float, bytes]], writer: asyncio.StreamWriter) -> None:
        while True:
            due, data = await held.get()
            await asyncio.sleep(due - asyncio.get_running_loop().time())
            if not data:
                writer.close()
                return
            writer.write(data)

    async def connect(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        there, back = await asyncio.open_connection(address.host, address.port)
        up, down = asyncio.Queue[tuple[float, bytes]](), asyncio.Queue[tuple[float, bytes]]()
        await asyncio.gather(take(reader, up, 0.0), give(up, back), take(there, down, jitter), give(down, writer))

    async with await asyncio.start_server(connect, "127.0.0.1", 0) as server:
        host, port = server.sockets[0].getsockname()
        yield URL.build(scheme="http", host=host, port=port, path="/")
