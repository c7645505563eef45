"""docs/plugins.md: its plug-ins are found, play, and pass their contracts outside of this repository."""

import asyncio
import os
import shutil
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from aiohttp.test_utils import unused_port

from reactive_realizer.__main__ import main
from reactive_realizer.assembly.registry import load, names
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.cli.bridge import bridge
from reactive_realizer.client.realizer_socket import RealizerSocket
from reactive_realizer.embodiment.audio import AudioGain
from reactive_realizer.errors import FAULTS
from reactive_realizer.testing.pilot import open_pilot

from .conftest import EXAMPLES, REPOSITORY, fences
from .installing import install

PAGE = "docs/plugins.md"
PLUGIN = EXAMPLES / "plugin"


@pytest.fixture
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install(PLUGIN, tmp_path, monkeypatch)


@pytest.mark.usefixtures("installed")
async def test_the_block_on_the_page_uses_the_engine_the_voice_and_the_trajectory() -> None:
    options = SceneOptions(PLUGIN / "human.toml", "beep", seed=1)  # without a blink meanwhile
    async with open_pilot(options) as pilot:
        pilot.watch()
        pilot.perform((PLUGIN / "wink.xml").read_bytes())
        await pilot.advance(3)
        told = pilot.feedback
        assert told.warnings == []
        assert told.status("hint") == "DONE"
        assert told.time("hint:eye:start") == told.time("hint:words:what") == pytest.approx(0.8)
        assert told.time("hint:eye:end") == told.time("hint:words:end") == pytest.approx(2.0)
        morphs = pilot.realizer.characters["alice"].humanoid.avatar.morphs
        lid = np.array([frame.weights[morphs.index("eyeBlinkLeft")] for frame in pilot.frames["alice"]])
        assert lid[40:100] == pytest.approx(1.0)
        assert lid[38] == lid[101] == 0.0
        gains = [change.gain for change in pilot.sounds if isinstance(change, AudioGain)]
        assert max(gains) > gains[-1] == pytest.approx(70 / 50)


@pytest.mark.usefixtures("installed")
async def test_the_motion_on_the_page_plays_an_element_of_its_own_and_its_degrees_may_change() -> None:
    async with open_pilot(SceneOptions(PLUGIN / "swaying.toml", "text", (PLUGIN,))) as pilot:
        pilot.watch()
        pilot.block(
            "b",
            '<sway xmlns="urn:example:wink" id="s" start="0.5" degrees="10"/><head id="h" lexeme="NOD" start="s:left"/>'
            '<bmla:parametervaluechange id="c" target="s" paramId="degrees" start="s:left + 0.5" end="s:left + 0.6">'
            '<bmla:trajectory type="linear" targetValue="0"/></bmla:parametervaluechange>',
        )
        await pilot.advance(4)
        told, head = pilot.feedback, pilot.path("skullbase")
        assert told.warnings == []
        assert told.time("b:h:start") == told.time("b:s:left") == pytest.approx(1.0)
        assert told.time("b:s:end") == pytest.approx(2.5)
        left, right = (head[round(50 * told.time(f"b:s:{point}")), 0] for point in ("left", "right"))
        assert left > 0.05
        assert abs(right) < 0.01


@pytest.mark.usefixtures("installed")
async def test_the_strategy_stretches_nothing_and_reports_dropped_constraints() -> None:
    async with open_pilot(SceneOptions(voice="text", strategy="earliest")) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="BEAT" start="1" end="9"/><head id="n" lexeme="NOD" start="g:end"/>')
        await pilot.advance(5)
        told = pilot.feedback
        assert told.warnings == [("b:g", "IMPOSSIBLE_TO_SCHEDULE")]
        assert told.time("b:g:start") == pytest.approx(1.0)
        assert told.time("b:n:start") == told.time("b:g:end") < 5.0


@pytest.mark.usefixtures("installed")
def test_the_command_line_accepts_plug_ins_by_name(capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--human", str(PLUGIN / "human.toml"), "--voice", "beep", "--strategy", "earliest", "--feedback", "-"]
    assert main(["realize", str(PLUGIN / "wink.xml"), *options]) == 0
    assert "hint:eye:end" in capsys.readouterr().out


@pytest.mark.usefixtures("installed")
@pytest.mark.parametrize("command", ["realize", "serve", "demo"])
def test_the_help_of_a_command_lists_plug_ins(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="0"):
        main([command, "--help"])
    told = capsys.readouterr().out
    assert "--voice {beep,captions,espeak,kokoro,piper,text}" in told
    assert "earliest" in told


@pytest.mark.usefixtures("installed")
def test_each_plug_in_is_found_under_its_name_on_the_page() -> None:
    for group, name in [("engines", "wink"), ("tts", "beep"), ("strategies", "earliest")]:
        assert name in names(group)
        assert load(group, name).__module__
    assert load("trajectories", "overshoot")(1.0) == pytest.approx(1.0)


@pytest.mark.usefixtures("installed")
async def test_the_engine_warns_of_behaviors_that_it_cannot_play() -> None:
    async with open_pilot(SceneOptions(PLUGIN / "human.toml", "text")) as pilot:
        pilot.block("b", '<wink xmlns="urn:example:wink" id="w" eye="third"/>')
        await pilot.advance(0.1)
        assert pilot.feedback.warnings == [("b:w", "CANNOT_CREATE_BEHAVIOR")]
        text = pilot.feedback.of("warningFeedback")[0].text
        assert "there is no eye 'third'; available: left, right" in text
        assert FAULTS["wink-no-such-eye"].warning == "CANNOT_CREATE_BEHAVIOR"


@pytest.mark.usefixtures("installed")
async def test_a_document_in_the_dialect_plays() -> None:
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.perform((PLUGIN / "greeting.cues").read_bytes())
        pilot.perform("#cues\n1 sing la")
        await pilot.advance(4)
        assert pilot.feedback.predicted("document1:cue2:end") > 0
        assert pilot.feedback.time("document1:cue3:start") == pytest.approx(0.3)
        assert pilot.feedback.time("document1:cue4:start") == pytest.approx(1.5)
        assert pilot.feedback.warnings == [("document2", "PARSING_FAILURE")]
        assert "line 2, column 1: '1 sing la' is not a cue" in pilot.feedback.of("warningFeedback")[0].text


@pytest.mark.usefixtures("installed")
def test_check_knows_a_file_by_its_content(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.xml").write_text("#cues\n0 nod\n1 sing la\n")
    assert main(["check", str(tmp_path / "a.xml")]) == 1
    assert capsys.readouterr().out.startswith(f"{tmp_path}/a.xml:3:1: '1 sing la' is not a cue")


@pytest.mark.usefixtures("installed")
async def test_the_bridge_on_the_page_has_lines_said(server: str) -> None:
    port = unused_port()
    async with asyncio.timeout(60), asyncio.TaskGroup() as group, RealizerSocket(server) as observer:
        bridging = group.create_task(bridge(f"lines --port {port}").run(server))
        writer = await opened(port)
        writer.write(b"Good & evil.\n")
        while '"line1:said:start"' not in (await observer.receive()).get("xml", ""):
            pass
        writer.close()
        bridging.cancel()


@pytest.mark.usefixtures("installed")
def test_the_command_bridge_has_the_bridge_on_the_page(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bridge", "lines", "http://127.0.0.1:9"]) == 2
    assert "no realizer can be reached at http://127.0.0.1:9" in capsys.readouterr().err


async def opened(port: int) -> asyncio.StreamWriter:
    """A connection to a port, as soon as somebody listens there."""
    while True:
        with suppress(ConnectionRefusedError):
            _, writer = await asyncio.open_connection("localhost", port)
            return writer


FEW = """
from hypothesis import settings

settings.register_profile("few", derandomize=True, max_examples=20)
settings.load_profile("few")
"""
"""Keeps the property tests of the examples short, and the same in every run."""


@pytest.mark.timeout(300)
def test_the_contract_tests_on_the_page_pass_in_a_separate_pytest(tmp_path: Path) -> None:
    for folder in ("plugin", "anticipator"):
        shutil.copytree(EXAMPLES / folder, tmp_path / "examples" / folder)
    (tmp_path / "few.py").write_text(FEW)
    plain = ["-p", "few", "-p", "no:asyncio", "-p", "no:cacheprovider", "-q"]
    (session,) = fences(PAGE, "console")
    command = session.text.splitlines()[-1].removeprefix("$ python ").split()
    environment = os.environ | {"PYTHONPATH": f"{REPOSITORY}:{tmp_path}", "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run(
        [sys.executable, *command, *plain], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout
    assert "skipped" not in done.stdout


def test_the_page_shows_the_files_of_the_examples() -> None:
    shown = [fence for language in ("python", "toml", "xml", "text") for fence in fences(PAGE, language) if fence.note]
    assert {fence.note for fence in shown if not fence.note.startswith("examples/anticipator")} == {
        f"examples/plugin/{path.name}" for path in PLUGIN.iterdir() if path.is_file() and path.name != "pyproject.toml"
    }
    for fence in shown:
        assert fence.text == (REPOSITORY / fence.note).read_text(encoding="utf-8"), fence
    entry_points, *_ = fences(PAGE, "toml")
    assert entry_points.text in (PLUGIN / "pyproject.toml").read_text(encoding="utf-8")


def test_the_page_lists_every_kind_of_plug_in() -> None:
    table = {
        line.split("`")[1] for line in (REPOSITORY / PAGE).read_text("utf-8").splitlines() if line.startswith("| [")
    }
    projects = ((folder / "pyproject.toml").read_text("utf-8") for folder in (REPOSITORY, PLUGIN))
    lines = [line for project in projects for line in project.splitlines()]
    assert table == {line.split('"')[1] for line in lines if line.startswith("[project.entry-points.")}
