"""Under what a figure does of its own accord."""

import logging
from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")

_log = logging.getLogger(__name__)


class Net:
    """Catches what fails outside of all units: nobody can be told of it, and the figure lives on without."""

    def __init__(self, figure: str) -> None:
        """Of a figure, by its name for people."""
        self._figure = figure
        self._told: set[str] = set()

    def __call__(self, what: str, show: Callable[[], T], instead: T) -> T:
        """What is shown, or something else in this frame if that fails; the log says so once.

        Args:
            what: is shown, for people.
            show: gives it.
            instead: is shown if it fails.
        """
        try:
            return show()
        except Exception:
            if what not in self._told:
                self._told.add(what)
                _log.exception("%s: %s fails, and is left out", self._figure, what)
            return instead
