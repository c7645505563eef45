"""The command ``bridge``: connects a realizer with clients of another system."""

import argparse
import asyncio
import math

from reactive_realizer.bridges import embr, vhmsg
from reactive_realizer.bridges.vhmsg_feedback import FeedbackForm
from reactive_realizer.cli.broker_options import USER_OF_BROKER, add_address, add_broker, broker_of


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
        f"example: reactive-realizer bridge vhmsg http://127.0.0.1:8088 --agent brad=alice; {USER_OF_BROKER}"
    )
    _add_url(parser)
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
    parser.set_defaults(run=_run_vhmsg)


def _add_embr(parser: argparse.ArgumentParser) -> None:
    parser.description = "Takes EMBRScript in the place of EMBR, plays it on a realizer, and reports its feedback."
    parser.epilog = "example: reactive-realizer bridge embr http://127.0.0.1:8088"
    _add_url(parser)
    add_address(parser, "--listen", embr.LISTEN, "where scripts are taken, over TCP")
    add_address(parser, "--feedback", embr.FEEDBACK, "where feedback is sent, over UDP")
    parser.set_defaults(run=_run_embr)


def _add_url(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("url", metavar="URL", help="the address of the realizer, http://127.0.0.1:8088")


def _run_vhmsg(options: argparse.Namespace) -> int:
    """The exit status: 0 if the toolkit asks the bridge to end. If a connection is lost, an error is raised."""
    asyncio.run(
        vhmsg.run_bridge(
            options.url, broker_of(options), options.scope, dict(options.agent), options.feedback, options.unit
        )
    )
    return 0


def _run_embr(options: argparse.Namespace) -> int:
    """If the connection to the realizer is lost, an error is raised."""
    asyncio.run(embr.run_bridge(options.url, options.listen, options.feedback))
    return 0
