"""The Realizer: inputs in, ticks through, feedback, frames and sounds out."""

import asyncio
from collections.abc import Callable, Mapping, Sequence
from contextlib import AsyncExitStack
from types import TracebackType
from typing import Self

from reactive_realizer.bml.document import parse
from reactive_realizer.clock.ticker import Tick, tick_time
from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.embodiment.audio import AudioChange
from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.embodiment.world import World
from reactive_realizer.engine.effects import Play
from reactive_realizer.engine.engine_task import EngineTask, play_all
from reactive_realizer.feedback.feedback_manager import FeedbackManager
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.reactive.commit import Commit
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.realizer.character import Character
from reactive_realizer.realizer.entered import Delivery, Entered
from reactive_realizer.realizer.inbox import Inbox
from reactive_realizer.realizer.inputs import BmlText, Input
from reactive_realizer.realizer.verifier import Verifier
from reactive_realizer.realizer.workshop import TaskWorkshop
from reactive_realizer.scheduler.bml_scheduler import BMLScheduler
from reactive_realizer.scheduler.cast import Cast
from reactive_realizer.scheduler.constraint_watch import ConstraintWatch
from reactive_realizer.scheduler.reporter import Reporter
from reactive_realizer.scheduler.strategy import SchedulingStrategy

_MOST_ROUNDS = 100

FrameListener = Callable[[Character, Frame], None]
AudioListener = Callable[[AudioChange], None]
EntryListener = Callable[[Entered], None]


class Realizer:
    """One board, one ticker and one task an engine for all characters; used as an async context manager.

    Whoever owns the clock calls `step` for every tick; whoever has something to say calls `put` at any time, and it
    enters at the first tick at or after its time.

    Attributes:
        feedback: tells everybody who listens.
        board: all points in time.
        world: what can be looked at.
        scheduler: the blocks.
        characters: by id, the first takes what names none.
        anticipators: by id.
    """

    def __init__(
        self,
        characters: Sequence[Character],
        world: World,
        anticipators: Callable[[PegBoard], Mapping[str, Anticipator]],
        strategy: SchedulingStrategy,
        limits: Limits,
        *,
        verify: bool = False,
    ) -> None:
        self.limits = limits
        self.characters = {character.id: character for character in characters}
        self.world = world
        self.feedback = FeedbackManager()
        self.board = PegBoard(Graph())
        self.anticipators = dict(anticipators(self.board))
        self.time = GlobalTime(0.0)
        self._strategy = strategy
        self._verify = verify
        self._cast = Cast({character.id: character.engines for character in characters})
        self._leading = [EngineTask(engine) for engine in self._cast.engines if engine.leads]
        self._following = [EngineTask(engine) for engine in self._cast.engines if not engine.leads]
        self._inbox = Inbox(self.board, self.anticipators, world)
        self._commits: list[Commit] = []
        self._clamped = 0
        self._frame_listeners: list[FrameListener] = []
        self._audio_listeners: list[AudioListener] = []
        self._entry_listeners: list[EntryListener] = []
        self._stack = AsyncExitStack()
        self.board.graph.listen(self._commits.append)

    # --- life

    async def __aenter__(self) -> Self:
        group = await self._stack.enter_async_context(asyncio.TaskGroup())
        running = [group.create_task(task.run(), name=task.engine.name) for task in (*self._leading, *self._following)]
        self._stack.callback(lambda: [task.cancel() for task in running])
        self._workshop = TaskWorkshop(group)
        self._stack.callback(self._workshop.close)
        self.scheduler = BMLScheduler(
            self.board, self._cast, self.feedback, self._workshop, self._strategy, self.limits
        )
        self._watch = ConstraintWatch(self.board, self.scheduler.blocks, Reporter(self.feedback, self.scheduler.blocks))
        self.scheduler.listen(self._watch.note_end)
        self._verifier = Verifier(self.board, self.scheduler, self.feedback) if self._verify else None
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, failure: BaseException | None, trace: TracebackType | None
    ) -> None:
        # What went wrong outside is raised as it is: the group of engine tasks has no part in it.
        await self._stack.aclose()

    # --- the port

    def put(self, entry: Input, at: GlobalTime = GlobalTime(0.0)) -> None:  # noqa: B008 - a float
        """Have an input enter at the first tick at or after ``at``, after all that was put before."""
        self._inbox.put(entry, at)

    def watch(self, listener: FrameListener) -> Callable[[], None]:
        """Get the frames of all characters; the returned call ends that. Nothing is composed where nobody looks."""
        self._frame_listeners.append(listener)
        return lambda: self._frame_listeners.remove(listener)

    def hear(self, listener: AudioListener) -> None:
        """Get what becomes audible."""
        self._audio_listeners.append(listener)

    def record(self, listener: EntryListener) -> None:
        """Get what enters, tick by tick, before anything comes of it."""
        self._entry_listeners.append(listener)

    @property
    def busy(self) -> bool:
        """Whether something is still to enter."""
        return bool(self._inbox) or self._workshop.busy

    async def settle(self) -> None:
        """Wait for slow work requested until now."""
        await self._workshop.settle()

    # --- a tick

    async def step(self, tick: Tick, work: Sequence[Delivery] | None = None) -> None:
        """One tick, phase by phase (semantics: a tick, in phases).

        Args:
            tick: after all that were before.
            work: what is handed over of the slow work; None: whatever is there.
        """
        self.time = self.board.time = tick.time
        entered = self._enter(tick, self._workshop.ready() if work is None else tuple(work))
        self._inbox.apply(entered.inputs, tick.time)
        self._clamp(tick)
        await self._catch_up(tick)
        self._take_blocks(entered, tick.time)
        watched = Tick.on_time(tick.number, tick.frame and bool(self._frame_listeners))
        plays = await self._play(watched)
        if watched.frame:
            self._publish_frames(tick.time, plays)
        self.scheduler.publish(tick.time)
        self._check(tick.time)
        self.feedback.flush(tick.time)

    def _enter(self, tick: Tick, work: tuple[Delivery, ...]) -> Entered:
        entered = Entered(tick.number, self._inbox.take(tick.time), work)
        for listener in self._entry_listeners:
            listener(entered)
        return entered

    async def _catch_up(self, tick: Tick) -> None:
        """What was due at ticks that were left out happens in its order, as it would have; nothing of it is seen."""
        due = self.scheduler.next_due(tick.previous) if tick.left_out else None
        for number in tick.left_out:
            if is_due(due, tick_time(number)):
                missed = Tick.on_time(number)
                self.board.time = missed.time
                await self._play(missed)
                self._check(missed.time)
                due = self.scheduler.next_due(missed.time)
        self.board.time = tick.time

    def _take_blocks(self, entered: Entered, now: GlobalTime) -> None:
        """What was prepared, then what is new."""
        self._workshop.deliver(entered.work, now)
        for entry in entered.inputs:
            if isinstance(entry, BmlText):
                self._read(entry, now)

    def _read(self, entry: BmlText, now: GlobalTime) -> None:
        for parsed in parse(entry.text, self.limits) if entry.parsed is None else entry.parsed:
            self.scheduler.accept(parsed, now)

    async def _play(self, tick: Tick) -> list[Play]:
        """Rounds of the tick until nothing changes; what the last one shows is what is seen."""
        plays: list[Play] = []
        played: set[EngineTask] = set()
        for _ in range(_MOST_ROUNDS):
            self.scheduler.advance(tick.time)
            self._clamp(tick)
            leading = [task for task in self._leading if self._cast.awake(task.engine)]
            if self.scheduler.apply(await play_all(leading, tick), tick.time):
                continue
            plays = await play_all(self._following if tick.frame else self._awake(played, tick.time), tick)
            changed = self.scheduler.apply(plays, tick.time)
            for play in plays:
                self._publish_audio(play)
            if not changed and not self.scheduler.advance(tick.time):
                return plays
        self.scheduler.fail_restless(_MOST_ROUNDS, tick.time)
        return plays

    def _awake(self, played: set[EngineTask], now: GlobalTime) -> list[EngineTask]:
        """The followers that have something to play: of many characters most rest, and to wake one has its price.

        Args:
            played: those that have played in this tick; they are from now on.
            now: the time of the tick.
        """
        cast = self._cast
        awake = [t for t in self._following if (cast.called(t.engine, now) if t in played else cast.awake(t.engine))]
        played.update(awake)
        return awake

    def _clamp(self, tick: Tick) -> None:
        """Nothing that changed since the last call has moved points into the past."""
        commits = self._commits[self._clamped :]
        self.scheduler.clamp(tick.previous, tick.time, commits)
        self._clamped = len(self._commits)

    def _check(self, now: GlobalTime) -> None:
        """Say what the commits since the last call have broken."""
        if self._verifier is not None:
            self._verifier.check(self._commits, now)
        self._watch.check(self._commits, now)
        self._commits.clear()
        self._clamped = 0

    def _publish_audio(self, play: Play) -> None:
        for change in play.audio:
            for listener in self._audio_listeners:
                listener(change)

    def _publish_frames(self, time: GlobalTime, plays: Sequence[Play]) -> None:
        by_engine = dict(zip((task.engine for task in self._following), plays, strict=True))
        shown = [
            (character, [by_engine[engine] for engine in character.engines if engine in by_engine])
            for character in self.characters.values()
        ]
        for character, its in shown:
            character.move(time, its)
        # Who looks at another one, or at his own hand, sees where that is in this frame.
        for character, its in shown:
            frame = character.look(its)
            for listener in tuple(self._frame_listeners):
                listener(character, frame)
