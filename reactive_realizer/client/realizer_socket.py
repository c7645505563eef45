"""The socket of a realizer (docs/protocol.md), as its clients see it."""

import asyncio
import json
from contextlib import AsyncExitStack
from typing import Any, Final, Self

import aiohttp
from yarl import URL

from reactive_realizer.errors import Fault, RealizerError

_PROTOCOL: Final = 2
_SCHEMES: Final = ("http", "https", "ws", "wss")
_EXAMPLE: Final = "http://127.0.0.1:8088"

Message = dict[str, Any]


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


class RealizerSocket:
    """A connection to a realizer, with its feedback; used as an async context manager.

    Args:
        url: of its server or its socket; its query may contain a token.
        patience: time limit for the connection, s.

    Attributes:
        hello: the first message of the realizer.

    Raises:
        RealizerError: "not-reached" or "other-protocol".
    """

    hello: Message

    def __init__(self, url: str, patience: float = 10.0) -> None:
        self._url = url
        self._shown = url.partition("?")[0]  # without the token, which does not belong into a log
        self._patience = patience

    async def __aenter__(self) -> Self:
        async with AsyncExitStack() as stack:
            await self._connect(stack)
            self._stack = stack.pop_all()
        return self

    async def __aexit__(self, *_: object) -> None:
        await self._stack.aclose()

    async def send(self, **message: object) -> None:
        """Send a message.

        Raises:
            RealizerError: "not-reached": the connection was lost.
        """
        try:
            await self._socket.send_json(message)
        except ConnectionError as problem:
            raise self.not_reached(str(problem)) from problem

    async def receive(self) -> Message:
        """The next message; one that is not an object of JSON has the type None and its text.

        Raises:
            RealizerError: "not-reached": the connection was lost.
        """
        message = await self._socket.receive()
        if message.type is aiohttp.WSMsgType.BINARY:
            return {"type": "binary"}
        if message.type is not aiohttp.WSMsgType.TEXT:
            raise self.not_reached(f"the connection was lost ({self._socket.close_code})")
        try:
            decoded = json.loads(message.data)
        except ValueError:
            decoded = None
        return decoded if isinstance(decoded, dict) else {"type": None, "text": message.data}

    def not_reached(self, reason: str) -> RealizerError:
        """The error of a connection that does not work."""
        return RealizerError(NotReached(url=self._shown, reason=reason))

    async def _connect(self, stack: AsyncExitStack) -> None:
        try:
            async with asyncio.timeout(self._patience):
                session = await stack.enter_async_context(aiohttp.ClientSession())
                connecting = session.ws_connect(_socket_url(self._url), max_msg_size=0)
                self._socket = await stack.enter_async_context(connecting)
                self.hello = await self.receive()
        except aiohttp.ClientResponseError as problem:  # its text has the URL, with the token
            raise self.not_reached(f"{problem.status}, {problem.message}") from problem
        except (OSError, ValueError, aiohttp.ClientError) as problem:
            raise self.not_reached(str(problem) or type(problem).__name__) from problem
        if (self.hello.get("type"), self.hello.get("protocol")) != ("hello", _PROTOCOL):
            text = json.dumps(self.hello)[:200]
            raise RealizerError(OtherProtocol(url=self._shown, protocol=_PROTOCOL, message=text))


def _socket_url(url: str) -> URL:
    """The address of the socket.

    Raises:
        ValueError: this is no address of a server.
    """
    address = URL(url)
    if address.scheme not in _SCHEMES or not address.host:
        raise ValueError(f"this is not an address such as {_EXAMPLE}")
    socket = address.with_path("/ws").with_query(address.query) if address.path in ("", "/") else address
    return socket.update_query(streams="feedback")
