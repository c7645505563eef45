"""Stands in for EMBR: takes EMBRScript over TCP, as EMBOTS and the Behavior Builder send it, and reports over UDP.

A client of EMBR opens a connection for each script, writes the script and closes the connection; EMBR listens on port
5555. Feedback goes to port 5556, one message of BML in each datagram.
"""

import argparse
import asyncio
import logging
import re
import socket
from collections.abc import Awaitable, Callable, Mapping
from functools import partial
from typing import Any, Final

from lxml import etree

from reactive_realizer.bridges.bridge import Bridge
from reactive_realizer.client.broker_options import add_address
from reactive_realizer.client.realizer_socket import RealizerSocket
from reactive_realizer.errors import RealizerError, WarningType
from reactive_realizer.feedback.messages import WarningFeedback
from reactive_realizer.feedback.xml import to_xml
from reactive_realizer.limits import Limits

logger = logging.getLogger(__name__)

MEDIA_TYPE: Final = "application/vnd.embr"

_HTTP: Final = re.compile(rb"[A-Z]+ [^\s]+ HTTP/")
"""The first line of an HTTP request."""

_REPORTED: Final = ("blockProgress", "syncPointProgress", "warningFeedback")
"""The feedback of BML 1.0. Predictions, which change while a block plays, are not reported."""


Address = tuple[str, int]
"""A host and a port."""

LISTEN: Final = ("localhost", 5555)
"""The address at which EMBR receives scripts."""
FEEDBACK: Final = ("localhost", 5556)
"""The address at which EMBOTS receives feedback."""


async def run_bridge(
    url: str, listen: Address, feedback: Address, ready: Callable[[Address], object] = lambda address: None
) -> None:
    """Pass scripts on to a realizer, and feedback to a port.

    Args:
        url: of the realizer.
        listen: where scripts are taken, over TCP; any free port if that is 0.
        feedback: where the feedback of the realizer goes, over UDP.
        ready: is called with the address once scripts are taken there.

    Raises:
        RealizerError: "not-reached" or "other-protocol"; also if the connection is lost.
        OSError: the bridge cannot listen at the address, or there is no such host.
    """
    async with RealizerSocket(url) as realizer:
        reports = await _reports(feedback)
        try:
            bridge = EmbrBridge(partial(_send, realizer), reports.sendto)
            async with await asyncio.start_server(bridge.take, *listen) as server:
                ready(server.sockets[0].getsockname()[:2])
                while True:
                    bridge.report(await realizer.receive())
        finally:
            reports.close()


async def _reports(feedback: Address) -> asyncio.DatagramTransport:
    """Open the way to the receiver of feedback.

    Raises:
        OSError: its host is not known.
    """
    loop = asyncio.get_running_loop()
    try:
        transport, _ = await loop.create_datagram_endpoint(
            asyncio.DatagramProtocol, remote_addr=feedback, family=socket.AF_INET
        )
    except OSError as problem:
        raise OSError(f"feedback cannot be sent to {feedback[0]}: {problem}") from problem
    return transport


async def _send(realizer: RealizerSocket, message: Mapping[str, object]) -> None:
    await realizer.send(**message)


class EmbrBridge:
    """Passes scripts on, each the whole text of a connection, and feedback.

    Args:
        send: sends a message to the realizer.
        report: sends a report, as XML in UTF-8.
        limits: of the connections at the same time, and of the size and time of a script.
    """

    def __init__(
        self,
        send: Callable[[Mapping[str, object]], Awaitable[None]],
        report: Callable[[bytes], object],
        limits: Limits | None = None,
    ) -> None:
        self._send = send
        self._report = report
        self._limits = limits or Limits()
        self._open = 0

    async def take(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Take the script of a connection; one without text only tests whether the port is open.

        A request of HTTP is refused, because any page that is open in a browser here can send one.
        """
        self._open += 1
        try:
            if self._open > self._limits.connections:
                raise ValueError(f"the limit of open connections is {self._limits.connections}")
            async with asyncio.timeout(self._limits.body_seconds):
                script = await _all_of(reader, self._limits.message_bytes)
            if _HTTP.match(script):
                self._fail("it is a request of HTTP, as pages send them")
            elif script.strip():
                text = script.decode("utf-8", "replace")
                await self._send({"type": "bml", "xml": text, "mediaType": MEDIA_TYPE, "ref": "script"})
        except (OSError, TimeoutError, ValueError) as problem:
            self._fail(str(problem) or "the script did not end")
        except RealizerError as lost:
            logger.warning("a script is lost: %s", lost.fault.sentence)
        finally:
            self._open -= 1
            writer.close()

    def report(self, message: Mapping[str, Any]) -> None:
        """Take a message of the realizer, and report feedback of BML 1.0, and that a script is refused.

        What is wrong in a script that was read is feedback.
        """
        if message["type"] == "error" and "warnings" not in message:
            self._fail(message["message"])
        elif message["type"] == "feedback" and etree.QName(etree.fromstring(message["xml"])).localname in _REPORTED:
            self._report(message["xml"].encode())

    def _fail(self, reason: str) -> None:
        logger.warning("a script is refused: %s", reason)
        self._report(to_xml(WarningFeedback(None, "bml", WarningType.PARSING_FAILURE, reason)).encode())


async def _all_of(reader: asyncio.StreamReader, most: int) -> bytes:
    """Read until the connection is closed.

    Raises:
        ValueError: it is too long.
    """
    received = bytearray()
    while part := await reader.read(65536):
        received += part
        if len(received) > most:
            raise ValueError(f"the script has more than {most} bytes")
    return bytes(received)


def _add_options(parser: argparse.ArgumentParser) -> None:
    add_address(parser, "--listen", LISTEN, "where scripts are taken, over TCP")
    add_address(parser, "--feedback", FEEDBACK, "where feedback is sent, over UDP")


async def _run(url: str, options: argparse.Namespace) -> None:
    await run_bridge(url, options.listen, options.feedback)


BRIDGE = Bridge(
    "Takes EMBRScript in the place of EMBR, plays it on a realizer, and reports its feedback.", _run, _add_options
)
