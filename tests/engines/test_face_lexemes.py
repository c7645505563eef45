"""Morph weights of face lexemes."""

import json
from importlib.resources import files
from pathlib import Path

import pytest

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.engines.face_engine import read_face_lexemes
from reactive_realizer.errors import RealizerError

ASSETS = Path(str(files("reactive_realizer"))) / "assets"
OURS = read_face_lexemes(ASSETS / "face" / "lexemes.json")


def test_every_lexeme_of_bml_is_defined() -> None:
    sides = ["RAISE_{}_BROW", "LOWER_{}_BROW", "LOWER_{}_MOUTH_CORNER", "RAISE_{}_MOUTH_CORNER"]
    both = (
        "OBLIQUE_BROWS RAISE_BROWS LOWER_BROWS LOWER_MOUTH_CORNERS RAISE_MOUTH_CORNERS OPEN_MOUTH OPEN_LIPS WIDEN_EYES"
    )
    words = {side.format(which) for side in sides for which in ("LEFT", "RIGHT")} | {*both.split(), "CLOSE_EYES"}
    assert OURS.keys() == words
    assert len(OURS) == 17


@pytest.mark.parametrize("name", ["female", "male"])
def test_every_morph_of_a_lexeme_exists_on_the_avatars(name: str) -> None:
    morphs = set(Avatar.read(ASSETS / "avatars" / f"{name}.glb").morphs)
    assert all(weights and weights.keys() <= morphs for weights in OURS.values())


def test_one_sided_lexemes_move_only_that_side() -> None:
    assert "browOuterUpLeft" in OURS["RAISE_LEFT_BROW"]
    assert "browOuterUpRight" not in OURS["RAISE_LEFT_BROW"]
    for left, weights in OURS.items():
        if "_LEFT_" in left:
            right = {morph.replace("Left", "Right"): weight for morph, weight in weights.items()}
            assert OURS[left.replace("_LEFT_", "_RIGHT_")] == right


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("{", r"face\.json, line 1, <JSON>"),
        ("[]", r"<lexemes>: no object of that name"),
        (json.dumps({"lexemes": {"SMILE": {"mouthSmileLeft": 2}}}), r"<SMILE>: weights are numbers from 0 to 1"),
        (json.dumps({"lexemes": {"SMILE": 1}}), r"<SMILE>"),
        ('{"lexemes": {"SMILE": {"mouthSmileLeft": NaN}}}', r"<SMILE>"),
    ],
)
def test_an_invalid_table_is_refused_with_file_and_lexeme(tmp_path: Path, content: str, message: str) -> None:
    path = tmp_path / "face.json"
    path.write_text(content)
    with pytest.raises(RealizerError, match=message):
        read_face_lexemes(path)
