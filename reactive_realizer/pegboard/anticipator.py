"""What predicts: the base of all anticipators (thesis 8.5.1), and in itself the one that says what it is told."""

from math import isfinite
from typing import ClassVar

from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.errors import RealizerError, error
from reactive_realizer.pegboard.pegboard import PegBoard


class Anticipator:
    """The only writer of its points on the board; sub-classes turn events into predictions.

    All calls come within a transaction of the realizer's input phase.

    A point is one moment, like the third beat, or, like the press of a key, each time the next one: then it is renewed
    on the board whenever it has come.

    Attributes:
        kind: by which the human file names its class.
        events: names of those that `event` knows.
        heard: names of those that `hear` knows, and that come with a text.
        points: names of its points, with an N where a number stands; none where they are not known beforehand.
        id: by which BML names it, ``anticipators:ID:SYNC``.
    """

    kind: ClassVar[str] = "remote"
    events: ClassVar[tuple[str, ...]] = ()
    heard: ClassVar[tuple[str, ...]] = ()
    points: tuple[str, ...] = ()

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
            RealizerError: "unknown-event", or its value cannot be.
        """
        if name not in self.events:
            raise self._unknown(name)

    def check_heard(self, name: str) -> None:
        """Like `check`, of an event that comes with a text.

        Raises:
            RealizerError: "unknown-event".
        """
        if name not in self.heard:
            raise self._unknown(f"{name} with a text")

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
        """Something happened that concerns it."""

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

    def _unknown(self, event: str) -> RealizerError:
        known = ", ".join([*self.events, *(f"{name} with a text" for name in self.heard)])
        if not known:
            known = "none; when its points are to be is said by predict" if self.kind == Anticipator.kind else "none"
        return error("unknown-event", anticipator=self.id, event=event, known=known)
