"""docs/anticipators.md: its examples behave as described, and its plug-ins are found and predict."""

import asyncio
import json
from collections.abc import AsyncIterator
from pathlib import Path

import pytest
from lxml import etree

from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions
from reactive_realizer.realizer.inputs import TickInputs
from reactive_realizer.realizer.session import replay
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .conftest import EXAMPLES, Fence, fences
from .installing import install

PLUGIN = EXAMPLES / "anticipator"


@pytest.fixture
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install(PLUGIN, tmp_path, monkeypatch)


@pytest.mark.usefixtures("installed")
async def test_the_answer_starts_at_the_predicted_end_of_the_turn_and_waits_while_it_is_unknown() -> None:
    async with open_pilot(SceneOptions(PLUGIN / "human.toml", "text")) as pilot:
        pilot.perform((PLUGIN / "reply.xml").read_bytes())
        await pilot.advance(1)
        pilot.event("user", "pause")
        await pilot.advance(0.1)
        assert pilot.feedback.predicted("reply:words:start") == pytest.approx(1.6)
        pilot.event("user", "voice")
        await pilot.advance(1.9)
        assert not pilot.feedback.reached("reply:words:start")
        pilot.event("user", "pause")
        await pilot.advance(3)
        assert pilot.feedback.time("reply:listening:start") == pytest.approx(3.2)
        assert pilot.feedback.time("reply:words:start") == pytest.approx(3.6)
        assert pilot.feedback.status("reply") == "DONE"
        assert pilot.feedback.warnings == []


@pytest.mark.usefixtures("installed")
async def test_a_custom_turn_model_replaces_the_built_in_one(tmp_path: Path) -> None:
    human = tmp_path / "human.toml"
    human.write_text('[character.alice]\n[anticipator.user]\nkind = "patient_stop"\n', encoding="utf-8")
    async with open_pilot(SceneOptions(human, "text")) as pilot:
        pilot.block("b", '<head id="nod" lexeme="NOD" start="anticipators:user:stop"/>')
        pilot.event("user", "words", text="I have thought about it")
        await pilot.advance(4)
        assert pilot.feedback.predicted("b:nod:start") == pytest.approx(5.0)
        pilot.event("user", "words", text="I have thought about it, over.")
        await pilot.advance(3)
        assert pilot.feedback.time("b:nod:start") == pytest.approx(4.3)


@pytest.mark.usefixtures("installed")
async def test_an_anticipator_that_is_fed_by_a_socket_predicts_and_is_recorded_with_its_end(tmp_path: Path) -> None:
    connected: asyncio.Queue[asyncio.StreamWriter] = asyncio.Queue()
    server = await asyncio.start_server(lambda _, writer: connected.put(writer), "127.0.0.1", 0)
    human = tmp_path / "human.toml"
    port = server.sockets[0].getsockname()[1]
    human.write_text(f'[character.alice]\n[anticipator.sound]\nkind = "detector"\nport = {port}\n', encoding="utf-8")
    session: list[TickInputs] = []

    async def hear(line: str) -> None:
        """Send a line, and wait until it has arrived."""
        detector.write(line.encode())
        await asyncio.sleep(0.05)

    async with open_pilot(SceneOptions(human, "text")) as pilot:
        pilot.realizer.record(session.append)
        pilot.block("b", '<head id="nod" lexeme="NOD" stroke="anticipators:sound:clap"/>')
        await pilot.tick()
        detector = await connected.get()
        await hear("1.5\n")
        await pilot.advance(0.5)
        await hear("1.2\n")
        await pilot.advance(0.1)
        await hear("soon\n")
        await pilot.advance(3)
        told = [(line.time, etree.tostring(line.element)) for line in pilot.feedback.messages]
        assert pilot.feedback.time("b:nod:stroke") == pytest.approx(1.7)
        assert "ValueError: could not convert string to float" in pilot.feedback.of("warningFeedback")[0].text
    detector.close()
    server.close()
    async with open_pilot(SceneOptions(human, "text")) as again:
        await replay(again.realizer, session)
        assert [(line.time, etree.tostring(line.element)) for line in again.feedback.messages] == told


def test_the_page_shows_the_files_of_the_example() -> None:
    simple, fed, replaced = [fence for fence in fences("docs/anticipators.md", "python") if not fence.note]
    block = plug_in("xml")
    entry_points, human = plug_in("toml")
    assert simple.text == (PLUGIN / "turn_end.py").read_text(encoding="utf-8")
    assert fed.text == (PLUGIN / "detector.py").read_text(encoding="utf-8")
    assert replaced.text == (PLUGIN / "patient_stop.py").read_text(encoding="utf-8")
    assert block[0].text == (PLUGIN / "reply.xml").read_text(encoding="utf-8")
    assert entry_points.text in (PLUGIN / "pyproject.toml").read_text(encoding="utf-8")
    assert human.text in (PLUGIN / "human.toml").read_text(encoding="utf-8")


# --- those that are there


def plug_in(language: str) -> list[Fence]:
    return [fence for fence in fences("docs/anticipators.md", language) if fence.note == "plug-in"]


def ready(language: str) -> list[Fence]:
    return [fence for fence in fences("docs/anticipators.md", language) if not fence.note]


@pytest.fixture
async def pilot(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    """The default scene with the anticipators of the page."""
    human = tmp_path / "human.toml"
    human.write_text(DEFAULT_HUMAN.read_text("utf-8") + "".join(fence.text for fence in ready("toml")), "utf-8")
    async with open_pilot(SceneOptions(human, "text")) as pilot:
        for block in ready("xml"):
            pilot.perform(block.text)
        yield pilot


async def test_the_gesture_of_the_page_follows_the_key(pilot: RealizerPilot) -> None:
    await pilot.advance(1)
    pilot.event("spacebar", "press")
    await pilot.advance(0.3)
    pilot.event("spacebar", "release")
    await pilot.advance(0.1)
    pilot.event("spacebar", "release")
    await pilot.advance(3)
    assert pilot.feedback.time("agree:nod:start") == pytest.approx(1.0)
    assert pilot.feedback.time("agree:yes:start") == pytest.approx(1.5)
    assert pilot.feedback.status("agree") == "DONE"


@pytest.mark.parametrize(
    ("words", "silence"), [("", 0.88), ("I live in a house.", 0.19), ("I live in a", 1.76)], ids=str
)
async def test_the_answer_starts_after_the_silence_that_the_page_gives(
    pilot: RealizerPilot, words: str, silence: float
) -> None:
    pilot.event("user", "voice", 1.0)
    pilot.event("user", "words", text=words)
    await pilot.advance(1)
    pilot.event("user", "voice", 0.0)
    await pilot.advance(4)
    assert pilot.feedback.time("reply:words:start") == pytest.approx(1 + silence + 0.2, abs=0.01)


async def test_the_trainer_moves_ahead_of_the_user(pilot: RealizerPilot) -> None:
    while pilot.now < 8:
        phase = pilot.now % 2  # down at every odd second, up 0.6 s later
        pilot.event("trainee", "sample", 18.0 if 1.0 <= phase < 1.1 or 1.6 <= phase < 1.7 else 9.81)
        await pilot.tick()
    assert pilot.feedback.time("ahead:push:stroke") == pytest.approx(4.7, abs=0.05)


async def test_the_conductor_follows_the_orchestra(pilot: RealizerPilot) -> None:
    for _ in range(10):
        pilot.event("orchestra", "beat")
        await pilot.advance(0.8)
    await pilot.advance(3)
    assert pilot.feedback.time("conduct:four:stroke") == pytest.approx(2.4)
    assert pilot.feedback.time("conduct:eight:stroke") == pytest.approx(5.6)
    assert pilot.feedback.status("conduct") == "DONE"


async def test_the_listener_moves_with_the_foot_of_the_user(pilot: RealizerPilot) -> None:
    for _ in range(3):
        pilot.event("foot", "tap")
        await pilot.advance(0.8)
    await pilot.advance(1)
    assert pilot.feedback.time("along:with:stroke") == pytest.approx(1.6)


async def test_the_listener_nods_seven_tenths_of_a_second_after_the_voice_has_become_low(pilot: RealizerPilot) -> None:
    while pilot.now < 2:
        pilot.event("voice", "pitch", 200.0 if pilot.now < 1.2 else 150.0)
        await pilot.tick()
    await pilot.advance(1)
    assert pilot.feedback.time("attention:listening:start") == pytest.approx(1.2 + 0.11 + 0.7)


async def test_every_event_on_the_page_is_accepted_by_its_anticipator(pilot: RealizerPilot) -> None:
    for fence in ready("json"):
        message = json.loads(fence.text)
        if message["type"] == "event":
            anticipator = pilot.realizer.anticipators[message["anticipator"]]
            if "text" in message:
                anticipator.check_heard(message["event"])
            else:
                anticipator.check(message["event"], message.get("value"))
