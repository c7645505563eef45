"""One thing that is asserted of a case."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from reactive_realizer.testing.feedback_list import FeedbackList

TOLERANCE: Final = 0.01
"""s: a tick of 100 Hz, the coarsest that a realizer may look at its clock."""


@dataclass(frozen=True, slots=True)
class Check:
    """An assertion over what was told.

    Attributes:
        source: what says so: a part of the script, or a rule of the language.
        assertion: raises AssertionError where it does not hold.
    """

    source: str
    assertion: Callable[[FeedbackList], None]

    def problem(self, told: FeedbackList) -> str | None:
        """Why it does not hold; None where it does."""
        try:
            self.assertion(told)
        except AssertionError as problem:
            return f"{problem} ({self.source})"
        except (ValueError, LookupError, StopIteration) as problem:
            return f"feedback without what it must have: {problem!r} ({self.source})"
        return None
