"""The file of a recorded session, line by line."""

import json
from collections.abc import Callable
from contextlib import closing
from dataclasses import fields
from pathlib import Path
from typing import Any, get_args

import pytest
from jsonschema import Draft202012Validator

from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions, open_scene
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioHeard, StreamedAudio
from reactive_realizer.embodiment.quaternion import normalize
from reactive_realizer.engines.speech.speech_worker import VoiceFailed
from reactive_realizer.errors import RealizerError
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
from reactive_realizer.server import recording as recording_module
from reactive_realizer.server.recorder import Recorder
from reactive_realizer.server.recording import SessionRecording, read_recording
from reactive_realizer.server.recording_parts import RecordingParts

INPUTS: list[Input] = [
    BmlText('<bml id="ü"/>'),
    BmlText('<bml id="ü"/>', "192.0.2.7"),
    BmlText("#cues", number=7, media_type="text/x-cues"),
    BmlText("a half of a pair: \ud800"),
    BmlText('<bml id="ü"/>'.encode()),
    BmlText('<?xml version="1.0" encoding="UTF-16"?><bml id="ü"/>'.encode("utf-16")),
    Prediction("partner", "hit", GlobalTime(0.1 + 0.2)),
    Prediction("partner", "hit", None),
    Event("metronome", "start"),
    Event("metronome", "tempo", 92.5, "faster"),
    TargetMoved("bluebox", (0.1, 1.0, -2.5)),
    TargetMoved("bluebox", None),
    TargetMoved("bluebox", (0.1, 1.0, -2.5), normalize((0.1, 0.2, 0.3, -0.4))),
    AudioHeard("alice-1", 0.1 + 0.2, GlobalTime(1.7)),
    Push("alice", "vt10", (0.1, 0.0, -2.5), 0.5),
    StreamedAudio("reply", b"\x00\xff\x01", (("Hé", 0.1 + 0.2),), end=True),
    StreamedAudio("reply"),
]
PREDICTED = (
    Prediction("user", "stop", GlobalTime(1.3)),
    Prediction("user", "stop", None),
    Revocation("user", "stop"),
    StreamFailure("user", "ZeroDivisionError: ü"),
)
FORECASTS = (Forecast("metronome", "tick1", GlobalTime(1.0)), Forecast("orchestra", "beat1", None))
SESSION = [
    TickInputs(0, tuple(INPUTS)),
    TickInputs(1, (), (), PREDICTED, FORECASTS),
    TickInputs(7, (), (Delivery(2), Delivery(1, VoiceFailed(reason="killed", line=3, column=4)))),
    TickInputs(9, (Event("metronome", "start"),)),
]
SHARED = [
    TickInputs(300, (Event("metronome", "start"),)),
    TickInputs(301),
    TickInputs(302),
    TickInputs(303, (), (), (), FORECASTS),
    TickInputs(304),
    TickInputs(305),
    TickInputs(306, (), (Delivery(1),)),
]
"""With ticks in which nothing enters, one of which is followed by answers."""


def recorded(session: list[TickInputs], options: SceneOptions | None = None) -> str:
    lines: list[str] = []
    record(session, lines.append, options)
    return "".join(lines)


def record(session: list[TickInputs], write: Callable[[str], None], options: SceneOptions | None = None) -> None:
    recorder = Recorder(write, options or SceneOptions(), 1234.5)
    for entered in session:
        recorder(entered)
        for forecast in entered.forecasts:
            recorder.forecast(forecast)
    recorder.close()


@pytest.fixture
def read(tmp_path: Path) -> Callable[[str | bytes], SessionRecording]:
    def read(text: str | bytes) -> SessionRecording:
        file = tmp_path / "session.jsonl"
        file.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_recording(file)

    return read


def test_a_session_is_read_as_it_was_recorded(read: Callable[[str | bytes], SessionRecording]) -> None:
    recording = read(recorded(SESSION))
    assert list(recording.ticks) == SESSION
    assert recording.started == 1234.5


def test_the_examples_cover_every_field_of_every_kind_of_input() -> None:
    assert {type(entry) for entry in INPUTS} == set(get_args(Input))
    for kind in get_args(Input):
        own = [entry for entry in INPUTS if isinstance(entry, kind)]
        said = [field.name for field in fields(kind) if field.compare]  # the others are derived
        assert any(all(getattr(entry, name) is not None for name in said) for entry in own)


def test_the_examples_cover_every_kind_of_prediction() -> None:
    assert {type(each) for each in PREDICTED} == set(get_args(Predicted))


def test_every_option_of_a_scene_is_read_as_it_was(
    read: Callable[[str | bytes], SessionRecording], tmp_path: Path
) -> None:
    options = SceneOptions(DEFAULT_HUMAN, "text", (tmp_path,), 7)
    again = read(recorded([], options)).options(tmp_path)
    assert again.human.read_text("utf-8") == DEFAULT_HUMAN.read_text("utf-8")
    others = [field.name for field in fields(SceneOptions) if field.name != "human"]
    assert [getattr(again, name) for name in others] == [getattr(options, name) for name in others]


def test_an_input_precedes_its_tick_with_its_number_and_time() -> None:
    *_, line, tick = map(json.loads, recorded(SESSION).splitlines())
    event = {"type": "event", "anticipator": "metronome", "event": "start"}
    assert line == {"seq": len(INPUTS) + 1, "tick": 9, "time": 0.09, "input": event}
    assert tick == {"tick": 9}


def test_ticks_in_which_nothing_enters_share_a_line_up_to_a_hundred_or_a_skipped_tick() -> None:
    numbers = [*range(250), *range(252, 255), 260]
    _, *lines = map(json.loads, recorded([*map(TickInputs, numbers), *SHARED]).splitlines())
    assert lines[:3] == [{"tick": 0, "count": 100}, {"tick": 100, "count": 100}, {"tick": 200, "count": 50}]
    assert lines[3:5] == [{"tick": 252, "count": 3}, {"tick": 260}]
    assert [line.get("count") for line in lines[5:]] == [None, None, 3, None, None, 2, None]


def test_ticks_that_share_a_line_are_all_watched_or_none_is(read: Callable[[str | bytes], SessionRecording]) -> None:
    session = [TickInputs(number, watched=3 <= number < 7) for number in range(10)]
    _, *lines = map(json.loads, recorded(session).splitlines())
    assert lines == [{"tick": 0, "count": 3}, {"tick": 3, "count": 4, "watched": True}, {"tick": 7, "count": 3}]
    assert list(read(recorded(session)).ticks) == session


def test_ticks_that_share_a_line_are_read_one_by_one(read: Callable[[str | bytes], SessionRecording]) -> None:
    session = [*map(TickInputs, range(250)), *SHARED]
    assert list(read(recorded(session)).ticks) == session


def test_a_killed_session_lacks_at_most_a_second_without_input() -> None:
    lines: list[str] = []
    recorder = Recorder(lines.append, SceneOptions(), 0.0)
    recorder(TickInputs(0, (Event("metronome", "start"),)))
    for number in range(1, 1000):
        recorder(TickInputs(number))
        last = json.loads("".join(lines).splitlines()[-1])
        assert number - (last["tick"] + last.get("count", 1) - 1) < 100


def test_every_line_satisfies_the_schema() -> None:
    schema = json.loads(Path(recording_module.__file__).with_name("recording.json").read_text("utf-8"))
    for number, line in enumerate(map(json.loads, recorded([*SESSION, *SHARED]).splitlines())):
        kind = "Header" if number == 0 else "Input" if "input" in line else "Answer" if "forecast" in line else "Tick"
        Draft202012Validator({"$ref": f"#/$defs/{kind}", "$defs": schema["$defs"]}).validate(line)


def test_all_complete_ticks_of_a_truncated_file_are_read(read: Callable[[str | bytes], SessionRecording]) -> None:
    session = [
        TickInputs(0, (Event("metronome", "start"),)),
        TickInputs(3),
        TickInputs(9, (BmlText("<bml/>"),), (Delivery(1),)),
    ]
    text = recorded(session).encode()
    for size in range(text.index(b"\n") + 1, len(text)):
        ticks = list(read(text[:size]).ticks)
        assert ticks == session[: len(ticks)]
    assert list(read(text).ticks) == session


GOOD = recorded(SESSION).splitlines()
EVENT = '{"seq": 19, "tick": 10, "time": 0.1, "input": {"type": "event", "anticipator": "a", "event": "e"}}'
FORECAST = '{"tick": 9, "forecast": {"anticipator": "m", "sync": "tick1", "time": null}}'


@pytest.mark.parametrize(
    ("lines", "row", "part"),
    [
        ([], 1, "not valid JSON"),
        (["<bml/>"], 1, "not valid JSON"),
        (["{}"], 1, "required"),
        ([GOOD[0].replace('"recording": 2', '"recording": 3')], 1, "recording: 3"),
        ([GOOD[0].replace('"recording": 2', '"recording": 1')], 1, "this version reads format 2; replay it with"),
        ([GOOD[0].replace('"seed"', '"sead"')], 1, "scene"),
        ([GOOD[0], "[]"], 2, "Tick: []"),
        ([GOOD[0], '{"tick": -1}'], 2, "minimum 0"),
        ([GOOD[0], '{"tick": 1e308}'], 2, "maximum 10000000000"),
        ([GOOD[0], '{"tick": 3}', '{"tick": 3}'], 3, "tick 3 follows tick 3"),
        ([GOOD[0], '{"tick": 3, "count": 4}', '{"tick": 6}'], 3, "tick 6 follows tick 6"),
        ([GOOD[0], '{"tick": 3, "count": 0}'], 2, "minimum 1"),
        ([GOOD[0], '{"tick": 3, "count": 1e9}'], 2, "maximum 100"),
        ([GOOD[0], EVENT.replace("19", "2")], 2, "input 2 follows where input 1"),
        ([*GOOD, EVENT.replace("10", "9")], len(GOOD) + 1, "tick 9 follows tick 9"),
        ([*GOOD, EVENT, '{"tick": 11}'], len(GOOD) + 2, "tick 11 follows tick 10"),
        ([GOOD[0], FORECAST], 2, "tick 9 follows tick -1"),
        ([*GOOD, FORECAST.replace("9", "8")], len(GOOD) + 1, "tick 8 follows tick 9"),
        ([*GOOD, FORECAST.replace("null", "true")], len(GOOD) + 1, "forecast.time: true"),
        ([*GOOD, '{"tick": 11, "predicted": [{"anticipator": "a"}]}'], len(GOOD) + 1, "predicted.0"),
        ([*GOOD, EVENT.replace("event", "ping")], len(GOOD) + 1, "ping"),
        ([*GOOD, EVENT.replace('"event": "e"', '"event": 4')], len(GOOD) + 1, "event: 4"),
        ([*GOOD, '{"tick": 11, "work": [{"request": 0}]}'], len(GOOD) + 1, "work.0.request"),
        ([*GOOD, '{"tick": 11, "work": [{"request": 1, "failure": {"code": "x"}}]}'], len(GOOD) + 1, "failure"),
        ([*GOOD, GOOD[-3].replace("reason", "x").replace(": 7", ": 11")], len(GOOD) + 1, "is not a known fault"),
        (
            [*GOOD, GOOD[-3].replace("voice-failed", "x").replace(": 7", ": 11")],
            len(GOOD) + 1,
            "is not a known fault",
        ),
    ],
)
def test_an_invalid_recording_is_refused_with_line_and_reason(
    read: Callable[[str | bytes], SessionRecording], lines: Any, row: int, part: str
) -> None:
    with pytest.raises(RealizerError) as refused:
        read("".join(line + "\n" for line in lines))
    assert refused.value.fault.details["row"] == row
    assert part in str(refused.value)


def test_invalid_utf_8_is_refused_with_its_line(read: Callable[[str | bytes], SessionRecording]) -> None:
    with pytest.raises(RealizerError, match="line 2: not valid JSON"):
        read(GOOD[0].encode() + b"\n\xff\xff\n")


@pytest.fixture
def parts(tmp_path: Path) -> list[Path]:
    """The session, recorded into parts, of which each is followed by another one after a tick or an answer."""
    with closing(RecordingParts(tmp_path / "session.jsonl", 300)) as parts:
        record(SESSION, parts.write)
    return [tmp_path / "session.jsonl", *(tmp_path / f"session.{number}.jsonl" for number in range(2, 8))]


def test_a_recording_in_parts_is_read_as_one_session(parts: list[Path]) -> None:
    assert list(read_recording(parts[0]).ticks) == SESSION


def test_parts_of_a_longer_session_before_are_not_read(parts: list[Path]) -> None:
    with closing(RecordingParts(parts[0], 300)) as shorter:
        record(SESSION[:1], shorter.write)
    assert list(read_recording(parts[0]).ticks) == SESSION[:1]


def test_a_session_that_ends_while_a_part_begins_is_read_to_there(parts: list[Path]) -> None:
    *_, before, last = parts
    text = last.read_bytes()
    for size in range(text.index(b"\n") + 1, len(text)):
        last.write_bytes(text[:size])
        assert list(read_recording(parts[0]).ticks) == SESSION[:-1]
    last.unlink()
    before.write_bytes(before.read_bytes()[:-1])  # without the end of the line that names the last part
    assert list(read_recording(parts[0]).ticks) == SESSION[:-1]


def test_a_missing_part_is_named(parts: list[Path]) -> None:
    parts[2].unlink()
    with pytest.raises(FileNotFoundError, match="session"):
        read_recording(parts[0])


def test_parts_that_do_not_belong_together_are_refused(parts: list[Path]) -> None:
    text = parts[2].read_text()
    parts[2].write_text(text.replace("1234.5", "1234.6"))
    with pytest.raises(RealizerError, match="line 1: this file is part of another recording"):
        read_recording(parts[0])
    parts[2].write_text(text.replace('"part": 4', '"part": 5'))
    with pytest.raises(RealizerError, match="line 3: part 5 follows part 3"):
        read_recording(parts[0])


async def test_a_full_disk_ends_the_recording_and_not_the_session(caplog: pytest.LogCaptureFixture) -> None:
    options, room = SceneOptions(voice="text"), [True] * 2

    def write(_: str) -> None:
        if not room:
            raise OSError("no space left")
        room.pop()

    async with open_scene(options) as scene:
        scene.realizer.record(Recorder(write, options, 0.0))
        tick = None
        for number in range(200):
            tick = Tick.following(tick, number)
            await scene.realizer.step(tick)
        assert scene.realizer.time == 1.99
    assert [record.message for record in caplog.records] == ["recording has stopped: no space left"]
