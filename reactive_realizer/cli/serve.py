"""The command ``serve``: serves a scene to browsers and planners."""

import argparse
import logging
import os
import sys
from functools import partial
from math import inf
from pathlib import Path

from reactive_realizer.assembly.registry import names
from reactive_realizer.cli.bridge import bridge
from reactive_realizer.cli.output import complain_of_inputs
from reactive_realizer.cli.scene_options import add_scene_options, scene_options
from reactive_realizer.clock.punctual_loop import run_punctually
from reactive_realizer.server.serve import ServerOptions, serve

_TOKEN = "REACTIVE_REALIZER_TOKEN"
"""The environment variable with the token, which, unlike an option, other users of the machine cannot list."""

_LARGEST_PORT = 65535
_MEGABYTE = 1_000_000


def add_options(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options of ``serve``."""
    parser.epilog = "example: reactive-realizer serve --port 8088"
    parser.add_argument("--host", default="127.0.0.1", help="the address to bind to")
    parser.add_argument("--port", type=port, default=8088, help="0 chooses a free port")
    token = parser.add_mutually_exclusive_group()
    token.add_argument("--token", metavar="T", help=f"a token that every client must present (default: ${_TOKEN})")
    token.add_argument("--token-file", type=Path, metavar="FILE", help="a file that contains the token")
    parser.add_argument("--allow-origin", action="append", default=[], metavar="O", help="accept pages of this origin")
    add_scene_options(parser)
    parser.add_argument(
        "--sound-device", nargs="?", const="", metavar="NAME", help="play sounds on this machine, without a page"
    )
    parser.add_argument(
        "--bridge",
        type=bridge,
        action="append",
        default=[],
        metavar="'NAME OPTIONS'",
        help=f"also start a bridge ({', '.join(names('bridges'))}), with its options; can be repeated",
    )
    parser.add_argument("--record", type=Path, metavar="FILE", help="record the session for realize --replay")
    parser.add_argument(
        "--record-size",
        type=megabytes,
        default=inf,
        metavar="MB",
        help="begin another file at this size (default: never)",
    )
    parser.set_defaults(run=partial(run, parser), performance=None)


def port(text: str) -> int:
    """The number of a port.

    Raises:
        argparse.ArgumentTypeError: there is no such port.
    """
    if not (text.isascii() and text.isdigit() and len(text) < 6 and int(text) <= _LARGEST_PORT):
        raise argparse.ArgumentTypeError(f"'{text}' is not a port: 0 to {_LARGEST_PORT}")
    return int(text)


def megabytes(text: str) -> float:
    """A size.

    Raises:
        ValueError: not a positive number.
    """
    size = float(text)
    if not size > 0:
        raise ValueError(text)
    return size


def run(parser: argparse.ArgumentParser, options: argparse.Namespace) -> int:
    """The exit status: 2 if a file does not exist or cannot be written, or the address is in use."""
    if options.record_size < inf and options.record is None:
        parser.error("--record-size requires --record")
    if complain_of_inputs([options.human]):
        return 2
    logging.getLogger().setLevel(logging.INFO)
    try:
        run_punctually(serve(_server_options(options)))
    except OSError as problem:
        print(problem, file=sys.stderr)
        return 2
    return 0


def _server_options(options: argparse.Namespace) -> ServerOptions:
    return ServerOptions(
        host=options.host,
        port=options.port,
        token=_token(options),
        origins=tuple(options.allow_origin),
        scene=scene_options(options),
        performance=options.performance.read_text(encoding="utf-8") if options.performance else None,
        sound_device=options.sound_device,
        record=options.record,
        record_bytes=options.record_size * _MEGABYTE,
        bridges=tuple(options.bridge),
    )


def _token(options: argparse.Namespace) -> str | None:
    """The token: that of the options, or of the environment."""
    if options.token_file is not None:
        text: str = options.token_file.read_text(encoding="utf-8", errors="surrogateescape")
        return text.strip()
    token: str | None = os.environ.get(_TOKEN) if options.token is None else options.token
    return token
