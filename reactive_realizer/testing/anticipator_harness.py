"""A test harness for anticipators: a peg board, and calls like those of the realizer."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.reactive.graph import Graph


class AnticipatorEvent(NamedTuple):
    """An event for an anticipator: with a value, with a text, or with neither."""

    name: str
    value: float | None = None
    text: str | None = None


@dataclass
class AnticipatorHarness:
    """A peg board and its time.

    Attributes:
        board: the board of all anticipators under test.
        now: time of the last call, s.
    """

    board: PegBoard = field(default_factory=lambda: PegBoard(Graph()))
    now: GlobalTime = GlobalTime(0.0)  # noqa: RUF009 - a float

    def at(self, now: float, act: Callable[..., None], *arguments: object) -> None:
        """Calls ``act(*arguments, now)`` in a transaction."""
        self.now = GlobalTime(now)
        with self.board.graph.transaction("event"):
            act(*arguments, self.now)

    def event(
        self, now: float, anticipator: Anticipator, name: str, value: float | None = None, text: str | None = None
    ) -> None:
        """Sends an event, or words if there is a text.

        Raises:
            RealizerError: the anticipator refuses it.
        """
        self.at(now, anticipator.advance)
        self.check(anticipator, AnticipatorEvent(name, value, text))
        if text is None:
            self.at(now, anticipator.event, name, value)
        else:
            self.at(now, anticipator.hear, name, text)

    def check(self, anticipator: Anticipator, event: AnticipatorEvent) -> None:
        """Checks whether an anticipator takes an event, without sending it.

        Raises:
            RealizerError: the anticipator refuses it.
        """
        if event.text is None:
            anticipator.check(event.name, event.value)
        else:
            anticipator.check_heard(event.name)

    def time(self, anticipator: Anticipator, sync: str) -> Time:
        """The time of a point, for a reference made now."""
        return self.board.predicted(anticipator.id, sync).value
