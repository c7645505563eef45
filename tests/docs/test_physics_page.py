"""docs/physics.md: its blocks play without warnings, its file is read, and its tables name what there is."""

import re
from importlib.resources import files
from pathlib import Path

import pytest
from lxml import etree

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.physics.controllers.catalog import CONTROLLERS, new_controller
from reactive_realizer.testing.pilot import open_pilot

from .conftest import Fence, fences, page

PAGE = "docs/physics.md"
BLOCKS = [fence for fence in fences(PAGE, "xml") if not fence.note]
ROWS = dict(re.findall(r"^\| `(\w+Controller)` \|(.*)\|$", page(PAGE), re.MULTILINE))


@pytest.mark.parametrize("example", BLOCKS, ids=str)
async def test_every_block_plays_without_warnings(example: Fence) -> None:
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.block("talk", '<gesture id="g" lexeme="OFFER" mode="LEFT_HAND" start="0"/>')
        await pilot.advance(0.5)
        pilot.perform(example.text)
        await pilot.advance(6)
        assert pilot.feedback.warnings == []
        assert pilot.feedback.of("fall") == []


async def test_the_file_is_played_by_its_name(tmp_path: Path) -> None:
    (file,) = (fence for fence in fences(PAGE, "xml") if fence.note == "file")
    (tmp_path / "controllers").mkdir()
    (tmp_path / "controllers" / "hang.xml").write_text(file.text)
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,))) as pilot:
        pilot.watch()
        pilot.block("b", '<bmlt:controller id="x" class="CompoundController" name="hang"/>')
        await pilot.advance(1)
        assert pilot.feedback.warnings == []
        assert pilot.bodies()[0].rotation("r_elbow") != pilot.bodies()[-1].rotation("r_elbow")


def test_every_controller_is_in_the_table_with_its_parameters() -> None:
    assert set(ROWS) == {*CONTROLLERS, "CompoundController"}
    skeleton = Avatar.read(Path(str(files("reactive_realizer"))) / "assets/avatars/female.glb").skeleton
    for kind in CONTROLLERS:
        controller = new_controller(kind, {"joint": "l_elbow"}, skeleton)
        for name, value in controller.parameters.items():
            if name[-1] not in "yz":
                assert re.search(rf"`{name}`[^`]* ?\({value:g}\)|`{name}` \({value:g}\)", ROWS[kind]), name


async def test_the_fall_has_the_form_on_the_page() -> None:
    (shown,) = re.findall(r"^ {4}(<fall .*/>)$", page(PAGE), re.MULTILINE)
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.block("stand", '<bmlt:controller id="legs" class="BalanceController" start="0"/>')
        await pilot.advance(0.5)
        pilot.push("vt10", (0.0, 0.0, 400.0), 0.5)
        await pilot.advance(2)
        (fall,) = pilot.feedback.of("fall")
    form = etree.fromstring(shown)
    form.set("globalTime", fall.element.attrib["globalTime"])
    assert etree.tostring(fall.element) == etree.tostring(form)
