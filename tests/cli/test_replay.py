"""Recording a served session, and replaying it."""

import asyncio
import json
import logging
import struct
from pathlib import Path

import aiohttp
import numpy as np
import pytest
from lxml import etree

from reactive_realizer.__main__ import main
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.clock.clock import SystemClock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioHeard
from reactive_realizer.feedback.xml import add_posix_times
from reactive_realizer.server import serve as serving
from reactive_realizer.server.recording import read_recording
from reactive_realizer.server.serve import ServerOptions, serve
from reactive_realizer.testing.pilot import block

SPEECH = '<speech id="s"><text>Well <sync id="m"/>then, one two three.</text></speech>'
BEAT = '<gesture id="g" lexeme="BEAT" stroke="s:m"/>'


class HastyClock(SystemClock):
    """A clock that is six times as fast as its waits, so that ticks are late."""

    def now(self) -> GlobalTime:
        return GlobalTime(6 * super().now())


class Address(logging.Handler):
    """Keeps the address that the server prints."""

    def __init__(self) -> None:
        super().__init__()
        self.said: asyncio.Future[str] = asyncio.get_running_loop().create_future()

    def emit(self, record: logging.LogRecord) -> None:
        if not self.said.done() and "serving on" in record.getMessage():
            self.said.set_result(record.getMessage().rpartition(" ")[2])


async def live_session(options: ServerOptions) -> list[tuple[float, str]]:
    """Sends all kinds of messages to a server; its feedback as (time, XML)."""
    logger, address = logging.getLogger(serving.__name__), Address()
    logger.addHandler(address)
    try:
        async with asyncio.TaskGroup() as group:
            server = group.create_task(serve(options))
            async with aiohttp.ClientSession(await address.said) as http:
                told = await talk(http)
            server.cancel()
    finally:
        logger.removeHandler(address)
    return told


async def talk(http: aiohttp.ClientSession) -> list[tuple[float, str]]:
    told: list[tuple[float, str]] = []
    sounds: dict[str, float] = {}
    async with http.ws_connect("/ws?after=0") as socket:

        async def report_sounds(frame: bytes) -> None:
            """Report every fifth frame that each sound is heard 0.2 s late."""
            number, time = struct.unpack_from("<Id", frame, 4)
            for id_, start in sounds.items() if number % 5 == 0 else ():
                if 0 <= (position := time - start - 0.2) <= 1.0:
                    await socket.send_json({"type": "heard", "id": id_, "position": position, "time": time})

        async def hear(part: str) -> None:
            async for message in socket:
                if message.type is aiohttp.WSMsgType.BINARY:
                    await report_sounds(message.data)
                said = message.json() if message.type is aiohttp.WSMsgType.TEXT else {}
                if said.get("type") == "audio":
                    sounds[said["id"]] = said["start"]
                if said.get("type") == "feedback":
                    told.append((said["time"], said["xml"]))
                    if part in said["xml"]:
                        return

        keyed = '<head id="h" lexeme="NOD" start="anticipators:spacebar:press+0.1"/>'
        beats = '<head id="i" lexeme="SHAKE" start="anticipators:metronome:tick4"/>'
        await socket.send_json({"type": "bml", "xml": block("keyed", keyed) + block("beats", beats)})
        await socket.send_json({"type": "bml", "xml": block("one", SPEECH + BEAT)})
        await hear('"one:start"')
        await socket.send_json({"type": "event", "anticipator": "metronome", "event": "tempo", "value": 150})
        await socket.send_json({"type": "event", "anticipator": "spacebar", "event": "press"})
        await socket.send_json({"type": "predict", "anticipator": "partner", "sync": "hit", "in": 2.0})
        await socket.send_json({"type": "world", "set": {"bluebox": [-1, 1.2, 1.5], "greensphere": None}})
        hit = block("hit", '<gesture id="g" lexeme="BEAT" stroke="anticipators:partner:hit"/>', composition="APPEND")
        await http.post("/bml", data=hit.encode(), headers={"Content-Type": "application/xml"})
        await hear('"one:end"')
        await socket.send_json({"type": "predict", "anticipator": "partner", "sync": "hit", "in": 1.5})
        await hear('"hit:end"')
        await socket.send_json({"type": "bml", "xml": block("cut", SPEECH) + "<bml id='bad'><oops></bml>"})
        await hear('"cut:s:m"')
        await http.post("/stop")
        await hear('"stop-1:end"')
    return told


def stamped(xml: str, epoch: float) -> str:
    element = etree.fromstring(xml)
    add_posix_times(element, epoch)
    return etree.tostring(element, encoding="unicode")


def replayed(recording: Path, folder: Path, name: str) -> tuple[list[tuple[float, str]], dict[str, bytes]]:
    feedback, frames = folder / f"{name}.jsonl", folder / f"{name}.npz"
    # The exit status is 1, because a block of the session was refused.
    assert main(["realize", "--replay", str(recording), "--feedback", str(feedback), "--frames", str(frames)]) == 1
    lines = map(json.loads, feedback.read_text().splitlines())
    arrays = np.load(frames)
    return [(line["time"], line["xml"]) for line in lines], {key: arrays[key].tobytes() for key in arrays}


@pytest.mark.parametrize("voice", ["text", pytest.param("espeak", marks=pytest.mark.speech)])
def test_a_recorded_session_with_late_ticks_is_replayed_with_identical_bytes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture, voice: str
) -> None:
    monkeypatch.setattr(serving, "SystemClock", HastyClock)
    caplog.set_level(logging.INFO, serving.__name__)
    file = tmp_path / "session.jsonl"
    options = ServerOptions(port=0, scene=SceneOptions(voice=voice, liveliness=0.8), record=file, record_bytes=2_000)
    told = asyncio.run(live_session(options))
    assert list(tmp_path.glob("session.*.jsonl"))
    recording = read_recording(file)
    ticks = [entered.tick for entered in recording.ticks]
    assert ticks[-1] > 1.5 * len(ticks), "ticks were left out"
    assert any(entered.work for entered in recording.ticks) == (voice == "espeak")
    heard = [entry for entered in recording.ticks for entry in entered.inputs if isinstance(entry, AudioHeard)]
    assert bool(heard) == (voice == "espeak")

    feedback, frames = replayed(file, tmp_path, "one")
    assert [(time, stamped(xml, recording.started)) for time, xml in feedback] == told
    assert len(told) > 30
    assert any(".lively" in xml for _, xml in told)
    assert replayed(file, tmp_path, "two") == (feedback, frames)
    main(["realize", "--replay", str(file), "--feedback", str(tmp_path / "unseen.jsonl")])
    assert (tmp_path / "unseen.jsonl").read_bytes() == (tmp_path / "one.jsonl").read_bytes(), "whoever looks on"


def test_realize_needs_a_recording_or_items(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["realize"])
    assert ended.value.code == 2
    assert "--replay" in capsys.readouterr().err


@pytest.mark.parametrize("beside", [["a.xml"], ["--voice", "text"], ["--seed", "3"], ["--clock", "real"]])
def test_options_that_a_recording_contains_cannot_be_given_with_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], beside: list[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["realize", "--replay", str(tmp_path / "session.jsonl"), *beside])
    assert ended.value.code == 2
    assert "the recording sets them" in capsys.readouterr().err


def test_the_exit_status_is_2_for_a_missing_recording(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["realize", "--replay", "no-such-file.jsonl"]) == 2
    assert "no-such-file.jsonl" in capsys.readouterr().err


def test_the_exit_status_is_2_for_an_invalid_recording_with_one_line_of_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "session.jsonl"
    file.write_text("<bml/>\n")
    assert main(["realize", "--replay", str(file)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("session.jsonl, line 1: not valid JSON")


def test_a_recording_that_cannot_be_written_keeps_the_server_from_starting(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["serve", "--port", "0", "--voice", "text", "--record", str(tmp_path / "none" / "session.jsonl")]) == 2
    assert "session.jsonl" in capsys.readouterr().err
