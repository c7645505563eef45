"""Runs the streams of anticipators beside the ticks, and applies what they predict."""

import asyncio
import logging
from collections import deque
from collections.abc import Callable, Iterable, Sequence
from contextlib import aclosing
from dataclasses import dataclass
from functools import partial
from math import isfinite

from reactive_realizer.clock.tick_clock import TickClock
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.errors import Fault, NotANumber, PlayingFault, RealizerError
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext, AnticipatorEvent, Revoked
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.predicted_points import PredictedPoints
from reactive_realizer.realizer.inputs import Forecast, Predicted, Prediction, Revocation, StreamFailure

logger = logging.getLogger(__name__)

_TURNS = 5
"""Turns of the event loop in which a stream may react within the tick; one that only waits here takes one."""


class AnticipatorFailed(PlayingFault):
    """An anticipator whose stream has failed."""

    code = "anticipator-failed"
    template = "the anticipator '{anticipator}' has failed and predicts nothing more: {reason}"
    anticipator: str
    reason: str


class ForecastDiffers(Fault):
    """A question to an anticipator that was not recorded."""

    code = "forecast-differs"
    template = (
        "the replay differs from the recording at {time:g} s: it needs the time of {point}; files or versions have "
        "probably changed"
    )
    time: float
    point: str


class UndeclaredPoint(Fault):
    """A prediction of a point that is not among those of its anticipator."""

    code = "undeclared-point"
    template = "it predicted '{point}', which is not one of its points: {known}"
    point: str
    known: tuple[str, ...]


@dataclass(eq=False, slots=True)
class _Stream:
    """A running stream, and what it has predicted since the last tick."""

    task: "asyncio.Task[None]"
    predicted: list[Predicted]


class AnticipatorStreams:
    """The streams of the anticipators of a board.

    Args:
        board: of their points.
        points: writes them.

    Attributes:
        clock: of the streams.
    """

    def __init__(self, board: PegBoard, points: PredictedPoints) -> None:
        self.clock = TickClock()
        self._board = board
        self._points = points
        self._streams: dict[str, _Stream] = {}
        self._listeners: list[Callable[[Forecast], None]] = []
        board.forecast = self._forecast

    def context(self, id: str) -> AnticipatorContext:  # noqa: A002 - the standard's word
        """The context of an anticipator with an id."""
        return AnticipatorContext(id, self.clock, partial(self._named, id))

    def add(self, anticipator: Anticipator) -> None:
        """Add an anticipator; its stream starts in the next tick."""
        self._board.anticipators[anticipator.id] = anticipator

    def open(self, group: asyncio.TaskGroup | asyncio.AbstractEventLoop) -> None:
        """Have the streams run as tasks of a group, from the next tick on."""
        self._group = group

    def close(self) -> None:
        """End the streams."""
        for stream in self._streams.values():
            stream.task.cancel()

    def listen(self, listener: Callable[[Forecast], None]) -> None:
        """Call a listener with each forecast, before it has any effect."""
        self._listeners.append(listener)

    @property
    def expectant(self) -> bool:
        """Whether a stream waits for anything but an event, and may predict then."""
        return any(
            not stream.task.done() and not self._board.anticipators[id_].waits_for_event
            for id_, stream in self._streams.items()
        )

    async def run(self, events: Iterable[tuple[str, AnticipatorEvent]], now: GlobalTime) -> tuple[Predicted, ...]:
        """Start new streams, pass them events, and wake those that wait for the time; all that has been predicted.

        Args:
            events: with the ids of their anticipators.
            now: the time of the tick.
        """
        awake = self.clock.advance(now)
        for id_ in [id_ for id_ in self._board.anticipators if id_ not in self._streams]:
            self._start(id_)
            awake = True
        for id_, event in events:
            if not self._streams[id_].task.done():
                self._board.anticipators[id_].enter(event)
                awake = True
        if awake:
            for _ in range(_TURNS):
                await asyncio.sleep(0)
        return tuple(each for stream in self._streams.values() for each in _taken(stream.predicted))

    def apply(self, predicted: Sequence[Predicted], now: GlobalTime) -> None:
        """Write predictions on the board, within a transaction."""
        self._points.renew(now)
        for each in predicted:
            match each:
                case Prediction(anticipator, sync, time):
                    self._points.predict(anticipator, sync, time, now)
                case Revocation(anticipator, sync):
                    self._points.revoke(anticipator, sync)
                case StreamFailure():
                    pass

    def replay(self, forecasts: Sequence[Forecast]) -> None:
        """Answer the next questions to anticipators as they were answered when the session was recorded."""
        recorded = deque(forecasts)

        def forecast(anticipator: Anticipator, sync: str) -> Time:
            if not recorded or (recorded[0].anticipator, recorded[0].sync) != (anticipator.id, sync):
                raise RealizerError(ForecastDiffers(time=self._board.time, point=f"{anticipator.id}:{sync}"))
            return recorded.popleft().time

        self._board.forecast = forecast

    def _start(self, id_: str) -> None:
        predicted: list[Predicted] = []
        task = self._group.create_task(
            _run(self._board.anticipators[id_], predicted.append), name=f"anticipators:{id_}"
        )
        self._streams[id_] = _Stream(task, predicted)

    def _forecast(self, anticipator: Anticipator, sync: str) -> Time:
        try:
            time = anticipator.forecast(sync)
        except Exception:
            logger.exception("the anticipator '%s' has no forecast of '%s'", anticipator.id, sync)
            time = None
        if time is not None and not isfinite(time):
            time = None
        for listener in self._listeners:
            listener(Forecast(anticipator.id, sync, time))
        return time

    def _named(self, id_: str) -> tuple[str, ...]:
        anticipator = self._board.anticipators[id_]
        return tuple(sync for sync in self._board.predictions(id_) if anticipator.counts(sync))


async def _run(anticipator: Anticipator, take: Callable[[Predicted], None]) -> None:
    """Run the stream of an anticipator; a failure ends it, and nothing else."""
    try:
        async with aclosing(anticipator.predictions()) as predictions:
            async for each in predictions:
                take(_checked(anticipator, each))
    except Exception as failure:
        logger.exception("the anticipator '%s' has failed", anticipator.id)
        reason = (
            failure.fault.sentence if isinstance(failure, RealizerError) else f"{type(failure).__name__}: {failure}"
        )
        take(StreamFailure(anticipator.id, reason))


def _checked(anticipator: Anticipator, item: tuple[str, float | None] | Revoked) -> Prediction | Revocation:
    point, time = (item.point, None) if isinstance(item, Revoked) else item
    if not anticipator.has(point):
        raise RealizerError(UndeclaredPoint(point=point, known=tuple(map(str, anticipator.points))))
    if isinstance(item, Revoked):
        return Revocation(anticipator.id, point)
    if time is not None and not isfinite(time):
        raise RealizerError(NotANumber())
    return Prediction(anticipator.id, point, None if time is None else GlobalTime(time))


def _taken(predicted: list[Predicted]) -> list[Predicted]:
    taken, predicted[:] = predicted[:], []
    return taken
