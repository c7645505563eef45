"""The command ``translate``: writes documents in any dialect as BML 1.0."""

import argparse
import sys
from pathlib import Path

from reactive_realizer.assembly.registry import load, names
from reactive_realizer.bml.block_writer import document
from reactive_realizer.bml.dialects import Dialect, Dialects
from reactive_realizer.cli.output import complain_of_inputs, print_problems
from reactive_realizer.limits import Limits


def add_options(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options of ``translate``."""
    parser.description = (
        "Writes the blocks of a document in any dialect as BML 1.0 with its extensions, which plays the same. What "
        "cannot be read is reported on stderr."
    )
    parser.epilog = "example: reactive-realizer translate wave.embr > wave.xml"
    parser.add_argument("file", type=Path, metavar="FILE")
    parser.add_argument("--name", default="document1", help="the id of a block that has none")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The exit status: 1 if a block is refused, 2 if the file does not exist."""
    if complain_of_inputs([options.file]):
        return 2
    dialects = Dialects({name: load("dialects", name, Dialect) for name in names("dialects")})
    found = dialects.read(options.file.read_bytes(), Limits(), options.name)
    print_problems(options.file, (problem for each in found for problem in each.problems), sys.stderr)
    print(document(each.written for each in found if each.written is not None), end="")
    return 1 if any(each.written is None for each in found) else 0
