"""Keyframe animations of the face, as seen in frames."""

from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .conftest import weight

SIGH = """<FaceInterpolator parts="jawOpen browInnerUp">
  <KeyPosition id="deep" time="1.0"/>
  0.5  0    0
  1.0  0.6  0.4
  2.0  0.2  0.8
  2.5  0    0
</FaceInterpolator>"""


@pytest.fixture
def assets(tmp_path: Path) -> Path:
    (tmp_path / "faces").mkdir()
    (tmp_path / "faces" / "sigh.xml").write_text(SIGH)
    return tmp_path


async def test_rows_inside_of_a_behavior_are_played_at_their_times(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<bmlt:facekeyframe id="k" start="0.2">{SIGH}</bmlt:facekeyframe>')
    await pilot.advance(3)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:k:deep") == pytest.approx(0.7)
    assert pilot.feedback.time("b:k:end") == pytest.approx(2.2)
    jaw = weight(pilot, "jawOpen")
    assert jaw[round(50 * 0.7)] == pytest.approx(0.6, abs=0.02)
    assert jaw[round(50 * 1.2)] == pytest.approx(0.4, abs=0.02)
    assert weight(pilot, "browInnerUp")[round(50 * 1.7)] == pytest.approx(0.8, abs=0.02)
    assert jaw[-1] == 0.0


async def test_a_sync_point_of_a_file_can_be_tied_and_stretches_the_rows_around_it(assets: Path) -> None:
    async with open_pilot(SceneOptions(voice="text", assets=(assets,))) as pilot:
        pilot.watch()
        pilot.block(
            "b",
            """<bmlt:facekeyframe id="k" name="sigh" start="0.5" deep="n:stroke" end="4"/>
               <head id="n" lexeme="NOD" stroke="2"/>""",
        )
        await pilot.advance(5)
        assert pilot.feedback.warnings == []
        start, deep = (pilot.feedback.time(f"b:k:{point}") for point in ("start", "deep"))
        assert deep == pilot.feedback.time("b:n:stroke") == pytest.approx(start + 1.5)
        jaw = weight(pilot, "jawOpen")
        assert jaw[round(50 * deep)] == pytest.approx(0.6, abs=0.02)
        assert jaw[round(25 * (start + deep))] == pytest.approx(0.3, abs=0.02)


@pytest.mark.parametrize(
    ("kind", "parts", "row", "expected"),
    [
        ("FACS", "12.LEFT 2", "0.8 0.5", {"mouthSmileLeft": 0.8, "mouthSmileRight": 0, "browOuterUpRight": 0.5}),
        ("FAPS", "12 raise_r_cornerlip 23", "440 440 0", {"mouthSmileLeft": 0.5, "mouthSmileRight": 0.5}),
        ("MORPH", "cheekPuff", "0.7", {"cheekPuff": 0.7, "mouthSmileLeft": 0}),
    ],
)
async def test_parts_are_morph_targets_action_units_or_parameters(
    pilot: RealizerPilot, kind: str, parts: str, row: str, expected: dict[str, float]
) -> None:
    rows = f'<FaceInterpolator parts="{parts}">0 {row} 1 {row}</FaceInterpolator>'
    pilot.block("b", f'<bmlt:facekeyframe id="k" type="{kind}">{rows}</bmlt:facekeyframe>')
    await pilot.advance(0.5)
    assert pilot.feedback.warnings == []
    assert {morph: weight(pilot, morph)[-1] for morph in expected} == pytest.approx(expected, abs=0.01)


async def test_an_animation_neither_starts_nor_ends_with_a_jump(pilot: RealizerPilot) -> None:
    rows = '<FaceInterpolator parts="cheekPuff">0 0.8 1 0.8</FaceInterpolator>'
    pilot.block("b", f'<bmlt:facekeyframe id="k" start="0.5">{rows}</bmlt:facekeyframe>')
    await pilot.advance(2.5)
    puff = weight(pilot, "cheekPuff")
    assert puff.max() == pytest.approx(0.8)
    assert np.abs(np.diff(puff)).max() < 0.25
    assert puff[-1] == 0.0


@pytest.mark.parametrize(
    ("attributes", "content", "message"),
    [
        ("", "", "needs a name, or a FaceInterpolator inside"),
        ('name="sighh"', "", "did you mean 'sigh.xml'"),
        ("", '<FaceInterpolator parts="jaw">0 0 1 1</FaceInterpolator>', "no morph target 'jaw'"),
        ("", '<FaceInterpolator parts="jawOpen">0 0 1</FaceInterpolator>', "3 numbers do not form rows of 2"),
        ("", '<FaceInterpolator parts="jawOpen">1 0 1 1</FaceInterpolator>', "the times of the rows do not increase"),
        ("", '<FaceInterpolator parts="">0 0 1 1</FaceInterpolator>', "parts names nothing that moves"),
        ('type="FACS"', '<FaceInterpolator parts="12.UP">0 0 1 1</FaceInterpolator>', "'12.UP' is not an action unit"),
        (
            'type="FAPS"',
            '<FaceInterpolator parts="3">0 0 1 -9</FaceInterpolator>',
            "negative values of the facial animation parameter 3",
        ),
    ],
)
async def test_keyframes_that_cannot_be_played_are_warned_of(
    assets: Path, attributes: str, content: str, message: str
) -> None:
    async with open_pilot(SceneOptions(voice="text", assets=(assets,))) as pilot:
        pilot.block(
            "b", f'<bmlt:facekeyframe id="k" {attributes}>{content}</bmlt:facekeyframe><wait id="w" duration="0.1"/>'
        )
        await pilot.advance(1)
        assert pilot.feedback.warnings == [("b:k", "CANNOT_CREATE_BEHAVIOR")]
        assert message in pilot.feedback.of("warningFeedback")[0].text
        assert pilot.feedback.reached("b:w:end")
