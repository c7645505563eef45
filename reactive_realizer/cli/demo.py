"""The command ``demo``: `serve` with a performance."""

import argparse

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.cli import serve


def add_options(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options of ``demo``, which are those of ``serve``."""
    serve.add_options(parser)
    parser.epilog = "example: reactive-realizer demo --port 8088"
    parser.set_defaults(performance=PACKAGE_ASSETS / "demo" / "performance.xml")
