"""docs/human.md: its example plays, and its tables match the code."""

import re
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.human_file import CharacterSpec, read_human_file
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import open_pilot

from .conftest import EXAMPLES, fences, page

HUMAN, BLOCKS = EXAMPLES / "two_characters.toml", EXAMPLES / "two_characters.xml"


async def test_both_characters_play_and_one_waits_for_the_speech_of_the_other() -> None:
    async with open_pilot(SceneOptions(HUMAN, "text")) as pilot:
        pilot.watch()
        pilot.perform(BLOCKS.read_bytes())
        await pilot.advance(6)
        told = pilot.feedback
        assert told.warnings == []
        assert (told.status("ask"), told.status("answer")) == ("DONE", "DONE")
        assert told.time("answer:nod:start") == told.time("ask:words:end")
        assert told.time("answer:words:start") == pytest.approx(told.time("ask:words:end") + 0.3)
        for frames in (pilot.frames["alice"], pilot.frames["bert"]):
            assert max(abs(frame.rotations - frames[0].rotations).max() for frame in frames) > 0.1


async def test_a_file_in_the_folder_of_the_user_is_a_new_pose(tmp_path: Path) -> None:
    file = fences("docs/human.md", "xml")[1]
    (tmp_path / "postures").mkdir()
    (tmp_path / file.note).write_text(file.text, encoding="utf-8")
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,))) as pilot:
        pilot.watch()
        pilot.block("b", '<posture id="p" start="0" end="4"><pose part="HEAD" lexeme="HEAD_BOWED"/></posture>')
        await pilot.advance(5)
        assert pilot.feedback.warnings == []
        joints = pilot.realizer.characters["alice"].humanoid.avatar.skeleton.joints
        nods = np.array([frame.rotations[joints.index("skullbase")][1] for frame in pilot.frames["alice"]])
        assert 2 * np.arcsin(nods.max()) == pytest.approx(0.3, abs=0.02)
        assert abs(nods[-1]) < 0.01


async def test_nothing_moves_without_idle_animation(tmp_path: Path) -> None:
    human = tmp_path / "human.toml"
    human.write_text("[character.alice]\nidle = false\n", encoding="utf-8")
    async with open_pilot(SceneOptions(human, "text")) as pilot:
        pilot.watch()
        await pilot.advance(20)
        first, *others = pilot.frames["alice"]
        assert all((frame.rotations == first.rotations).all() for frame in others)
        assert all((frame.weights == first.weights).all() for frame in others)


async def test_the_autonomous_behaviors_of_the_page_come_by_themselves_and_at_their_event(tmp_path: Path) -> None:
    (example,) = (fence for fence in fences("docs/human.md", "toml") if fence.note == "autonomous.toml")
    (tmp_path / example.note).write_text(example.text, encoding="utf-8")
    async with open_pilot(SceneOptions(tmp_path / example.note, "text")) as pilot:
        pilot.predict("partner", "pause", 3.0)
        await pilot.advance(46)
        assert pilot.feedback.time("listen.autonomous.1:nod:start") == pytest.approx(3.0, abs=0.02)
        assert 15.0 <= pilot.feedback.time("sigh.autonomous.1:sigh:start") <= 45.0
        assert pilot.feedback.warnings == []


def test_the_page_shows_the_files_of_the_example() -> None:
    assert fences("docs/human.md", "toml")[0].text == HUMAN.read_text(encoding="utf-8")
    assert fences("docs/human.md", "xml")[0].text == BLOCKS.read_text(encoding="utf-8")


def test_the_table_lists_every_key_of_a_character() -> None:
    rows = re.findall(r"^\| `(\w+)` \|", page("docs/human.md"), re.MULTILINE)
    assert rows == [each.name for each in fields(CharacterSpec)]


@pytest.mark.parametrize("name", ["docs/gesture.md", "docs/human.md"])
def test_every_human_file_on_a_page_can_be_read(name: str, tmp_path: Path) -> None:
    examples = fences(name, "toml")
    assert examples
    for example in examples:
        file = tmp_path / "human.toml"
        file.write_text(example.text, encoding="utf-8")
        assert read_human_file(file).characters
