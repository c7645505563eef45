"""docs/face.md: its examples play, and its tables match the code."""

import json
import re
from pathlib import Path

import pytest

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.engines.face.face_shapes import KINDS
from reactive_realizer.testing.pilot import open_pilot

from .conftest import Fence, fences, page

PAGE = "docs/face.md"


@pytest.mark.parametrize("example", [fence for fence in fences(PAGE, "xml") if not fence.note], ids=str)
async def test_an_example_plays_without_a_warning(example: Fence) -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(example.text)
        await pilot.advance(8)
        (block,) = re.findall(r'<bml [^>]*id="(\w+)"', example.text)
        assert pilot.feedback.warnings == []
        assert pilot.feedback.status(block) == "DONE"
        weights = [frame.weights for frame in pilot.frames["alice"]]
        assert max(weight.max() for weight in weights) > 0.2


@pytest.mark.parametrize(("folder", "block"), [("my_assets", "play"), ("greta", "document1")])
async def test_the_words_of_the_bindings_on_the_page_play(tmp_path: Path, folder: str, block: str) -> None:
    (tmp_path / folder).mkdir()
    for fence in fences(PAGE, "xml"):
        if fence.note.startswith(folder):
            (tmp_path / fence.note).write_text(fence.text, encoding="utf-8")
    assets = tmp_path / folder
    async with open_pilot(SceneOptions(voice="text", assets=(assets,))) as pilot:
        pilot.perform((assets / "block.xml").read_text("utf-8"))
        await pilot.advance(5)
        assert pilot.feedback.warnings == []
        assert pilot.feedback.status(block) == "DONE"


def test_the_page_lists_every_kind_of_face_unit() -> None:
    rows = re.findall(r"^\| `([A-Z]\w+)` \| [^|]* \| (.*) \|$", page(PAGE), re.MULTILINE)
    assert {kind: tuple(re.findall(r"`(\w+)`", names)) for kind, names in rows} == {
        name: kind.parameters for name, kind in KINDS.items()
    }


def test_the_wheel_on_the_page_is_that_of_the_table() -> None:
    angles, emotions = (
        re.findall(r"[\w.]+", row.partition("|")[2])
        for row in re.findall(r"^\| (?:angle|emotion) .*$", page(PAGE), re.MULTILINE)
    )
    table = json.loads((PACKAGE_ASSETS / "face" / "emotion_wheel.json").read_text("utf-8"))["emotions"]
    written = dict(zip(emotions[1:], map(float, angles[1:]), strict=True))
    assert written == {name.lower(): entry["angle"] for name, entry in table.items()}
