"""A session on the air, recorded and played again."""

import asyncio
import json
import logging
from pathlib import Path
from typing import Any

import aiohttp
import numpy as np
import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.clock.clock import SystemClock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.feedback.feedback_manager import Report
from reactive_realizer.server import serve as serving
from reactive_realizer.server.feedback_log import with_posix_times
from reactive_realizer.server.recording import read_recording
from reactive_realizer.server.serve import ServerOptions, serve
from reactive_realizer.testing.pilot import block

SPEECH = '<speech id="s"><text>Well <sync id="m"/>then, one two three.</text></speech>'
BEAT = '<gesture id="g" lexeme="BEAT" stroke="s:m"/>'


class HastyClock(SystemClock):
    """Goes six times as fast as it waits, so that ticks are left out all the time."""

    def now(self) -> GlobalTime:
        return GlobalTime(6 * super().now())


class Address(logging.Handler):
    """Hands out where a server is."""

    def __init__(self) -> None:
        super().__init__()
        self.said: asyncio.Future[str] = asyncio.get_running_loop().create_future()

    def emit(self, record: logging.LogRecord) -> None:
        if not self.said.done() and "serving on" in record.getMessage():
            self.said.set_result(record.getMessage().rpartition(" ")[2])


async def live_session(options: ServerOptions) -> list[tuple[float, str]]:
    """Talks to a server in many ways; all feedback, as time and XML."""
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
    async with http.ws_connect("/ws?after=0") as socket:

        async def hear(part: str) -> None:
            async for message in socket:
                said = message.json() if message.type is aiohttp.WSMsgType.TEXT else {}
                if said.get("type") == "feedback":
                    told.append((said["time"], said["xml"]))
                    if part in said["xml"]:
                        return

        await socket.send_json({"type": "bml", "xml": block("one", SPEECH + BEAT)})
        await hear('"one:start"')
        await socket.send_json({"type": "event", "anticipator": "metronome", "event": "tempo", "value": 150})
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


def replayed(recording: Path, folder: Path, name: str) -> tuple[list[tuple[float, str]], dict[str, bytes]]:
    feedback, frames = folder / f"{name}.jsonl", folder / f"{name}.npz"
    # A block of the session was refused: that is 1, as with files.
    assert main(["realize", "--replay", str(recording), "--feedback", str(feedback), "--frames", str(frames)]) == 1
    lines = map(json.loads, feedback.read_text().splitlines())
    arrays = np.load(frames)
    return [(line["time"], line["xml"]) for line in lines], {key: arrays[key].tobytes() for key in arrays}


@pytest.mark.parametrize("voice", ["text", pytest.param("espeak", marks=pytest.mark.speech)])
def test_a_live_session_with_late_ticks_is_the_same_again_to_the_last_byte(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture, voice: str
) -> None:
    monkeypatch.setattr(serving, "SystemClock", HastyClock)
    caplog.set_level(logging.INFO, serving.__name__)
    file = tmp_path / "session.jsonl"
    told = asyncio.run(live_session(ServerOptions(port=0, scene=SceneOptions(voice=voice), record=file)))
    recording = read_recording(file)
    ticks = [entered.tick for entered in recording.ticks]
    assert ticks[-1] > 1.5 * len(ticks), "ticks were left out"
    assert any(entered.work for entered in recording.ticks) == (voice == "espeak")

    feedback, frames = replayed(file, tmp_path, "one")
    message: Any = None  # only the XML is read
    reports = [Report(GlobalTime(time), message, xml) for time, xml in feedback]
    stamped = [(report.time, with_posix_times(report, recording.started)) for report in reports]
    assert stamped == told
    assert len(told) > 30
    assert replayed(file, tmp_path, "two") == (feedback, frames)
    main(["realize", "--replay", str(file), "--feedback", str(tmp_path / "unseen.jsonl")])
    assert (tmp_path / "unseen.jsonl").read_bytes() == (tmp_path / "one.jsonl").read_bytes(), "whoever looks on"


def test_without_a_recording_and_without_items_there_is_nothing_to_realize(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["realize"])
    assert ended.value.code == 2
    assert "--replay" in capsys.readouterr().err


@pytest.mark.parametrize("beside", [["a.xml"], ["--voice", "text"], ["--seed", "3"], ["--clock", "real"]])
def test_what_a_recording_has_itself_cannot_be_said_beside_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], beside: list[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["realize", "--replay", str(tmp_path / "session.jsonl"), *beside])
    assert ended.value.code == 2
    assert "the recording sets them" in capsys.readouterr().err


def test_a_recording_that_is_not_there_is_2(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["realize", "--replay", "no-such-file.jsonl"]) == 2
    assert "no-such-file.jsonl" in capsys.readouterr().err


def test_a_file_that_is_no_recording_is_2_and_one_line_says_where(
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
