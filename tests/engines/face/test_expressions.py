"""Compound faces, action units, morph targets and resting faces, as seen in frames."""

import numpy as np
import pytest

from reactive_realizer.testing.pilot import RealizerPilot

from .conftest import weight

EXT = 'xmlns="http://www.bml-initiative.org/bml/coreextensions-1.0"'


async def test_an_action_unit_moves_its_half_of_the_face_at_its_times(pilot: RealizerPilot) -> None:
    pilot.block(
        "b", f'<faceFacs {EXT} id="f" au="12" side="LEFT" amount="0.8" start="0" attackPeak="0.4" relax="1" end="1.4"/>'
    )
    await pilot.advance(2)
    assert pilot.feedback.warnings == []
    assert weight(pilot, "mouthSmileLeft")[20:50] == pytest.approx(0.8)
    assert weight(pilot, "mouthSmileLeft")[71:] == pytest.approx(0.0, abs=0.01)
    assert weight(pilot, "mouthSmileRight").max() < 0.01
    assert pilot.feedback.time("b:f:attackPeak") == 0.4


async def test_an_action_unit_that_no_blend_shape_is_like_is_warned_of(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<faceFacs {EXT} id="f" au="51"/><wait id="w" duration="0.1"/>')
    await pilot.advance(1)
    assert pilot.feedback.warnings == [("b:f", "CANNOT_CREATE_BEHAVIOR")]
    assert "there is no action unit 51; available: 1, 2, 4" in pilot.feedback.of("warningFeedback")[0].text
    assert pilot.feedback.reached("b:w:end")


async def test_the_parts_of_a_face_play_as_one_and_may_overlap(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        f"""<face id="f" start="0" attackPeak="0.4" relax="1" end="1.4">
              <faceLexeme lexeme="RAISE_BROWS"/><faceFacs {EXT} au="12"/><faceFacs {EXT} au="6"/>
            </face>""",
    )
    await pilot.advance(2)
    assert pilot.feedback.warnings == []
    assert weight(pilot, "mouthSmileLeft")[20:50] == pytest.approx(0.5)
    assert weight(pilot, "cheekSquintLeft")[20:50] == pytest.approx(0.5)
    assert weight(pilot, "browOuterUpLeft")[20:50].max() == pytest.approx(0.45, abs=0.03)


@pytest.mark.parametrize(("whole", "part", "shown"), [(1.0, 0.4, 0.8), (0.5, 0.4, 0.4), (0.25, 0.4, 0.2), (1, 1, 1)])
async def test_the_amount_of_a_face_scales_those_of_its_parts(
    pilot: RealizerPilot, whole: float, part: float, shown: float
) -> None:
    pilot.block("b", f'<face id="f" amount="{whole}"><faceFacs {EXT} au="12" amount="{part}"/></face>')
    await pilot.advance(2)
    assert weight(pilot, "mouthSmileLeft").max() == pytest.approx(shown)


async def test_a_face_overshoots_at_its_attack_peak(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        f"""<face id="f" overshoot="0.4" start="0" attackPeak="0.4" relax="1.2" end="1.6">
              <faceFacs {EXT} au="18"/></face>""",
    )
    await pilot.advance(2)
    pucker = weight(pilot, "mouthPucker")
    assert pucker[20] == pytest.approx(0.7)
    assert pucker[60] == pytest.approx(0.5)


async def test_a_morph_target_is_moved_by_its_name_and_an_unknown_one_is_warned_of(pilot: RealizerPilot) -> None:
    pilot.block("b", '<bmlt:facemorph id="f" targetname="cheekPuff" intensity="0.9"/>')
    pilot.block("c", '<bmlt:facemorph id="f" targetname="cheekPuf" intensity="0.9"/>')
    await pilot.advance(2)
    assert weight(pilot, "cheekPuff").max() == pytest.approx(0.9)
    assert pilot.feedback.warnings == [("c:f", "CANNOT_CREATE_BEHAVIOR")]
    assert "cheekPuff" in pilot.feedback.of("warningFeedback")[0].text


@pytest.mark.parametrize("element", ['faceLexeme lexeme="BLINK"', f'faceFacs {EXT} au="45" amount="1"'])
async def test_a_blink_that_is_asked_for_closes_the_lids_and_opens_them_in_a_quarter_of_a_second(
    pilot: RealizerPilot, element: str
) -> None:
    pilot.block("b", f'<head id="n" lexeme="NOD" stroke="1"/><{element} id="f" end="n:stroke"/>')
    await pilot.advance(1.5)
    closed = weight(pilot, "eyeBlinkLeft")
    assert pilot.feedback.time("b:f:start") == pytest.approx(1.0 - 0.255)
    assert closed[round(50 * 0.84)] > 0.95
    assert closed[: round(50 * 0.72)].max() == closed[50:].max() == 0.0


@pytest.mark.parametrize(
    ("face", "parameter", "shown"),
    [
        (f'<faceFacs {EXT} id="f" au="12" amount="0.2" {{}}/>', "amount", 0.4),
        (f'<face id="f" amount="0.1" {{}}><faceFacs {EXT} au="12" amount="1"/></face>', "amount", 0.8),
        ('<bmlt:facemorph id="f" targetname="mouthSmileLeft" intensity="0.2" {}/>', "intensity", 0.4),
    ],
)
async def test_the_strength_of_an_expression_changes_while_it_plays(
    pilot: RealizerPilot, face: str, parameter: str, shown: float
) -> None:
    change = f'<bmla:parametervaluechange id="c" target="f" paramId="{parameter}" start="1" end="1.4">'
    pilot.block(
        "b",
        f"""{face.format('start="0" attackPeak="0.4" relax="2" end="2.5"')}
            {change}<bmla:trajectory type="linear" targetValue="0.4"/></bmla:parametervaluechange>""",
    )
    await pilot.advance(3)
    assert pilot.feedback.warnings == []
    smile = weight(pilot, "mouthSmileLeft")
    assert smile[45] == pytest.approx(0.2)
    assert smile[60] == pytest.approx((smile[45] + smile[80]) / 2, abs=0.03)
    assert smile[80] == pytest.approx(shown)
    assert smile[-1] == 0.0


async def test_skin_blushes_and_turns_pale_by_words_and_by_weights_of_their_own(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        """<faceLexeme id="f" lexeme="BLUSHING" amount="0.6" end="6"/>
           <bmlt:facemorph id="m" targetname="skinPallor" intensity="0.4"/>""",
    )
    await pilot.advance(7)
    assert pilot.feedback.warnings == []
    blush = weight(pilot, "skinBlush")
    assert blush.max() == pytest.approx(0.6)
    assert np.abs(np.diff(blush)).max() < 0.02, "blood takes seconds"
    assert weight(pilot, "skinPallor").max() == pytest.approx(0.4)


SAD = '<faceShift id="f" start="{}" end="{}"><faceLexeme lexeme="{}" amount="1"/></faceShift>'


async def test_a_shift_stays_and_an_expression_takes_its_place_only_where_it_moves(pilot: RealizerPilot) -> None:
    pilot.block("b", SAD.format(0, 1, "SADNESS"))
    await pilot.advance(2)
    frown, brow = weight(pilot, "mouthFrownLeft"), weight(pilot, "browInnerUp")
    assert pilot.feedback.time("b:f:end") == 1.0
    assert frown[50:] == pytest.approx(0.8)
    assert np.abs(np.diff(frown)).max() < 0.05
    pilot.frames.clear()
    pilot.block("c", f'<faceFacs {EXT} id="f" au="12" amount="1"/>')
    await pilot.advance(3)
    smile, during = weight(pilot, "mouthSmileLeft"), weight(pilot, "mouthFrownLeft")
    assert during[smile.argmax()] == pytest.approx(0.0, abs=1e-3)
    assert weight(pilot, "browInnerUp")[smile.argmax()] == pytest.approx(brow[-1], abs=0.02)
    assert during[-1] == pytest.approx(0.8)
    assert np.abs(np.diff(during)).max() < 0.1


async def test_a_shift_to_neutral_ends_the_one_before_and_one_that_is_interrupted_stays_where_it_is(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", SAD.format(0, 1, "SADNESS"))
    await pilot.advance(0.5)
    pilot.block("stop", **{"bmla:interrupt": "b"})
    await pilot.advance(1)
    halfway = weight(pilot, "mouthFrownLeft")
    assert halfway[30:] == pytest.approx(0.4, abs=0.03)
    assert np.abs(np.diff(halfway)).max() < 0.05
    pilot.block("c", SAD.format(0, 0.5, "NEUTRAL"))
    await pilot.advance(1)
    assert weight(pilot, "mouthFrownLeft")[-1] == 0.0


async def test_a_block_that_replaces_all_others_returns_to_the_neutral_face(pilot: RealizerPilot) -> None:
    pilot.block("b", SAD.format(0, 1, "SADNESS"))
    await pilot.advance(2)
    pilot.block("all", composition="REPLACE")
    await pilot.advance(1)
    frown = weight(pilot, "mouthFrownLeft")
    assert frown[90] == pytest.approx(0.8)
    assert frown[-1] == 0.0
    assert np.abs(np.diff(frown)).max() < 0.1


async def test_a_moved_end_of_a_shift_is_followed_without_a_jump(pilot: RealizerPilot) -> None:
    pilot.predict("user", "stop", 1.0)
    pilot.block("b", SAD.format(0, "anticipators:user:stop", "SADNESS"))
    await pilot.advance(0.5)
    pilot.predict("user", "stop", 2.0)
    await pilot.advance(2)
    frown = weight(pilot, "mouthFrownLeft")
    assert pilot.feedback.time("b:f:end") == 2.0
    assert frown[99] < 0.8
    assert frown[101:] == pytest.approx(0.8)
    assert np.abs(np.diff(frown)).max() < 0.05
