"""Reads recorded sessions, and converts inputs to and from JSON lines."""

import json
from base64 import b64encode
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final, assert_never

from reactive_realizer.assembly.registry import load_all
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.faults import BadEncoding
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioHeard, StreamedAudio
from reactive_realizer.errors import FAULTS, Fault, RealizerError
from reactive_realizer.realizer.inputs import (
    BmlText,
    Delivery,
    Event,
    Forecast,
    Input,
    Predicted,
    Prediction,
    Push,
    Revocation,
    StreamFailure,
    TargetMoved,
    TickInputs,
)
from reactive_realizer.server.faults import (
    BadMessage,
    BadRecording,
    ForeignPart,
    LostInput,
    NotRecorded,
    OldRecording,
    PartsOutOfOrder,
    TicksOutOfOrder,
)
from reactive_realizer.server.protocol import Message, check, decode, moved_of, push_of, streamed_of
from reactive_realizer.server.recording_parts import part_path
from reactive_realizer.server.schema import Schema, shown

FORMAT: Final = 2
"""Version of the format of recordings; since 2, they have what anticipators predicted."""


def message_of(entry: Input) -> Message:
    """Encodes an input as a message of the protocol.

    A document in bytes gets an ``encoding`` beside its ``xml``, so that decoding restores the same bytes.
    """
    match entry:
        case BmlText(text, media_type=media_type):
            return {"type": "bml", **_document(text), **({"mediaType": media_type} if media_type else {})}
        case Prediction(anticipator, sync, time):
            return {"type": "predict", "anticipator": anticipator, "sync": sync, "time": time}
        case Event(anticipator, name, value, text):
            content = {key: what for key, what in (("value", value), ("text", text)) if what is not None}
            return {"type": "event", "anticipator": anticipator, "event": name, **content}
        case TargetMoved(target, position, None):
            return {"type": "world", "set": {target: position}}
        case TargetMoved(target, position, orientation):
            return {"type": "world", "set": {target: {"position": position, "orientation": orientation}}}
        case AudioHeard(id_, position, time):
            return {"type": "heard", "id": id_, "position": position, "time": time}
        case Push(character, joint, force, duration):
            return {"type": "push", "character": character, "joint": joint, "force": force, "duration": duration}
        case StreamedAudio(stream, audio, words, end):
            sound = b64encode(audio).decode()
            return {"type": "speech", "stream": stream, "audio": sound, "words": words, "end": end}
        case _:
            assert_never(entry)


def input_of(message: Message, client: str = "", number: int = 0) -> Input:
    """Decodes an input from the recorded message of a client, and the number of a document.

    Raises:
        RealizerError: "unknown-message" or "bad-message".
    """
    check(message)
    match message:
        case {"type": "bml"}:
            return BmlText(_text(message), client, number, message.get("mediaType", ""))
        case {"type": "predict", "anticipator": anticipator, "sync": sync, "time": time}:
            return Prediction(anticipator, sync, None if time is None else GlobalTime(time))
        case {"type": "event", "anticipator": anticipator, "event": name}:
            return Event(anticipator, name, message.get("value"), message.get("text"))
        case {"type": "heard", "id": id_, "position": position, "time": time}:
            return AudioHeard(id_, position, GlobalTime(time))
        case {"type": "push"}:
            return push_of(message)
        case {"type": "speech"}:
            return streamed_of(message)
        case {"type": "world", "set": targets} if len(targets) == 1:
            ((target, place),) = targets.items()
            return moved_of(target, place)
        case _:
            raise RealizerError(NotRecorded(type=message["type"]))


def _document(text: str | bytes) -> Mapping[str, str]:
    if isinstance(text, str):
        return {"xml": text}
    try:
        return {"xml": text.decode(), "encoding": "utf-8"}
    except UnicodeDecodeError:
        return {"xml": text.decode("latin-1"), "encoding": "latin-1"}


def _text(message: Message) -> str | bytes:
    xml, encoding = str(message["xml"]), message.get("encoding")
    if encoding is None:
        return xml
    try:
        return xml.encode(encoding)
    except (TypeError, LookupError, UnicodeEncodeError) as problem:
        raise RealizerError(BadEncoding()) from problem


_LINES: Final = Schema(json.loads(Path(__file__).with_name("recording.json").read_text(encoding="utf-8")))


@dataclass(frozen=True, slots=True)
class SessionRecording:
    """A recorded session.

    Attributes:
        version: of the realizer that was recorded.
        started: POSIX time (s) of its time 0.
        scene: the options of its scene, as in the file.
        ticks: the inputs of each tick.
    """

    version: str
    started: float
    scene: Message
    ticks: tuple[TickInputs, ...]

    def options(self, folder: Path) -> SceneOptions:
        """The options of its scene. Writes the human file into a folder.

        Raises:
            OSError: the folder cannot be written to.
        """
        human = folder / "human.toml"
        human.write_text(self.scene["human"], encoding="utf-8")
        return SceneOptions(**{**self.scene, "human": human, "assets": tuple(map(Path, self.scene["assets"]))})


def read_recording(path: Path) -> SessionRecording:
    """Reads a recorded session from a file, and from the parts that follow it.

    Lines after the last complete tick are ignored: the recording ended in the middle of a tick.

    Raises:
        RealizerError: "bad-recording", with the file and the line.
        OSError: the file or a part cannot be read.
    """
    reader, read = _Reader(), 0
    while read < reader.parts:
        read += 1
        _read_part(reader, path, read)
    return SessionRecording(
        reader.header["version"], reader.header["started"], reader.header["scene"], tuple(reader.ticks)
    )


def _read_part(reader: "_Reader", path: Path, number: int) -> None:
    part = part_path(path, number)
    for row, line in enumerate(part.read_bytes().split(b"\n")[:-1] or [b""], 1):
        try:
            reader.read(decode(line), begins=row == 1)
        except RealizerError as problem:
            raise RealizerError(BadRecording(file=part.name, row=row, reason=problem.fault.sentence)) from problem


class _Reader:
    """Collects the inputs of each tick until the line of the tick, which follows them.

    Attributes:
        parts: how many there are, as far as is known.
    """

    def __init__(self) -> None:
        self.header: Message = {}
        self.ticks: list[TickInputs] = []
        self.parts = 1
        self._inputs: list[Input] = []
        self._tick: int | None = None
        self._seq = 0

    def read(self, line: Any, *, begins: bool) -> None:
        """Reads the next line, which begins a part or not.

        Raises:
            RealizerError: the line is invalid.
        """
        if begins:
            self._take_header(_header(line))
        elif isinstance(line, dict) and "part" in line:
            self._take_part(_checked(line, "Part"))
        elif isinstance(line, dict) and "input" in line:
            self._take_input(_checked(line, "Input"))
        elif isinstance(line, dict) and "forecast" in line:
            self._take_forecast(_checked(line, "Answer"))
        else:
            self._take_tick(_checked(line, "Tick"))

    def _take_header(self, header: Message) -> None:
        if header != (self.header or header):
            raise RealizerError(ForeignPart())
        self.header = header

    def _take_part(self, line: Message) -> None:
        if line["part"] != self.parts + 1:
            raise RealizerError(PartsOutOfOrder(part=line["part"], last=self.parts))
        self.parts += 1

    def _take_input(self, line: Message) -> None:
        self._seq += 1
        if line["seq"] != self._seq:
            raise RealizerError(LostInput(seq=line["seq"], wanted=self._seq))
        self._tick = self._later(int(line["tick"]))
        self._inputs.append(input_of(line["input"], line.get("client", ""), line.get("number", 0)))

    def _take_tick(self, line: Message) -> None:
        work = tuple(map(_delivery, line.get("work", ())))
        predicted = tuple(map(_predicted, line.get("predicted", ())))
        tick, watched = self._later(int(line["tick"])), line.get("watched", False)
        self.ticks.append(TickInputs(tick, tuple(self._inputs), work, predicted, watched=watched))
        following = range(tick + 1, tick + int(line.get("count", 1)))
        self.ticks += (TickInputs(number, watched=watched) for number in following)
        self._inputs, self._tick = [], None

    def _take_forecast(self, line: Message) -> None:
        last = self.ticks[-1].tick if self.ticks else -1
        if line["tick"] != last:
            raise RealizerError(TicksOutOfOrder(tick=line["tick"], last=last))
        answer = Forecast(**line["forecast"])
        self.ticks[-1] = replace(self.ticks[-1], forecasts=(*self.ticks[-1].forecasts, answer))

    def _later(self, tick: int) -> int:
        """Check that a tick is after all complete ones, and equals that of the inputs read since; return it."""
        last = self.ticks[-1].tick if self.ticks else -1
        if tick <= last or self._tick not in (None, tick):
            raise RealizerError(TicksOutOfOrder(tick=tick, last=last if self._tick is None else self._tick))
        return tick


def _header(line: Any) -> Message:
    recorded = line.get("recording") if isinstance(line, dict) else None
    if isinstance(recorded, int) and 0 < recorded < FORMAT:
        raise RealizerError(OldRecording(format=recorded, known=FORMAT, version=line.get("version", "unknown")))
    return _checked(line, "Header")


def _predicted(entry: Message) -> Predicted:
    match entry:
        case {"anticipator": anticipator, "sync": sync, "time": time}:
            return Prediction(anticipator, sync, time)
        case {"anticipator": anticipator, "revoked": sync}:
            return Revocation(anticipator, sync)
        case _:
            return StreamFailure(entry["anticipator"], entry["failed"])


def _checked(line: Any, kind: str) -> Message:
    _LINES.check(line, kind, kind)
    checked: Message = line
    return checked


def _delivery(work: Message) -> Delivery:
    failure = work.get("failure")
    return Delivery(work["request"], None if failure is None else _fault(failure))


def _fault(failure: Message) -> Fault:
    code, line, column = failure["code"], failure["line"], failure["column"]
    values: Mapping[str, Any] = failure["details"]
    details = {name: tuple(value) if isinstance(value, list) else value for name, value in values.items()}
    if code not in FAULTS:
        load_all()  # a plug-in may define it
    try:
        fault = FAULTS[code](**details, line=line, column=column)
        str(fault)
    except (LookupError, ValueError, AttributeError, TypeError) as problem:
        reason = f"{shown(failure)} is not a known fault"
        raise RealizerError(BadMessage(place="failure", reason=reason)) from problem
    return fault
