"""Anticipators alone with a board, and somebody who tells them what happens, as the realizer does."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.reactive.graph import Graph


class Told(NamedTuple):
    """An event, as a message brings it: with a value, with words, or with neither."""

    name: str
    value: float | None = None
    text: str | None = None


@dataclass
class AnticipatorStand:
    """A board and the hand on its clock.

    Attributes:
        board: that all anticipators of the stand share.
        now: when something was told last, s.
    """

    board: PegBoard = field(default_factory=lambda: PegBoard(Graph()))
    now: GlobalTime = GlobalTime(0.0)  # noqa: RUF009 - a float

    def at(self, now: float, act: Callable[..., None], *arguments: object) -> None:
        """Have ``act(*arguments, now)`` done in a transaction of its own."""
        self.now = GlobalTime(now)
        with self.board.graph.transaction("told"):
            act(*arguments, self.now)

    def event(
        self, now: float, anticipator: Anticipator, name: str, value: float | None = None, text: str | None = None
    ) -> None:
        """Have an event happen, or words be heard where there is a text.

        Raises:
            RealizerError: the anticipator refuses it.
        """
        self.at(now, anticipator.advance)
        self.check(anticipator, Told(name, value, text))
        if text is None:
            self.at(now, anticipator.event, name, value)
        else:
            self.at(now, anticipator.hear, name, text)

    def check(self, anticipator: Anticipator, told: Told) -> None:
        """Ask whether it may be told that, and tell it nothing.

        Raises:
            RealizerError: the anticipator refuses it.
        """
        if told.text is None:
            anticipator.check(told.name, told.value)
        else:
            anticipator.check_heard(told.name)

    def time(self, anticipator: Anticipator, sync: str) -> Time:
        """When a point is, for whoever names it now."""
        return self.board.predicted(anticipator.id, sync).value
