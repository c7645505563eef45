"""Anticipators: they predict the times of events outside the realizer (thesis 8.5.1)."""

from math import isfinite
from typing import ClassVar

from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.errors import Fault, NotANumber, RealizerError
from reactive_realizer.pegboard.pegboard import PegBoard


class PredictsItself(Fault):
    """A client's prediction for an anticipator that makes its own."""

    code = "predicts-itself"
    template = "'{anticipator}' is a {kind}: it makes its own predictions and accepts none from clients"
    anticipator: str
    kind: str


class UnknownEvent(Fault):
    """An event that an anticipator does not know."""

    code = "unknown-event"
    template = "'{anticipator}' does not know the event {event}; known events: {known}"
    anticipator: str
    event: str
    known: str


class Anticipator:
    """Predicts the times of its points, which it alone writes.

    This class takes predictions of clients; subclasses make predictions from events. All methods are called within a
    transaction in the input phase of a tick.

    A point is either one moment, such as the third beat, or the next occurrence of an event, such as a key press; such
    a point is renewed on the board after each occurrence.

    Attributes:
        kind: name of its class in the human file.
        events: names of the events that `event` accepts.
        heard: names of the events with a text, which `hear` accepts.
        points: names of its points, with an N for a number; empty if they are not known in advance.
        id: its name in BML, ``anticipators:ID:SYNC``.
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
        """The predicted time of a point that is named for the first time; None while it is unknown."""
        return None

    def check(self, name: str, value: float | None) -> None:
        """Check an event of a client, before it enters.

        Raises:
            RealizerError: "unknown-event", or the value is invalid.
        """
        if name not in self.events:
            raise self._unknown(name)

    def check_heard(self, name: str) -> None:
        """Check an event with a text, as `check` does.

        Raises:
            RealizerError: "unknown-event".
        """
        if name not in self.heard:
            raise self._unknown(f"{name} with a text")

    def check_prediction(self) -> None:
        """Check whether it accepts a client's prediction, before the prediction enters.

        Raises:
            RealizerError: it makes its own predictions.
        """
        if self.kind != Anticipator.kind:
            raise RealizerError(PredictsItself(anticipator=self.id, kind=self.kind))

    def advance(self, now: GlobalTime) -> None:
        """Called at every tick, before the inputs of the tick."""

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        """Handle an event."""

    def hear(self, name: str, text: str, now: GlobalTime) -> None:
        """Handle an event with a text."""

    def revise(self, now: GlobalTime) -> None:
        """Predict all named points that have not passed again."""
        for sync, peg in self._board.predictions(self.id).items():
            if not is_due(peg.value, now):
                self.predict(sync, self.forecast(sync), now)

    def renew(self, sync: str) -> None:
        """Make a passed point mean its next occurrence; pegs that depend on it already keep this one."""
        self._board.renew(self.id, sync)

    def withdraw(self, now: GlobalTime) -> None:
        """Withdraw the predictions of all points."""
        for sync in self._board.predictions(self.id):
            self.predict(sync, None, now)

    def predict(self, sync: str, time: Time, now: GlobalTime) -> None:
        """Predict the time of a point; None withdraws the prediction.

        Since network messages are late, a point that has not passed is never set before ``now``. A point that has
        passed keeps its time, unless it is to happen again.

        Raises:
            RealizerError: the time is not finite.
        """
        if time is not None and not isfinite(time):
            raise RealizerError(NotANumber())
        peg = self._board.predicted(self.id, sync)
        passed = is_due(peg.value, now)
        if time is None or time > now:
            peg.set(time)
        elif not passed:
            peg.set(now)

    def _unknown(self, event: str) -> RealizerError:
        known = ", ".join([*self.events, *(f"{name} with a text" for name in self.heard)])
        if not known:
            known = "none (it takes predictions)" if self.kind == Anticipator.kind else "none"
        return RealizerError(UnknownEvent(anticipator=self.id, event=event, known=known))
