"""What clients say, as inputs of the realizer."""

import asyncio
from collections.abc import Sequence
from typing import Any, NamedTuple
from xml.sax.saxutils import quoteattr

from reactive_realizer.bml.block import Parsed
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import Fault, RealizerError, error
from reactive_realizer.realizer.inputs import BmlText, Event, Position, Prediction, TargetMoved
from reactive_realizer.scheduler.admission import Admission
from reactive_realizer.server.demo import Demo
from reactive_realizer.server.live import Live
from reactive_realizer.server.protocol import Message

_SMALL = 2000
"""Bytes or characters of a document that is read at once: a thread takes longer to begin; one of a megabyte takes
longer than many ticks."""


class BlocksRefused(RealizerError):
    """Some blocks of a document were refused; it says why the first one was.

    Attributes:
        entered: ids of the others, which have entered.
    """

    def __init__(self, first: Fault, entered: list[str]) -> None:
        super().__init__(first)
        self.entered = entered


class _Judged(NamedTuple):
    """A document, the ids of what of it can be accepted, and why the rest cannot."""

    entry: BmlText
    blocks: list[str]
    procedures: list[str]
    faults: list[Fault]


class Intake:
    """The door of a live scene: refuses what can be refused at once, and puts the rest in.

    Attributes:
        demo: the performance of the scene.
    """

    def __init__(self, live: Live) -> None:
        self._live = live
        self._realizer = live.realizer
        self._stops = 0
        self._points: set[tuple[str, str]] = set()
        self._procedures: dict[str, None] = {}
        self.demo = Demo(live, self.stop)

    async def document(self, text: str | bytes) -> list[str]:
        """Take in a document if every block of it can be accepted; their ids.

        Raises:
            RealizerError: why the first of the others is refused; nothing has entered.
        """
        judged = await self._judge(text)
        if judged.faults:
            raise RealizerError(judged.faults[0])
        self._put(judged)
        return judged.blocks

    async def blocks(self, text: str) -> list[str]:
        """Take in the blocks of a document that can be accepted, whatever the others are; their ids.

        It enters as a file does: feedback tells of each of the others.

        Raises:
            BlocksRefused: why the first of the others is refused.
        """
        judged = await self._judge(text)
        self._put(judged)
        if judged.faults:
            raise BlocksRefused(judged.faults[0], judged.blocks)
        return judged.blocks

    def predict(self, message: Message) -> GlobalTime | None:
        """Take in a prediction; when it is for.

        Raises:
            RealizerError: a time too far from now, one point too many, or an anticipator that predicts by itself.
        """
        if "in" in message:
            time: float | None = self._live.now + message["in"]
        else:
            time = message["time"]
        limit = self._live.limits.time_seconds
        if time is not None and abs(time - self._live.now) > limit:
            raise error("absurd-time", limit=limit)
        if message["anticipator"] in self._realizer.anticipators:
            self._realizer.anticipators[message["anticipator"]].check_prediction()
        self._name_point(message["anticipator"], message["sync"])
        predicted = None if time is None else GlobalTime(time)
        self._realizer.put(Prediction(message["anticipator"], message["sync"], predicted))
        return predicted

    def stop(self) -> list[str]:
        """End all blocks: an empty REPLACE for every character; the ids of these."""
        self._stops += 1
        id_ = f"stop-{self._stops}"
        for character in self._realizer.characters:
            attributes = f"id={quoteattr(id_)} characterId={quoteattr(character)}"
            self._realizer.put(BmlText(f'<bml xmlns="{BML}" {attributes} composition="REPLACE"/>'))
        return [id_] * len(self._realizer.characters)

    def message(self, message: Message) -> None:
        """Take in a checked message of the socket that is neither BML nor a question.

        Raises:
            RealizerError: why it is refused.
        """
        match message["type"]:
            case "predict":
                self.predict(message)
            case "event":
                self._event(Event(message["anticipator"], message["event"], message.get("value"), message.get("text")))
            case "camera":
                self._realizer.put(TargetMoved("camera", _position(message["position"])))
            case "world":
                self._move(message["set"])
            case _:  # "demo" is what is left of the protocol
                self.demo.perform()

    async def _judge(self, text: str | bytes) -> _Judged:
        if len(text) < _SMALL:
            read = parse(text, self._live.limits)
        else:
            read = await asyncio.to_thread(parse, text, self._live.limits)
        # Procedures of the documents that are still to enter count too.
        admission = self._realizer.scheduler.admission(self._procedures)
        judged = _Judged(BmlText(text, read), [], [], [])
        for parsed in read:
            if (fault := _refusal(admission, parsed)) is not None:
                judged.faults.append(fault)
            elif parsed.block is not None:
                judged.blocks.append(parsed.block.id)
            elif parsed.procedure is not None:
                judged.procedures.append(parsed.procedure.id)
        return judged

    def _put(self, judged: _Judged) -> None:
        self._procedures.update(dict.fromkeys(judged.procedures))
        self._realizer.put(judged.entry)

    def _event(self, event: Event) -> None:
        known = self._realizer.anticipators
        if event.anticipator not in known:
            raise error("unknown-anticipator", anticipator=event.anticipator, known=", ".join(known) or "none")
        anticipator = known[event.anticipator]
        if event.text is None:
            anticipator.check(event.name, event.value)
        else:
            anticipator.check_heard(event.name)
        self._realizer.put(event)

    def _name_point(self, anticipator: str, sync: str) -> None:
        """Points stay on the board once they are named."""
        limit = self._live.limits.predicted_points
        if len(self._points) >= limit and (anticipator, sync) not in self._points:
            raise error("too-many-names", limit=limit, things="predicted points")
        self._points.add((anticipator, sync))

    def _move(self, targets: dict[str, Any]) -> None:
        for target in targets:
            if target in self._realizer.characters:
                raise error("not-movable", target=target)
        limit, known = self._live.limits.targets, set(self._realizer.world.targets)
        if len(known | targets.keys()) > max(limit, len(known)):
            raise error("too-many-names", limit=limit, things="targets")
        for target, position in targets.items():
            self._realizer.put(TargetMoved(target, None if position is None else _position(position)))


def _refusal(admission: Admission, parsed: Parsed) -> Fault | None:
    if parsed.block is not None:
        return admission.take(parsed.block, parsed.failed)
    return parsed.refusal if parsed.procedure is None else admission.define(parsed.procedure)


def _position(coordinates: Sequence[float]) -> Position:
    x, y, z = coordinates
    return (float(x), float(y), float(z))
