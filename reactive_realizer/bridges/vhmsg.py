"""Connects a realizer with the Virtual Human Toolkit, over an ActiveMQ broker."""

import argparse
import asyncio
import math
from collections.abc import Mapping
from functools import partial

from reactive_realizer.bridges.bridge import Bridge
from reactive_realizer.bridges.vhmsg_bridge import VhmsgBridge, ends
from reactive_realizer.bridges.vhmsg_feedback import FeedbackForm
from reactive_realizer.client.broker_options import USER_OF_BROKER, add_broker, broker_of
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


def agent(text: str) -> tuple[str, str]:
    """Parse ``NAME=CHARACTER``.

    Raises:
        ValueError: a part is missing.
    """
    name, _, character = text.partition("=")
    if not name or not character:
        raise ValueError(text)
    return name, character


def length(text: str) -> float:
    """Parse a length above 0.

    Raises:
        ValueError: it is none.
    """
    value = float(text)
    if not 0.0 < value < math.inf:
        raise ValueError(text)
    return value


def _add_options(parser: argparse.ArgumentParser) -> None:
    add_broker(parser)
    parser.add_argument(
        "--agent",
        type=agent,
        action="append",
        default=[],
        metavar="NAME=CHARACTER",
        help="the character that plays requests to an agent, if it has another name; can be repeated",
    )
    parser.add_argument(
        "--feedback",
        type=FeedbackForm,
        choices=tuple(FeedbackForm),
        default=FeedbackForm.NONE,
        help="also send feedback on behaviors, as that of BML 1.0 or as SmartBody's; none by default",
    )
    parser.add_argument(
        "--unit", type=length, default=1.0, metavar="M", help="the unit in which pawns are placed, m: 0.01 for cm; 1"
    )


async def _run(url: str, options: argparse.Namespace) -> None:
    agents = dict(options.agent)
    await run_bridge(url, broker_of(options), options.scope, agents, options.feedback, options.unit)


BRIDGE = Bridge(
    "Plays requests of the Virtual Human Toolkit (vrSpeak) on a realizer, and reports their progress (vrAgentBML); "
    f"{USER_OF_BROKER}.",
    _run,
    _add_options,
)
