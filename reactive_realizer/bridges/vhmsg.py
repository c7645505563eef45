"""Connects a realizer with the Virtual Human Toolkit, over an ActiveMQ broker."""

import asyncio
from collections.abc import Mapping
from functools import partial
from typing import Final

from reactive_realizer.bridges.stomp_bus import Broker, StompBus, connected
from reactive_realizer.bridges.vhmsg_bridge import VhmsgBridge, ends
from reactive_realizer.bridges.vhmsg_messages import VhMessage
from reactive_realizer.client.realizer_socket import RealizerSocket
from reactive_realizer.errors import RealizerError

SCOPE: Final = "DEFAULT_SCOPE"
"""The usual scope of messages."""


async def run_bridge(url: str, broker: Broker, scope: str, agents: Mapping[str, str]) -> None:
    """Pass messages on until the toolkit asks this component to end.

    Args:
        url: of the realizer.
        broker: of the toolkit.
        scope: of its messages.
        agents: characters by the names of agents; other agents have the name of their character.

    Raises:
        RealizerError: "not-reached", "other-protocol" or "no-broker"; also if a connection is lost.
    """
    async with RealizerSocket(url) as realizer, connected(broker, f"/topic/{scope}") as bus:
        known = {character["id"]: character["id"] for character in realizer.hello["characters"]}
        bridge = VhmsgBridge({**known, **agents}, partial(_send, bus, scope))
        bridge.announce()
        try:
            async with asyncio.TaskGroup() as group:
                reporting = group.create_task(_report(realizer, bridge))
                await _take(bus, bridge, realizer)
                reporting.cancel()
        except* RealizerError as lost:
            raise lost.exceptions[0] from None


async def _report(realizer: RealizerSocket, bridge: VhmsgBridge) -> None:
    while True:
        bridge.report(await realizer.receive())


async def _take(bus: StompBus, bridge: VhmsgBridge, realizer: RealizerSocket) -> None:
    while not ends(message := VhMessage.read(await bus.receive())):
        if (request := bridge.take(message)) is not None:
            await realizer.send(**request)


def _send(bus: StompBus, scope: str, message: VhMessage) -> None:
    bus.send(message.text, ELVISH_SCOPE=scope, MESSAGE_PREFIX=message.word)
