"""When a scene closes, the processes of its voice have ended, whatever they were doing."""

import asyncio
import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.engines.speech.piper.voice import PLACE, PiperVoice
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .piper_files import write_voice

LONG = "one two three four five six seven eight nine ten, " * 20

pytestmark = pytest.mark.piper


def workers() -> set[int]:
    """The processes that were started by this one and run a part of the realizer."""
    found = set()
    for entry in Path("/proc").iterdir():
        try:
            parent = entry.joinpath("stat").read_text("utf-8").rpartition(")")[2].split()[1]
            if int(parent) == os.getpid() and b"reactive_realizer" in entry.joinpath("cmdline").read_bytes():
                found.add(int(entry.name))
        except (OSError, IndexError):
            continue  # no process, or one that has just ended
    return found


@pytest.fixture
def options(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[SceneOptions]:
    """A scene with a tiny network; whatever is left after it is ended."""
    write_voice(tmp_path)
    monkeypatch.setenv(PLACE, str(tmp_path))
    before = workers()
    yield SceneOptions(voice="piper")
    left = workers() - before
    for pid in left:
        os.kill(pid, signal.SIGKILL)
    assert not left


async def speaking(pilot: RealizerPilot) -> PiperVoice:
    """The voice of a scene while it makes the parts of a speech that has begun."""
    pilot.patient = False
    pilot.block("b", f'<speech id="s"><text>{LONG}</text></speech>')
    while not pilot.feedback.reached("b:s:start"):
        await pilot.tick()
        await asyncio.sleep(0.001)
    assert pilot.realizer.busy
    assert isinstance(pilot.scene.tts, PiperVoice)
    return pilot.scene.tts


async def test_while_a_speech_is_made_in_parts(options: SceneOptions) -> None:
    async with open_pilot(options) as pilot:
        await speaking(pilot)
        assert len(workers()) == 2, "the dictionary and the network"


async def test_while_a_killed_worker_is_replaced(options: SceneOptions) -> None:
    async with open_pilot(options) as pilot:
        voice = await speaking(pilot)
        killed = voice.worker.process
        assert killed
        os.kill(killed.pid, signal.SIGKILL)
        await killed.ended
        pilot.block("again", f'<speech id="s"><text>Again, {LONG}</text></speech>')
        while not voice.worker.restarts:
            await pilot.tick()
            await asyncio.sleep(0)
        new = voice.worker.process
        assert new is killed or (new and not new.hello.done()), "the new one is not ready yet"
