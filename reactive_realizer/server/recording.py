"""A recorded session, read back."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.errors import Fault, RealizerError, error
from reactive_realizer.realizer.entered import Delivery, Entered
from reactive_realizer.realizer.inputs import Input
from reactive_realizer.server.protocol import Message, decode
from reactive_realizer.server.recorded_input import input_of
from reactive_realizer.server.schema import Schema

_LINES: Final = Schema(json.loads(Path(__file__).with_name("recording.json").read_text(encoding="utf-8")))


@dataclass(frozen=True, slots=True)
class Recording:
    """A session as it was.

    Attributes:
        version: of the realizer that was recorded.
        started: POSIX time (s) of its time 0.
        scene: the options of its scene, as they stand in the file.
        ticks: what each tick took in.
    """

    version: str
    started: float
    scene: Message
    ticks: tuple[Entered, ...]

    def options(self, folder: Path) -> SceneOptions:
        """What its scene is assembled from; the human file is written into a folder.

        Raises:
            OSError: the folder cannot be written to.
        """
        human = folder / "human.toml"
        human.write_text(self.scene["human"], encoding="utf-8")
        return SceneOptions(**{**self.scene, "human": human, "assets": tuple(map(Path, self.scene["assets"]))})


def read_recording(path: Path) -> Recording:
    """The session that a file holds.

    What stands after the last tick that is whole was cut off with its end, and is left out.

    Raises:
        RealizerError: "bad-recording", with the line.
        OSError: the file cannot be read.
    """
    reader = _Reader()
    for row, line in enumerate(path.read_bytes().split(b"\n")[:-1] or [b""], 1):
        try:
            reader.read(decode(line))
        except RealizerError as problem:
            raise error("bad-recording", file=path.name, row=row, reason=problem.fault.sentence) from problem
    return Recording(reader.header["version"], reader.header["started"], reader.header["scene"], tuple(reader.ticks))


class _Reader:
    """Puts the inputs of a tick together with its own line, which comes after them."""

    def __init__(self) -> None:
        self.header: Message = {}
        self.ticks: list[Entered] = []
        self._inputs: list[Input] = []
        self._tick: int | None = None
        self._seq = 0

    def read(self, line: Any) -> None:
        """Take in the next line.

        Raises:
            RealizerError: what is wrong with it.
        """
        if not self.header:
            self.header = _checked(line, "Header")
        elif isinstance(line, dict) and "input" in line:
            self._take_input(_checked(line, "Input"))
        else:
            self._take_tick(_checked(line, "Tick"))

    def _take_input(self, line: Message) -> None:
        self._seq += 1
        if line["seq"] != self._seq:
            raise error("lost-input", seq=line["seq"], wanted=self._seq)
        self._tick = self._later(line["tick"])
        self._inputs.append(input_of(line["input"]))

    def _take_tick(self, line: Message) -> None:
        work = tuple(map(_delivery, line.get("work", ())))
        self.ticks.append(Entered(self._later(line["tick"]), tuple(self._inputs), work))
        self._inputs, self._tick = [], None

    def _later(self, tick: int) -> int:
        """A tick after those that are whole, and the same as that of the inputs before it."""
        last = self.ticks[-1].tick if self.ticks else -1
        if tick <= last or self._tick not in (None, tick):
            raise error("ticks-out-of-order", tick=tick, last=last if self._tick is None else self._tick)
        return tick


def _checked(line: Any, kind: str) -> Message:
    wrong = _LINES.mismatch(line, _LINES.definitions[kind])
    if wrong is not None:
        raise error("bad-message", place=wrong.place or kind, value=json.dumps(wrong.value)[:60], rule=wrong.rule)
    checked: Message = line
    return checked


def _delivery(work: Message) -> Delivery:
    failure = work.get("failure")
    return Delivery(work["request"], None if failure is None else _fault(failure))


def _fault(failure: Message) -> Fault:
    fault = Fault(failure["code"], failure["details"], failure["line"], failure["column"])
    try:
        str(fault)
    except (LookupError, ValueError, AttributeError) as problem:
        shown = json.dumps(failure)[:60]
        raise error("bad-message", place="failure", value=shown, rule="the table of errors") from problem
    return fault
