"""Records a live session as JSON lines, in the format of recording.json."""

import json
import logging
from collections.abc import Callable, Mapping
from dataclasses import asdict, fields
from typing import Any, assert_never

from reactive_realizer import __version__
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.clock.ticker import RATE, tick_time
from reactive_realizer.realizer.inputs import (
    BmlText,
    Delivery,
    Forecast,
    Input,
    Predicted,
    Prediction,
    Revocation,
    StreamFailure,
    TickInputs,
)
from reactive_realizer.server.protocol import Message
from reactive_realizer.server.recording import FORMAT, message_of

logger = logging.getLogger(__name__)

_MOST_EMPTY = RATE
"""Ticks in which nothing enters that wait for a common line: a killed session lacks no more than these."""


class Recorder:
    """Records the inputs of a realizer, tick by tick, before they have any effect.

    So even a killed session can be replayed up to its last tick, or up to a second earlier if nothing has entered since
    then. If a line cannot be written, recording ends, and the session continues.

    Args:
        write: writes lines, and raises OSError if it cannot.
        options: of the scene.
        started: POSIX time (s) of realizer time 0.
    """

    def __init__(self, write: Callable[[str], None], options: SceneOptions, started: float) -> None:
        self._write_lines: Callable[[str], None] | None = write
        self._inputs = 0
        self._tick = 0
        self._empty = range(0)
        self._watched = False
        scene = _scene(options)
        self._write([{"recording": FORMAT, "version": __version__, "rate": RATE, "started": started, "scene": scene}])

    def __call__(self, entered: TickInputs) -> None:
        """Write the inputs of a tick, then the line of the tick, which marks them as complete."""
        self._tick = entered.tick
        if not (entered.inputs or entered.work or entered.predicted):
            self._add_empty(entered)
            return
        lines = []
        for entry in entered.inputs:
            self._inputs += 1
            place = {"seq": self._inputs, "tick": entered.tick, "time": tick_time(entered.tick)}
            lines.append({**place, **_origin(entry), "input": message_of(entry)})
        work = {"work": [_delivery(delivery) for delivery in entered.work]} if entered.work else {}
        predicted = {"predicted": [_predicted(each) for each in entered.predicted]} if entered.predicted else {}
        self._write(
            [*self._take_empty(), *lines, {"tick": entered.tick, **work, **predicted, **_watched(entered.watched)}]
        )

    def forecast(self, answer: Forecast) -> None:
        """Write an answer of an anticipator after the line of its tick."""
        self._write([*self._take_empty(), {"tick": self._tick, "forecast": asdict(answer)}])

    def close(self) -> None:
        """Write the ticks that wait for a common line."""
        self._write(self._take_empty())

    def _add_empty(self, entered: TickInputs) -> None:
        """Have a tick in which nothing enters share a line with those just before it, if these are watched like it."""
        tick = entered.tick
        if tick != self._empty.stop or entered.watched != self._watched:
            self._write(self._take_empty())
        self._watched = entered.watched
        self._empty = range(self._empty.start if self._empty else tick, tick + 1)
        if len(self._empty) == _MOST_EMPTY:
            self._write(self._take_empty())

    def _take_empty(self) -> list[Mapping[str, object]]:
        """The line of the ticks in which nothing has entered since the last line, if there are any."""
        empty, self._empty = self._empty, range(0)
        count = {"count": len(empty)} if len(empty) > 1 else {}
        return [{"tick": empty.start, **count, **_watched(self._watched)}] if empty else []

    def _write(self, lines: list[Mapping[str, object]]) -> None:
        if self._write_lines is None or not lines:
            return
        try:
            self._write_lines("".join(json.dumps(line, default=str) + "\n" for line in lines))
        except OSError as problem:
            logger.error("recording has stopped: %s", problem)
            self._write_lines = None


def _scene(options: SceneOptions) -> Message:
    plain = {field.name: getattr(options, field.name) for field in fields(options)}
    human = options.human.read_text(encoding="utf-8")
    return plain | {"human": human, "assets": [str(folder.resolve()) for folder in options.assets]}


def _watched(watched: bool) -> Message:
    return {"watched": True} if watched else {}


def _origin(entry: Input) -> dict[str, Any]:
    """The client that sent a document, and the number of the document, if it has any of these."""
    known = {"client": entry.client, "number": entry.number} if isinstance(entry, BmlText) else {}
    return {name: value for name, value in known.items() if value}


def _delivery(delivery: Delivery) -> Message:
    failure = delivery.failure
    if failure is None:
        return {"request": delivery.request}
    place = {"line": failure.line, "column": failure.column}
    return {"request": delivery.request, "failure": {"code": failure.code, "details": failure.details, **place}}


def _predicted(each: Predicted) -> Message:
    match each:
        case Prediction(anticipator, sync, time):
            return {"anticipator": anticipator, "sync": sync, "time": time}
        case Revocation(anticipator, sync):
            return {"anticipator": anticipator, "revoked": sync}
        case StreamFailure(anticipator, reason):
            return {"anticipator": anticipator, "failed": reason}
        case _:
            assert_never(each)
