"""The command ``bridge``: connects a realizer with the message bus of another system."""

import argparse
import asyncio
import os

from reactive_realizer.bridges.stomp_bus import Broker
from reactive_realizer.bridges.vhmsg import SCOPE, run_bridge

_LOGIN, _PASSCODE = "VHMSG_LOGIN", "VHMSG_PASSCODE"


def broker(text: str) -> tuple[str, int]:
    """Parse ``host:port``, or ``host``.

    Raises:
        ValueError: no host, or no port number.
    """
    host, colon, port = text.partition(":")
    if not host or not 0 < (number := int(port) if colon else Broker().port) < 65536:
        raise ValueError(text)
    return host, number


def agent(text: str) -> tuple[str, str]:
    """Parse ``NAME=CHARACTER``.

    Raises:
        ValueError: a part is missing.
    """
    name, _, character = text.partition("=")
    if not name or not character:
        raise ValueError(text)
    return name, character


def add_options(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options of ``bridge``."""
    parser.description = (
        "Plays requests of the Virtual Human Toolkit (vrSpeak) on a realizer, and reports their progress (vrAgentBML)."
    )
    parser.epilog = (
        "example: reactive-realizer bridge vhmsg http://127.0.0.1:8088 --agent brad=alice; the user of the broker is "
        f"taken from the environment ({_LOGIN}, {_PASSCODE}), and is guest by default"
    )
    parser.add_argument("bus", choices=("vhmsg",), metavar="BUS", help="vhmsg: VHMSG over ActiveMQ, by STOMP")
    parser.add_argument("url", metavar="URL", help="the address of the realizer, http://127.0.0.1:8088")
    parser.add_argument(
        "--broker",
        type=broker,
        default=(Broker().host, Broker().port),
        metavar="HOST:PORT",
        help="the address of the broker, localhost:61613",
    )
    parser.add_argument("--scope", default=SCOPE, metavar="NAME", help=f"the scope of the messages, {SCOPE}")
    parser.add_argument(
        "--agent",
        type=agent,
        action="append",
        default=[],
        metavar="NAME=CHARACTER",
        help="the character that plays requests to an agent, if it has another name; can be repeated",
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The exit status: 0 if the toolkit asks the bridge to end. If a connection is lost, an error is raised."""
    host, port = options.broker
    reached = Broker(host, port, os.environ.get(_LOGIN, "guest"), os.environ.get(_PASSCODE, "guest"))
    asyncio.run(run_bridge(options.url, reached, options.scope, dict(options.agent)))
    return 0
