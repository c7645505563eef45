"""The command ``check``: reports mistakes in BML files without playing them."""

import argparse
import asyncio
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TextIO

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.cli.checker import Checker
from reactive_realizer.cli.scene_options import add_file_options
from reactive_realizer.errors import Fault


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """The options of ``check``."""
    parser = commands.add_parser(
        "check",
        help="check BML files for mistakes",
        description="Reports mistakes in BML files. Valid BML that this scene cannot play, such as a lexeme without an "
        "entry in a binding, is reported on stderr.",
        epilog="example: reactive-realizer check hello.xml",
    )
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE")
    add_file_options(parser)
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The exit status: 1 if there are mistakes, 2 if a file does not exist."""
    missing = [str(path) for path in (*options.files, options.human) if not path.is_file()]
    if missing:
        print(f"no such file: {', '.join(missing)}", file=sys.stderr)
        return 2
    return 1 if asyncio.run(_check(options)) else 0


async def _check(options: argparse.Namespace) -> bool:
    """Prints the findings; returns whether there are mistakes."""
    wrong = False
    async with open_scene(SceneOptions(options.human, "text", tuple(options.assets))) as scene:
        checker = Checker(scene.realizer)
        for path in options.files:
            found = await checker.check(path.read_bytes())
            _print(path, found.mistakes, sys.stdout)
            _print(path, found.notes, sys.stderr)
            wrong = wrong or bool(found.mistakes)
    return wrong


def _print(path: Path, faults: Iterable[Fault], stream: TextIO) -> None:
    for fault in faults:
        print(f"{path}:{fault.line or 1}:{fault.column or 1}: {fault.sentence}", file=stream)
