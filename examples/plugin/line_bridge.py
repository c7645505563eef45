"""A bridge that has the first character say each line that is sent to a TCP port."""

import argparse
import asyncio
import logging
from functools import partial
from itertools import count
from xml.sax.saxutils import escape

from reactive_realizer.bml.names import BML
from reactive_realizer.bridges.bridge import Bridge
from reactive_realizer.client.realizer_socket import RealizerSocket

logger = logging.getLogger(__name__)

_NUMBERS = count(1)


async def run(url: str, options: argparse.Namespace) -> None:
    """Pass lines on until the realizer is lost, or the bridge is canceled."""
    async with (
        RealizerSocket(url) as realizer,
        await asyncio.start_server(partial(_take, realizer), "localhost", options.port),
    ):
        while True:
            message = await realizer.receive()
            if message["type"] == "error":
                logger.warning("a line is not said: %s", message["message"])


async def _take(realizer: RealizerSocket, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    while line := await reader.readline():
        text = escape(line.decode("utf-8", "replace").strip())
        block = f'<bml xmlns="{BML}" id="line{next(_NUMBERS)}" composition="APPEND">'
        await realizer.send(type="bml", xml=f'{block}<speech id="said"><text>{text}</text></speech></bml>')
    writer.close()


def _add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--port", type=int, default=7000, help="where lines are taken, 7000")


LINES = Bridge("Has the first character say each line that is sent to a TCP port.", run, _add_options)
