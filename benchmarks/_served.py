"""A server in its own process."""

import asyncio
import sys
from asyncio.subprocess import PIPE
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

from yarl import URL


@asynccontextmanager
async def served(human: Path, voice: str) -> AsyncIterator[tuple[URL, int]]:
    """The address and the process id of a server.

    Args:
        human: the human file.
        voice: id of the text-to-speech system.
    """
    command = ("-m", "reactive_realizer", "serve", "--voice", voice, "--port", "0", "--human", str(human))
    process = await asyncio.create_subprocess_exec(sys.executable, *command, stderr=PIPE)
    assert process.stderr is not None
    try:
        async for line in process.stderr:
            if b"serving on" in line:
                break
        yield URL(line.decode().split()[-1]), process.pid
    finally:
        process.terminate()
        await process.communicate()
