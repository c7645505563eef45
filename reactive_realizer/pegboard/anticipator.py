"""What predicts: the base of all anticipators (thesis 8.5.1), and in itself the one that says what it is told."""

from math import isfinite
from typing import ClassVar

from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.errors import error
from reactive_realizer.pegboard.pegboard import PegBoard


class Anticipator:
    """The only writer of its points on the board; sub-classes turn events into predictions.

    All calls come within a transaction of the realizer's input phase.

    A point is one moment, like the third beat, or, like the press of a key, each time the next one: then it is renewed
    on the board whenever it has come.

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

    def advance(self, now: GlobalTime) -> None:
        """It is ``now``: asked at every tick, before whatever comes in."""

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        """Something happened that concerns it; unknown events mean nothing."""

    def hear(self, name: str, text: str, now: GlobalTime) -> None:
        """Like `event`, of words that were said."""

    def revise(self, now: GlobalTime) -> None:
        """Predict all points anew that were named and have not passed."""
        for sync, peg in self._board.predictions(self.id).items():
            if not is_due(peg.value, now):
                self.predict(sync, self.forecast(sync), now)

    def renew(self, sync: str) -> None:
        """Have a point that has come mean the next time; what hangs on it already keeps its moment."""
        self._board.renew(self.id, sync)

    def withdraw(self, now: GlobalTime) -> None:
        """Take back what was said of all points."""
        for sync in self._board.predictions(self.id):
            self.predict(sync, None, now)

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
