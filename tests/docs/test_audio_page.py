"""docs/audio.md: its blocks play without warnings."""

import re
from pathlib import Path
from textwrap import dedent

import numpy as np
import pytest
import soundfile

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.audio import AudioStart
from reactive_realizer.testing.pilot import open_pilot

from .conftest import Fence, fences, page

PAGE = "docs/audio.md"
BLOCKS = fences(PAGE, "xml")


@pytest.fixture
def assets(tmp_path: Path) -> Path:
    """The folder with the files of the page."""
    (tmp_path / "sounds").mkdir()
    for name in ("clap", "welcome"):
        soundfile.write(tmp_path / "sounds" / f"{name}.wav", np.zeros(16_000), 8000)
    times, *_ = re.findall(r"^ +```json\n(.*?)```", page(PAGE), re.MULTILINE | re.DOTALL)
    (tmp_path / "sounds" / "welcome.json").write_text(dedent(times))
    return tmp_path


@pytest.mark.parametrize("example", BLOCKS, ids=str)
async def test_every_block_plays_a_sound_without_warnings(example: Fence, assets: Path) -> None:
    async with open_pilot(SceneOptions(voice="text", assets=(assets,))) as pilot:
        pilot.perform(example.text)
        if example.note == "streamed":
            pilot.stream("reply-1", bytes(48_000), ("Good", 0.1), ("morning", 0.4), ("everybody", 0.8), end=True)
        await pilot.advance(6)
        assert pilot.feedback.warnings == []
        assert [type(change) for change in pilot.sounds] == [AudioStart]


async def test_the_words_of_the_recording_have_the_times_on_the_page(assets: Path) -> None:
    example = next(each for each in BLOCKS if "rr:words" in each.text)
    async with open_pilot(SceneOptions(voice="text", assets=(assets,))) as pilot:
        pilot.perform(example.text)
        await pilot.advance(6)
        start, words = pilot.feedback.time("welcome:words:start"), ("word0", "word1", "word2", "all")
        times = [pilot.feedback.time(f"welcome:words:{word}") - start for word in words]
        assert times == pytest.approx([0.12, 0.35, 0.95, 0.95])
