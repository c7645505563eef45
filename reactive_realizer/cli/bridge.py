"""The command ``bridge``: connects a realizer with clients of another system."""

import argparse
import asyncio
import logging
import shlex
from collections.abc import Sequence
from functools import partial
from typing import Any

from reactive_realizer.assembly.registry import broken, load, names, one_line
from reactive_realizer.bridges.bridge import Bridge
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.server.own_clients import OwnClient

logger = logging.getLogger(__name__)

_GROUP = "bridges"


class BridgeFailed(Fault):
    """An exception of a bridge that does not tell of a lost connection."""

    code = "bridge-failed"
    template = "the bridge {name} has failed: {reason}"
    name: str
    reason: str


class _BridgeParser(argparse.ArgumentParser):
    """The parser of a bridge, which is imported when it is used."""

    def parse_known_args(self, args: Sequence[str] | None = None, namespace: Any = None) -> Any:  # type: ignore[override]
        """Parse the arguments after the name of the bridge."""
        name = self.prog.rpartition(" ")[2]
        bridge: Bridge = load(_GROUP, name, Bridge)
        self.description = bridge.description
        self.epilog = f"example: reactive-realizer bridge {name} http://127.0.0.1:8088"
        self.add_argument("url", metavar="URL", help="the address of the realizer, http://127.0.0.1:8088")
        _add_options(name, bridge, self)
        self.set_defaults(run=partial(_run, name, bridge))
        return super().parse_known_args(args, namespace)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options of ``bridge``."""
    parser.description = "Connects a realizer with clients of another system."
    bridges = parser.add_subparsers(required=True, title="systems", dest="bridge", parser_class=_BridgeParser)
    for name in names(_GROUP):
        bridges.add_parser(name)


def bridge(text: str) -> OwnClient:
    """Parse the name of a bridge and its options, as a shell would: ``vhmsg --agent brad=alice``.

    Raises:
        ArgumentTypeError: there is no such bridge.
        RealizerError: "two-plugins" or "broken-plugin".
        ValueError: a quotation does not end, or there is no name.
    """
    name, *arguments = shlex.split(text)
    if name not in (known := names(_GROUP)):
        raise argparse.ArgumentTypeError(f"there is no bridge '{name}'; available: {', '.join(known)}")
    chosen: Bridge = load(_GROUP, name, Bridge)
    parser = argparse.ArgumentParser(f"--bridge {name}", description=chosen.description)
    _add_options(name, chosen, parser)
    options = parser.parse_args(arguments)
    return OwnClient(name, lambda url: chosen.run(url, options))


def _add_options(name: str, bridge: Bridge, parser: argparse.ArgumentParser) -> None:
    """Add the options of a bridge to a parser.

    Raises:
        RealizerError: "broken-plugin".
    """
    try:
        bridge.add_options(parser)
    except Exception as problem:
        raise broken(_GROUP, name, problem) from problem


def _run(name: str, bridge: Bridge, options: argparse.Namespace) -> int:
    """The exit status: 0 if the other system ends the bridge.

    Raises:
        RealizerError: a connection cannot be made or is lost; or "bridge-failed", with a traceback in the verbose log.
        OSError: a connection cannot be made or is lost.
    """
    try:
        asyncio.run(bridge.run(options.url, options))
    except (RealizerError, OSError):
        raise
    except (Exception, asyncio.CancelledError) as problem:
        logger.info("the bridge %s has failed", name, exc_info=True)
        raise RealizerError(BridgeFailed(name=name, reason=one_line(problem))) from problem
    return 0
