"""A test harness for engines: one character, and calls like those of the scheduler and the realizer."""

import asyncio
from collections.abc import AsyncGenerator
from functools import cache
from math import inf
from pathlib import Path

from reactive_realizer.assembly.assets import Assets
from reactive_realizer.assembly.binding_files import binding_files
from reactive_realizer.assembly.human_file import CharacterSpec
from reactive_realizer.assembly.registry import load, names
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.clock.ticker import FRAME_EVERY, RATE, Tick, tick_time
from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.embodiment.audio import AudioChange, AudioGain, AudioMove, AudioStart, AudioStop
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.world import World
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.effects import (
    ActivateBlock,
    BindParameter,
    Dropped,
    EndUnit,
    FollowCell,
    InterruptBlock,
    MovePoints,
    Output,
    Play,
    ReportFall,
    Request,
    SetParameter,
    Warn,
)
from reactive_realizer.engine.engine import Engine, SlowWork
from reactive_realizer.engine.tts import TTSBinding
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg
from reactive_realizer.planunit.parameter import Parameter, Range
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.planunit.timing import Timing, timing_at
from reactive_realizer.reactive.graph import Commit
from reactive_realizer.realizer.character import Character
from reactive_realizer.testing.pilot import block

CHARACTER = "alice"
BLOCK = BlockKey(CHARACTER, "b")
"""The block of all behaviors under test."""

_MOST_ROUNDS = 100


def minimal_context(tts: TTSBinding | None = None, *assets: Path) -> EngineContext:
    """The context of an engine for one character, with a target ``viewer`` and, by default, the text voice.

    Args:
        tts: a voice that is already started.
        assets: folders searched before the package's own.
    """
    spec, found = CharacterSpec(), Assets(assets)
    humanoid = Humanoid(_avatar(found(spec.avatar)))
    world = World({"viewer": (0.0, 1.6, 2.5)})
    world.add_character(CHARACTER, humanoid.locate)
    trajectories = {name: load("trajectories", name) for name in names("trajectories")}
    voice, bindings = tts or TextVoice(), binding_files(spec.bindings, found(spec.avatar), found)
    return EngineContext(CHARACTER, humanoid, world, found, 0, voice, None, bindings, trajectories=trajectories)


def behavior_of(element: str) -> Behavior:
    """The behavior in an element, whose default namespace is BML 1.0.

    Raises:
        ValueError: the element cannot be read.
    """
    (parsed,) = parse(block(BLOCK.block, element), Limits())
    if parsed.block is None or parsed.problems:
        raise ValueError("; ".join(problem.fault.sentence for problem in parsed.problems))
    (behavior,) = parsed.block.behaviors
    return behavior


def prepared(engine: Engine, behavior: Behavior) -> object:
    """The result of the slow work for a behavior, None if there is none."""
    work = engine.prepare(behavior)
    return None if work is None else asyncio.run(_result(work))


def offsets_of(timing: Timing) -> tuple[float, ...]:
    """The preferred time of each point after the first, s; without a preference, one second for the whole."""
    if timing.instant or timing.offsets[-1] > 0:
        return timing.offsets
    return tuple(rank / len(timing.phases) for rank in range(len(timing.points)))


class EngineHarness:
    """Plans behaviors, moves their pegs, plays tick by tick, and carries out the requests of the engine.

    As in a realizer, the engine plays only if something is due, or after it called ``wake``.
    A request for a parameter always gets the same one, which is unbounded and belongs to a behavior without an end.

    Attributes:
        engine: the engine under test.
        now: time of the last tick, s.
        reached: each sync point that was reached: unit, sync id, time of its peg, time of the tick.
        dropped: the units that were dropped, with the reasons.
        requests: except those for parameters.
        audio: the changes of sounds.
        frames: one for each frame tick.
        play_result: the last result of `Engine.play`.
        output: the last result of `Engine.show`.
        plays: how often the engine was asked to play.
        commits: those made while the engine played.
    """

    def __init__(self, engine: Engine, context: EngineContext) -> None:
        self.engine = engine
        self.now = GlobalTime(-1.0)
        self.reached: list[tuple[PlanUnit, str, GlobalTime, GlobalTime]] = []
        self.dropped: list[Dropped] = []
        self.requests: list[Request] = []
        self.audio: list[AudioChange] = []
        self.frames: list[Frame] = []
        self.play_result = Play()
        self.output = Output()
        self.plays = 0
        self.commits: list[Commit] = []
        self._graph = context.graph
        self._time = context.time
        self._character = Character(context.character, context.humanoid, (engine,))
        self._pegs: dict[PlanUnit, dict[str, AnticipatorPeg]] = {}
        self._parameter = Parameter(context.graph, "parameter", 0.0, Range(-inf, inf))
        self._number = -1
        self._playing = False
        self._woken = False
        self._due: Time = None
        engine.listen(self._wake)
        context.graph.listen(self._note)

    # --- as the scheduler does

    def plan(self, behavior: Behavior) -> PlanUnit:
        """A unit for a behavior, not yet in the plan of the engine."""
        unit = self.engine.plan(BLOCK, behavior, prepared(self.engine, behavior))
        for _ in unit.finish_planning():
            pass
        return unit

    def schedule(self, behavior: Behavior, start: float | None) -> PlanUnit:
        """A unit in the plan of the engine, with its preferred timing from a start on, s; None if that is unknown."""
        unit = self.plan(behavior)
        self.place(unit, start)
        self.engine.add(unit)
        return unit

    def place(self, unit: PlanUnit, start: float | None) -> None:
        """Makes pegs for the points of a unit, with its preferred timing, and starts its block."""
        offsets = dict(zip(unit.timing.points, offsets_of(unit.timing), strict=True))
        times = {sync: None if start is None else GlobalTime(start + offset) for sync, offset in offsets.items()}
        pegs = {sync: AnticipatorPeg(self._graph, f"planned {sync}", time) for sync, time in times.items()}
        unit.points = [SyncPoint(sync, OffsetPeg(self._graph, sync, peg, 0.0)) for sync, peg in pegs.items()]
        unit.release()
        self._pegs[unit] = pegs

    def shift(self, unit: PlanUnit, by: float, *syncs: str) -> None:
        """Moves some points of a unit, by default all, by some seconds."""
        with self._graph.transaction("shift"):
            for sync, peg in self._pegs[unit].items():
                if peg.value is not None and (not syncs or sync in syncs):
                    peg.set(GlobalTime(peg.value + by))

    def interrupt(self, unit: PlanUnit) -> None:
        """Interrupts a unit now, after the points that are due."""
        if unit.state is UnitState.LURKING:
            unit.drop(self.now)
        elif unit.state is UnitState.IN_EXEC:
            unit.fire(unit.due_points(self.now), self.now)
            if unit.live:
                with self._graph.transaction("interrupt"):
                    unit.interrupt(self.now)
        self.engine.remove(unit)

    def remove(self, unit: PlanUnit) -> None:
        """Removes a unit from the plan of the engine."""
        unit.drop(self.now)
        self.engine.remove(unit)

    # --- time

    def tick(self, after: int = 1, *, frames: bool = True) -> None:
        """Plays one tick, round by round until nothing changes.

        Args:
            after: number of ticks since the last one; those between are skipped.
            frames: whether there is a frame if one is due.

        Raises:
            AssertionError: the engine never stops sending requests.
        """
        self._number += after
        number, last = self._number, self.now
        tick = Tick(number, last, frames and number // FRAME_EVERY > (number - after) // FRAME_EVERY)
        self.now = tick.time
        with self._graph.transaction("time"):
            self._time.set(tick.time)
        for _ in range(_MOST_ROUNDS):
            if self._plays_or_shows(tick):
                continue
            if tick.frame:
                self._character.move(self.now, [self.output])
                self.frames.append(self._character.look([self.output]))
            return
        raise AssertionError(f"{self.engine.name} sends requests in each of {_MOST_ROUNDS} rounds")

    def play(self, tick: Tick) -> None:
        """Plays one round of a tick, and records the result."""
        self._woken = False
        self.plays += 1
        self._playing = True
        self.play_result = self.engine.play(tick)
        self._playing = False
        self._record(self.play_result, tick)

    def show(self, tick: Tick) -> None:
        """Shows the frame of a tick, and records the result."""
        self._playing = True
        self.output = self.engine.show(tick)
        self._playing = False
        self._record(self.output.effects, tick)

    def _record(self, play: Play, tick: Tick) -> None:
        with self._graph.transaction("reached"):
            for each in play.reached:
                each.point.peg.pin(each.time)
        self.reached += [(each.unit, each.point.id, each.time, tick.time) for each in play.reached]
        self.dropped += play.dropped
        self.audio += play.audio
        self.requests += [
            each for each in play.requests if not isinstance(each, BindParameter | SetParameter | FollowCell)
        ]

    def repeat_tick(self) -> tuple[Play, Output]:
        """Plays and shows the last tick once more."""
        tick = Tick(self._number, tick_time(self._number - 1), frame=True)
        self.play(tick)
        self.show(tick)
        return self.play_result, self.output

    def advance(self, seconds: float, *, every: int = 1, frames: bool = True) -> None:
        """Plays for some seconds, one tick of ``every``."""
        last = self._number + round(seconds * RATE)
        while self._number < last:
            self.tick(min(every, last - self._number), frames=frames)

    # --- results

    def points(self, unit: PlanUnit) -> list[tuple[str, GlobalTime]]:
        """The points of a unit that were reached, with their times."""
        return [(sync, time) for each, sync, time, _ in self.reached if each is unit]

    def planned(self, unit: PlanUnit) -> list[tuple[str, Time]]:
        """The points of a unit, with the times of their pegs."""
        return [(sync, peg.value) for sync, peg in self._pegs[unit].items()]

    def end(self, unit: PlanUnit) -> GlobalTime:
        """The planned time of the last point of a unit.

        Raises:
            ValueError: the time is unknown.
        """
        _, time = self.planned(unit)[-1]
        if time is None:
            raise ValueError(f"the end of {unit.behavior.id} is unknown")
        return time

    def audible_clips(self) -> set[str]:
        """The ids of the clips that sound now or later."""
        ends: dict[str, float] = {}
        durations: dict[str, float] = {}
        for change in self.audio:
            match change:
                case AudioStart(clip=clip, start=start):
                    durations[clip.id] = clip.sound.duration
                    ends[clip.id] = inf if start is None else start + clip.sound.duration
                case AudioMove(id=id_, start=start):
                    ends[id_] = start + durations[id_]
                case AudioStop(id=id_):
                    ends.pop(id_)
                case AudioGain():
                    pass
        return {id_ for id_, end in ends.items() if end > self.now}

    def _plays_or_shows(self, tick: Tick) -> bool:
        """Plays a round if something is due; otherwise shows a frame, if one is due; whether anything changed."""
        if self._woken or is_due(self._due, tick.time):
            self.play(tick)
            self._due = self.engine.next_due
            if self._carry_out(self.play_result):
                return True
        if not tick.frame:
            return False
        self.show(tick)
        return self._carry_out(self.output.effects)

    def _wake(self) -> None:
        self._woken = True

    def _carry_out(self, play: Play) -> bool:
        """Carries out requests; returns whether the tick needs another round."""
        for request in play.requests:
            self._carry_out_one(request)
        for dropped in play.dropped:
            self.engine.remove(dropped.unit)
        requested = any(not isinstance(each, SetParameter | FollowCell | Warn | ReportFall) for each in play.requests)
        return bool(play.reached or play.dropped or requested)

    def _carry_out_one(self, request: Request) -> None:
        match request:
            case BindParameter(unit=unit):
                unit.bind(_forever(), self._parameter)
            case SetParameter(parameter=parameter, value=value):
                parameter.set(value)
            case FollowCell(parameter=parameter, cell=cell):
                parameter.follow(cell)
            case EndUnit(unit=unit, time=time):
                with self._graph.transaction("end"):
                    unit.interrupt(time)
                self.engine.remove(unit)
            case MovePoints(unit=unit, times=times):
                with self._graph.transaction("move"):
                    for sync, time in times.items():
                        self._pegs[unit][sync].set(time)
            case ActivateBlock() | InterruptBlock() | Warn() | ReportFall():
                pass  # there are no other blocks, and no client

    def _note(self, commit: Commit) -> None:
        if self._playing:
            self.commits.append(commit)


def _forever() -> PlanUnit:
    behavior = Wait(id="target", namespace=BML, name="wait", location=Location(1, 1), order=0)
    return PlanUnit(BLOCK, behavior, timing_at({"start": 0.0, "end": inf}))


async def _result(work: SlowWork) -> object:
    if isinstance(work, AsyncGenerator):
        return [part async for part in work][-1].result
    return await work


@cache
def _avatar(path: Path) -> Avatar:
    return Avatar.read(path)
