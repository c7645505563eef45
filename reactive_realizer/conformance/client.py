"""A client of the protocol, as a planner uses it."""

import asyncio
import json
from collections.abc import Callable
from itertools import count
from typing import Any, Self

from lxml import etree

from reactive_realizer.client.realizer_socket import RealizerSocket
from reactive_realizer.testing.feedback_list import FeedbackList


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
        self._socket = RealizerSocket(url, patience)
        self.feedback = FeedbackList()
        self.mistakes: list[str] = []
        self._silent = True
        self._patience = patience
        self._refs = count(1)
        self._answered: set[object] = set()

    async def __aenter__(self) -> Self:
        await self._socket.__aenter__()
        return self

    async def __aexit__(self, *_: object) -> None:
        await self._socket.__aexit__()

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
            raise self._socket.not_reached(f"it accepted a document, but sent no message for {self._patience:g} s")

    async def send(self, xml: str) -> bool:
        """Sends a document; returns whether it was answered."""
        ref = next(self._refs)
        await self._socket.send(type="bml", xml=xml, ref=ref)
        return await self.until(lambda: ref in self._answered)

    async def until(self, condition: Callable[[], bool]) -> bool:
        """Receives messages until a condition holds; returns whether it held in time."""
        try:
            async with asyncio.timeout(self._patience):
                while not condition():
                    self._take(await self._socket.receive())
        except TimeoutError:
            return False
        return True

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
