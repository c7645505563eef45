"""An engine alone with a figure, and somebody who does for it what the scheduler does."""

import asyncio
from collections.abc import Awaitable
from math import inf

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.clock.ticker import FRAME_EVERY, RATE, Tick, tick_time
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.embodiment.audio import AudioChange, AudioGain, AudioMove, AudioStart, AudioStop
from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.effects import (
    ActivateBlock,
    BindParameter,
    Dropped,
    EndUnit,
    InterruptBlock,
    Play,
    Request,
    SetParameter,
    Warn,
)
from reactive_realizer.engine.engine import Engine
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg
from reactive_realizer.planunit.parameter import Parameter, Range
from reactive_realizer.planunit.plan_unit import PlanUnit, SyncPoint, UnitState
from reactive_realizer.planunit.timing import Timing, timing_at
from reactive_realizer.reactive.cell import Source
from reactive_realizer.reactive.commit import Commit
from reactive_realizer.realizer.character import Character
from reactive_realizer.testing.lone_context import CHARACTER
from reactive_realizer.testing.pilot import block

BLOCK = BlockKey(CHARACTER, "b")
"""The block that all behaviors are said to be of."""

_MOST_ROUNDS = 100


def behavior_of(element: str) -> Behavior:
    """A behavior from its element, whose namespace is BML's unless it says another.

    Raises:
        ValueError: it cannot be read.
    """
    (parsed,) = parse(block(BLOCK.block, element), Limits())
    if parsed.block is None or parsed.problems:
        raise ValueError("; ".join(problem.fault.sentence for problem in parsed.problems))
    (behavior,) = parsed.block.behaviors
    return behavior


def prepared(engine: Engine, behavior: Behavior) -> object:
    """What the slow work for a behavior gives, None where there is none."""
    work = engine.prepare(behavior)
    return None if work is None else asyncio.run(_result(work))


def offsets_of(timing: Timing) -> tuple[float, ...]:
    """The time (s) of each point after the first, as wanted; what wants no time gets a second, as if from outside."""
    if timing.instant or timing.offsets[-1] > 0:
        return timing.offsets
    return tuple(rank / len(timing.phases) for rank in range(len(timing.points)))


class EngineStand:
    """Plans behaviors, moves their pegs, plays tick by tick, and does what the engine asks for.

    Whoever asks for a parameter gets one without bounds, of a behavior that goes on for ever.

    Attributes:
        engine: it.
        now: time of the last tick, s.
        told: each sync point as it was reached: unit, sync id, time of its peg, time of the tick.
        dropped: the units that left, and why.
        asked: requests, those for parameters left out.
        audio: what became audible, moved or fell silent.
        frames: as they were due.
        played: the last answer of the engine.
        written: commits that happened while the engine played.
    """

    def __init__(self, engine: Engine, context: EngineContext) -> None:
        self.engine = engine
        self.now = GlobalTime(-1.0)
        self.told: list[tuple[PlanUnit, str, GlobalTime, GlobalTime]] = []
        self.dropped: list[Dropped] = []
        self.asked: list[Request] = []
        self.audio: list[AudioChange] = []
        self.frames: list[Frame] = []
        self.played = Play()
        self.written: list[Commit] = []
        self._graph = context.graph
        self._character = Character(context.character, context.humanoid, (engine,))
        self._pegs: dict[PlanUnit, dict[str, AnticipatorPeg]] = {}
        self._parameter = Parameter(_forever(), Source(context.graph, "parameter", 0.0), Range(-inf, inf))
        self._number = -1
        self._playing = False
        context.graph.listen(self._note)

    # --- what the scheduler does

    def plan(self, behavior: Behavior) -> PlanUnit:
        """A unit for a behavior, not yet in the plan."""
        return self.engine.plan(BLOCK, behavior, prepared(self.engine, behavior))

    def enter(self, behavior: Behavior, start: float | None) -> PlanUnit:
        """A unit in the plan of the engine, its points on pegs as it would like them from a start (s) on."""
        unit = self.plan(behavior)
        self.place(unit, start)
        self.engine.add(unit)
        return unit

    def place(self, unit: PlanUnit, start: float | None) -> None:
        """Hang the points of a unit on pegs, as it would like them, and have its block started."""
        offsets = dict(zip(unit.timing.points, offsets_of(unit.timing), strict=True))
        times = {sync: None if start is None else GlobalTime(start + offset) for sync, offset in offsets.items()}
        pegs = {sync: AnticipatorPeg(self._graph, f"planned {sync}", time) for sync, time in times.items()}
        unit.points = [SyncPoint(sync, OffsetPeg(self._graph, sync, peg, 0.0)) for sync, peg in pegs.items()]
        unit.release()
        self._pegs[unit] = pegs

    def shift(self, unit: PlanUnit, by: float, *syncs: str) -> None:
        """Move some of its points, or all, by a distance (s)."""
        with self._graph.transaction("shift"):
            for sync, peg in self._pegs[unit].items():
                if peg.value is not None and (not syncs or sync in syncs):
                    peg.set(GlobalTime(peg.value + by))

    def interrupt(self, unit: PlanUnit) -> None:
        """Cut a unit now; what is due of it happens first."""
        if unit.state is UnitState.LURKING:
            unit.drop(self.now)
        elif unit.state is UnitState.IN_EXEC:
            unit.fire(self.now)
            if unit.live:
                unit.interrupt(self.now)
        self.engine.remove(unit)

    def remove(self, unit: PlanUnit) -> None:
        """Take a unit out of the plan without a word."""
        unit.drop(self.now)
        self.engine.remove(unit)

    # --- time

    def tick(self, after: int = 1, *, frames: bool = True) -> None:
        """Play one tick, so many numbers after the last one, round by round until nothing changes.

        Raises:
            AssertionError: it never comes to rest.
        """
        self._number += after
        number, last = self._number, self.now
        tick = Tick(number, last, frames and number // FRAME_EVERY > (number - after) // FRAME_EVERY)
        self.now = tick.time
        for _ in range(_MOST_ROUNDS):
            self.play(tick)
            if not self._answer(self.played):
                break
        else:
            raise AssertionError(f"{self.engine.name} asks for something in each of {_MOST_ROUNDS} rounds")
        if tick.frame:
            self._character.move(self.now, [self.played])
            self.frames.append(self._character.look([self.played]))

    def play(self, tick: Tick) -> None:
        """Have the engine play one round of a tick, and keep what it says."""
        self._playing = True
        self.played = self.engine.play(tick)
        self._playing = False
        self.told += [(each.unit, each.point.id, each.time, tick.time) for each in self.played.reached]
        self.dropped += self.played.dropped
        self.audio += self.played.audio
        self.asked += [each for each in self.played.requests if not isinstance(each, BindParameter | SetParameter)]

    def again(self) -> Play:
        """Have the last tick played once more."""
        self.play(Tick(self._number, tick_time(self._number - 1), frame=True))
        return self.played

    def advance(self, seconds: float, *, every: int = 1, frames: bool = True) -> None:
        """Play for so long, one tick of ``every``."""
        last = self._number + round(seconds * RATE)
        while self._number < last:
            self.tick(min(every, last - self._number), frames=frames)

    # --- what came out

    def points(self, unit: PlanUnit) -> list[tuple[str, GlobalTime]]:
        """The points of a unit as they were reached."""
        return [(sync, time) for who, sync, time, _ in self.told if who is unit]

    def planned(self, unit: PlanUnit) -> list[tuple[str, Time]]:
        """The points of a unit as they are planned."""
        return [(sync, peg.value) for sync, peg in self._pegs[unit].items()]

    def end(self, unit: PlanUnit) -> GlobalTime:
        """When the last point of a unit is planned.

        Raises:
            ValueError: that is unknown.
        """
        _, time = self.planned(unit)[-1]
        if time is None:
            raise ValueError(f"the end of {unit.behavior.id} is unknown")
        return time

    def sounding(self) -> set[str]:
        """The ids of the clips that can be heard, or will be."""
        ends: dict[str, float] = {}
        durations: dict[str, float] = {}
        for change in self.audio:
            match change:
                case AudioStart(clip=clip, start=start):
                    durations[clip.id] = clip.duration
                    ends[clip.id] = start + clip.duration
                case AudioMove(id=id_, start=start):
                    ends[id_] = start + durations[id_]
                case AudioStop(id=id_):
                    ends.pop(id_)
                case AudioGain():
                    pass
        return {id_ for id_, end in ends.items() if end > self.now}

    def _answer(self, play: Play) -> bool:
        """Do what is asked for; whether that is more than to give parameters their values."""
        for each in play.requests:
            match each:
                case BindParameter(unit=unit):
                    unit.bind(self._parameter)
                case SetParameter(parameter=parameter, value=value):
                    parameter.set(value)
                case EndUnit(unit=unit, time=time):
                    unit.interrupt(time)
                    self.engine.remove(unit)
                case ActivateBlock() | InterruptBlock() | Warn():
                    pass  # there are no blocks, and nobody to be warned
        for dropped in play.dropped:
            self.engine.remove(dropped.unit)
        asks = any(not isinstance(each, SetParameter | Warn) for each in play.requests)
        return bool(play.reached or play.dropped or asks)

    def _note(self, commit: Commit) -> None:
        if self._playing:
            self.written.append(commit)


def _forever() -> PlanUnit:
    behavior = Wait(id="target", namespace=BML, name="wait", location=Location(1, 1), order=0)
    return PlanUnit(BLOCK, behavior, timing_at({"start": 0.0, "end": inf}))


async def _result(work: Awaitable[object]) -> object:
    return await work
