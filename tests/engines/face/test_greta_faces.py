"""Libraries of faces of Greta, as seen in frames, and what is left out of wrong ones."""

import logging
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.vocabulary import Side
from reactive_realizer.engine.lexicon import lexicon_of
from reactive_realizer.engines.face.greta_faces import GretaAction, GretaFaces
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .conftest import STILL, weight

BINDING = """<facebinding><FaceUnitSpec type="faceLexeme">
  <parametermap><parameter src="lexeme" dst="lexeme"/><parameter src="amount" dst="intensity"/></parametermap>
  <FaceUnit type="GretaFace" filename="faces.xml"/>
</FaceUnitSpec></facebinding>"""

LIBRARY = """<facelibrary>
  <expression class="faceexp" instance="Wry">
    <action name="AU2" side="left" intensity="0.8"/><action name="AU12"/>
  </expression>
  <expression class="faceexp" instance="plain"/>
  <expression class="gaze" instance="look_up"><action name="AU63"/></expression>
  <expression class="faceexp" instance="JOY"><action name="AU12" intensity="0.3"/><action name="AU63"/></expression>
</facelibrary>"""


async def played(tmp_path: Path, behavior: str, *, draft: bool = False) -> RealizerPilot:
    for name, text in (("facebinding.xml", BINDING), ("faces.xml", LIBRARY), ("still.toml", STILL)):
        (tmp_path / name).write_text(text, encoding="utf-8")
    async with open_pilot(SceneOptions(tmp_path / "still.toml", "text", (tmp_path,))) as pilot:
        pilot.watch()
        if draft:
            pilot.perform(f'<bml id="b">{behavior}</bml>')
        else:
            pilot.block("b", behavior)
        await pilot.advance(2.1)
        return pilot


def highest(pilot: RealizerPilot, *morphs: str) -> list[float]:
    return [float(weight(pilot, morph).max()) for morph in morphs]


BROWS = ("browOuterUpLeft", "browOuterUpRight")


async def test_an_expression_has_the_units_sides_and_intensities_of_the_file(tmp_path: Path) -> None:
    full = await played(tmp_path, '<faceLexeme id="f" lexeme="wry" amount="1"/>')
    half = await played(tmp_path, '<faceLexeme id="f" lexeme="faceexp=Wry" amount="0.5"/>')
    assert full.feedback.warnings == []
    assert highest(full, *BROWS) == pytest.approx([0.8, 0.0])
    assert highest(half, *BROWS) == pytest.approx([0.4, 0.0])
    assert highest(full, "mouthSmileRight")[0] == pytest.approx(2.0 * highest(half, "mouthSmileRight")[0])


async def test_a_draft_of_greta_plays_its_faces(tmp_path: Path) -> None:
    pilot = await played(tmp_path, '<face id="f" amount="1"><lexeme lexeme="wry"/></face>', draft=True)
    assert pilot.feedback.warnings == []
    assert highest(pilot, *BROWS) == pytest.approx([0.8, 0.0])


async def test_faces_of_the_file_come_before_those_of_the_package_which_play_the_others(tmp_path: Path) -> None:
    own = await played(tmp_path, '<faceLexeme id="f" lexeme="JOY" amount="1"/>')
    other = await played(tmp_path, '<faceLexeme id="f" lexeme="SURPRISE" amount="1"/>')
    assert highest(own, "cheekSquintLeft") == [0.0]
    assert min(highest(other, *BROWS)) > 0.3
    assert other.feedback.warnings == []


async def test_an_expression_without_units_is_a_plain_face(tmp_path: Path) -> None:
    pilot = await played(tmp_path, '<faceLexeme id="f" lexeme="plain"/>')
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:f:end") > 1.0


async def test_the_lexicon_lists_the_expressions_of_the_file(tmp_path: Path) -> None:
    pilot = await played(tmp_path, '<faceLexeme id="f" lexeme="plain"/>')
    entries = lexicon_of(pilot.realizer.characters["alice"].engines)
    assert [each.lexeme for each in entries if each.file == "faces.xml"] == ["Wry", "plain", "JOY"]
    (tmp_path / "faces.xml").write_text("<faces/>")
    problems = [each.problem for each in lexicon_of(pilot.realizer.characters["alice"].engines) if each.problem]
    assert any("the file should begin with <facelibrary>" in problem for problem in problems)


UNITS = frozenset({2, 12})


def test_units_that_faces_do_not_have_are_left_out_with_one_line_of_the_log(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    path = tmp_path / "faces.xml"
    path.write_text(LIBRARY)
    with caplog.at_level(logging.WARNING):
        faces, again = (GretaFaces.read(path, UNITS).faces for _ in range(2))
    assert faces is again
    assert list(faces) == ["Wry", "plain", "JOY"]
    assert faces["Wry"] == (GretaAction(2, 0.8, Side.LEFT), GretaAction(12, 1.0, Side.BOTH))
    (record,) = caplog.records
    assert record.getMessage() == "faces.xml: faces do not have these action units, which are left out: 63"


@pytest.mark.parametrize(
    ("action", "reason"),
    [
        ('<action name="smile"/>', "name='smile' is no action unit, such as AU12"),
        ('<action name="AU12" intensity="2"/>', "intensity='2' is not from 0 to 1"),
        ('<action name="AU12" intensity="much"/>', "intensity='much' is not a number"),
        ('<action name="AU12" side="UP"/>', "side='UP': known are LEFT, RIGHT, BOTH"),
        ("<fap/>", "known is action"),
    ],
)
def test_a_wrong_action_is_logged_with_its_line_and_the_others_show(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, action: str, reason: str
) -> None:
    path = tmp_path / "faces.xml"
    path.write_text(
        f'<facelibrary>\n<expression instance="x">\n{action}<action name="AU2"/></expression></facelibrary>'
    )
    with caplog.at_level(logging.WARNING):
        assert [each.unit for each in GretaFaces.read(path, UNITS).face("x")] == [2]
    assert "faces.xml, line 3, <" in caplog.text
    assert f"{reason}; it is left out" in caplog.text


def test_an_expression_without_a_name_and_a_file_of_another_kind_are_refused(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    path, other = tmp_path / "faces.xml", tmp_path / "other.xml"
    path.write_text("<facelibrary>\n<expression/></facelibrary>")
    other.write_text("<faces/>")
    with caplog.at_level(logging.WARNING):
        library = GretaFaces.read(path, UNITS)
    assert "line 2, <expression>: the attribute instance is missing; it is left out" in caplog.text
    with pytest.raises(RealizerError, match=r"faces.xml has no face 'x'"):
        library.face("x")
    with pytest.raises(RealizerError, match=r"other.xml, line 1, <faces>: the file should begin with <facelibrary>"):
        GretaFaces.read(other, UNITS)
