"""``reactive-realizer``, also ``python -m reactive_realizer``."""

import argparse
import logging
import os
import sys
from collections.abc import Sequence
from importlib import import_module
from types import MappingProxyType
from typing import Any

from reactive_realizer import __version__
from reactive_realizer.cli.log import FORMATTERS, log_to_stderr
from reactive_realizer.errors import RealizerError

_COMMANDS = MappingProxyType(
    {
        "serve": "serve a scene to browsers and planners",
        "demo": "serve a scene that performs when the first page opens",
        "realize": "play BML files and write feedback and frames",
        "check": "check BML files for mistakes",
        "translate": "write a document in any dialect as BML 1.0",
        "lexicon": "list the available lexemes with their sync points and parameters",
        "avatar": "say what an avatar file contains",
        "make-avatar": "make an avatar by age, build, skin, hair and clothes",
        "physics": "write the physical model of a character",
        "conformance": "test a realizer over the protocol",
        "bridge": "connect a realizer with clients of another system",
    }
)
"""The commands, each a module of `reactive_realizer.cli`, with a line of help."""


class _Command(argparse.ArgumentParser):
    """The parser of a command. Its module is imported when the command is used, because some need seconds for that."""

    def parse_known_args(self, args: Sequence[str] | None = None, namespace: Any = None) -> Any:  # type: ignore[override]
        """Parse the arguments after the command."""
        name = self.prog.rpartition(" ")[2].replace("-", "_")
        import_module(f"reactive_realizer.cli.{name}").add_options(self)
        return super().parse_known_args(args, namespace)


_READER_GONE = 141
"""The exit status that a shell gives a program that SIGPIPE has ended."""


def main(arguments: list[str] | None = None) -> int:
    """Run a command; the exit status."""
    try:
        options = _parser().parse_args(arguments)
        log_to_stderr(logging.INFO if options.verbose else logging.ERROR, options.log_format)
        status: int = options.run(options)
        if sys.stdout is not None:
            sys.stdout.flush()
    except RealizerError as problem:
        print(problem.fault.sentence, file=sys.stderr)
        return 2
    except BrokenPipeError:  # of the output, as after `head`; clients have errors of their own
        return _READER_GONE
    except OSError as problem:
        print(problem, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    finally:
        _discard_unwritable()
    return status


def _discard_unwritable() -> None:
    """Discard output that cannot be written, of which Python would complain when it ends."""
    try:
        if sys.stdout is not None:
            sys.stdout.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="reactive-realizer",
        description="A BML realizer with reactive timing.",
        epilog="example: reactive-realizer realize hello.xml --feedback -",
    )
    parser.add_argument("--version", action="version", version=__version__)
    parser.add_argument("--verbose", action="store_true", help="write a log to stderr")
    parser.add_argument("--log-format", choices=tuple(FORMATTERS), default="text", help="the format of the log")
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=_Command)
    for name, text in _COMMANDS.items():
        commands.add_parser(name, help=text)
    return parser


if __name__ == "__main__":
    sys.exit(main())
