"""Requests of clients, checked and passed on as inputs of the realizer; and the demo."""

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from itertools import islice
from typing import Any, NamedTuple, TypeVar
from xml.sax.saxutils import quoteattr

from reactive_realizer.bml.block import Problem
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML
from reactive_realizer.bml.speech import Speech
from reactive_realizer.bml.value_faults import AbsurdTime
from reactive_realizer.clock.ticker import tick_time
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioHeard
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.feedback.feedback_manager import Report
from reactive_realizer.feedback.messages import BlockProgress
from reactive_realizer.limits import Limits
from reactive_realizer.realizer.document_checker import DocumentChecker
from reactive_realizer.realizer.inbox import TooManyNames
from reactive_realizer.realizer.inputs import BmlText, Event, Prediction, Push
from reactive_realizer.server.faults import GoingAway, NoDemo, NotMovable, UnknownAnticipator, WrongMediaType
from reactive_realizer.server.heard_reports import HeardReports
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.protocol import Message, Received, moved_of, push_of, read, streamed_of
from reactive_realizer.server.stream_senders import StreamSenders
from reactive_realizer.server.turns import Turns

T = TypeVar("T")

_LEAD_IN = 150
"""Ticks until the performance begins: by then, a page that has just opened shows its avatars."""

_METRONOME = "metronome"
"""The anticipator that the performance uses; it is restarted with it, and when the figure begins to speak."""


class Demo:
    """Plays the performance of a scene, if it has one.

    Args:
        live: the scene.
        stop: ends all blocks.
    """

    def __init__(self, live: LiveScene, stop: Callable[[], object]) -> None:
        self._live = live
        self._stop = stop
        self._seen = False
        self._stop_listening: Callable[[], None] = lambda: None

    def page_opened(self) -> None:
        """Starts the performance when the first page opens."""
        if not self._seen and self._live.performance is not None:
            self.perform()
        self._seen = True

    def perform(self) -> None:
        """Plays the performance from its beginning; it replaces everything that plays.

        Raises:
            RealizerError: "no-demo".
        """
        if self._live.performance is None:
            raise RealizerError(NoDemo())
        self._stop()
        # Some ticks after the stop, the ids of the performance are free again.
        begin = tick_time(self._live.tick + _LEAD_IN)
        self._stop_listening()
        if _METRONOME in self._live.realizer.anticipators:
            self._live.realizer.put(Event(_METRONOME, "start"), begin)  # so that no beat of the performance has passed
            follow = partial(self._follow, _first_spoken(self._live.performance, self._live.limits), begin)
            self._stop_listening = self._live.realizer.feedback.listen(follow)
        self._live.realizer.put(BmlText(self._live.performance), begin)

    def _follow(self, block: str, begin: GlobalTime, report: Report) -> None:
        """Restart the metronome with a block, because the time that a voice takes to begin depends on the machine."""
        message = report.message
        started = isinstance(message, BlockProgress) and (message.block, message.sync) == (block, "start")
        if started and report.time >= begin:  # not one of a performance before
            self._live.realizer.put(Event(_METRONOME, "start"))
            self._stop_listening()


def _first_spoken(performance: str, limits: Limits) -> str:
    """Id of the first block of a performance with a speech, or else of the first one."""
    blocks = [parsed.block for parsed in parse(performance, limits) if parsed.block is not None]
    spoken = [block for block in blocks if any(isinstance(each, Speech) for each in block.behaviors)]
    return (spoken or blocks)[0].id


_SMALL = 2000
"""Size below which a text is read at once: starting a thread takes longer. Larger ones can take many ticks."""

_THREADS = 2
"""Threads that read texts. They are not those of other work, which would wait for clients that send much."""


_AT_ONCE = 20
"""Blocks of a document that are judged or checked in one turn."""


class Answer(NamedTuple):
    """The answer to a document.

    Attributes:
        blocks: ids of the blocks that have entered.
        warnings: what is known of it to be wrong, in document order.
    """

    blocks: list[str]
    warnings: list[Problem]


class BlocksRefused(RealizerError):
    """Some blocks of a document were refused; the fault is that of the first.

    Attributes:
        answer: about the other blocks, which have entered, and with the warnings of all.
    """

    def __init__(self, first: Fault, answer: Answer) -> None:
        super().__init__(first)
        self.answer = answer


class _Judged(NamedTuple):
    """A document, the ids of its acceptable blocks, and for each of its parts why it is refused, or None."""

    document: BmlText
    blocks: list[str]
    refusals: list[Fault | None]

    @property
    def first_refusal(self) -> Fault | None:
        return next(filter(None, self.refusals), None)


class Intake:
    """Checks requests of clients and passes them to the realizer; refuses what can be refused at once.

    Attributes:
        demo: the performance of the scene.
        turns: in which messages and documents are read and checked.
        closed: whether new documents are refused, because the server is about to shut down.
    """

    def __init__(self, live: LiveScene) -> None:
        self._live = live
        self._realizer = live.realizer
        self._stops = 0
        self.closed = False
        self.turns = Turns()
        self._judging = asyncio.Lock()
        self._threads = ThreadPoolExecutor(_THREADS, "reading")
        self._heard = HeardReports(live)
        self._senders = StreamSenders(live.realizer)
        self.demo = Demo(live, self.stop)

    async def read(self, text: str | bytes, kind: str | None = None) -> Received:
        """Reads a message, which is of a kind if it does not contain its type."""
        most = self._live.limits.message_values
        return await self._apart(len(text), lambda aside: read(text, most, kind, aside=aside))

    async def _apart(self, size: int, work: Callable[[bool], T]) -> T:
        """The result of reading a text: in a turn or, if it is long, aside, in a thread; ``work(aside)`` does so."""
        if size < _SMALL:
            async with self.turns:
                return work(False)
        return await asyncio.get_running_loop().run_in_executor(self._threads, work, True)

    async def document(self, text: str | bytes, client: str = "", media_type: str = "") -> Answer:
        """Accepts a client's document if every block can be accepted.

        Args:
            text: the document.
            client: its sender.
            media_type: of the document.

        Raises:
            BlocksRefused: with the fault of the first block that cannot be accepted; none has entered.
        """
        judged, checker = await self._admitted(text, client, media_type, whole=True)
        warnings = await self._warnings(judged, checker)
        if judged.first_refusal is not None:
            raise BlocksRefused(judged.first_refusal, Answer([], warnings))
        return Answer(judged.blocks, warnings)

    async def blocks(self, text: str, client: str = "", media_type: str = "") -> Answer:
        """Accepts those blocks of a client's document that can be accepted; feedback reports each of the others.

        Args:
            text: the document.
            client: its sender.
            media_type: of the document; empty if it is not known.

        Raises:
            BlocksRefused: with the fault of the first of the others.
        """
        judged, checker = await self._admitted(text, client, media_type, whole=False)
        answer = Answer(judged.blocks, await self._warnings(judged, checker))
        if judged.first_refusal is not None:
            raise BlocksRefused(judged.first_refusal, answer)
        return answer

    def predict(self, message: Message) -> GlobalTime | None:
        """Accepts a prediction, and returns its time.

        Raises:
            RealizerError: the time is too far from now, there are too many points, or the anticipator makes its own
                predictions.
        """
        if "in" in message:
            time: float | None = self._live.now + message["in"]
        else:
            time = message["time"]
        limit = self._live.limits.time_seconds
        if time is not None and abs(time - self._live.now) > limit:
            raise RealizerError(AbsurdTime(limit=limit))
        self._realizer.check_prediction(message["anticipator"], message["sync"])
        predicted = None if time is None else GlobalTime(time)
        self._realizer.put(Prediction(message["anticipator"], message["sync"], predicted))
        return predicted

    def stop(self) -> list[str]:
        """Ends all blocks with an empty REPLACE for every character, and returns the ids of these blocks."""
        self._stops += 1
        id_ = f"stop-{self._stops}"
        for character in self._realizer.characters:
            attributes = f"id={quoteattr(id_)} characterId={quoteattr(character)}"
            self._realizer.put(BmlText(f'<bml xmlns="{BML}" {attributes} composition="REPLACE"/>'))
        return [id_] * len(self._realizer.characters)

    def hear(self, heard: AudioHeard, client: object) -> None:
        """Takes a report of what a client hears.

        Raises:
            RealizerError: there is no such sound, or the report cannot be true.
        """
        self._heard.take(heard, client)

    def message(self, message: Message, client: object) -> None:
        """Handles a checked message of the socket other than BML, ping and clock.

        Args:
            message: the message.
            client: its sender.

        Raises:
            RealizerError: it is refused.
        """
        match message["type"]:
            case "predict":
                self.predict(message)
            case "event":
                self._event(Event(message["anticipator"], message["event"], message.get("value"), message.get("text")))
            case "camera":
                self._realizer.put(moved_of("camera", message["position"]))
            case "world":
                self._move(message["set"])
            case "heard":
                self.hear(AudioHeard(message["id"], message["position"], GlobalTime(message["time"])), client)
            case "push":
                self._push(push_of(message))
            case "speech":
                self._senders.take(streamed_of(message), client)
            case _:  # "demo", the last type of the protocol
                self.demo.perform()

    def leave(self, client: object) -> None:
        """Forgets a client that has disconnected."""
        self._senders.leave(client)

    async def _admitted(
        self, text: str | bytes, client: str, media_type: str, *, whole: bool
    ) -> tuple[_Judged, DocumentChecker]:
        """Reads and judges a document, and has it enter before its mistakes are looked for, with the checker for these.

        If it is to enter ``whole``, it does not enter if any block is refused.
        """
        document = await self._read(text, client, media_type)
        async with self._judging:  # the next one is judged when this one has entered
            judged = await self._judge(document, client)
            checker = self._realizer.checker()
            if not (whole and judged.first_refusal is not None):
                self._realizer.put(document)
        return judged, checker

    async def _read(self, text: str | bytes, client: str, media_type: str) -> BmlText:
        if self.closed:
            raise RealizerError(GoingAway())
        dialects = self._realizer.dialects
        if media_type and media_type not in dialects.media_types:
            raise RealizerError(WrongMediaType(type=media_type, known=dialects.media_types))
        kind = media_type if dialects.determined_by(media_type) else ""
        document = self._realizer.numbered(BmlText(text, client, media_type=kind))
        return await self._apart(len(text), lambda _: self._realizer.read(document))

    async def _judge(self, document: BmlText, client: str) -> _Judged:
        """Judges a document, some blocks at once. Documents of others wait meanwhile, so it does not wait for turns."""
        admission = self._realizer.admission()
        judged = _Judged(document, [], [])
        parts = iter(document.parsed or ())
        while some := list(islice(parts, _AT_ONCE)):
            for parsed in some:
                judged.refusals.append(admission.refusal(parsed, client))
                if judged.refusals[-1] is None and parsed.block is not None:
                    judged.blocks.append(parsed.block.id)
            if len(some) == _AT_ONCE:
                await asyncio.sleep(0)
        return judged

    async def _warnings(self, judged: _Judged, checker: DocumentChecker) -> list[Problem]:
        document = judged.document.parsed or ()
        warnings: list[Problem] = []
        checker.begin(document)
        for number, (parsed, refusal) in enumerate(zip(document, judged.refusals, strict=True)):
            mistakes, notes = await checker.check(parsed, refusal, self.turns)
            warnings += (each for each in (*mistakes, *notes) if each.fault.warning is not None)
            if number % _AT_ONCE == 0:
                await self._pause()
        warnings = sorted(dict.fromkeys(warnings), key=_place)
        for each in warnings[: self._live.limits.answered_warnings]:
            _ = each.fault.sentence  # its search for the name that may have been meant is remembered for the answer
            await self._pause()
        return warnings

    async def _pause(self) -> None:
        """Lets ticks and the turns of others come in between."""
        async with self.turns:
            pass

    def _event(self, event: Event) -> None:
        known = self._realizer.anticipators
        if event.anticipator not in known:
            raise RealizerError(UnknownAnticipator(anticipator=event.anticipator, known=tuple(known)))
        anticipator = known[event.anticipator]
        if event.text is None:
            anticipator.check(event.name, event.value)
        else:
            anticipator.check_heard(event.name)
        self._realizer.put(event)

    def _push(self, push: Push) -> None:
        self._realizer.check_push(push)
        self._realizer.put(push)

    def _move(self, targets: dict[str, Any]) -> None:
        for target in targets:
            if target in self._realizer.characters:
                raise RealizerError(NotMovable(target=target))
        limit, known = self._live.limits.targets, set(self._realizer.world.targets)
        if len(known | targets.keys()) > max(limit, len(known)):
            raise RealizerError(TooManyNames(limit=limit, things="targets"))
        for moved in [moved_of(target, place) for target, place in targets.items()]:
            self._realizer.put(moved)


def _place(problem: Problem) -> tuple[int, int]:
    return problem.fault.line or 1, problem.fault.column or 1
