"""Every entry of a binding plays without a warning and moves the figure."""

from collections.abc import Awaitable, Callable, Sequence
from itertools import groupby
from pathlib import Path
from shutil import copy

import numpy as np
import pytest

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.binding.gesture_binding import GestureBinding
from reactive_realizer.bml.names import BMLT
from reactive_realizer.engines.animation.lexicon import example_behavior
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .conftest import OpenStill

DATA = Path(__file__).parent.parent / "data"
BOX = "[target.bluebox]\nposition = [1.2, 1.1, 1.5]"

NOISE = f"""<b:noise xmlns:b="{BMLT}" id="example" type="perlin" joint="vl5" start="0" end="2">
  <b:parameter name="basefreqx" value="2"/><b:parameter name="baseamplitudex" value="0.1"/></b:noise>"""
"""Elements that need more than a lexeme."""


def asked_of(binding: Path, but: Sequence[str] = ()) -> list[str]:
    """How to ask for each entry of a binding that is a word, shifts last; those of some units left out."""
    asked = [example_behavior(spec, "bluebox") for spec in GestureBinding.read(binding).specs if spec.unit not in but]
    return sorted((text for text in asked if text is not None), key=lambda text: "Shift" in text)


def element_of(behavior: str) -> str:
    """Its name."""
    return behavior.lstrip("<").partition(" ")[0].rpartition(":")[2]


OURS = {
    element: list(behaviors)
    for element, behaviors in groupby(
        sorted(asked_of(PACKAGE_ASSETS / "gesturebinding.xml"), key=element_of), element_of
    )
}


@pytest.fixture
def play(open_still: OpenStill) -> Callable[..., Awaitable[None]]:
    async def play(behaviors: Sequence[str], *assets: Path) -> None:
        async with open_still(*assets, scene=BOX) as pilot:
            for i, behavior in enumerate(behaviors):
                turned = await played(pilot, f"b{i}", behavior)
                assert turned > 0.02 or is_still(behavior), behavior

    return play


async def played(pilot: RealizerPilot, id_: str, behavior: str) -> float:
    """Play a behavior to its end; by how much a joint turned away from where it was, at most, rad."""
    pilot.frames.clear()
    pilot.block(id_, behavior)
    while not pilot.feedback.reached(f"{id_}:end"):
        await pilot.advance(0.1)
    assert pilot.feedback.status(id_) == "DONE", behavior
    assert pilot.feedback.reached(f"{id_}:example:end"), behavior
    assert pilot.feedback.warnings == [], behavior
    rotations = np.array([frame.rotations for frame in pilot.frames["alice"]])
    return float(2.0 * np.arccos(np.clip(np.abs((rotations * rotations[:1]).sum(-1)), 0.0, 1.0)).max())


def is_still(behavior: str) -> bool:
    """Who is to look straight ahead, or to stand, does so already."""
    return 'lexeme="FRONT"' in behavior or element_of(behavior) in {"posture", "postureShift"}


def test_the_package_has_lexicon_entries_for_these_elements() -> None:
    shifts = {"gazeShift", "headDirectionShift", "postureShift"}
    assert OURS.keys() == {"gaze", "gesture", "head", "locomotion", "pointing", "posture", "procanimation"} | shifts
    assert sum(map(len, OURS.values())) == 97


@pytest.mark.parametrize("element", OURS)
async def test_every_lexicon_entry_of_the_package_plays(play: Callable[..., Awaitable[None]], element: str) -> None:
    await play(OURS[element])


async def test_every_lexicon_entry_of_a_published_binding_plays(
    play: Callable[..., Awaitable[None]], tmp_path: Path
) -> None:
    copy(DATA / "bindings" / "published.xml", tmp_path / "gesturebinding.xml")
    asked = asked_of(tmp_path / "gesturebinding.xml", ["PhysicalController"])
    assert len(asked) == 10
    await play([*asked, NOISE], tmp_path)


async def test_every_lexicon_entry_of_asaprealizers_binding_plays(
    play: Callable[..., Awaitable[None]], tmp_path: Path, shared_cases: Path
) -> None:
    copy(shared_cases / "asap" / "gesturebinding" / "gesturebinding.xml", tmp_path)
    asked = asked_of(tmp_path / "gesturebinding.xml", ["PhysicalController"])
    assert len(asked) == 70
    await play([*asked, NOISE], tmp_path)


async def test_the_package_plays_entries_with_an_unknown_unit(
    play: Callable[..., Awaitable[None]], tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "gesturebinding.xml").write_text(
        """<gesturebinding><MotionUnitSpec type="posture">
             <constraints><constraint name="stance" value="STANDING"/></constraints>
             <MotionUnit type="Muscle" class="Biceps"/>
           </MotionUnitSpec></gesturebinding>"""
    )
    await play(['<posture id="example" end="1"><stance type="STANDING"/></posture>'], tmp_path)
    assert "this entry is skipped: there is no motion unit 'Muscle'" in caplog.text


async def test_the_entries_of_a_user_come_before_those_of_the_package(tmp_path: Path) -> None:
    (tmp_path / "gesturebinding.xml").write_text(
        """<gesturebinding><MotionUnitSpec type="head">
          <constraints><constraint name="lexeme" value="NOD"/></constraints>
          <MotionUnit type="ProcAnimation" file="procanimation/smartbody/shake.xml"/>
          </MotionUnitSpec></gesturebinding>"""
    )
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,))) as pilot:
        pilot.watch()
        pilot.block("b", '<head id="no" lexeme="NOD" amount="1"/><gesture id="yes" lexeme="BEAT" start="no:end"/>')
        await pilot.advance(4)
        assert pilot.feedback.warnings == []
        assert pilot.feedback.reached("b:yes:end")
        joints = list(pilot.realizer.characters["alice"].humanoid.avatar.skeleton.joints)
        head = np.array([frame.rotations[joints.index("skullbase")] for frame in pilot.frames["alice"]])
        assert np.ptp(head[:, 2]) > 5 * np.ptp(head[:, 1]), "it turned about the vertical axis: it shook its head"


async def test_an_entry_with_a_missing_file_is_skipped_and_logged(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "gesturebinding.xml").write_text(
        """<gesturebinding><MotionUnitSpec type="gesture">
          <constraints><constraint name="lexeme" value="BEAT"/></constraints>
          <MotionUnit type="Gesture" file="nowhere.xml"/></MotionUnitSpec></gesturebinding>"""
    )
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,))) as pilot:
        for i in range(2):
            pilot.block(f"b{i}", '<gesture id="g" lexeme="BEAT"/>')
            await pilot.advance(3)
        assert pilot.feedback.warnings == []
        assert pilot.feedback.reached("b1:g:end")
    told = [record.message for record in caplog.records if "is skipped" in record.message]
    assert told == ["gesturebinding.xml, line 1: this entry is skipped: there is no asset named 'nowhere.xml'"]


async def test_the_warning_names_the_reason_of_the_best_entry(tmp_path: Path) -> None:
    (tmp_path / "gesturebinding.xml").write_text(
        """<gesturebinding><MotionUnitSpec type="gesture">
          <constraints><constraint name="lexeme" value="HOP"/></constraints>
          <MotionUnit type="Gesture" file="nowhere.xml"/></MotionUnitSpec></gesturebinding>"""
    )
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,))) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="HOP"/><gesture id="h" lexeme="SKIP"/>')
        await pilot.advance(1)
        assert pilot.feedback.warnings == [("b:g", "CANNOT_CREATE_BEHAVIOR"), ("b:h", "CANNOT_CREATE_BEHAVIOR")]
        texts = [line.text for line in pilot.feedback.of("warningFeedback")]
        assert "nowhere.xml" in texts[0]
        assert "SKIP" in texts[1]
