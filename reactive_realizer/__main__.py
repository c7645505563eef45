"""``reactive-realizer``, also ``python -m reactive_realizer``."""

import argparse
import logging
import sys

from reactive_realizer import __version__
from reactive_realizer.cli import check, conformance, lexicon, realize, serve
from reactive_realizer.cli.log import log_to_stderr
from reactive_realizer.errors import RealizerError


def main(arguments: list[str] | None = None) -> int:
    """Run a command; the exit status."""
    options = _parser().parse_args(arguments)
    log_to_stderr(logging.INFO if options.verbose else logging.ERROR)
    try:
        status: int = options.run(options)
    except RealizerError as problem:
        print(problem.fault.sentence, file=sys.stderr)
        return 2
    except OSError as problem:
        print(problem, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    return status


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="reactive-realizer",
        description="A BML realizer with reactive timing.",
        epilog="example: reactive-realizer realize hello.xml --feedback -",
    )
    parser.add_argument("--version", action="version", version=__version__)
    parser.add_argument("--verbose", action="store_true", help="write a log to stderr")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for command in (serve, realize, check, lexicon, conformance):
        command.add_parser(commands)
    return parser


if __name__ == "__main__":
    sys.exit(main())
