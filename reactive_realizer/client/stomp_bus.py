"""A connection to a message broker over STOMP (stomp.py, an extra)."""

import asyncio
import logging
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from importlib.util import find_spec
from typing import Any, NamedTuple

from reactive_realizer.errors import Fault, RealizerError

logging.getLogger("stomp.py").setLevel(logging.CRITICAL)  # what it reports is reported as a fault


class NoBroker(Fault):
    """No connection to a message broker, or a connection that was lost."""

    code = "no-broker"
    template = "no message broker can be reached at {host}:{port}: {reason}"
    host: str
    port: int
    reason: str


class Broker(NamedTuple):
    """A broker.

    Attributes:
        host: its address.
        port: for STOMP.
        login: user name.
        passcode: password of the user.
    """

    host: str = "localhost"
    port: int = 61613
    login: str = "guest"
    passcode: str = "guest"


class StompBus:
    """A topic of a broker.

    Args:
        broker: where it is.
        topic: its destination, ``/topic/NAME``.
        connection: to the broker.
    """

    def __init__(self, broker: Broker, topic: str, connection: Any) -> None:
        self._broker = broker
        self._topic = topic
        self._connection = connection
        self._texts: asyncio.Queue[str | None] = asyncio.Queue()
        self._loop = asyncio.get_running_loop()

    def send(self, text: str, **headers: str) -> None:
        """Send a text.

        Raises:
            RealizerError: "no-broker": the connection was lost.
        """
        from stomp.exception import StompException

        try:
            self._connection.send(self._topic, text, headers=headers)
        except (StompException, OSError) as problem:
            raise self._lost(str(problem)) from problem

    async def receive(self) -> str:
        """The next text.

        Raises:
            RealizerError: "no-broker": the connection was lost.
        """
        text = await self._texts.get()
        if text is None:
            raise self._lost("the connection was lost")
        return text

    # --- called in the thread of the connection

    def on_message(self, frame: Any) -> None:
        """Take a text of the broker."""
        self._loop.call_soon_threadsafe(self._texts.put_nowait, str(frame.body))

    def on_disconnected(self) -> None:
        """Take the loss of the connection."""
        self._loop.call_soon_threadsafe(self._texts.put_nowait, None)

    def _lost(self, reason: str) -> RealizerError:
        return RealizerError(NoBroker(host=self._broker.host, port=self._broker.port, reason=reason))


@asynccontextmanager
async def connected(broker: Broker, topic: str) -> AsyncIterator[StompBus]:
    """Connect to a topic.

    Raises:
        RealizerError: "no-broker".
    """
    if find_spec("stomp") is None:
        reason = "pip install 'reactive-realizer[vhmsg]'"
        raise RealizerError(NoBroker(host=broker.host, port=broker.port, reason=reason))
    import stomp
    from stomp.exception import StompException

    connection = stomp.Connection11([(broker.host, broker.port)], reconnect_attempts_max=1)
    connection.auto_content_length = False  # with a length, ActiveMQ takes a text for bytes
    bus = StompBus(broker, topic, connection)
    try:
        await asyncio.to_thread(connection.connect, broker.login, broker.passcode, wait=True)
    except (StompException, OSError) as problem:
        raise RealizerError(NoBroker(host=broker.host, port=broker.port, reason="it does not answer")) from problem
    connection.set_listener("", _listener(bus))
    connection.subscribe(topic, id="1")
    try:
        yield bus
    finally:
        connection.remove_listener("")
        await asyncio.to_thread(connection.disconnect)


def _listener(bus: StompBus) -> Any:
    import stomp

    listener = stomp.ConnectionListener()
    listener.on_message = bus.on_message
    listener.on_disconnected = bus.on_disconnected
    return listener
