"""The commands ``serve`` and ``demo``: serve a scene to browsers and planners."""

import argparse
import asyncio
import logging
import sys
from pathlib import Path

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.assembly.registry import names
from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions
from reactive_realizer.server.serve import ServerOptions, serve

_PERFORMANCE = PACKAGE_ASSETS / "demo" / "performance.xml"


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """The options of ``serve`` and of ``demo``."""
    _add(commands, "serve", "serve a scene to browsers and planners", None)
    _add(commands, "demo", "serve a scene that performs when the first page opens", _PERFORMANCE)


def _add(
    commands: "argparse._SubParsersAction[argparse.ArgumentParser]", name: str, text: str, performance: Path | None
) -> None:
    parser = commands.add_parser(name, help=text, epilog=f"example: reactive-realizer {name} --port 8088")
    parser.add_argument("--host", default="127.0.0.1")
    parser.add_argument("--port", type=int, default=8088)
    parser.add_argument("--human", type=Path, default=DEFAULT_HUMAN, metavar="FILE")
    parser.add_argument("--voice", choices=names("tts"), default="espeak")
    parser.add_argument("--assets", type=Path, action="append", default=[], metavar="DIR")
    parser.add_argument("--token", metavar="T", help="token required of every client")
    parser.add_argument("--allow-origin", action="append", default=[], metavar="O", help="accept pages of this origin")
    parser.add_argument("--seed", type=int, default=0, metavar="N")
    parser.add_argument("--strategy", choices=names("strategies"), default="convex", help="scheduling strategy")
    parser.add_argument("--verify", action="store_true", help="check plans during playback")
    parser.add_argument("--record", type=Path, metavar="FILE", help="record the session for realize --replay")
    parser.set_defaults(run=run, performance=performance)


def run(options: argparse.Namespace) -> int:
    """The exit status: 2 if the human file does not exist, a file cannot be written, or the address is in use."""
    if not options.human.is_file():
        print(f"no such file: {options.human}", file=sys.stderr)
        return 2
    logging.getLogger().setLevel(logging.INFO)
    try:
        asyncio.run(serve(_server_options(options)))
    except OSError as problem:
        print(problem, file=sys.stderr)
        return 2
    return 0


def _server_options(options: argparse.Namespace) -> ServerOptions:
    return ServerOptions(
        host=options.host,
        port=options.port,
        token=options.token,
        origins=tuple(options.allow_origin),
        scene=SceneOptions(
            options.human, options.voice, tuple(options.assets), options.seed, options.strategy, options.verify
        ),
        performance=options.performance.read_text(encoding="utf-8") if options.performance else None,
        record=options.record,
    )
