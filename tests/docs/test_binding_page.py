"""docs/binding.md: its folder of assets plays, and its tables match the code."""

import re
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions
from reactive_realizer.binding.gestuary import AHEAD, OUTWARD, UPWARD
from reactive_realizer.binding.gesture_binding import MURML_TEXT, GestureBinding
from reactive_realizer.binding.unit_spec import CLASS_NAMES
from reactive_realizer.bml.murml.description import Scope
from reactive_realizer.engines.animation.motion_library import MAKERS
from reactive_realizer.engines.animation.motions.greta_hands import STAND_INS, TOUCHED
from reactive_realizer.engines.animation.motions.murml_files import read_murml_text
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .conftest import fences, page

PAGE = "docs/binding.md"
TEXT = page(PAGE)
PACKAGE = "asap.animationengine."


@pytest.fixture
def assets(tmp_path: Path) -> Path:
    """The folder of assets on the page."""
    folder = tmp_path / "my_assets"
    folder.mkdir()
    for fence in (*fences(PAGE, "xml"), *fences(PAGE, "text")):
        if fence.note.startswith("my_assets/"):
            (tmp_path / fence.note).write_text(fence.text, encoding="utf-8")
    return folder


async def play(assets: Path, *blocks: str) -> RealizerPilot:
    async with open_pilot(SceneOptions(DEFAULT_HUMAN, "text", (assets,))) as pilot:
        pilot.watch()
        for block in blocks:
            pilot.perform(block)
        await pilot.advance(10)
        return pilot


def moved(pilot: RealizerPilot, joint: str, behavior: str) -> float:
    """How far a joint went while a behavior played, m."""
    start, end = (round(50 * pilot.feedback.time(f"{behavior}:{point}")) for point in ("start", "end"))
    return float(np.ptp(pilot.path(joint)[start:end], axis=0).max())


async def test_the_block_on_the_page_plays_with_the_files_on_the_page(assets: Path) -> None:
    pilot = await play(assets, (assets / "block.xml").read_text("utf-8"))
    told = pilot.feedback
    assert told.warnings == []
    assert told.status("play") == "DONE"
    assert told.time("play:yes:stroke") == pytest.approx(told.time("play:ball:caught") + 0.3)
    assert moved(pilot, "skullbase", "play:bow") > 0.1
    assert moved(pilot, "r_wrist", "play:ball") > 0.3
    assert moved(pilot, "l_wrist", "play:ball") < 0.05
    assert min(moved(pilot, "l_wrist", "play:come"), moved(pilot, "r_wrist", "play:come")) > 0.2


async def test_the_emphasis_of_the_motion_of_smartbody_is_on_the_word(assets: Path) -> None:
    (example,) = [fence for fence in fences(PAGE, "xml") if fence.note == "plays Figure@Raise01"]
    pilot = await play(assets, example.text)
    told = pilot.feedback
    assert told.warnings == []
    assert told.time("b:raise:stroke") == told.time("b:s:up")
    assert told.time("b:raise:end") - told.time("b:raise:start") == pytest.approx(1.4, abs=0.011)
    assert moved(pilot, "l_wrist", "b:raise") > 0.3


async def test_the_loop_on_the_page_goes_on_until_its_end(assets: Path) -> None:
    (example,) = [fence for fence in fences(PAGE, "xml") if 'name="loop"' in fence.text]
    pilot = await play(assets, example.text)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:juggle:end") - pilot.feedback.time("b:juggle:start") == pytest.approx(4.0)
    path = pilot.path("r_wrist")[140:200]  # the third round
    assert float(np.ptp(path, axis=0).max()) > 0.2


async def test_the_blend_on_the_page_is_between_its_clips(assets: Path) -> None:
    (example,) = [fence for fence in fences(PAGE, "xml") if fence.note == "plays a blend"]
    pilot = await play(assets, example.text)
    assert pilot.feedback.warnings == []
    start = pilot.feedback.time("b:r:start")
    assert pilot.feedback.time("b:r:caught") - start == pytest.approx(0.65)
    assert pilot.feedback.time("b:r:end") - start == pytest.approx(1.7)


async def test_a_gentle_interrupt_ends_the_catch_at_its_next_exit(assets: Path) -> None:
    spaces = 'xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla"'
    catch = f'<bml {spaces} id="a"><gesture id="g" lexeme="CATCH" start="0"/></bml>'
    stop = f'<bml {spaces} id="b"><bmla:interrupt id="i" target="a" start="0.3" speech="word"/></bml>'
    pilot = await play(assets, catch, stop)
    assert pilot.feedback.time("a:g:end") - pilot.feedback.time("a:start") == pytest.approx(0.9)


def test_the_binding_with_rest_poses_is_valid(tmp_path: Path) -> None:
    (example,) = [fence for fence in fences(PAGE, "xml") if fence.note == "reads"]
    file = tmp_path / "gesturebinding.xml"
    file.write_text(example.text, encoding="utf-8")
    binding = GestureBinding.read(file)
    assert [(rest.stance, rest.file) for rest in binding.rest_poses] == [("STANDING", "at_ease.xml")]
    assert [(spec.behavior, spec.unit) for spec in binding.specs] == [("gazeShift", "rest-gaze")]


def test_the_binding_with_a_description_of_murml_is_valid(tmp_path: Path) -> None:
    (example,) = [fence for fence in fences(PAGE, "xml") if fence.note == "MURML"]
    file = tmp_path / "gesturebinding.xml"
    file.write_text(example.text, encoding="utf-8")
    (spec,) = GestureBinding.read(file).specs
    assert (spec.behavior, spec.constraints, spec.unit) == ("gesture", {"lexeme": "STOP"}, "MURML")
    read_murml_text(spec.defaults[MURML_TEXT], "example", Scope.RIGHT)


async def test_the_gesture_of_embots_plays_with_the_entry_on_the_page(assets: Path, tmp_path: Path) -> None:
    human = tmp_path / "human.toml"
    human.write_text(
        '[character.alice]\navatar = "avatars/female.glb"\nbindings = { gesture = "embots.xml" }\n', encoding="utf-8"
    )
    async with open_pilot(SceneOptions(human, "text", (assets,))) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="invite"/><gesture id="h" lexeme="invite_RH" start="g:end"/>')
        await pilot.advance(6)
    told = pilot.feedback
    assert told.warnings == []
    assert told.time("b:g:strokeEnd") - told.time("b:g:ready") == pytest.approx(0.5)
    assert told.time("b:h:relax") - told.time("b:h:start") == pytest.approx(1.3, abs=0.2)


async def test_the_gestures_of_greta_play_with_the_entry_on_the_page(assets: Path, tmp_path: Path) -> None:
    human = tmp_path / "human.toml"
    human.write_text(
        '[character.alice]\navatar = "avatars/female.glb"\nbindings = { gesture = "greta.xml" }\n', encoding="utf-8"
    )
    async with open_pilot(SceneOptions(human, "text", (assets,))) as pilot:
        pilot.watch()
        pilot.block(
            "b", '<gesture id="g" lexeme="metaphoric=Unfold"/><gesture id="h" lexeme="REMEMBER" start="g:end"/>'
        )
        await pilot.advance(6)
    assert pilot.feedback.warnings == []
    assert moved(pilot, "r_wrist", "b:g") > 0.3
    assert moved(pilot, "l_wrist", "b:h") > 0.3


async def test_the_movements_of_greta_play_with_the_entries_on_the_page(assets: Path, tmp_path: Path) -> None:
    human = tmp_path / "human.toml"
    human.write_text(
        '[character.alice]\navatar = "avatars/female.glb"\nidle = 0\nbindings = { gesture = "greta_spine.xml" }\n',
        encoding="utf-8",
    )
    async with open_pilot(SceneOptions(human, "text", (assets,))) as pilot:
        pilot.watch()
        pilot.perform(
            '<bml id="b"><head id="g" lexeme="NOD" amount="1"/><torso id="t" lexeme="LeanIn" start="2" end="5"/></bml>'
        )
        await pilot.advance(6)
    assert pilot.feedback.warnings == []
    assert moved(pilot, "skullbase", "b:t") > 0.05
    assert pilot.feedback.time("b:g:strokeEnd") > pilot.feedback.time("b:g:stroke")


def test_the_page_gives_the_values_of_gretas_symbols_places_and_shapes() -> None:
    section = TEXT.partition("## Gestures of Greta")[2]
    for symbols in (OUTWARD, UPWARD, AHEAD):
        assert ", ".join(f"`{symbol}` {value}" for symbol, value in symbols.items()) in section
    (row,) = re.findall(r"^\| `touchPosition` \| (.*) \|$", section, re.MULTILINE)
    assert set(re.findall(r"`([a-z]+)`", row)) == TOUCHED.keys()
    stand_ins = re.findall(r"^\| `(hands_.*)` \| (.*) \|$", section, re.MULTILINE)
    named = {shape.lower(): pose for pose, shapes in stand_ins for shape in re.findall(r"`(\w+)`", shapes)}
    assert named == STAND_INS


def test_the_page_lists_every_kind_of_motion() -> None:
    table = TEXT.partition("## Kinds of motion")[2].partition("## Rest")[0]
    firsts = [line.split(" | ")[0] for line in table.splitlines() if line.startswith("| `")]
    named = [name for first in firsts for name in re.findall(r"`([\w-]+)`", first)]
    assert sorted(set(named) - {"type", "class"}) == sorted({*MAKERS, "Sequence"})


def test_the_page_maps_every_class_to_its_kind() -> None:
    table = TEXT.partition("## Classes of AsapRealizer")[2].partition("\n## ")[0]
    rows = re.findall(r"^\| (`.*`) \| `(.*)` \|$", table, re.MULTILINE)
    named = {f"{PACKAGE}{name}": unit for names, unit in rows for name in re.findall(r"`([\w.]+)`", names)}
    assert named == CLASS_NAMES
