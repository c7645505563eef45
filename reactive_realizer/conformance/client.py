"""A client of the protocol, as a planner uses it."""

import asyncio
import json
from collections.abc import Callable
from contextlib import AsyncExitStack
from itertools import count
from typing import Any, Self

import aiohttp
from lxml import etree
from yarl import URL

from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.testing.feedback_list import FeedbackList

_PROTOCOL = 2


class NotReached(Fault):
    """No connection to a realizer, or a connection that was lost."""

    code = "not-reached"
    template = "no realizer can be reached at {url}: {reason}"
    url: str
    reason: str


class OtherProtocol(Fault):
    """A server that does not speak this protocol."""

    code = "other-protocol"
    template = "{url} does not use protocol version {protocol}; its first message was {message}"
    url: str
    protocol: int
    message: str


class RealizerClient:
    """A connection to a realizer; used as an async context manager.

    Args:
        url: of its server or its socket; its query may contain a token.
        patience: time limit for every answer, s.

    Attributes:
        feedback: all feedback since the last `forget`.
        mistakes: the invalid messages since then.

    Raises:
        RealizerError: "not-reached" or "other-protocol"; also in `send` and `until`, if the connection is lost.
    """

    def __init__(self, url: str, patience: float) -> None:
        self.feedback = FeedbackList()
        self.mistakes: list[str] = []
        self._silent = True
        self._url = url
        self._patience = patience
        self._refs = count(1)
        self._answered: set[object] = set()

    async def __aenter__(self) -> Self:
        async with AsyncExitStack() as stack:
            await self._connect(stack)
            self._stack = stack.pop_all()
        return self

    async def __aexit__(self, *_: object) -> None:
        await self._stack.aclose()

    def forget(self) -> None:
        """Discards the feedback received so far."""
        self.feedback = FeedbackList()
        self.mistakes = []
        self._silent = True

    def check_alive(self) -> None:
        """Checks that any message was received since `forget`.

        Raises:
            RealizerError: "not-reached".
        """
        if self._silent:
            raise self._not_reached(f"it accepted a document, but sent no message for {self._patience:g} s")

    async def send(self, xml: str) -> bool:
        """Sends a document; returns whether it was answered."""
        ref = next(self._refs)
        await self._socket.send_json({"type": "bml", "xml": xml, "ref": ref})
        return await self.until(lambda: ref in self._answered)

    async def until(self, condition: Callable[[], bool]) -> bool:
        """Receives messages until a condition holds; returns whether it held in time."""
        try:
            async with asyncio.timeout(self._patience):
                while not condition():
                    self._take(await self._hear())
        except TimeoutError:
            return False
        return True

    async def _connect(self, stack: AsyncExitStack) -> None:
        try:
            async with asyncio.timeout(self._patience):
                session = await stack.enter_async_context(aiohttp.ClientSession())
                connecting = session.ws_connect(_socket_url(self._url), max_msg_size=0)
                self._socket = await stack.enter_async_context(connecting)
                hello = await self._hear()
        except (OSError, ValueError, aiohttp.ClientError) as problem:
            raise self._not_reached(str(problem) or type(problem).__name__) from problem
        if (hello.get("type"), hello.get("protocol")) != ("hello", _PROTOCOL):
            raise RealizerError(OtherProtocol(url=self._url, protocol=_PROTOCOL, message=json.dumps(hello)[:200]))

    async def _hear(self) -> dict[str, Any]:
        message = await self._socket.receive()
        if message.type is aiohttp.WSMsgType.BINARY:
            return {"type": "binary"}
        if message.type is not aiohttp.WSMsgType.TEXT:
            raise self._not_reached(f"the connection was lost ({self._socket.close_code})")
        try:
            decoded = json.loads(message.data)
        except ValueError:
            decoded = None
        return decoded if isinstance(decoded, dict) else {"type": None, "text": message.data}

    def _take(self, message: dict[str, Any]) -> None:
        self._silent = False
        try:
            match message:
                case {"type": "feedback", "time": float(time) | int(time), "xml": str(xml)}:
                    self.feedback.add(time, xml)
                case {"type": "accepted" | "error", "ref": ref}:
                    self._answered.add(ref)
                case {"type": "error"}:
                    pass
                case _:
                    self.mistakes.append(f"unexpected message {json.dumps(message)[:200]}")
        except etree.XMLSyntaxError as problem:
            self.mistakes.append(f"feedback that is not XML: {problem}")

    def _not_reached(self, reason: str) -> RealizerError:
        return RealizerError(NotReached(url=self._url, reason=reason))


def _socket_url(url: str) -> URL:
    address = URL(url)
    socket = address.with_path("/ws").with_query(address.query) if address.path in ("", "/") else address
    return socket.update_query(streams="feedback")
