"""Where slow work goes: it leaves the loop and comes back as an input of a later tick."""

from collections.abc import Awaitable, Callable
from typing import Protocol

from reactive_realizer.clock.units import GlobalTime

Result = object | Exception


class Workshop(Protocol):
    """Does slow work aside."""

    def request(
        self, name: str, work: Awaitable[object], done: Callable[[Result, GlobalTime], None]
    ) -> Callable[[], None]:
        """Have work done; ``done`` gets its result, or the exception it raised, and the time, in a later tick.

        Returns:
            A call that gives the work up; ``done`` is not called then.
        """
        ...
