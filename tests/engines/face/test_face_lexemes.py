"""Morph weights of face lexemes."""

import json
from importlib.resources import files
from pathlib import Path

import pytest

from reactive_realizer.bml.vocabulary import Side
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.engines.face.expressions import Expressions
from reactive_realizer.errors import RealizerError

ASSETS = Path(str(files("reactive_realizer"))) / "assets"
UNITS = ASSETS / "face" / "action_units.json"
EXPRESSIONS = Expressions.read(ASSETS / "face" / "lexemes.json", UNITS)
OURS = EXPRESSIONS.lexemes


def test_every_lexeme_of_bml_is_defined() -> None:
    sides = ["RAISE_{}_BROW", "LOWER_{}_BROW", "LOWER_{}_MOUTH_CORNER", "RAISE_{}_MOUTH_CORNER"]
    both = (
        "OBLIQUE_BROWS RAISE_BROWS LOWER_BROWS LOWER_MOUTH_CORNERS RAISE_MOUTH_CORNERS OPEN_MOUTH OPEN_LIPS WIDEN_EYES"
    )
    words = {side.format(which) for side in sides for which in ("LEFT", "RIGHT")} | {*both.split(), "CLOSE_EYES"}
    assert words < OURS.keys()
    assert len(words) == 17


def test_the_basic_emotions_move_eyes_brows_and_mouth_together() -> None:
    for emotion in ("JOY", "SADNESS", "ANGER", "FEAR", "DISGUST", "SURPRISE"):
        assert {"mouth", "jaw"} & set(map(region, OURS[emotion])), emotion
        assert {"brow", "cheek"} & set(map(region, OURS[emotion])), emotion
        assert "eye" in map(region, OURS[emotion]), emotion
    assert OURS["HAPPY"] == OURS["JOY"]
    assert OURS["NEUTRAL"] == {}


def region(morph: str) -> str:
    return next(name for name in ("brow", "eye", "cheek", "nose", "mouth", "jaw", "tongue") if morph.startswith(name))


def test_an_action_unit_moves_one_half_or_both() -> None:
    lips = EXPRESSIONS.units[12]
    assert lips.weights(Side.LEFT) == {"mouthSmileLeft": 1.0}
    assert lips.weights(Side.BOTH) == {"mouthSmileLeft": 1.0, "mouthSmileRight": 1.0}
    assert EXPRESSIONS.units[18].weights(Side.RIGHT) == {"mouthPucker": 1.0}


@pytest.mark.parametrize("name", ["female", "male"])
def test_every_morph_of_a_lexeme_exists_on_the_avatars(name: str) -> None:
    morphs = set(Avatar.read(ASSETS / "avatars" / f"{name}.glb").morphs)
    assert all(weights.keys() <= morphs for weights in OURS.values())
    assert all(weights for lexeme, weights in OURS.items() if lexeme != "NEUTRAL")
    for number, unit in EXPRESSIONS.units.items():
        assert unit.weights(Side.BOTH), number
        assert unit.weights(Side.BOTH).keys() <= morphs, number


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
        (json.dumps({"lexemes": {"SMILE": {"mouthSmileLeft": 3}}}), r"<SMILE>: weights are numbers from 0 to 2"),
        (json.dumps({"lexemes": {}, "durations": {"BLINK": [0.1, 0]}}), r"<BLINK>: durations are three numbers"),
        (json.dumps({"lexemes": {"SMILE": 1}}), r"<SMILE>"),
        ('{"lexemes": {"SMILE": {"mouthSmileLeft": NaN}}}', r"<SMILE>"),
        ('{"lexemes": {}, "emotions": {"JOY": {"12 UP": 1}}}', r"<JOY>: '12 UP' is not an action unit"),
        ('{"lexemes": {}, "emotions": {"JOY": {"99": 1}}}', r"<JOY>: '99' is not an action unit"),
        ('{"lexemes": {}, "synonyms": {"GLAD": "JOY"}}', r"<GLAD>: there is no lexeme 'JOY'"),
    ],
)
def test_an_invalid_table_is_refused_with_file_and_lexeme(tmp_path: Path, content: str, message: str) -> None:
    path = tmp_path / "face.json"
    path.write_text(content)
    with pytest.raises(RealizerError, match=message):
        Expressions.read(path, UNITS)


@pytest.mark.parametrize(
    ("units", "message"),
    [
        ({"one": {"name": "x"}}, r"<one>: these entries are named by their numbers"),
        ({"1": {"middle": {}}}, r"<1>: an action unit has a name"),
        ({"1": {"name": "x", "sides": {"brow": -1}}}, r"<1>: weights are numbers from 0 to 1"),
    ],
)
def test_an_invalid_action_unit_is_refused_with_its_number(tmp_path: Path, units: object, message: str) -> None:
    path = tmp_path / "units.json"
    path.write_text(json.dumps({"units": units}))
    with pytest.raises(RealizerError, match=message):
        Expressions.read(ASSETS / "face" / "lexemes.json", path)
