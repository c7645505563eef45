"""Preparation of a block: the background work of engines, and the units that they make with its results."""

from collections.abc import Awaitable, Callable, Container, Iterator, Mapping
from functools import partial
from typing import Protocol

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.engine import Engine
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.engine_routing import Result, RoutedBehavior
from reactive_realizer.scheduler.solution import Loss, lost_behavior


class BackgroundWork(Protocol):
    """Does slow work outside of ticks; a result is an input of a later tick."""

    def request(
        self, name: str, work: Awaitable[object], done: Callable[[Result, GlobalTime], None]
    ) -> Callable[[], None]:
        """Start work; ``done`` gets its result and the time, in a later tick.

        Returns:
            A call that cancels the work; ``done`` is not called then.
        """
        ...


class Preparation:
    """Starts the background work of the engines of a block, and has them make units when it is done."""

    def __init__(self, routed: Mapping[str, RoutedBehavior], background: BackgroundWork) -> None:
        self._routed = routed
        self._results: dict[str, Result] = {}
        self._cancels: list[Callable[[], None]] = []
        self._listeners: list[Callable[[], None]] = []
        for id_, each in routed.items():
            try:
                work = each.prepare()
            except Exception as failure:
                self._results[id_] = failure
                continue
            if work is None:
                self._results[id_] = None
            else:
                receive = partial(self._receive, id_)
                self._cancels.append(background.request(f"{each.engine.name} {id_}", work, receive))

    @property
    def complete(self) -> bool:
        """Whether all results are there."""
        return len(self._results) == len(self._routed)

    def when_complete(self, listener: Callable[[], None]) -> None:
        """Call a listener when all results are there, at once if they are."""
        if self.complete:
            listener()
        else:
            self._listeners.append(listener)

    def units(
        self, block: BlockKey, without: Container[str], left_out: Callable[[RoutedBehavior, Fault], None]
    ) -> Iterator[PlanUnit | Loss]:
        """A unit for each behavior, or the loss of a behavior that its engine cannot make.

        Args:
            block: in which they are played.
            without: ids of behaviors that are not played.
            left_out: called with the fault of each description that is replaced by the next form.
        """
        for id_, each in self._routed.items():
            if id_ not in without:
                try:
                    yield each.plan(block, self._results[id_], partial(left_out, each))
                except RealizerError as problem:
                    yield lost_behavior(each.behavior, problem.fault)

    def engine_of(self, unit: PlanUnit) -> Engine:
        """The engine that has made a unit."""
        return self._routed[unit.behavior.id].engine

    def cancel(self) -> None:
        """Cancel the work."""
        for cancel in self._cancels:
            cancel()

    def _receive(self, id_: str, result: Result, now: GlobalTime) -> None:
        self._results[id_] = result
        if self.complete:
            listeners, self._listeners = self._listeners, []
            for listener in listeners:
                listener()
