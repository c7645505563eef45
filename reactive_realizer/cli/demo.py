"""The command ``demo``: `serve` with a performance."""

import argparse
from pathlib import Path

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.cli import serve
from reactive_realizer.engines.speech.kokoro.voice import KokoroVoice

PERFORMANCES = {file.stem: file for file in sorted((PACKAGE_ASSETS / "demo").glob("*.xml"))}
"""The file of each performance by its name."""

_FIRST = "greeting"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options of ``demo``: those of ``serve``, with another default voice, and a performance."""
    serve.add_options(parser)
    if KokoroVoice.installed():
        parser.set_defaults(voice="kokoro")
    names = ", ".join(PERFORMANCES)
    parser.add_argument(
        "performance", nargs="?", type=performance, default=_FIRST, help=f"one of {names} (default: {_FIRST})"
    )
    parser.epilog = "example: reactive-realizer demo conductor --port 8088"


def performance(name: str) -> Path:
    """The file of a performance.

    Raises:
        argparse.ArgumentTypeError: there is none of this name.
    """
    if name not in PERFORMANCES:
        raise argparse.ArgumentTypeError(f"there is no performance '{name}'; available: {', '.join(PERFORMANCES)}")
    return PERFORMANCES[name]
