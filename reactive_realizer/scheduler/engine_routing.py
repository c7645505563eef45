"""The engines of each character, and which engine plays which behavior."""

import logging
from collections.abc import AsyncGenerator, Callable, Collection, Iterable, Mapping, Sequence
from contextlib import aclosing
from typing import NamedTuple, TypeVar

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.engine import Engine, Part, SlowWork
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.faults import WorkFailed

logger = logging.getLogger(__name__)

T = TypeVar("T")

Result = object | Exception
"""The result of background work: a value, or the exception that it raised."""


class Prepared(NamedTuple):
    """The result of slow work for a behavior with several forms.

    Attributes:
        forms: those that can still be played, best first; the work was done for the first one.
        result: of the work.
        refused: the faults of better forms, for which it failed.
    """

    forms: "Sequence[Behavior]"
    result: object
    refused: tuple[Fault, ...]


class RoutedBehavior(NamedTuple):
    """A behavior with the engine that plays it.

    Attributes:
        forms: the forms of the behavior that the engine supports, best first.
    """

    behavior: Behavior
    engine: Engine
    forms: Sequence[Behavior]

    def prepare(self) -> SlowWork | None:
        """The slow work to be done before planning; None if there is none.

        With several forms, each result is a `Prepared`, for the first form whose work does not fail.
        """
        form, *others = self.forms
        if not others:
            return self.engine.prepare(form)
        try:
            work = self.engine.prepare(form)
        except RealizerError as problem:
            return self._prepare_next(problem.fault)
        return None if work is None else self._prepare_best(work)

    def check(self, left_out: Callable[[Fault], None]) -> Collection[str] | None:
        """The sync points of the best form that can be made; None if only slow work can tell.

        Args:
            left_out: called with the fault of each better form.

        Raises:
            RealizerError: no form can be made.
        """
        return self._best(self.engine.check, left_out)

    def plan(self, block: BlockKey, result: Result, left_out: Callable[[Fault], None]) -> PlanUnit:
        """A unit for the best form that can be made.

        Args:
            block: in which it is played.
            result: of the slow work.
            left_out: called with the fault of each better form.

        Raises:
            RealizerError: the slow work failed, or no form can be made.
        """
        if isinstance(result, Prepared):
            for fault in result.refused:
                left_out(fault)
            return self._replace(forms=result.forms).plan(block, result.result, left_out)
        if isinstance(result, RealizerError):
            raise result
        if isinstance(result, Exception):
            raise RealizerError(WorkFailed(reason=str(result))) from result
        unit = self._best(lambda form: self.engine.plan(block, form, result), left_out)
        unit.behavior = self.behavior  # feedback names the behavior, whatever form of it is played
        return unit

    async def _prepare_best(self, work: SlowWork) -> AsyncGenerator[Part, None]:
        begun = False
        try:
            async with aclosing(_parts(work)) as parts:
                async for part in parts:
                    begun = True
                    yield Part(Prepared(self.forms, part.result, ()), part.last)
        except RealizerError as problem:
            if begun:
                raise
            refused = problem.fault
        else:
            return
        async with aclosing(self._prepare_next(refused)) as parts:
            async for part in parts:
                yield part

    async def _prepare_next(self, refused: Fault) -> AsyncGenerator[Part, None]:
        following = self._replace(forms=self.forms[1:])
        work = following.prepare()
        async with aclosing(_parts(_nothing() if work is None else work)) as parts:
            async for part in parts:
                result = part.result
                prepared = result if isinstance(result, Prepared) else Prepared(following.forms, result, ())
                yield Part(prepared._replace(refused=(refused, *prepared.refused)), part.last)

    def _best(self, make: Callable[[Behavior], T], left_out: Callable[[Fault], None]) -> T:
        """What an engine makes of the best form that it does not refuse."""
        try:
            for form in self.forms[:-1]:
                try:
                    return make(form)
                except RealizerError as problem:
                    left_out(problem.fault)
            return make(self.forms[-1])
        except RealizerError:
            raise
        except Exception as failure:
            logger.exception("'%s' could not be made by %s", self.behavior.id, self.engine.name)
            raise RealizerError(WorkFailed(reason=str(failure))) from failure


async def _parts(work: SlowWork) -> AsyncGenerator[Part, None]:
    """The results of slow work as parts."""
    if isinstance(work, AsyncGenerator):
        async with aclosing(work):
            async for part in work:
                yield part
    else:
        yield Part(await work, last=True)


async def _nothing() -> None:
    """Slow work without a result."""


class EngineRouting:
    """Chooses an engine for each behavior, and gives it its units.

    Args:
        engines: by character id, in rank order; the first character takes blocks that name none.
    """

    def __init__(self, engines: Mapping[str, Sequence[Engine]]) -> None:
        self._engines = {character: tuple(own) for character, own in engines.items()}
        self._engine_of: dict[PlanUnit, Engine] = {}

    @property
    def characters(self) -> tuple[str, ...]:
        """The ids of the characters."""
        return tuple(self._engines)

    @property
    def engines(self) -> tuple[Engine, ...]:
        """All engines, in rank order."""
        return tuple(engine for own in self._engines.values() for engine in own)

    def route(self, character: str, behaviors: Iterable[Behavior]) -> dict[str, RoutedBehavior]:
        """Behaviors by id, with the engine that plays each; a behavior that no engine supports is left out."""
        found = (self._routed(character, behavior) for behavior in behaviors)
        return {routed.behavior.id: routed for routed in found if routed is not None}

    def assign(self, unit: PlanUnit, engine: Engine) -> None:
        """Have an engine play a unit that has its pegs."""
        self._engine_of[unit] = engine
        engine.add(unit)

    def unassign(self, unit: PlanUnit) -> None:
        """Take a unit from its engine, if it has one."""
        engine = self._engine_of.pop(unit, None)
        if engine is not None:
            engine.remove(unit)

    def reset(self, character: str, time: GlobalTime) -> None:
        """Have a character's engines remove the lasting effects of behaviors."""
        for engine in self._engines[character]:
            engine.reset(time)

    def _routed(self, character: str, behavior: Behavior) -> RoutedBehavior | None:
        """A behavior with the first engine of a character that supports its best form."""
        for form in (forms := behavior.forms):
            for engine in self._engines[character]:
                if engine.supports(form):
                    return RoutedBehavior(behavior, engine, [other for other in forms if engine.supports(other)])
        return None
