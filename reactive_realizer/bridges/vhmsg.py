"""Connects a realizer with the Virtual Human Toolkit, over an ActiveMQ broker."""

import asyncio
from collections.abc import Mapping
from functools import partial

from reactive_realizer.bridges.vhmsg_bridge import VhmsgBridge, ends
from reactive_realizer.bridges.vhmsg_feedback import FeedbackForm
from reactive_realizer.client.realizer_socket import RealizerSocket
from reactive_realizer.client.stomp_bus import Broker, StompBus, connected
from reactive_realizer.client.vh_message import VhMessage
from reactive_realizer.errors import RealizerError


async def run_bridge(
    url: str,
    broker: Broker,
    scope: str,
    agents: Mapping[str, str],
    form: FeedbackForm = FeedbackForm.NONE,
    unit: float = 1.0,
) -> None:
    """Pass messages on until the toolkit asks this component to end.

    Args:
        url: of the realizer.
        broker: of the toolkit.
        scope: of its messages.
        agents: characters by the names of agents; other agents have the name of their character.
        form: of feedback on behaviors.
        unit: of lengths in commands of the toolkit, m.

    Raises:
        RealizerError: "not-reached", "other-protocol" or "no-broker"; also if a connection is lost.
    """
    async with RealizerSocket(url) as realizer, connected(broker, f"/topic/{scope}") as bus:
        known = {character["id"]: character["id"] for character in realizer.hello["characters"]}
        bridge = VhmsgBridge({**known, **agents}, partial(_send, bus, scope), form, unit)
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
    bus.send(message.text, **message.headers(scope))
