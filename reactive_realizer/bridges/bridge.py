"""A bridge as a plug-in (entry points ``reactive_realizer.bridges``)."""

import argparse
from collections.abc import Callable, Coroutine
from dataclasses import dataclass
from typing import Any


def _no_options(parser: argparse.ArgumentParser) -> None:
    """Add nothing."""


@dataclass(frozen=True, slots=True)
class Bridge:
    """A client of a realizer that connects it with another system.

    Attributes:
        description: a sentence for ``reactive-realizer bridge NAME --help``.
        run: connects a realizer until it is canceled or the other system ends it. It gets the URL of the realizer,
            with a token if it needs one, and the values of the options. It raises a `RealizerError` or an `OSError` if
            a connection cannot be made or is lost.
        add_options: adds the options of the bridge to a parser.
    """

    description: str
    run: Callable[[str, argparse.Namespace], Coroutine[Any, Any, None]]
    add_options: Callable[[argparse.ArgumentParser], None] = _no_options
