"""The bridge to the Virtual Human Toolkit with a real broker and a real server."""

import asyncio

import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.bridges.vhmsg import run_bridge
from reactive_realizer.client.stomp_bus import Broker, StompBus, connected
from reactive_realizer.client.vh_message import SCOPE, VhMessage
from reactive_realizer.errors import RealizerError
from reactive_realizer.server.live_scene import LiveScene

LIMIT = 30.0
"""The longest wait for a message, s."""
LONG = '<act><bml><wait id="w" start="0" end="80000"/></bml></act>'
SHORT = """<act><participant id="brad" role="actor"/><bml composition="REPLACE">
  <speech id="s"><text>Hello <sync id="T1"/>there.</text></speech>
  <event message="vrSpoke brad user m2 Hello" start="s:T1"/>
</bml></act>"""


class Toolkit:
    """Another component on the bus, and the clock of the realizer, which moves while a message is awaited."""

    def __init__(self, bus: StompBus, live: LiveScene) -> None:
        self._bus, self._live = bus, live
        self._ticks = live.ticker.ticks()

    def say(self, word: str, argument: str = "") -> None:
        message = VhMessage(word, argument)
        self._bus.send(message.text, **message.headers(SCOPE))

    async def hear(self, *words: str) -> str:
        """The next message with one of these first words."""
        async with asyncio.timeout(LIMIT), asyncio.TaskGroup() as group:
            ticking = group.create_task(self._tick())
            while (message := VhMessage.read(await self._bus.receive())).word not in words:
                pass
            ticking.cancel()
        return " ".join(message)

    async def _tick(self) -> None:
        while True:
            await self._live.step(await anext(self._ticks))
            await asyncio.sleep(0.001)  # the threads of the broker and of its clients need the interpreter too


async def test_requests_on_the_bus_are_played_and_reported_there(broker: Broker, live: tuple[LiveScene, str]) -> None:
    scene, url = live
    async with connected(broker, f"/topic/{SCOPE}") as bus, asyncio.TaskGroup() as group:
        bridge = group.create_task(run_bridge(url, broker, SCOPE, {"brad": "alice"}))
        toolkit = Toolkit(bus, scene)
        assert await toolkit.hear("vrComponent") == "vrComponent reactive-realizer all"
        toolkit.say("vrSpeak", f"brad user m1 {LONG}")
        assert await toolkit.hear("vrAgentBML") == "vrAgentBML brad m1 start"
        toolkit.say("sbm", "pawn cup init loc 0.5 1.5 2")
        toolkit.say("vrSpeak", f"brad user m2 {SHORT}")
        reports = [await toolkit.hear("vrAgentBML", "vrSpoke") for _ in range(4)]
        assert reports == [
            "vrAgentBML brad m1 end interrupted",
            "vrAgentBML brad m2 start",
            "vrSpoke brad user m2 Hello",
            "vrAgentBML brad m2 end complete",
        ]
        assert scene.realizer.world.position("cup") == (0.5, 1.5, 2.0)
        toolkit.say("vrSpeak", "brad user m3 <act><bml><speech></bml></act>")
        assert (await toolkit.hear("vrSpeakFailed")).startswith("vrSpeakFailed brad user m3 ")
        toolkit.say("vrKillComponent", "all")
        await bridge


async def test_a_bridge_without_a_realizer_or_a_broker_says_so(
    broker: Broker, live: tuple[LiveScene, str], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(RealizerError, match="no realizer can be reached"):
        await run_bridge("http://127.0.0.1:9", broker, SCOPE, {})
    _, url = live
    with pytest.raises(RealizerError, match=r"no message broker can be reached at 127\.0\.0\.1:9"):
        await run_bridge(url, Broker("127.0.0.1", 9), SCOPE, {})
    assert await asyncio.to_thread(main, ["bridge", "vhmsg", "http://127.0.0.1:9"]) == 2
    assert "no realizer can be reached at http://127.0.0.1:9" in capsys.readouterr().err


async def test_a_lost_broker_ends_the_bridge_with_an_error(live: tuple[LiveScene, str]) -> None:
    _, url = live
    server = await asyncio.start_server(_accept_and_vanish, "127.0.0.1", 0)
    async with server:
        host, port = server.sockets[0].getsockname()
        with pytest.raises(RealizerError, match="no message broker"):
            await run_bridge(url, Broker(host, port), SCOPE, {})


async def _accept_and_vanish(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    await reader.readuntil(b"\0")
    writer.write(b"CONNECTED\nversion:1.1\n\n\0")
    await reader.readuntil(b"\0")
    writer.close()
