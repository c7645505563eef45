"""The realizer: takes inputs, plays ticks, and gives feedback, frames and sounds."""

import asyncio
import logging
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import AsyncExitStack
from dataclasses import replace
from types import MappingProxyType, TracebackType
from typing import Self

from reactive_realizer.bml.block import Parsed
from reactive_realizer.bml.dialects import ONLY_BML, Dialects
from reactive_realizer.bml.names import EVENTS
from reactive_realizer.bml.speech import streams_of
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange, AudioHeard, StreamedAudio
from reactive_realizer.embodiment.world import World
from reactive_realizer.engine.engine_task import EngineTasks
from reactive_realizer.engine.guarded_engine import GuardedEngine
from reactive_realizer.engine.speech_streams import SpeechStreams
from reactive_realizer.errors import RealizerError, TargetFault, WarningType
from reactive_realizer.feedback.feedback_manager import FeedbackManager
from reactive_realizer.feedback.messages import WarningFeedback
from reactive_realizer.limits import Limits
from reactive_realizer.liveliness.accompanist import Accompanist
from reactive_realizer.liveliness.autonomous_behaviors import AutonomousBehavior, AutonomousBehaviors
from reactive_realizer.liveliness.fillers import NO_FILLERS, Fillers
from reactive_realizer.liveliness.floor_holder import FloorHolder
from reactive_realizer.liveliness.listeners import Listeners
from reactive_realizer.liveliness.word_classes import NO_CLASSES, WordClasses
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext
from reactive_realizer.pegboard.peg_key import ANTICIPATORS
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.predicted_points import PredictedPoints
from reactive_realizer.reactive.cell import Source
from reactive_realizer.realizer.anticipator_streams import AnticipatorFailed, AnticipatorStreams
from reactive_realizer.realizer.background_tasks import BackgroundTasks
from reactive_realizer.realizer.character import Character
from reactive_realizer.realizer.document_checker import DocumentChecker
from reactive_realizer.realizer.emitted_events import EmittedEvents
from reactive_realizer.realizer.frame_maker import FrameMaker, FramesListener
from reactive_realizer.realizer.inbox import Inbox
from reactive_realizer.realizer.inputs import BmlText, Forecast, Input, Push, StreamFailure, TickInputs
from reactive_realizer.realizer.rounds import Rounds
from reactive_realizer.realizer.verifier import Verifier
from reactive_realizer.scheduler.admission import Admission, UnknownCharacter
from reactive_realizer.scheduler.bml_scheduler import BMLScheduler
from reactive_realizer.scheduler.engine_routing import EngineRouting
from reactive_realizer.scheduler.strategy import SchedulingStrategy

logger = logging.getLogger(__name__)

AudioListener = Callable[[AudioChange], None]
EntryListener = Callable[[TickInputs], None]


class UnknownJoint(TargetFault):
    """No joint of a character has the name."""

    code = "unknown-joint"
    template = "{character} has no joint '{joint}'; available: {known}"
    unknown = "joint"
    character: str
    joint: str
    known: tuple[str, ...]


class Realizer:
    """Plays the behavior of all characters; used as an async context manager.

    The owner of the clock calls `step` for every tick. Inputs are given to `put` at any time, and enter at the first
    tick at or after their time.

    Args:
        time: the cell of the present tick's time, in the graph of the pegs; parameters of engines depend on it.
        speech_streams: the sound of speeches that clients send.
        word_classes: the words with which speakers move.
        fillers: what they say to hold the floor.
        autonomous: the behaviors that they do by themselves, by character and name.
        dialects: in which documents may be.

    Attributes:
        feedback: of all blocks, for its listeners.
        board: the pegs of all characters.
        world: the targets of gaze and pointing.
        scheduler: of the blocks.
        characters: by id; the first gets the blocks that name none.
    """

    def __init__(
        self,
        characters: Sequence[Character],
        world: World,
        anticipators: Callable[[Callable[[str], AnticipatorContext]], Iterable[Anticipator]],
        strategy: SchedulingStrategy,
        limits: Limits,
        time: Source[GlobalTime],
        *,
        speech_streams: SpeechStreams | None = None,
        word_classes: WordClasses = NO_CLASSES,
        fillers: Fillers = NO_FILLERS,
        autonomous: Mapping[str, Mapping[str, AutonomousBehavior]] = MappingProxyType({}),
        dialects: Dialects = ONLY_BML,
        verify: bool = False,
    ) -> None:
        self.limits = limits
        self.dialects = dialects
        self._documents = 0
        self.characters = {character.id: character for character in characters}
        self.world = world
        self.feedback = FeedbackManager()
        self.board = PegBoard(time.graph)
        self._streams = AnticipatorStreams(self.board, PredictedPoints(self.board, limits.predicted_points))
        for anticipator in anticipators(self._streams.context):
            self._streams.add(anticipator)
        self._streams.add(EmittedEvents(self._streams.context(EVENTS), limits))
        self.time = GlobalTime(0.0)
        self._time = time
        self._strategy = strategy
        self._speech_streams = speech_streams or SpeechStreams(limits)
        self._word_classes = word_classes
        self._fillers = fillers
        self._autonomous_behaviors = autonomous
        self._verify = verify
        self._engines = {each.id: tuple(map(GuardedEngine, each.engines)) for each in characters}
        self._routing = EngineRouting(self._engines)
        self._leading = EngineTasks(engine for engine in self._routing.engines if engine.leads)
        self._following = EngineTasks(engine for engine in self._routing.engines if not engine.leads)
        self._inbox = Inbox(self.board, self._streams, world, limits)
        self._frames = FrameMaker(characters, self._engines, self._following)
        self._audio_listeners: list[AudioListener] = []
        self._entry_listeners: list[EntryListener] = []
        self._stack = AsyncExitStack()

    @property
    def anticipators(self) -> Mapping[str, Anticipator]:
        """The anticipators of the scene, and those that clients have predicted, by id."""
        return self.board.anticipators

    # --- life

    async def __aenter__(self) -> Self:
        group = await self._stack.enter_async_context(asyncio.TaskGroup())
        tasks = (*self._leading.tasks, *self._following.tasks)
        running = [group.create_task(task.run(), name=task.engine.name) for task in tasks]
        self._stack.callback(lambda: [task.cancel() for task in running])
        self._stack.callback(self._streams.close)
        self._streams.open(group)
        self._background = BackgroundTasks(group, self._speech_streams)
        self._stack.callback(self._background.close)
        self.scheduler = BMLScheduler(
            self.board, self._routing, self.feedback, self._background, self._strategy, self.limits
        )
        self._rounds = Rounds(
            self.board, self._time, self.scheduler, self._leading, self._following, self._publish_audio
        )
        figures = {each.id: each.humanoid for each in self.characters.values()}
        listeners = Listeners(self.scheduler, figures, self.world)
        Accompanist(self.scheduler, listeners, self.limits, self._word_classes)
        voices = {each.id: each.voice for each in self.characters.values()}
        self._floor = FloorHolder(self.scheduler, listeners, self.limits, self._fillers, voices)
        self._autonomous = AutonomousBehaviors(self.scheduler, self.limits, self._autonomous_behaviors)
        self._verifier = Verifier(self.scheduler, self.feedback) if self._verify else None
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, failure: BaseException | None, trace: TracebackType | None
    ) -> None:
        # Raise an error of the caller as it is, not in the exception group of the engine tasks.
        await self._stack.aclose()

    # --- the port

    def numbered(self, document: BmlText) -> BmlText:
        """A document with the next number, unless it has one."""
        if document.number:
            return document
        self._documents += 1
        return replace(document, number=self._documents)

    def read(self, document: BmlText) -> BmlText:
        """A document with its blocks and procedures, in whatever dialect it is."""
        document = self.numbered(document)
        parsed = self.dialects.read(document.text, self.limits, document.name, document.media_type)
        return replace(document, parsed=parsed)

    def put(self, entry: Input, at: GlobalTime = GlobalTime(0.0)) -> None:  # noqa: B008 - a float
        """Add an input, which enters at the first tick at or after ``at``, after all earlier inputs."""
        self._inbox.put(entry, at)

    def check_prediction(self, anticipator: str, sync: str) -> None:
        """Check whether a prediction of a point can enter after all earlier inputs.

        Raises:
            RealizerError: "predicts-itself" or "too-many-names".
        """
        self._inbox.check_prediction(anticipator, sync, self.time)

    def check_heard(self, heard: AudioHeard) -> bool:
        """Whether a report of what is heard is about a sound that plays now.

        Raises:
            RealizerError: "outside-sound" or "far-off".
        """
        return self.scheduler.check_heard(heard)

    def check_streamed(self, audio: StreamedAudio) -> None:
        """Check whether sound of a speech can be taken after all earlier inputs.

        Raises:
            RealizerError: it cannot; "stream-over" if its stream or its speech has ended.
        """
        waiting = (parsed.block for parsed, _ in self._waiting if parsed.block is not None)
        self._speech_streams.check(audio, {each.name for block in waiting for each in streams_of(block.behaviors)})

    @property
    def streams(self) -> Collection[str]:
        """The names of the streams of speech that take sound."""
        return self._speech_streams.names

    def check_push(self, push: Push) -> None:
        """Check whether there is such a character with such a joint.

        Raises:
            RealizerError: "unknown-character" or "unknown-joint".
        """
        character = self.characters.get(push.character)
        if character is None:
            raise RealizerError(UnknownCharacter(character=push.character, known=tuple(self.characters)))
        joints = character.humanoid.avatar.skeleton.joints
        if push.joint not in joints:
            raise RealizerError(UnknownJoint(character=push.character, joint=push.joint, known=joints))

    def admission(self) -> Admission:
        """Checks for blocks and procedures that would enter after all earlier inputs."""
        admission = self.scheduler.admission()
        for parsed, client in self._waiting:
            admission.refusal(parsed, client)
        return admission

    def checker(self) -> DocumentChecker:
        """Finds the mistakes in a document that would enter after all earlier inputs."""
        blocks = self.scheduler.blocks
        waiting = (parsed.block for parsed, _ in self._waiting if parsed.block is not None)
        alive = (*(block.description for block in blocks.alive), *waiting)
        return DocumentChecker(
            self._routing,
            self.board,
            alive,
            blocks.has_ended,
        )

    @property
    def _waiting(self) -> Iterator[tuple[Parsed, str]]:
        """The blocks and procedures that have arrived and have not entered yet, as far as parsed, and their clients."""
        yield from ((entry.parsed, entry.lane.client) for entry in self.scheduler.entering)
        for document in (each for each in self._inbox.waiting if isinstance(each, BmlText)):
            yield from ((parsed, document.client) for parsed in document.parsed or ())

    def watch(self, listener: FramesListener) -> Callable[[], None]:
        """Call a listener with the frames of each tick, by the ids of all characters in their order.

        The returned function ends that. Without listeners, frames are composed only while an engine needs them.
        """
        return self._frames.watch(listener)

    def hear(self, listener: AudioListener) -> None:
        """Call a listener with the changes of audio."""
        self._audio_listeners.append(listener)

    def record(self, listener: EntryListener, forecasts: Callable[[Forecast], None] = lambda _: None) -> None:
        """Call a listener with the inputs of each tick, and another with each forecast, before they have any effect."""
        self._entry_listeners.append(listener)
        self._streams.listen(forecasts)

    @property
    def busy(self) -> bool:
        """Whether inputs or results of slow work are outstanding."""
        return bool(self._inbox) or self._background.busy or bool(self.scheduler.entering)

    @property
    def expectant(self) -> bool:
        """Whether an anticipator may predict something without further input."""
        return self._streams.expectant

    async def settle(self) -> None:
        """Wait for the slow work that has been requested."""
        await self._background.settle()

    # --- a tick

    async def step(self, tick: Tick, recorded: TickInputs | None = None) -> None:
        """Play one tick in phases (docs/semantics.md, a tick).

        Args:
            tick: later than all earlier ones.
            recorded: what is to enter, in a replay; None for the inputs that are due, the results of slow work that are
                ready, and what the streams of anticipators predict.
        """
        self.time = tick.time
        self.board.begin(tick)
        entered = await self._enter(tick) if recorded is None else recorded
        for listener in self._entry_listeners:
            listener(entered)
        entered = self._read(entered)
        if recorded is not None:
            self._streams.replay(recorded.forecasts)
        self._apply(entered, tick.time)
        await self._rounds.catch_up(tick, self._check)
        watched = Tick.on_time(tick.number, tick.frame and (entered.watched or self._frames.needed))
        self.board.begin(watched)
        self._take_blocks(entered, tick.time)
        shown = await self._rounds.play(watched)
        if watched.frame:
            await self._frames.publish(tick.time, shown)
        self.scheduler.publish(tick.time)
        self._check(tick.time)
        self.feedback.flush(tick.time)

    async def _enter(self, tick: Tick) -> TickInputs:
        inputs, work = self._inbox.take(tick.time), self._background.ready()
        predicted = await self._streams.run(self._inbox.deliver(inputs, tick.time), tick.time)
        return TickInputs(tick.number, inputs, work, predicted, watched=self._frames.watched)

    def _apply(self, entered: TickInputs, now: GlobalTime) -> None:
        """Move targets, write predictions, have speech follow what is heard, take sound, and push characters."""
        with self.board.graph.transaction("inputs"):
            self._inbox.apply(entered.inputs)
            self._streams.apply(entered.predicted, now)
        for entry in entered.inputs:
            if isinstance(entry, AudioHeard):
                self.scheduler.follow_heard(entry)
            if isinstance(entry, Push):
                self._push(entry)
            if isinstance(entry, StreamedAudio):
                self._speech_streams.take(entry)
            if isinstance(entry, BmlText):
                self._open_streams(entry)
        self._speech_streams.advance(now)
        for each in entered.predicted:
            if isinstance(each, StreamFailure):
                fault = AnticipatorFailed(anticipator=each.anticipator, reason=each.reason)
                id_ = f"{ANTICIPATORS}:{each.anticipator}"
                self.feedback.add(WarningFeedback(None, id_, WarningType.EXECUTION_FAILURE, str(fault)))

    def _read(self, entered: TickInputs) -> TickInputs:
        """The inputs of a tick with their documents parsed."""
        if not any(isinstance(each, BmlText) for each in entered.inputs):
            return entered
        inputs = (
            self.read(each) if isinstance(each, BmlText) and each.parsed is None else each for each in entered.inputs
        )
        return replace(entered, inputs=tuple(inputs))

    def _open_streams(self, document: BmlText) -> None:
        """Open the streams of a document, because its sender may send their sound right after it."""
        for parsed in document.parsed or ():
            for stream in streams_of(parsed.block.behaviors if parsed.block is not None else ()):
                self._speech_streams.open(stream)

    def _push(self, push: Push) -> None:
        try:
            self.check_push(push)
        except RealizerError as problem:
            logger.warning("%s is skipped: %s", push, problem)
            return
        force = self.characters[push.character].humanoid.to_own_axes(push.force)
        for engine in self._engines[push.character]:
            engine.push(push.joint, force, push.duration)

    def _take_blocks(self, entered: TickInputs, now: GlobalTime) -> None:
        """Deliver the results of slow work, then have new blocks enter."""
        self.scheduler.begin_planning()
        self._background.deliver(entered.work, now)
        self._floor.advance(now)
        self._autonomous.advance(now)
        for entry in entered.inputs:
            if isinstance(entry, BmlText):
                self.scheduler.take(entry.parsed or (), entry.client)

    def _check(self, now: GlobalTime) -> None:
        """Report the constraints that have been broken since the last call."""
        if self._verifier is not None:
            self._verifier.check(now)
        self.scheduler.check(now)

    def _publish_audio(self, change: AudioChange) -> None:
        for listener in self._audio_listeners:
            listener(change)
