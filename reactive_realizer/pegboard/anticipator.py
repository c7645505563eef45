"""What predicts: the base of all anticipators (thesis 8.5.1), and in itself the one that says what it is told."""

from math import isfinite
from typing import ClassVar

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.errors import error
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import Time


class Anticipator:
    """The only writer of its points on the board; sub-classes turn events into predictions.

    All calls come within a transaction of the realizer's input phase.

    Attributes:
        id: by which BML names it, ``anticipators:ID:SYNC``.
    """

    kind: ClassVar[str] = "remote"

    def __init__(self, id: str, board: PegBoard) -> None:  # noqa: A002 - the standard's word
        self.id = id
        self._board = board
        board.ask(id, self.forecast)

    def forecast(self, sync: str) -> Time:
        """When a point that is named for the first time is to be; None while nothing is known."""
        return None

    def check(self, name: str, value: float | None) -> None:
        """Whether an event may be told; whoever brings it from outside asks first.

        Raises:
            RealizerError: its value cannot be.
        """

    def check_prediction(self) -> None:
        """Whether others may say when its points are to be; whoever brings a prediction from outside asks first.

        Raises:
            RealizerError: it is of a kind that predicts by itself.
        """
        if self.kind != Anticipator.kind:
            raise error("predicts-itself", anticipator=self.id, kind=self.kind)

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        """Something happened that concerns it; unknown events mean nothing."""

    def predict(self, sync: str, time: Time, now: GlobalTime) -> None:
        """Say when a point is to be; None withdraws what was said.

        Whatever comes over a network is late: a point not yet passed is never set before ``now``. A point that has
        passed keeps its time, unless it is to happen again.

        Raises:
            RealizerError: the time is not finite.
        """
        if time is not None and not isfinite(time):
            raise error("not-a-number")
        peg = self._board.predicted(self.id, sync)
        passed = is_due(peg.value, now)
        if time is None or time > now:
            peg.set(time)
        elif not passed:
            peg.set(now)
