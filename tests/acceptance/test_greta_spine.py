"""Movements of Greta's libraries for heads and torsos: how far they turn and when, and what plays of wrong files."""

from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.quaternion import conjugate, multiply, rotation_vector
from reactive_realizer.engine.lexicon import lexicon_of
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

FRAMES = 50
"""Frames per second."""
BINDING = """<gesturebinding>
<MotionUnitSpec type="head">
  <parametermap><parameter src="lexeme" dst="name"/></parametermap>
  <MotionUnit type="GretaHead" file="HeadGestures.xml"/>
</MotionUnitSpec>
<MotionUnitSpec type="posture"><MotionUnit type="GretaTorso" file="TorsoGestures.xml"/></MotionUnitSpec>
</gesturebinding>"""
HUMAN = '[character.alice]\navatar = "avatars/female.glb"\nidle = 0\nbindings = { gesture = "lexicon.xml" }\n'

HEADS = """<HeadGestures>
<head id="Nod_Deep" lexeme="NOD">
  <KeyPoint type="strokeEnd"><SagittalTilt direction="Forward" min="0.1" max="0.3"/></KeyPoint></head>
<head id="Nod_Slight" lexeme="NOD">
  <KeyPoint type="strokeEnd"><SagittalTilt direction="Forward" min="0.1" max="0.1"/></KeyPoint></head>
<head id="Aside_Down_Left"><KeyPoint><LateralRoll direction="Leftward" min="0.1" max="0.1"/></KeyPoint></head>
<head id="No" lexeme="SHAKE">
  <KeyPoint type="strokeStart"><VerticalTorsion direction="Leftward" min="0.1" max="0.1"/></KeyPoint>
  <KeyPoint type="strokeEnd"><VerticalTorsion direction="Rightward" min="0.1" max="0.1"/></KeyPoint></head>
<head id="Aslant" lexeme="Aslant"><KeyPoint><LateralRoll direction="Leftward" min="0.25" max="0.25"/></KeyPoint></head>
<head id="Odd"><KeyPoint type="stroke"><LateralRoll direction="Forward"/>
  <SagittalTilt direction="Backward" min="0.2" max="0.2"/></KeyPoint></head>
<head id="Still"/>
</HeadGestures>"""
TORSOS = """<TorsoGestures>
<torso id="Bow" lexeme="Bow" amount="0.5">
  <KeyPoint><SagittalTilt direction="Forward" min="0" max="1"/></KeyPoint></torso>
<torso id="Bend" lexeme="Bend"><KeyPoint><Rotations>
  <vl5 w="0.9962" x="0.0872" y="0" z="0"/><vl3 w="0.9962" x="0.0872" y="0" z="0"/></Rotations></KeyPoint></torso>
</TorsoGestures>"""

Open = Callable[[], AbstractAsyncContextManager[RealizerPilot]]


@pytest.fixture
def libraries(tmp_path: Path) -> Open:
    """Opens a scene with both libraries."""

    @asynccontextmanager
    async def open_() -> AsyncIterator[RealizerPilot]:
        files = {"lexicon.xml": BINDING, "human.toml": HUMAN, "HeadGestures.xml": HEADS, "TorsoGestures.xml": TORSOS}
        for name, text in files.items():
            (tmp_path / name).write_text(text, encoding="utf-8")
        async with open_pilot(SceneOptions(tmp_path / "human.toml", "text", (tmp_path,))) as pilot:
            pilot.watch()
            yield pilot

    return open_


async def turns(libraries: Open, behavior: str, joint: str = "skullbase") -> tuple[RealizerPilot, NDArray[np.float64]]:
    """Return a session with a behavior, and how far a joint is turned in each frame: (F, 3), degrees."""
    async with libraries() as pilot:
        pilot.perform(f'<bml id="b">{behavior}</bml>')
        await pilot.advance(6)
    first = conjugate(pilot.bodies()[0].transform(joint).rotation)
    turned = [rotation_vector(multiply(body.transform(joint).rotation, first)) for body in pilot.bodies()]
    return pilot, np.degrees(turned)


def at(pilot: RealizerPilot, turned: NDArray[np.float64], point: str) -> NDArray[np.float64]:
    there: NDArray[np.float64] = turned[round(FRAMES * pilot.feedback.time(f"b:g:{point}"))]
    return there


@pytest.mark.parametrize(("amount", "degrees"), [(0, 5.0), (0.5, 10.0), (1, 15.0)])
async def test_a_head_tilts_by_a_share_of_its_range_between_the_limits_of_the_file(
    libraries: Open, amount: float, degrees: float
) -> None:
    pilot, turned = await turns(libraries, f'<head id="g" lexeme="Nod_Deep" amount="{amount}"/>')
    assert pilot.feedback.warnings == []
    assert at(pilot, turned, "stroke") == pytest.approx((degrees, 0.0, 0.0), abs=1.0)
    assert at(pilot, turned, "end") == pytest.approx((0.0, 0.0, 0.0), abs=0.1)


async def test_a_head_goes_from_point_to_point_between_the_points_of_the_stroke(libraries: Open) -> None:
    pilot, turned = await turns(libraries, '<head id="g" lexeme="No" strokeStart="1" strokeEnd="3"/>')
    assert pilot.feedback.warnings == []
    assert at(pilot, turned, "strokeStart") == pytest.approx((0.0, 9.0, 0.0), abs=0.5)
    assert turned[2 * FRAMES] == pytest.approx((0.0, 0.0, 0.0), abs=0.5)
    assert at(pilot, turned, "strokeEnd") == pytest.approx((0.0, -9.0, 0.0), abs=0.5)


async def test_a_pose_of_the_head_is_kept_as_long_as_there_is_time(libraries: Open) -> None:
    pilot, turned = await turns(libraries, '<head id="g" lexeme="Aslant" start="0" end="5"/>')
    assert pilot.feedback.time("b:g:relax") - pilot.feedback.time("b:g:ready") > 1.0
    for point in ("ready", "relax"):
        assert at(pilot, turned, point) == pytest.approx((0.0, 0.0, -15.0), abs=0.5)


async def test_the_lexicon_lists_the_movements_of_both_files(libraries: Open) -> None:
    async with libraries() as pilot:
        entries = lexicon_of(pilot.realizer.characters["alice"].engines)
    listed = [(each.element, each.lexeme) for each in entries if each.file in ("HeadGestures.xml", "TorsoGestures.xml")]
    heads = ("Nod_Deep", "Nod_Slight", "Aside_Down_Left", "No", "Aslant", "Odd", "Still")
    assert listed == [*(("head", name) for name in heads), ("posture", "Bow"), ("posture", "Bend")]


async def test_a_reference_selects_one_of_several_movements_with_a_lexeme(libraries: Open) -> None:
    description = '<description type="gretabml"><reference>{}</reference></description>'
    highest: list[float] = []
    for name in ("Unknown", "Nod_Slight"):
        nod = f'<head id="g" lexeme="NOD" amount="1">{description.format(name)}</head>'
        _, turned = await turns(libraries, nod)
        highest.append(turned[:, 0].max())
    assert highest == pytest.approx([15.0, 5.0], abs=1.0)


async def test_a_word_that_drafts_rewrite_names_its_movement_as_written(libraries: Open) -> None:
    pilot, turned = await turns(libraries, '<head id="g" lexeme="Aside_Down_Left" start="0" end="3"/>')
    assert pilot.feedback.warnings == []
    assert at(pilot, turned, "ready") == pytest.approx((0.0, 0.0, -6.0), abs=0.5)


async def test_each_stroke_of_a_repeated_movement_is_reported_where_the_head_is_down(libraries: Open) -> None:
    pilot, turned = await turns(libraries, '<head id="g" lexeme="NOD" amount="1" repetition="3"/>')
    strokes = [at(pilot, turned, f"stroke:{number}")[0] for number in (1, 2, 3)]
    assert strokes == pytest.approx([15.0] * 3, abs=1.0)
    first, second = (round(FRAMES * pilot.feedback.time(f"b:g:stroke:{number}")) for number in (1, 2))
    assert turned[first:second, 0].min() < 1.0


async def test_a_movement_is_added_to_a_gaze(libraries: Open) -> None:
    gaze = '<gaze id="l" target="3 1.5 1" influence="HEAD" start="0" end="6"/>'
    pilot, turned = await turns(libraries, f'{gaze}<head id="g" lexeme="Aslant" start="2" end="5"/>')
    aslant, upright = at(pilot, turned, "ready"), turned[round(1.9 * FRAMES)]
    assert upright[1] > 20.0
    assert aslant[1] > 15.0
    assert np.linalg.norm(aslant - upright) > 8.0


async def test_a_torso_tilts_by_its_amount_and_comes_back(libraries: Open) -> None:
    pilot, turned = await turns(libraries, '<torso id="g" lexeme="Bow" start="0" end="4"/>', "vt6")
    assert pilot.feedback.warnings == []
    assert at(pilot, turned, "ready") == pytest.approx((10.1, 0.0, 0.0), abs=0.3)
    assert at(pilot, turned, "relax") == pytest.approx((10.1, 0.0, 0.0), abs=0.3)
    assert at(pilot, turned, "end") == pytest.approx((0.0, 0.0, 0.0), abs=0.1)


async def test_rotations_of_vertebrae_that_the_figure_lacks_pass_to_their_neighbors(libraries: Open) -> None:
    pilot, turned = await turns(libraries, '<torso id="g" lexeme="Bend" end="3"/>', "vl5")
    assert at(pilot, turned, "ready") == pytest.approx((20.0, 0.0, 0.0), abs=0.3)


async def test_movements_that_the_libraries_lack_are_those_of_the_package(libraries: Open) -> None:
    pilot, turned = await turns(libraries, '<head id="g" lexeme="WIGGLE"/><torso id="t" lexeme="forward" end="3"/>')
    assert pilot.feedback.warnings == []
    assert np.ptp(turned[:, 0]) > 5.0


async def test_what_cannot_be_played_is_told_with_its_line_and_the_rest_plays(libraries: Open) -> None:
    pilot, turned = await turns(libraries, '<head id="g" lexeme="Odd"/><head id="s" lexeme="Still" start="g:end"/>')
    told = {message.id: message.text for message in pilot.feedback.of("warningFeedback")}
    assert "HeadGestures.xml, line 11, <LateralRoll>: direction='Forward': known are RIGHTWARD, LEFTWARD" in told["b:g"]
    assert "Still has no points" in told["b:s"]
    assert at(pilot, turned, "stroke") == pytest.approx((-10.0, 0.0, 0.0), abs=0.5)
