"""Rehearsal of a block: which of its behaviors can be played, and with which sync points."""

import asyncio
from collections import deque
from collections.abc import AsyncGenerator, Callable, Collection, Mapping, Sequence
from contextlib import AbstractAsyncContextManager
from dataclasses import dataclass

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.block import BehaviorBlock, DefineProc, Problem
from reactive_realizer.bml.speech import StreamedSpeech
from reactive_realizer.engine.engine import Engine
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.scheduler.block_planner import DescriptionLeftOut, unsupported
from reactive_realizer.scheduler.engine_routing import EngineRouting, Result, RoutedBehavior

Points = Collection[str] | None
"""The sync points of a behavior; None if they are not known."""


@dataclass(frozen=True, slots=True)
class Rehearsal:
    """What is known of the behaviors of a block before it is planned.

    Attributes:
        engines: the engine of each behavior, by id; behaviors without an engine are missing.
        points: the sync points of each behavior whose engine knows them, by id.
        problems: of the behaviors that cannot be played, or only in another form, in document order.
    """

    engines: Mapping[str, Engine]
    points: Mapping[str, Collection[str]]
    problems: Sequence[Problem]


_AT_ONCE = 20
"""Behaviors that are checked in one turn at most."""

_TURN = 0.002
"""Duration of a turn, s, after which no more behaviors are checked in it: a tick waits for it."""


Turns = AbstractAsyncContextManager[object]
"""A lock for short work on the event loop; other tasks go on when it is released."""


async def rehearse(block: BehaviorBlock | DefineProc, routing: EngineRouting, turns: Turns) -> Rehearsal:
    """Asks the engines about the behaviors of a block, some in each turn, without slow work and without effects."""
    rehearsing, loop = _Rehearsing(block, routing), asyncio.get_running_loop()
    left = deque(rehearsing.routed.values())
    while left:
        async with turns:
            end = loop.time() + _TURN
            for _ in range(min(_AT_ONCE, len(left))):
                each = left.popleft()
                rehearsing.note(each, each.check)
                if loop.time() >= end:
                    break
    return rehearsing.result()


async def rehearse_slowly(block: BehaviorBlock | DefineProc, routing: EngineRouting) -> Rehearsal:
    """Plans the behaviors of a block, in document order, with the slow work that this takes.

    The plan ignores the effects of earlier blocks.
    """
    rehearsing = _Rehearsing(block, routing)
    for each in rehearsing.routed.values():
        if any(isinstance(form, StreamedSpeech) for form in each.forms):
            rehearsing.note(each, each.check)  # no client sends its sound
            continue
        result = await _prepared(each)

        def points(left_out: Callable[[Fault], None], each: RoutedBehavior = each, result: Result = result) -> Points:
            return each.plan(BlockKey(rehearsing.character, block.id), result, left_out).timing.points

        rehearsing.note(each, points)
    return rehearsing.result()


class _Rehearsing:
    """A rehearsal that is going on; for an unknown character, no behavior has an engine."""

    def __init__(self, block: BehaviorBlock | DefineProc, routing: EngineRouting) -> None:
        characters = routing.characters
        self.character = block.played_by(characters) if isinstance(block, BehaviorBlock) else characters[0]
        known = self.character in routing.characters
        self.routed = routing.route(self.character, block.behaviors) if known else {}
        self._block = block
        self._points: dict[str, Collection[str]] = {}
        self._problems: list[Problem] = []
        for behavior in block.behaviors if known else ():
            if behavior.id not in self.routed:
                self._report(behavior, unsupported(behavior))

    def note(self, routed: RoutedBehavior, find_points: Callable[[Callable[[Fault], None]], Points]) -> None:
        """Keeps the points of a behavior, or the reason why it cannot be played."""
        behavior = routed.behavior
        try:
            points = find_points(lambda fault: self._report(behavior, DescriptionLeftOut(reason=fault.sentence)))
        except RealizerError as refused:
            self._report(behavior, refused.fault)
        else:
            if points is not None:
                self._points[behavior.id] = points

    def result(self) -> Rehearsal:
        """The rehearsal."""
        engines = {id_: routed.engine for id_, routed in self.routed.items()}
        return Rehearsal(engines, self._points, self._problems)

    def _report(self, behavior: Behavior, fault: Fault) -> None:
        place = behavior.location
        self._problems.append(Problem(fault.located(place.line, place.column), f"{self._block.id}:{behavior.id}"))


async def _prepared(routed: RoutedBehavior) -> Result:
    try:
        work = routed.prepare()
        if isinstance(work, AsyncGenerator):
            return [part async for part in work][-1].result
        return None if work is None else await work
    except Exception as failure:
        return failure
