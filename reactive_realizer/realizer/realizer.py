"""The Realizer: inputs in, ticks through, feedback, frames and sounds out."""

import asyncio
import logging
from collections.abc import Callable, Mapping, Sequence
from contextlib import AsyncExitStack
from types import TracebackType
from typing import Self

from reactive_realizer.bml.document import parse
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.embodiment.audio import AudioChange
from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.embodiment.world import World
from reactive_realizer.engine.effects import Play
from reactive_realizer.engine.engine_task import EngineTask, play_all
from reactive_realizer.errors import RealizerError
from reactive_realizer.feedback.feedback_manager import FeedbackManager
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.reactive.commit import Commit
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.realizer.character import Character
from reactive_realizer.realizer.entered import Delivery, Entered
from reactive_realizer.realizer.inputs import BmlText, Event, Input, Prediction, TargetMoved
from reactive_realizer.realizer.verifier import Verifier
from reactive_realizer.realizer.workshop import TaskWorkshop
from reactive_realizer.scheduler.bml_scheduler import BMLScheduler
from reactive_realizer.scheduler.cast import Cast
from reactive_realizer.scheduler.constraint_watch import ConstraintWatch
from reactive_realizer.scheduler.reporter import Reporter
from reactive_realizer.scheduler.strategy import SchedulingStrategy

logger = logging.getLogger(__name__)

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
        self._inbox: list[tuple[GlobalTime, int, Input]] = []
        self._entered = 0
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
        self._verifier = Verifier(self.board, self.scheduler.blocks, self.feedback) if self._verify else None
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, failure: BaseException | None, trace: TracebackType | None
    ) -> None:
        # What went wrong outside is raised as it is: the group of engine tasks has no part in it.
        await self._stack.aclose()

    # --- the port

    def put(self, entry: Input, at: GlobalTime = GlobalTime(0.0)) -> None:  # noqa: B008 - a float
        """Have an input enter at the first tick at or after ``at``, after all that was put before."""
        self._entered += 1
        self._inbox.append((at, self._entered, entry))

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
        watched = Tick(tick.number, tick.previous, tick.frame and bool(self._frame_listeners))
        self._commits.clear()
        self._clamped = 0
        self._take_inputs(tick, self._workshop.ready() if work is None else tuple(work))
        plays = await self._play(watched)
        if watched.frame:
            self._publish_frames(tick.time, plays)
        self.scheduler.publish(tick.time)
        self._watch.check(self._commits, tick.time)
        if self._verifier is not None:
            self._verifier.check(self._commits, tick.time)
        self.feedback.flush(tick.time)

    def _take_inputs(self, tick: Tick, work: tuple[Delivery, ...]) -> None:
        due = [entry for at, _, entry in sorted(self._inbox, key=lambda e: e[:2]) if is_due(at, tick.time)]
        self._inbox = [waiting for waiting in self._inbox if not is_due(waiting[0], tick.time)]
        for listener in self._entry_listeners:
            listener(Entered(tick.number, tuple(due), work))
        with self.board.graph.transaction("inputs"):
            for anticipator in self.anticipators.values():
                self._try(anticipator.id, anticipator.advance, tick.time)
            for entry in due:
                self._try(entry, self._apply, entry, tick.time)
        self._clamp(tick)
        self._workshop.deliver(work, tick.time)
        for entry in due:
            if isinstance(entry, BmlText):
                self._read(entry, tick.time)

    def _try(self, what: object, act: Callable[..., None], *arguments: object) -> None:
        """Whoever brings an input may check it first; one that cannot be is left out, and all else goes on."""
        try:
            act(*arguments)
        except RealizerError as problem:
            logger.warning("%s is left out: %s", what, problem)
        except Exception:
            logger.exception("%s is left out", what)

    def _apply(self, entry: Input, now: GlobalTime) -> None:
        match entry:
            case Prediction(anticipator, sync, time):
                self._anticipator(anticipator).check_prediction()
                self._anticipator(anticipator).predict(sync, time, now)
            case Event(anticipator):
                _tell(self._anticipator(anticipator), entry, now)
            case TargetMoved(target, position):
                self.world.move(target, position)
            case BmlText():
                pass

    def _anticipator(self, name: str) -> Anticipator:
        if name not in self.anticipators:
            self.anticipators[name] = Anticipator(name, self.board)
        return self.anticipators[name]

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


def _tell(anticipator: Anticipator, event: Event, now: GlobalTime) -> None:
    if event.text is None:
        anticipator.check(event.name, event.value)
        anticipator.event(event.name, event.value, now)
    else:
        anticipator.check_heard(event.name)
        anticipator.hear(event.name, event.text, now)
