"""Libraries of Greta for heads and torsos: what they say about points, and what is left out of wrong ones."""

import logging
from pathlib import Path

import pytest

from reactive_realizer.binding.spine_library import SpineLibrary, SpineMovement, SpinePoint, Tilt, sequence
from reactive_realizer.errors import RealizerError


def read(tmp_path: Path, *movements: str, part: str = "head") -> SpineLibrary:
    root = {"head": "HeadGestures", "torso": "TorsoGestures"}[part]
    path = tmp_path / f"{part}.xml"
    path.write_text("\n".join((f"<{root}>", *movements, f"</{root}>")))
    return SpineLibrary.read(path, part)


def head(name: str, inside: str, attributes: str = "") -> str:
    return f'<head id="{name}" {attributes}><KeyPoint type="strokeEnd">{inside}</KeyPoint></head>'


TILT = '<SagittalTilt direction="Forward" min="0.1" max="0.4"/>'


@pytest.mark.parametrize(
    ("tilt", "expected"),
    [
        (TILT, Tilt(0, 0.1, 0.4)),
        ('<SagittalTilt direction="Backward"/>', Tilt(0, 0.0, -1.0)),
        ('<VerticalTorsion direction="Leftward" min="0.5" max="0.5"/>', Tilt(1, 0.5, 0.5)),
        ('<VerticalTorsion direction="RIGHTWARD" max="0.2"/>', Tilt(1, 0.0, -0.2)),
        ('<LateralRoll direction="Leftward" max="0.3"/>', Tilt(2, 0.0, -0.3)),
        ('<LateralRoll direction="Rightward" max="0.3"/>', Tilt(2, 0.0, 0.3)),
    ],
)
def test_a_direction_is_the_sign_of_a_rotation_about_an_axis(tmp_path: Path, tilt: str, expected: Tilt) -> None:
    (point,) = read(tmp_path, head("x", tilt)).movement("x").points
    assert point.tilts == (expected,)


def test_the_amount_of_a_torso_is_a_factor_of_its_tilts(tmp_path: Path) -> None:
    torso = f'<torso id="x" amount="0.5" repetition="2"><KeyPoint>{TILT}</KeyPoint></torso>'
    movement = read(tmp_path, torso, part="torso").movement("x")
    assert movement.repetition == 2
    assert movement.points == (SpinePoint("", (Tilt(0, 0.05, 0.2),), ()),)


def test_a_point_may_rotate_joints(tmp_path: Path) -> None:
    torso = '<torso id="x"><KeyPoint><Rotations><vl5 w="2" x="0" y="0" z="0"/></Rotations></KeyPoint></torso>'
    (point,) = read(tmp_path, torso, part="torso").movement("x").points
    assert point.rotations == (("vl5", (1.0, 0.0, 0.0, 0.0)),)


def test_a_movement_is_found_by_its_id_and_otherwise_by_its_lexeme(tmp_path: Path) -> None:
    big, small = head("Nod_Big", TILT, 'lexeme="NOD"'), head("Nod_Small", TILT, 'lexeme="NOD"')
    library = read(tmp_path, big, small, head("Toss", TILT, 'lexeme="Nod_Small"'))
    names = ("nod", "NOD_SMALL", "head=Nod-Small", "toss")
    assert [library.movement(name).id for name in names] == ["Nod_Big", "Nod_Small", "Nod_Small", "Toss"]
    with pytest.raises(RealizerError, match=r"head.xml has no head 'Shake'"):
        library.movement("Shake")


def test_repeated_movements_of_one_point_come_back_in_between() -> None:
    point, other = SpinePoint("stroke", (Tilt(0, 0.0, 1.0),), ()), SpinePoint("stroke", (Tilt(1, 0.0, 1.0),), ())
    back = SpinePoint("", (), ())
    once, twice = SpineMovement("x", "", (point,), 1, ()), SpineMovement("x", "", (point,), 2, ())
    assert list(sequence(once, 2)) == [(0, point), (0, back), (1, point)]
    assert list(sequence(twice, 1)) == [(0, point), (0, back), (0, point)]
    pair = SpineMovement("x", "", (point, other), 1, ())
    assert [each for _, each in sequence(pair, 2)] == [point, other, point, other]


@pytest.mark.parametrize(
    ("part", "reason"),
    [
        ('<SagittalTilt direction="Leftward"/>', "direction='Leftward': known are FORWARD, BACKWARD"),
        ('<SagittalTilt direction="Forward" max="far"/>', "max='far' is not a number"),
        ("<Collapse/>", "known are SagittalTilt, VerticalTorsion, LateralRoll, Rotations"),
        ('<Rotations><vl5 w="0" x="0" y="0" z="0"/></Rotations>', "the quaternion is 0"),
    ],
)
def test_a_wrong_part_is_named_with_its_line_and_the_others_are_read(tmp_path: Path, part: str, reason: str) -> None:
    movement = read(tmp_path, head("a", TILT), head("x", part + TILT)).movement("x")
    (fault,) = movement.faults
    assert fault.sentence.startswith("head.xml, line 3, <")
    assert reason in fault.sentence
    assert movement.points[0].tilts == (Tilt(0, 0.1, 0.4),)


def test_only_the_first_hundred_points_are_used(tmp_path: Path) -> None:
    movement = read(tmp_path, f'<head id="x" repetition="1000">{"<KeyPoint/>" * 101}</head>').movement("x")
    assert (len(movement.points), movement.repetition) == (100, 20)
    assert "101 points; the first 100 are used" in movement.faults[0].sentence


def test_what_nothing_can_name_is_logged_and_other_files_are_refused(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING):
        assert [each.id for each in read(tmp_path, "<head/>", head("x", TILT)).movements] == ["x"]
    assert "head.xml, line 2, <head>: the attribute id is missing; it is left out" in caplog.text
    with pytest.raises(RealizerError, match=r"line 1, <HeadGestures>: the file should begin with <TorsoGestures>"):
        SpineLibrary.read(tmp_path / "head.xml", "torso")
