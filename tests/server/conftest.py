"""A served scene with real sockets, whose clock and ticks the test controls."""

import json
from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from aiohttp import ClientWebSocketResponse, WSMsgType
from aiohttp.test_utils import TestClient, TestServer
from jsonschema import Draft202012Validator

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import ManualClock
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import WarningType
from reactive_realizer.feedback.feedback_manager import Report
from reactive_realizer.feedback.messages import WarningFeedback
from reactive_realizer.server.app import create_app
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.protocol import DOCUMENT
from reactive_realizer.server.security import Security

BML = 'xmlns="http://www.bml-initiative.org/bml/bml-1.0"'
WAIT = f'<bml {BML} id="{{id}}"><wait id="w" duration="{{duration}}"/></bml>'
ALICE = '[character.alice]\n[anticipator.metronome]\nkind = "metronome"\n'

XML = {"Content-Type": "application/xml"}

OPEN = Security()

_SCHEMA = json.loads(DOCUMENT)
_VALIDATORS = {
    direction: Draft202012Validator({"$ref": f"#/$defs/{direction}", "$defs": _SCHEMA["$defs"]})
    for direction in ("ClientMessage", "ServerMessage")
}


def wait(id_: str = "b1", duration: float = 0.1) -> str:
    """A block with one wait."""
    return WAIT.format(id=id_, duration=duration)


def report(text: str) -> Report:
    """Feedback with a text."""
    message = WarningFeedback(None, "bml", WarningType.PARSING_FAILURE, text)
    return Report(GlobalTime(0.0), message)


@dataclass
class Socket:
    """A client that validates every received message against the schema."""

    raw: ClientWebSocketResponse
    hello: dict[str, Any] = field(default_factory=dict)

    async def say(self, **message: Any) -> None:
        _VALIDATORS["ClientMessage"].validate(message)
        await self.raw.send_json(message)

    async def say_anything(self, text: str) -> None:
        await self.raw.send_str(text)

    async def hear(self, *types: str) -> dict[str, Any]:
        """The next text message of one of these types; frames and other messages are skipped."""
        while True:
            received = await self.raw.receive(timeout=10)
            if received.type is WSMsgType.TEXT:
                message: dict[str, Any] = json.loads(received.data)
                _VALIDATORS["ServerMessage"].validate(message)
                if not types or message["type"] in types:
                    return message
            elif received.type is not WSMsgType.BINARY:
                raise ConnectionError(f"closed with {self.raw.close_code}")

    async def hear_feedback(self, part: str) -> dict[str, Any]:
        """The next feedback whose XML contains a text."""
        while part not in (feedback := await self.hear("feedback"))["xml"]:
            pass
        return feedback

    async def see(self) -> bytes:
        """The next frame."""
        while (received := await self.raw.receive(timeout=10)).type is not WSMsgType.BINARY:
            assert received.type is WSMsgType.TEXT
        data: bytes = received.data
        return data

    async def close_code(self) -> int | None:
        """Read messages until the socket is closed."""
        async for _ in self.raw:
            pass
        return self.raw.close_code

    async def ask(self, **message: Any) -> dict[str, Any]:
        """Send a message and return the answer."""
        await self.say(**message, ref="asked")
        return await self.hear("accepted", "error")


@dataclass
class OnAir:
    """A served scene and a client."""

    live: LiveScene
    client: TestClient[Any, Any]
    ticks: AsyncIterator[Tick]

    async def tick(self) -> None:
        await self.live.step(await anext(self.ticks))
        await self.live.realizer.settle()

    async def tick_until(self, time: float) -> None:
        while self.live.realizer.time < time - 1e-9:
            await self.tick()

    async def connect(self, query: str = "", **options: Any) -> Socket:
        socket = Socket(await self.client.ws_connect("/ws" + query, max_msg_size=0, **options))
        socket.hello = await socket.hear()
        return socket


async def post(air: OnAir, path: str, body: str | bytes, headers: dict[str, str] = XML) -> tuple[int, dict[str, Any]]:
    """Post a body; the status and the JSON of the answer."""
    async with air.client.post(path, data=body, headers=headers) as answer:
        return answer.status, await answer.json()


Open = Callable[..., AbstractAsyncContextManager[OnAir]]


@pytest.fixture
def on_air(tmp_path: Path) -> Open:
    """Serves the scene of a human file."""

    @asynccontextmanager
    async def open_(
        human: str = ALICE,
        security: Security = OPEN,
        performance: str | None = None,
        voice: str = "text",
        assets: tuple[Path, ...] = (),
    ) -> AsyncIterator[OnAir]:
        file = tmp_path / "human.toml"
        file.write_text(human, encoding="utf-8")
        async with open_scene(SceneOptions(file, voice, assets)) as scene:
            live = LiveScene(scene, ManualClock(), performance)
            async with TestClient(TestServer(create_app(live, security))) as client:
                yield OnAir(live, client, live.ticker.ticks())

    return open_
