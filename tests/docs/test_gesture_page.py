"""docs/gesture.md: the gesture of its example is played, and the page shows the files as they are."""

import shutil
from pathlib import Path
from xml.etree.ElementTree import canonicalize

import numpy as np
import pytest
from lxml import etree

from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.engines.animation.expression.functions import FUNCTIONS
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .conftest import EXAMPLES, fences, page

GESTURE = EXAMPLES / "gesture"
QUESTION = (GESTURE / "question.xml").read_text(encoding="utf-8")


def above_shoulder(pilot: RealizerPilot, side: str) -> np.ndarray:
    """How far a wrist is above its shoulder in each frame, m."""
    skeleton = pilot.realizer.characters["alice"].humanoid.avatar.skeleton
    bodies = [
        Body(skeleton, dict(zip(skeleton.joints, map(tuple, frame.rotations), strict=True)))
        for frame in pilot.frames["alice"]
    ]
    return np.array([b.place(f"{side}_wrist").position[1] - b.place(f"{side}_shoulder").position[1] for b in bodies])


async def play(text: str, assets: Path = GESTURE) -> RealizerPilot:
    async with open_pilot(SceneOptions(DEFAULT_HUMAN, "text", (assets,))) as pilot:
        pilot.watch()
        pilot.perform(text)
        await pilot.advance(6)
        return pilot


@pytest.mark.parametrize(
    ("mode", "raised", "other"), [("", "r", "l"), ('mode="RIGHT_HAND"', "r", "l"), ('mode="LEFT_HAND"', "l", "r")]
)
async def test_the_hand_goes_up_stays_there_and_comes_down_again(mode: str, raised: str, other: str) -> None:
    pilot = await play(QUESTION.replace('lexeme="RAISE_HAND"', f'lexeme="RAISE_HAND" {mode}'))
    assert pilot.feedback.status("question") == "DONE"
    assert pilot.feedback.warnings == []
    held = pilot.feedback.time("question:me:relax") - pilot.feedback.time("question:me:stroke")
    assert held == pytest.approx(1.0)
    height = above_shoulder(pilot, raised)
    assert height[0] < -0.4
    assert height.max() > 0.15
    assert height[-1] < -0.4
    assert above_shoulder(pilot, other).max() < -0.4


async def test_the_parameter_says_how_high(tmp_path: Path) -> None:
    lower = tmp_path / "lower"
    shutil.copytree(GESTURE, lower)
    binding = lower / "gesturebinding.xml"
    binding.write_text(binding.read_text("utf-8").replace('name="up" value="0.24"', 'name="up" value="0.1"'), "utf-8")
    high, low = await play(QUESTION), await play(QUESTION, lower)
    assert above_shoulder(high, "r").max() - above_shoulder(low, "r").max() == pytest.approx(0.14, abs=0.02)


def said(element: etree._Element) -> str:
    """What an element says, comments and white space aside."""
    return canonicalize(etree.tostring(element, encoding="unicode", with_tail=False), strip_text=True)


def test_the_page_shows_the_files_of_the_example() -> None:
    animation, binding = (etree.fromstring(fence.text) for fence in fences("docs/gesture.md", "xml"))
    assert said(animation) == said(etree.parse(GESTURE / "procanimation" / "raise_hand.xml").getroot())
    assert said(binding[0]) == said(etree.parse(GESTURE / "gesturebinding.xml").find("MotionUnitSpec"))


def test_the_page_names_every_function() -> None:
    text = page("docs/gesture.md")
    assert [name for name in FUNCTIONS if name not in text] == []
