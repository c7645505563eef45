"""The command `lexicon`."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from reactive_realizer.__main__ import main

BINDING = """<gesturebinding>
  <MotionUnitSpec type="gesture">
    <constraints><constraint name="lexeme" value="HOP"/><constraint name="mode" value="LEFT_HAND"/></constraints>
    <MotionUnit type="Gesture" file="nowhere.xml"/>
  </MotionUnitSpec>
  <MotionUnitSpec type="gesture">
    <constraints><constraint name="lexeme" value="SKIP"/></constraints>
    <MotionUnit type="Muscle" class="Biceps"/>
  </MotionUnitSpec>
  <MotionUnitSpec type="gesture">
    <constraints><constraint name="lexeme" value="JUMP"/><constraint name="mood" value="glad"/></constraints>
    <parametermap><parameter src="how_high" dst="a"/></parametermap>
    <parameterdefaults><parameterdefault name="a" value="0.25"/></parameterdefaults>
    <MotionUnit type="Gesture" file="procanimation/beat_right.xml"/>
  </MotionUnitSpec>
</gesturebinding>"""


@pytest.fixture
def lexicon(capsys: pytest.CaptureFixture[str]) -> Callable[..., tuple[list[str], list[str]]]:
    """Runs ``lexicon``: its lines on stdout and on stderr."""

    def run(*arguments: str | Path) -> tuple[list[str], list[str]]:
        assert main(["lexicon", *map(str, arguments)]) == 0
        said = capsys.readouterr()
        return said.out.splitlines(), said.err.splitlines()

    return run


@pytest.fixture
def words(lexicon: Callable[..., tuple[list[str], list[str]]]) -> Callable[..., list[dict[str, Any]]]:
    """The entries of the default scene from ``--json``."""

    def run(*arguments: str | Path) -> list[dict[str, Any]]:
        (text,), _ = lexicon("--json", *arguments)
        found: list[dict[str, Any]] = json.loads(text)["alice"]
        return found

    return run


def word(words: list[dict[str, Any]], element: str, lexeme: str, **constraints: str) -> dict[str, Any]:
    (found,) = [w for w in words if (w["element"], w["lexeme"], w["constraints"]) == (element, lexeme, constraints)]
    return found


def test_all_lexemes_of_the_package_play(lexicon: Callable[..., tuple[list[str], list[str]]]) -> None:
    said, complaints = lexicon()
    assert complaints == []
    assert {"alice:", "  gesture", "  head", "  faceLexeme", "  pose", "  procanimation"} <= set(said)


def test_a_line_has_the_lexeme_its_constraints_duration_points_parameters_and_file(
    lexicon: Callable[..., tuple[list[str], list[str]]],
) -> None:
    said, _ = lexicon()
    (beat,) = [line for line in said if line.split()[:2] == ["BEAT", "mode=BOTH_HANDS"]]
    assert beat.endswith(
        "s  start ready strokeStart stroke strokeEnd relax end  amount=1 (0 to 1), a=0.5  procanimation/beat_both.xml"
    )


def test_the_json_output_has_the_same_entries(words: Callable[..., list[dict[str, Any]]]) -> None:
    nod = word(words(), "head", "NOD")
    assert nod["syncPoints"] == ["start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end"]
    assert nod["duration"] == pytest.approx(0.7)
    assert {"name": "amount", "default": 0.5, "low": None, "high": None} in nod["parameters"]
    assert nod["file"] == "procanimation/smartbody/nod.xml"
    assert nod["problem"] is None
    assert word(words(), "faceLexeme", "RAISE_BROWS")["syncPoints"] == ["start", "attackPeak", "relax", "end"]


def test_a_conducting_pattern_has_its_beats(words: Callable[..., list[dict[str, Any]]]) -> None:
    bar = word(words(), "procanimation", "conduct-3-beat", mode="RIGHT_HAND")
    assert [point for point in bar["syncPoints"] if point.startswith("beat")] == ["beat1", "beat2", "beat3"]


def test_entries_of_the_user_come_first_and_invalid_ones_are_listed_on_stderr(
    lexicon: Callable[..., tuple[list[str], list[str]]], tmp_path: Path
) -> None:
    (tmp_path / "gesturebinding.xml").write_text(BINDING)
    said, complaints = lexicon("--assets", tmp_path)
    jump, beat = (next(i for i, line in enumerate(said) if line.split()[:1] == [name]) for name in ("JUMP", "BEAT"))
    assert jump < beat
    assert not any(line.split()[0] in ("HOP", "SKIP") for line in said)
    assert complaints == [
        "alice: gesture HOP mode=LEFT_HAND: there is no asset named 'nowhere.xml'",
        "alice: gesture SKIP: there is no motion unit 'Muscle'",
    ]


def test_parameters_have_the_names_and_defaults_of_the_binding(
    words: Callable[..., list[dict[str, Any]]], tmp_path: Path
) -> None:
    (tmp_path / "gesturebinding.xml").write_text(BINDING)
    jump = word(words("--assets", tmp_path), "gesture", "JUMP", mood="glad")
    assert {"name": "how_high", "default": 0.25, "low": None, "high": None} in jump["parameters"]


def test_each_character_has_its_own_lexemes(
    lexicon: Callable[..., tuple[list[str], list[str]]], tmp_path: Path
) -> None:
    human = tmp_path / "two.toml"
    human.write_text('[character.alice]\n[character.bob]\nengines = ["face"]')
    said, _ = lexicon("--human", human)
    assert [line for line in said if not line.startswith(" ")] == ["alice:", "bob:"]
    assert not any(line.startswith("  gesture") for line in said[said.index("bob:") :])


def test_the_error_of_a_malformed_binding_has_its_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "gesturebinding.xml").write_text("<gesturebinding>\n<MotionUnitSpec>\n</gesturebinding>")
    assert main(["lexicon", "--assets", str(tmp_path)]) == 2
    assert "gesturebinding.xml, line 3" in capsys.readouterr().err


def test_help_has_an_example(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["lexicon", "--help"])
    assert "example: reactive-realizer lexicon" in capsys.readouterr().out
