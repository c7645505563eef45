"""Isolates failures outside of units, such as in idle animation."""

import logging
from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")

logger = logging.getLogger(__name__)


class FailureIsolation:
    """Leaves out parts of a figure's motion that fail: the other parts continue to move.

    Args:
        figure: its name, for messages.
    """

    def __init__(self, figure: str) -> None:
        self._figure = figure
        self._logged: set[str] = set()

    def __call__(self, part: str, show: Callable[[], T], fallback: T) -> T:
        """Return a part of the figure's motion, or a fallback in frames in which it fails. The first failure is logged.

        Args:
            part: its name, for the log.
            show: returns the part.
            fallback: returned if that fails.
        """
        try:
            return show()
        except Exception:
            if part not in self._logged:
                self._logged.add(part)
                logger.exception("%s: %s failed and is left out", self._figure, part)
            return fallback
