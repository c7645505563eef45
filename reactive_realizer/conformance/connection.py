"""Connections to the realizer under test: the socket of the protocol, or a program that reads and writes lines."""

import asyncio
import json
import os
import shlex
from abc import ABC, abstractmethod
from asyncio.subprocess import PIPE, Process
from collections.abc import Callable, Mapping
from contextlib import suppress
from itertools import count
from signal import SIGKILL, SIGTERM
from types import MappingProxyType
from typing import Any, ClassVar, Final, Self

from lxml import etree

from reactive_realizer.client.realizer_socket import NotReached, RealizerSocket
from reactive_realizer.errors import RealizerError, quoted
from reactive_realizer.testing.feedback_list import FeedbackList

START: Final = 5.0
"""Time limit for the first feedback, s."""
_SENT: Final = ("bml", "act")
"""Elements that are sent to a realizer; a program that sends them back is no realizer."""
_LONGEST_LINE = 16_000_000
"""Bytes."""
_MOST_MESSAGES: Final = 10_000
"""For one part of a case; a realizer that predicts 100 times in a second sends a tenth of that."""
_END: Final = 2.0
"""Time limit for the end of a program, s."""


class Connection(ABC):
    """A connection to a realizer; used as an async context manager.

    Args:
        patience: time limit for every answer, s.
        start: time limit for the first feedback, s.

    Attributes:
        feedback: all feedback since the last `forget`.
        mistakes: the invalid messages since then.
        unfit: why cases cannot be tried over such a connection, by their names.

    Raises:
        RealizerError: "not-reached" or "other-protocol"; also in `send` and `until`, if the connection is lost.
    """

    unfit: ClassVar[Mapping[str, str]] = MappingProxyType({})

    def __init__(self, patience: float, start: float = START) -> None:
        self.feedback = FeedbackList()
        self.mistakes: list[str] = []
        self._silent = True
        self._said = ""
        self._limit = min(start, patience)
        self._patience = patience

    @abstractmethod
    async def __aenter__(self) -> Self: ...

    @abstractmethod
    async def __aexit__(self, *_: object) -> None: ...

    @abstractmethod
    async def send(self, xml: str) -> bool:
        """Sends a document; returns whether it was answered in time."""

    @abstractmethod
    async def _receive(self) -> None:
        """Takes the next message."""

    @abstractmethod
    def _not_reached(self, reason: str) -> RealizerError: ...

    def forget(self) -> None:
        """Discards the feedback received so far."""
        self.feedback = FeedbackList()
        self.mistakes = []
        self._silent = True
        self._said = ""

    def check_alive(self) -> None:
        """Checks that any feedback was received since `forget`.

        Raises:
            RealizerError: "not-reached".
        """
        if self._silent:
            instead = f", only '{self._said}'" if self._said else ""
            raise self._not_reached(f"it was sent a block, but sent no feedback for {self._limit:g} s{instead}")

    async def until(self, condition: Callable[[], bool]) -> bool:
        """Receives messages until a condition holds; returns whether it held in time.

        Raises:
            RealizerError: "not-reached": there are too many messages.
        """
        try:
            async with asyncio.timeout(self._limit):
                while not condition():
                    await self._receive()
                    self._check_number()
                    await asyncio.sleep(0)  # while messages wait to be read, nothing else lets the time run out
        except TimeoutError:
            return False
        return True

    def _check_number(self) -> None:
        if len(self.feedback.raw) + len(self.mistakes) > _MOST_MESSAGES:
            reason = f"it sends more than {_MOST_MESSAGES} messages for a case, the last one '{self._said}'"
            raise self._not_reached(reason)

    def _add(self, time: float, xml: str) -> None:
        self._note(xml)
        try:
            kind = etree.QName(etree.fromstring(xml)).localname
        except etree.XMLSyntaxError as problem:
            self.mistakes.append(f"feedback that is not XML: {problem}")
            return
        if kind in _SENT:
            self.mistakes.append(f"<{kind}> is not feedback")
            return
        self.feedback.add(time, xml)
        self._silent = False
        self._limit = self._patience

    def _note(self, text: str) -> None:
        """Remembers the last message, for a realizer that does not send what it should."""
        self._said = quoted(text)


class SocketConnection(Connection):
    """A client of the protocol, as a planner uses it.

    Args:
        url: of the realizer's server or its socket; its query may contain a token.
        patience: time limit for every answer, s.
        start: time limit for the first feedback, s.
    """

    def __init__(self, url: str, patience: float, start: float = START) -> None:
        super().__init__(patience, start)
        self._socket = RealizerSocket(url, patience)
        self._refs = count(1)
        self._answered: set[object] = set()

    async def __aenter__(self) -> Self:
        await self._socket.__aenter__()
        return self

    async def __aexit__(self, *_: object) -> None:
        await self._socket.__aexit__()

    async def send(self, xml: str) -> bool:
        """Sends a document; returns whether it was answered in time."""
        ref = next(self._refs)
        await self._socket.send(type="bml", xml=xml, ref=ref)
        return await self.until(lambda: ref in self._answered)

    async def _receive(self) -> None:
        self._take(await self._socket.receive())

    def _take(self, message: dict[str, Any]) -> None:
        match message:
            case {"type": "feedback", "time": float(time) | int(time), "xml": str(xml)}:
                self._add(time, xml)
            case {"type": "accepted" | "error", "ref": ref}:
                self._answered.add(ref)
            case {"type": "error"}:
                pass
            case _:
                self._note(json.dumps(message))
                self.mistakes.append(f"unexpected message {json.dumps(message)[:200]}")

    def _not_reached(self, reason: str) -> RealizerError:
        return self._socket.not_reached(reason)


class ProgramConnection(Connection):
    """A program that reads a document of BML from each line of its input, and writes each feedback in a line.

    Lines that do not begin with ``<`` are not feedback, and are ignored. The program is ended with the connection.

    Args:
        command: the program and its arguments, as in a shell.
        patience: time limit for every answer, s.
        start: time limit for the first feedback, s.
    """

    def __init__(self, command: str, patience: float, start: float = START) -> None:
        super().__init__(patience, start)
        self._command = command
        self._clock = asyncio.get_running_loop().time

    async def __aenter__(self) -> Self:
        try:
            words = shlex.split(self._command)
            if not words:
                raise ValueError("no program is named")
            self._process: Process = await asyncio.create_subprocess_exec(
                *words, stdin=PIPE, stdout=PIPE, limit=_LONGEST_LINE, process_group=0
            )
        except (OSError, ValueError) as problem:
            raise self._not_reached(str(problem)) from problem
        return self

    async def __aexit__(self, *_: object) -> None:
        for signal in (SIGTERM, SIGKILL):
            if self._process.returncode is None:
                os.killpg(self._process.pid, signal)  # with the programs that it has started
            with suppress(TimeoutError):
                async with asyncio.timeout(_END):
                    return await self._finish()

    async def _finish(self) -> None:
        """Waits for the end of the program; what it still writes is read, but not kept."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.close()
        while await self._process.stdout.read(_LONGEST_LINE):
            pass
        await self._process.wait()

    async def send(self, xml: str) -> bool:
        """Writes a document in a line."""
        assert self._process.stdin is not None
        self._process.stdin.write(" ".join(xml.splitlines()).encode() + b"\n")
        try:
            await self._process.stdin.drain()
        except ConnectionError as problem:
            raise self._not_reached(str(problem)) from problem
        return True

    async def _receive(self) -> None:
        assert self._process.stdout is not None
        try:
            line = await self._process.stdout.readline()
        except ValueError as problem:
            raise self._not_reached(f"it wrote a line of more than {_LONGEST_LINE} bytes") from problem
        if not line:
            raise self._not_reached(f"it ended with status {await self._process.wait()}")
        text = line.decode(errors="replace").strip()
        if text.startswith("<"):
            self._add(self._clock(), text)
        else:
            self._note(text)

    def _not_reached(self, reason: str) -> RealizerError:
        return RealizerError(NotReached(url=self._command, reason=reason))
