"""docs/gesture.md: the gesture of its example plays, and the page shows its files."""

import os
import re
import shutil
from pathlib import Path
from xml.etree.ElementTree import canonicalize

import numpy as np
import pytest
from lxml import etree

from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.engines.animation.procedural.procedural_animation_reader import read_procedural_animation
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .conftest import EXAMPLES, fences, page

GESTURE = EXAMPLES / "gesture"
QUESTION = (GESTURE / "question.xml").read_text(encoding="utf-8")


def above_chest(pilot: RealizerPilot, side: str) -> np.ndarray:
    """How far a wrist is above the upper chest in each frame, m: the shoulder itself rises with the arm."""
    skeleton = pilot.realizer.characters["alice"].humanoid.avatar.skeleton
    bodies = [
        Body(skeleton, dict(zip(skeleton.joints, map(tuple, frame.rotations), strict=True)))
        for frame in pilot.frames["alice"]
    ]
    return np.array([b.transform(f"{side}_wrist").position[1] - b.transform("vt6").position[1] for b in bodies])


async def play(text: str, assets: Path = GESTURE) -> RealizerPilot:
    async with open_pilot(SceneOptions(DEFAULT_HUMAN, "text", (assets,))) as pilot:
        pilot.watch()
        pilot.perform(text)
        await pilot.advance(6)
        return pilot


@pytest.mark.parametrize(
    ("mode", "raised", "other"), [("", "r", "l"), ('mode="RIGHT_HAND"', "r", "l"), ('mode="LEFT_HAND"', "l", "r")]
)
async def test_the_hand_is_raised_held_and_lowered(mode: str, raised: str, other: str) -> None:
    pilot = await play(QUESTION.replace('lexeme="RAISE_HAND"', f'lexeme="RAISE_HAND" {mode}'))
    assert pilot.feedback.status("question") == "DONE"
    assert pilot.feedback.warnings == []
    held = pilot.feedback.time("question:me:relax") - pilot.feedback.time("question:me:stroke")
    assert held == pytest.approx(1.0)
    height = above_chest(pilot, raised)
    assert height[0] < -0.35
    assert height.max() > 0.15
    assert height[-1] < -0.35
    assert above_chest(pilot, other).max() < -0.35


async def test_the_left_hand_is_raised_while_the_right_one_is_busy() -> None:
    beat = '<gesture id="busy" lexeme="BEAT" mode="RIGHT_HAND" start="0" end="9"/>'
    pilot = await play(QUESTION.replace('<gesture id="me"', f'{beat}<gesture id="me"').replace("words:start", "2"))
    assert pilot.feedback.warnings == []
    assert above_chest(pilot, "l").max() > 0.15
    assert above_chest(pilot, "r").max() < 0


async def test_a_file_that_is_saved_during_a_session_is_read_again(tmp_path: Path) -> None:
    own = tmp_path / "own"
    shutil.copytree(GESTURE, own)
    animation = own / "procanimation" / "raise_hand.xml"
    async with open_pilot(SceneOptions(DEFAULT_HUMAN, "text", (own,))) as pilot:
        pilot.watch()
        pilot.perform(QUESTION)
        await pilot.advance(4)
        highest = above_chest(pilot, "r").max()
        animation.write_text(animation.read_text("utf-8").replace("0.06, up)", "0.06, up - 0.1)"), "utf-8")
        os.utime(animation, ns=(0, 0))
        pilot.frames.clear()
        pilot.perform(QUESTION)
        await pilot.advance(4)
        assert highest - above_chest(pilot, "r").max() == pytest.approx(0.1, abs=0.02)


async def test_the_parameter_sets_the_height_of_the_hand(tmp_path: Path) -> None:
    lower = tmp_path / "lower"
    shutil.copytree(GESTURE, lower)
    binding = lower / "gesturebinding.xml"
    binding.write_text(binding.read_text("utf-8").replace('name="up" value="0.24"', 'name="up" value="0.1"'), "utf-8")
    high, low = await play(QUESTION), await play(QUESTION, lower)
    assert above_chest(high, "r").max() - above_chest(low, "r").max() == pytest.approx(0.14, abs=0.02)


def said(element: etree._Element) -> str:
    """An element in canonical form, without comments and white space."""
    return canonicalize(etree.tostring(element, encoding="unicode", with_tail=False), strip_text=True)


def test_the_page_shows_the_files_of_the_example() -> None:
    animation, binding = (etree.fromstring(fence.text) for fence in fences("docs/gesture.md", "xml"))
    assert said(animation) == said(etree.parse(GESTURE / "procanimation" / "raise_hand.xml").getroot())
    unit = etree.parse(GESTURE / "gesturebinding.xml").find("MotionUnitSpec")
    assert unit is not None
    assert said(binding[0]) == said(unit)


def test_the_page_has_a_row_for_every_element_of_an_animation(tmp_path: Path) -> None:
    file = tmp_path / "x.xml"
    file.write_text('<ProcAnimation prefDuration="1"><Nothing/></ProcAnimation>', encoding="utf-8")
    with pytest.raises(RealizerError) as refused:
        read_procedural_animation(file)
    known = refused.value.fault.sentence.rpartition("known are ")[2].split(", ")
    rows = re.findall(r"^\| `(\w+)` \|", page("docs/gesture.md"), re.MULTILINE)
    assert set(rows) == {"ProcAnimation", *known}
