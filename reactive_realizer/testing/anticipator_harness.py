"""A test harness for anticipators: a peg board, and ticks like those of the realizer."""

import asyncio
from collections.abc import Callable, Sequence
from typing import Self, TypeVar

from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext, AnticipatorEvent
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.predicted_points import PredictedPoints
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.realizer.anticipator_streams import AnticipatorStreams
from reactive_realizer.realizer.inputs import Predicted

A = TypeVar("A", bound=Anticipator)


class AnticipatorHarness:
    """Runs the streams of anticipators on a peg board of their own; used as a context manager.

    Attributes:
        board: the board of all anticipators under test.
        now: time of the last tick, s.
        predicted: what the streams gave in the last tick.
    """

    def __init__(self) -> None:
        self.board = PegBoard(Graph())
        self.now = GlobalTime(0.0)
        self.predicted: Sequence[Predicted] = ()
        self._streams = AnticipatorStreams(self.board, PredictedPoints(self.board, Limits().predicted_points))
        self._runner = asyncio.Runner()
        self._streams.open(self._runner.get_loop())

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *raised: object) -> None:
        self.close()

    def close(self) -> None:
        """Ends the streams."""
        self._streams.close()
        self._runner.close()

    def context(self, id_: str) -> AnticipatorContext:
        """The context of an anticipator with an id."""
        return self._streams.context(id_)

    def add(self, anticipator: A) -> A:
        """Adds an anticipator, whose stream starts at once."""
        self._streams.add(anticipator)
        self.tick(self.now)
        return anticipator

    def make(self, id_: str, kind: Callable[..., A], *options: object, **named: object) -> A:
        """Makes an anticipator, and adds it."""
        return self.add(kind(self.context(id_), *options, **named))

    def tick(self, now: float, *events: tuple[Anticipator, AnticipatorEvent]) -> None:
        """Plays the inputs of a tick."""
        self.now = GlobalTime(now)
        entered = [(anticipator.id, event._replace(time=self.now)) for anticipator, event in events]
        self.predicted = self._runner.get_loop().run_until_complete(self._streams.run(entered, self.now))
        with self.board.graph.transaction("inputs"):
            self._streams.apply(self.predicted, self.now)

    def event(
        self, now: float, anticipator: Anticipator, name: str, value: float | None = None, text: str | None = None
    ) -> None:
        """Plays a tick with an event, which has a text or not.

        Raises:
            RealizerError: the anticipator refuses it.
        """
        event = AnticipatorEvent(name, value, text)
        self.check(anticipator, event)
        self.tick(now, (anticipator, event))

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
