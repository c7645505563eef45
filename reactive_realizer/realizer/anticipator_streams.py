"""Runs the streams of anticipators beside the ticks, and applies what they predict."""

import asyncio
import logging
from collections import deque
from collections.abc import Callable, Iterable, Sequence
from contextlib import aclosing
from functools import partial
from itertools import count
from math import isfinite

from reactive_realizer.clock.tick_clock import TickClock
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.engine.guarded_engine import FAILURES
from reactive_realizer.errors import Fault, NotANumber, PlayingFault, RealizerError
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext, AnticipatorEvent, Revoked
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.predicted_points import PredictedPoints
from reactive_realizer.realizer.inputs import Forecast, Predicted, Prediction, Revocation, StreamFailure

logger = logging.getLogger(__name__)

_TURNS = 5
"""Turns of the event loop in which a stream may react within the tick; one that only waits here takes one."""


_MOST = 10_000
"""Predictions of a stream in a tick, after which it fails: one that never waits would stop everything."""


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


class TooManyPredictions(Fault):
    """A stream that does not wait between its predictions."""

    code = "too-many-predictions"
    template = "it has made {limit} predictions in one tick; a stream has to wait for something between them"
    limit: int


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
        self._new: list[Anticipator] = []
        self._ranks = count()
        self._tasks: dict[str, asyncio.Task[None]] = {}
        self._predicted: dict[int, list[Predicted]] = {}
        """What streams have predicted since the last tick, by the rank of the stream."""
        self._listeners: list[Callable[[Forecast], None]] = []
        board.forecast = self._forecast

    def context(self, id: str) -> AnticipatorContext:  # noqa: A002 - the standard's word
        """The context of an anticipator with an id."""
        return AnticipatorContext(id, self.clock, partial(self._named, id))

    def add(self, anticipator: Anticipator) -> None:
        """Add an anticipator; its stream starts in the next tick."""
        self._board.anticipators[anticipator.id] = anticipator
        self._new.append(anticipator)

    def remove(self, id_: str) -> None:
        """End the stream of an anticipator, and forget it."""
        self._new = [each for each in self._new if each is not self._board.anticipators[id_]]
        del self._board.anticipators[id_]
        if (task := self._tasks.pop(id_, None)) is not None:
            task.cancel()

    def open(self, group: asyncio.TaskGroup | asyncio.AbstractEventLoop) -> None:
        """Have the streams run as tasks of a group, from the next tick on."""
        self._group = group

    def close(self) -> None:
        """End the streams."""
        for task in self._tasks.values():
            task.cancel()

    def listen(self, listener: Callable[[Forecast], None]) -> None:
        """Call a listener with each forecast, before it has any effect."""
        self._listeners.append(listener)

    @property
    def expectant(self) -> bool:
        """Whether a stream waits for anything but an event, and may predict then."""
        tasks = self._tasks.items()
        return any(not task.done() and not self._board.anticipators[id_].waits_for_event for id_, task in tasks)

    async def run(self, events: Iterable[tuple[str, AnticipatorEvent]], now: GlobalTime) -> tuple[Predicted, ...]:
        """Start new streams, pass them events, and wake those that wait for the time; all that has been predicted.

        Args:
            events: with the ids of their anticipators.
            now: the time of the tick.
        """
        awake = self.clock.advance(now) or bool(self._new)
        for anticipator in self._new:
            self._start(anticipator)
        self._new.clear()
        for id_, event in events:
            if not self._tasks[id_].done():
                self._board.anticipators[id_].enter(event)
                awake = True
        if awake:
            for _ in range(_TURNS):
                await asyncio.sleep(0)
        predicted, self._predicted = self._predicted, {}
        return tuple(each for rank in sorted(predicted) for each in predicted[rank])

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

    def _start(self, anticipator: Anticipator) -> None:
        take = partial(self._take, next(self._ranks))
        name = f"anticipators:{anticipator.id}"
        self._tasks[anticipator.id] = self._group.create_task(_run(anticipator, take), name=name)

    def _take(self, rank: int, predicted: Predicted) -> None:
        """Note a prediction of a stream.

        Raises:
            RealizerError: "too-many-predictions".
        """
        noted = self._predicted.setdefault(rank, [])
        if len(noted) == _MOST and not isinstance(predicted, StreamFailure):
            raise RealizerError(TooManyPredictions(limit=_MOST))
        noted.append(predicted)

    def _forecast(self, anticipator: Anticipator, sync: str) -> Time:
        try:
            time = _seconds(anticipator.forecast(sync))
        except FAILURES:
            logger.exception("the anticipator '%s' has no forecast of '%s'", anticipator.id, sync)
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
    except FAILURES as failure:
        ended = (task := asyncio.current_task()) is not None and task.cancelling() > 0
        if ended and isinstance(failure, asyncio.CancelledError):
            raise
        logger.exception("the anticipator '%s' has failed", anticipator.id)
        if ended:  # it failed while it closed
            return
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
    return Prediction(anticipator.id, point, _seconds(time))


def _seconds(time: float | None) -> Time:
    """A time that an anticipator gives, which may be any kind of number.

    Raises:
        RealizerError: "not-a-number".
        Exception: it is none.
    """
    if time is None:
        return None
    if not isfinite(time):
        raise RealizerError(NotANumber())
    return GlobalTime(float(time))
