"""The command ``bridge``: connects a realizer with clients of another system."""

import argparse
import asyncio
import os

from reactive_realizer.bridges import embr, vhmsg
from reactive_realizer.bridges.stomp_bus import Broker

_LOGIN, _PASSCODE = "VHMSG_LOGIN", "VHMSG_PASSCODE"


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
    parser.description = "Connects a realizer with clients of another system."
    buses = parser.add_subparsers(required=True, metavar="SYSTEM", parser_class=argparse.ArgumentParser)
    _add_vhmsg(buses.add_parser("vhmsg", help="the Virtual Human Toolkit: VHMSG over ActiveMQ, by STOMP"))
    _add_embr(buses.add_parser("embr", help="clients of EMBR: EMBRScript over TCP, feedback over UDP"))


def _add_vhmsg(parser: argparse.ArgumentParser) -> None:
    parser.description = (
        "Plays requests of the Virtual Human Toolkit (vrSpeak) on a realizer, and reports their progress (vrAgentBML)."
    )
    parser.epilog = (
        "example: reactive-realizer bridge vhmsg http://127.0.0.1:8088 --agent brad=alice; the user of the broker is "
        f"taken from the environment ({_LOGIN}, {_PASSCODE}), and is guest by default"
    )
    _add_url(parser)
    _add_address(parser, "--broker", (Broker().host, Broker().port), "the address of the broker")
    parser.add_argument(
        "--scope", default=vhmsg.SCOPE, metavar="NAME", help=f"the scope of the messages, {vhmsg.SCOPE}"
    )
    parser.add_argument(
        "--agent",
        type=agent,
        action="append",
        default=[],
        metavar="NAME=CHARACTER",
        help="the character that plays requests to an agent, if it has another name; can be repeated",
    )
    parser.set_defaults(run=_run_vhmsg)


def _add_embr(parser: argparse.ArgumentParser) -> None:
    parser.description = "Takes EMBRScript in the place of EMBR, plays it on a realizer, and reports its feedback."
    parser.epilog = "example: reactive-realizer bridge embr http://127.0.0.1:8088"
    _add_url(parser)
    _add_address(parser, "--listen", embr.LISTEN, "where scripts are taken, over TCP")
    _add_address(parser, "--feedback", embr.FEEDBACK, "where feedback is sent, over UDP")
    parser.set_defaults(run=_run_embr)


def _add_url(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("url", metavar="URL", help="the address of the realizer, http://127.0.0.1:8088")


def _add_address(parser: argparse.ArgumentParser, name: str, default: tuple[str, int], text: str) -> None:
    """Add an option ``HOST:PORT``, or ``HOST`` with the default port."""
    host, port = default

    def address(text: str) -> tuple[str, int]:
        host, colon, number = text.partition(":")
        if not host or not 0 < (chosen := int(number) if colon else port) < 65536:
            raise ValueError(text)
        return host, chosen

    parser.add_argument(name, type=address, default=default, metavar="HOST:PORT", help=f"{text}, {host}:{port}")


def _run_vhmsg(options: argparse.Namespace) -> int:
    """The exit status: 0 if the toolkit asks the bridge to end. If a connection is lost, an error is raised."""
    host, port = options.broker
    reached = Broker(host, port, os.environ.get(_LOGIN, "guest"), os.environ.get(_PASSCODE, "guest"))
    asyncio.run(vhmsg.run_bridge(options.url, reached, options.scope, dict(options.agent)))
    return 0


def _run_embr(options: argparse.Namespace) -> int:
    """If the connection to the realizer is lost, an error is raised."""
    asyncio.run(embr.run_bridge(options.url, options.listen, options.feedback))
    return 0
