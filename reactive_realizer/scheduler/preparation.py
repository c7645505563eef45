"""Preparation of a block: the background work of engines, and the units that they make with its results."""

from collections.abc import Callable, Container, Iterator, Mapping
from functools import partial
from typing import Protocol

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.engine import Engine, Part, SlowWork
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.engine_routing import Prepared, Result, RoutedBehavior
from reactive_realizer.scheduler.solution import Loss, lost_behavior

Follower = Callable[[Result, GlobalTime], None]
"""Takes a result of slow work, and the time of the tick."""


class BackgroundWork(Protocol):
    """Does slow work outside of ticks; a result is an input of a later tick."""

    def request(self, name: str, work: SlowWork, done: Follower) -> Callable[[], None]:
        """Start work; ``done`` gets its result and the time, in a later tick; of work in parts, each one in turn.

        Returns:
            A call that cancels the work; ``done`` is not called then.
        """
        ...


class Preparation:
    """Starts the background work of the engines of a block, and has them make units when it is done.

    Of work in parts, the first one is enough; those who `follow` it get the results of the others.

    Args:
        routed: the behaviors, by id.
        background: does the work.
        kept: whether the work goes on whoever uses it.
    """

    def __init__(self, routed: Mapping[str, RoutedBehavior], background: BackgroundWork, *, kept: bool = False) -> None:
        self._routed = routed
        self._kept = kept
        self._results: dict[str, Result] = {}
        self._parted: set[str] = set()
        self._cancels: dict[str, Callable[[], None]] = {}
        self._listeners: list[Callable[[], None]] = []
        self._followers: dict[str, list[Follower]] = {}
        for id_, each in routed.items():
            try:
                work = each.prepare()
            except Exception as failure:
                self._results[id_] = failure
                continue
            if work is None:
                self._results[id_] = None
            else:
                name = f"{each.engine.name} {id_}"
                self._cancels[id_] = background.request(name, work, partial(self._receive, id_))

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

    def has_parts(self, unit: PlanUnit) -> bool:
        """Whether the work of a unit is done in parts."""
        return unit.behavior.id in self._parted

    def follow(self, unit: PlanUnit, follower: Follower, now: GlobalTime) -> Callable[[], None] | None:
        """Call ``follower`` with the present result of a unit's work, which has parts, and with all later ones.

        Returns:
            A call that ends this, and cancels the work; None if no other result follows.
        """
        id_ = unit.behavior.id
        follower(_result_of(self._results[id_]), now)
        if id_ not in self._cancels:
            return None
        self._followers.setdefault(id_, []).append(follower)
        return partial(self._leave, id_, follower)

    def cancel(self) -> None:
        """Cancel the work, unless it is kept."""
        if not self._kept:
            for cancel in self._cancels.values():
                cancel()
            self._cancels = {}

    def _leave(self, id_: str, follower: Follower) -> None:
        self._followers[id_].remove(follower)
        if not self._kept and id_ in self._cancels:
            self._cancels.pop(id_)()

    def _receive(self, id_: str, result: Result, now: GlobalTime) -> None:
        if isinstance(result, Part):
            if result.last:
                del self._cancels[id_]
            else:
                self._parted.add(id_)
            result = result.result
        else:
            del self._cancels[id_]
        first = id_ not in self._results
        self._results[id_] = result
        if not first:
            for follower in tuple(self._followers.get(id_, ())):
                follower(_result_of(result), now)
        elif self.complete:
            listeners, self._listeners = self._listeners, []
            for listener in listeners:
                listener()


def _result_of(result: Result) -> Result:
    """The result of the slow work for the form that is played."""
    return result.result if isinstance(result, Prepared) else result
