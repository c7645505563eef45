"""Anticipators: they predict the times of events outside the realizer (thesis 8.5.1)."""

import asyncio
import re
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import AsyncGenerator, AsyncIterator, Callable, Collection
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from reactive_realizer.clock.tick_clock import TickClock
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.errors import Fault, RealizerError, SchedulingFault, TargetFault

_NUMBER = re.compile(r"[0-9]{1,9}")


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
    unknown = "event"
    anticipator: str
    event: str
    known: tuple[str, ...]


class UnknownPoint(SchedulingFault):
    """A reference to a point that an anticipator does not have."""

    code = "unknown-point"
    template = "{reference}: the anticipator '{anticipator}' has no point '{point}'; it has {known}"
    unknown = "point"
    reference: str
    anticipator: str
    point: str
    known: tuple[str, ...]


class NoAnticipatorYet(TargetFault):
    """A reference to an anticipator that does not exist yet, with almost the name of one that does."""

    code = "no-anticipator-yet"
    template = "{reference}: no anticipator '{anticipator}' is known yet"
    unknown = "anticipator"
    reference: str
    anticipator: str
    known: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Counted:
    """Points that are a prefix with a number, such as ``tick3``: each is a single moment."""

    prefix: str

    def matches(self, point: str) -> bool:
        """Whether this is one of them."""
        number = point[len(self.prefix) :]
        return point.startswith(self.prefix) and _NUMBER.fullmatch(number) is not None

    def __str__(self) -> str:
        return f"{self.prefix}N"


@dataclass(frozen=True, slots=True)
class Revoked:
    """The last occurrence of a recurring point does not count: behaviors that have not begun wait for the next one."""

    point: str


Predictions = AsyncGenerator[tuple[str, float | None] | Revoked, None]
"""The stream of an anticipator: points with their times (s, global), None to withdraw a prediction; and revocations."""


class AnticipatorEvent(NamedTuple):
    """An event of a client.

    Attributes:
        name: one of the anticipator's ``events`` or ``heard``.
        value: None if it has none.
        text: None if it has none.
        time: of the tick in which it entered, s.
    """

    name: str
    value: float | None = None
    text: str | None = None
    time: GlobalTime = GlobalTime(0.0)


@dataclass(frozen=True, slots=True)
class AnticipatorContext:
    """What a realizer provides to an anticipator.

    Attributes:
        id: its name in BML, ``anticipators:ID:POINT``.
        clock: of the realizer.
        named: gives the counted points that behaviors have referred to.
    """

    id: str
    clock: TickClock
    named: Callable[[], Collection[str]] = tuple


class Anticipator(ABC):
    """Predicts the times of its points, which it alone writes.

    A plain point recurs: its name means the next occurrence, and behaviors that refer to it keep the one that they got.
    A `Counted` point is a single moment.

    Attributes:
        kind: name of its class in the human file.
        events: names of the events that it takes.
        heard: names of the events with a text that it takes.
        points: its points; empty if they are not known in advance.
        id: its name in BML, ``anticipators:ID:POINT``.
        clock: of the realizer; it stands still between two ticks.
    """

    kind: ClassVar[str]
    events: ClassVar[tuple[str, ...]] = ()
    heard: ClassVar[tuple[str, ...]] = ()
    points: tuple[str | Counted, ...] = ()

    def __init__(self, context: AnticipatorContext) -> None:
        self.id = context.id
        self.clock = context.clock
        self._named = context.named
        self._entered: deque[AnticipatorEvent] = deque()
        self._waiting: asyncio.Future[None] | None = None
        self._until: float | None = None

    @abstractmethod
    def predictions(self) -> Predictions:
        """The stream of its predictions: an async generator, which runs from the first tick to the end of the session.

        What it yields in reaction to an event or to the clock takes effect in the same tick, together with all other
        predictions of the tick; what it yields after it has waited for something else, in the next tick.
        """

    def forecast(self, point: str) -> Time:
        """The time of a counted point that is named for the first time, s; None while it is unknown."""
        return None

    # --- for the stream

    @property
    async def inputs(self) -> AsyncIterator[AnticipatorEvent]:
        """The events as they enter, forever."""
        while True:
            event = await self.next_input()
            assert event is not None  # without a time limit
            yield event

    async def next_input(self, until: float | None = None) -> AnticipatorEvent | None:
        """The next event; None in the first tick at or after ``until`` (s) if there was none before."""
        if not self._entered:
            self._until = until
            self._waiting = asyncio.get_running_loop().create_future()
            try:
                if until is None:
                    await self._waiting
                else:
                    await self.clock.wait(self._waiting, until)
            finally:
                self._waiting = None
        return self._entered.popleft() if self._entered else None

    @property
    def named(self) -> Collection[str]:
        """The counted points that behaviors have referred to: those whose predictions matter."""
        return self._named()

    # --- for the realizer

    def enter(self, event: AnticipatorEvent) -> None:
        """Pass an event to the stream."""
        self._entered.append(event)
        if self._waiting is not None and not self._waiting.done():
            self._waiting.set_result(None)

    @property
    def waits_for_event(self) -> bool:
        """Whether its stream waits for an event and for nothing else."""
        return self._waiting is not None and not self._waiting.done() and self._until is None

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

    def check_prediction(self, point: str) -> None:
        """Check whether it accepts a client's prediction of a point, before the prediction enters.

        Raises:
            RealizerError: "predicts-itself", or "unknown-point".
        """
        raise RealizerError(PredictsItself(anticipator=self.id, kind=self.kind))

    def has(self, point: str) -> bool:
        """Whether it may predict a point."""
        return not self.points or self.recurs(point) or self.counts(point)

    def recurs(self, point: str) -> bool:
        """Whether the name of a point means its next occurrence as soon as it has passed."""
        return point in self.points

    def counts(self, point: str) -> bool:
        """Whether a point is one of its counted points."""
        return any(isinstance(each, Counted) and each.matches(point) for each in self.points)

    def answers(self, point: str) -> bool:
        """Whether `forecast` gives the time of a point, so that its prediction need not be kept."""
        return self.counts(point) and type(self).forecast is not Anticipator.forecast

    def check_point(self, point: str, reference: str) -> None:
        """Check a reference to a point.

        Raises:
            RealizerError: "unknown-point".
        """
        if not self.has(point):
            known = tuple(map(str, self.points))
            raise RealizerError(UnknownPoint(reference=reference, anticipator=self.id, point=point, known=known))

    def _unknown(self, event: str) -> RealizerError:
        known = (*self.events, *(f"{name} with a text" for name in self.heard))
        return RealizerError(UnknownEvent(anticipator=self.id, event=event, known=known))


class Remote(Anticipator):
    """Predicts what clients predict.

    Each of its points is a single moment, which its name keeps.

    Args:
        context: of the anticipator.
        points: names of its points; without any, they are those that clients name.
    """

    kind = "remote"

    def __init__(self, context: AnticipatorContext, points: tuple[str, ...] = ()) -> None:
        super().__init__(context)
        self.points = points

    async def predictions(self) -> Predictions:
        """What clients predict."""
        async for event in self.inputs:
            yield event.name, event.value

    def check_prediction(self, point: str) -> None:
        """Accept predictions of its points.

        Raises:
            RealizerError: "unknown-point".
        """
        self.check_point(point, f"anticipators:{self.id}:{point}")

    def has(self, point: str) -> bool:
        """Whether clients may predict a point."""
        return not self.points or point in self.points

    def recurs(self, point: str) -> bool:
        """No point recurs."""
        return False

    def _unknown(self, event: str) -> RealizerError:
        return RealizerError(UnknownEvent(anticipator=self.id, event=event, known=("none (it takes predictions)",)))
