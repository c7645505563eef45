"""A connection to a realizer behind a message broker of the Virtual Human Toolkit."""

import asyncio
import re
from collections.abc import Iterator
from contextlib import AsyncExitStack
from types import MappingProxyType
from typing import Final, Self

from lxml import etree

from reactive_realizer.client.realizer_socket import NotReached
from reactive_realizer.client.stomp_bus import Broker, StompBus, connected
from reactive_realizer.client.vh_message import VhMessage
from reactive_realizer.conformance.connection import START, Connection
from reactive_realizer.conformance.vhmsg_feedback import Timed, VhmsgFeedback
from reactive_realizer.errors import RealizerError

_RECIPIENT: Final = "conformance"
_ID: Final = re.compile(r"<bml\b[^>]*\bid=\"([\w.-]+)\"")
"""The id of a block in a document that cannot be read."""


class BrokerConnection(Connection):
    """Sends each block in a ``vrSpeak``, whose name is its id, and takes ``vrAgentBML`` and feedback on behaviors.

    Args:
        broker: of the realizer.
        scope: of its messages.
        agent: that plays what is sent.
        patience: time limit for every answer, s.
        start: time limit for the first feedback, s.
    """

    unfit = MappingProxyType(
        {
            "bad-character": "an agent that no component plays gets no answer",
            "bad-doctype": "a message contains a block without declarations",
            "bad-no-id": "the name of a message is the id of its block",
            "bad-twice": "the name of a message may be in use",
            "several": "a message contains one block",
        }
    )

    def __init__(self, broker: Broker, scope: str, agent: str, patience: float, start: float = START) -> None:
        super().__init__(patience, start)
        self._broker = broker
        self._scope = scope
        self._agent = agent
        self._stack = AsyncExitStack()
        self._clock = asyncio.get_running_loop().time
        self._reader = VhmsgFeedback(agent)

    async def __aenter__(self) -> Self:
        self._bus: StompBus = await self._stack.enter_async_context(connected(self._broker, f"/topic/{self._scope}"))
        return self

    async def __aexit__(self, *_: object) -> None:
        await self._stack.aclose()

    async def send(self, xml: str) -> bool:
        """Sends each block of a document; of one that cannot be read, the text."""
        for name, text in self._requests(xml):
            message = VhMessage("vrSpeak", f"{self._agent} {_RECIPIENT} {name} <act>{text}</act>")
            self._bus.send(message.text, **message.headers(self._scope))
        return True

    def _requests(self, xml: str) -> Iterator[tuple[str, str]]:
        """The name and the BML of each request for a document."""
        try:
            blocks = list(etree.fromstring(f"<_>{xml}</_>").iterchildren("{*}bml"))
        except etree.XMLSyntaxError:
            found = _ID.search(xml)
            yield "bml" if found is None else found[1], xml
            return
        for block in blocks:
            yield block.get("id", ""), etree.tostring(block, encoding="unicode", with_tail=False)

    async def _receive(self) -> None:
        """Takes the next feedback; other messages, such as those sent here, say nothing about the realizer."""
        told: list[Timed] = []
        while not told:
            told = list(self._reader.take(VhMessage.read(await self._bus.receive()), self._clock()))
        for time, xml in told:
            self._add(time, xml)

    def _not_reached(self, reason: str) -> RealizerError:
        url = f"{self._broker.host}:{self._broker.port}"
        return RealizerError(NotReached(url=url, reason=reason))
