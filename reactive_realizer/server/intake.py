"""What clients say, as inputs of the realizer."""

import asyncio
from collections.abc import Sequence
from typing import Any
from xml.sax.saxutils import quoteattr

from reactive_realizer.bml.block import Parsed
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import RealizerError, error
from reactive_realizer.realizer.inputs import BmlText, Event, Position, Prediction, TargetMoved
from reactive_realizer.server.demo import Demo
from reactive_realizer.server.live import Live
from reactive_realizer.server.protocol import Message


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
        self.demo = Demo(live, self.stop)

    async def document(self, text: bytes) -> list[str]:
        """Take in a document if every block of it can be accepted; their ids.

        Raises:
            RealizerError: why the first of the others is refused; nothing has entered.
        """
        blocks = await self._read(text)
        for refusal in self._refusals(blocks):
            raise refusal
        self._realizer.put(BmlText(text))
        return [parsed.block.id for parsed in blocks if parsed.block is not None]

    def predict(self, message: Message) -> GlobalTime | None:
        """Take in a prediction; when it is for.

        Raises:
            RealizerError: a time too far from now, or one point too many.
        """
        if "in" in message:
            time: float | None = self._live.now + message["in"]
        else:
            time = message["time"]
        limit = self._live.limits.time_seconds
        if time is not None and abs(time - self._live.now) > limit:
            raise error("absurd-time", limit=limit)
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

    async def message(self, message: Message) -> None:
        """Take in a checked message of the socket that is no question.

        Raises:
            RealizerError: why it is refused.
        """
        match message["type"]:
            case "bml":
                await self._bml(message["xml"])
            case "predict":
                self.predict(message)
            case "event":
                self._event(message["anticipator"], message["event"], message.get("value"))
            case "camera":
                self._realizer.put(TargetMoved("camera", _position(message["position"])))
            case "world":
                self._move(message["set"])
            case _:  # "demo" is what is left of the protocol
                self.demo.perform()

    async def _bml(self, text: str) -> None:
        """As a file: blocks that can be read play whatever the others are; feedback tells of each of those."""
        blocks = await self._read(text)
        refusals = self._refusals(blocks)
        self._realizer.put(BmlText(text))
        for refusal in refusals:
            raise refusal

    async def _read(self, text: str | bytes) -> list[Parsed]:
        """Aside: a large document takes longer than a tick."""
        return await asyncio.to_thread(parse, text, self._live.limits)

    def _refusals(self, blocks: Sequence[Parsed]) -> list[RealizerError]:
        faults = [
            parsed.problems[0].fault if parsed.block is None else self._realizer.scheduler.refusal(parsed.block)
            for parsed in blocks
        ]
        return [RealizerError(fault) for fault in faults if fault is not None]

    def _event(self, anticipator: str, name: str, value: float | None) -> None:
        known = self._realizer.anticipators
        if anticipator not in known:
            raise error("unknown-anticipator", anticipator=anticipator, known=", ".join(known) or "none")
        known[anticipator].check(name, value)
        self._realizer.put(Event(anticipator, name, value))

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


def _position(coordinates: Sequence[float]) -> Position:
    x, y, z = coordinates
    return (float(x), float(y), float(z))
