"""How a face shows blend shapes, visemes and expressions by the morph targets that it has."""

from collections.abc import Mapping
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import pytest

from reactive_realizer.embodiment.avatar import SKIN_COLORS, Avatar
from reactive_realizer.embodiment.face_map import FaceMap, StandIns
from reactive_realizer.embodiment.face_names import ARKIT, OCULUS, VRM, meaning
from reactive_realizer.embodiment.morph_targets import MorphTargets
from reactive_realizer.errors import RealizerError

ASSETS = Path(str(files("reactive_realizer"))) / "assets"
TABLE = StandIns.read(ASSETS / "face/stand_ins.toml")
FEMALE = Avatar.read(ASSETS / "avatars/female.glb")


def face(*morphs: str, expressions: Mapping[str, Mapping[str, float]] | None = None) -> FaceMap:
    """The face of an avatar with some morph targets."""
    targets = MorphTargets(expressions=expressions or {})
    return FaceMap(replace(FEMALE, morphs=(*morphs, *SKIN_COLORS), targets=targets), TABLE)


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("jawOpen", "jawOpen"),
        ("JawOpen", "jawOpen"),
        ("Jaw_Open", "jawOpen"),
        ("eyeBlink_L", "eyeBlinkLeft"),
        ("blendShape1.eyeBlink_R", "eyeBlinkRight"),
        ("A14_Eye_Blink_Left", "eyeBlinkLeft"),
        ("Wolf3D_Head:mouthSmileLeft", "mouthSmileLeft"),
        ("viseme_aa", "viseme_aa"),
        ("Viseme_PP", "viseme_PP"),
        ("vrc.v_oh", "viseme_O"),
        ("Blink_L", "blinkLeft"),
        ("Surprised", "surprised"),
        ("Fcl_MTH_A", "aa"),
        ("Face.M_F00_000_00_Fcl_EYE_Close_R", "blinkRight"),
        ("あ", "aa"),
        ("Fcl_MTH_Angry", None),
        ("Brow_Raise", None),
        ("key 7", None),
    ],
)
def test_a_name_means_the_same_in_every_spelling(name: str, meant: str | None) -> None:
    assert meaning(name, TABLE.names) == meant


def test_every_vocabulary_means_itself() -> None:
    assert len(ARKIT) == 52
    assert len(OCULUS) == 15
    assert [meaning(name, {}) for name in (*ARKIT, *OCULUS, *VRM)] == [*ARKIT, *OCULUS, *VRM]


def test_a_face_with_the_names_of_arkit_shows_weights_as_they_are() -> None:
    female = FaceMap(FEMALE, TABLE)
    weights = {"jawOpen": 0.4, "temporomandibular+x": 0.1, "skinBlush": 0.5}
    assert female(weights) is weights
    assert not female.stand_ins


def test_other_spellings_move_all_targets_that_mean_the_same() -> None:
    shown = face("Head.JawOpen", "Teeth.JawOpen")({"jawOpen": 0.4})
    assert shown == {"Head.JawOpen": 0.4, "Teeth.JawOpen": 0.4}


def test_an_expression_moves_its_targets_by_their_weights() -> None:
    shown = face("m0", "m1", expressions={"aa": {"m0": 0.6, "m1": 0.2}, "oh": {"m0": 1.0}})({"aa": 0.5, "oh": 0.5})
    assert shown == pytest.approx({"m0": 0.8, "m1": 0.1})


def test_custom_expressions_may_be_blend_shapes() -> None:
    assert face("m0", expressions={"BrowDownLeft": {"m0": 1.0}})({"browDownLeft": 0.7}) == {"m0": 0.7}


@pytest.mark.parametrize(
    ("has", "asked", "shown"),
    [
        ("viseme_aa", {"jawOpen": 1.0}, {"viseme_aa": 0.9}),
        ("aa", {"jawOpen": 1.0}, {"aa": 0.9}),
        ("blink", {"eyeBlinkLeft": 1.0, "eyeBlinkRight": 1.0}, {"blink": 1.0}),
        ("blink", {"eyeBlinkLeft": 1.0}, {"blink": 0.5}),
        ("blinkLeft", {"eyeBlinkLeft": 1.0}, {"blinkLeft": 1.0}),
        ("happy", {"mouthSmileLeft": 0.8, "mouthSmileRight": 0.8}, {"happy": 0.8}),
        ("mouthSmile", {"mouthSmileLeft": 0.8, "mouthSmileRight": 0.8}, {"mouthSmile": 0.8}),
        ("angry", {"browDownLeft": 0.5, "browDownRight": 0.5, "browInnerUp": 0.9}, {"angry": 0.0}),
        ("angry", {"browDownLeft": 1.0, "browDownRight": 1.0, "noseSneerLeft": 1.0}, {"angry": 1.0}),
    ],
)
def test_a_stand_in_shows_what_the_face_lacks(has: str, asked: Mapping[str, float], shown: Mapping[str, float]) -> None:
    assert face(has)(asked) == pytest.approx(shown)


def test_a_jaw_turns_where_no_morph_target_opens_the_mouth() -> None:
    names = (*FEMALE.skeleton.joints, "temporomandibular")
    parents, offsets = (*FEMALE.skeleton.parents, 5), (*FEMALE.skeleton.offsets, (0.0, 0.0, 0.05))
    skeleton = replace(FEMALE.skeleton, joints=names, parents=parents, offsets=offsets)
    jawed = FaceMap(replace(FEMALE, morphs=SKIN_COLORS, skeleton=skeleton, targets=MorphTargets()), TABLE)
    assert jawed({"jawOpen": 0.5}) == {"temporomandibular+x": 0.2}


def test_what_a_face_can_not_show_is_left_as_it_is() -> None:
    assert face("blink")({"cheekPuff": 1.0}) == {"cheekPuff": 1.0}


def test_every_stand_in_of_the_package_is_for_a_blend_shape_and_from_known_names() -> None:
    known = {*ARKIT, *OCULUS, *VRM, *TABLE.names.values(), "temporomandibular+x"}
    assert {name for each in TABLE.alternatives.values() for weights in each for name in weights} <= known


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[stand_ins]\njawOpne = [{ aa = 1.0 }]", "stand_ins.jawOpne: this is not a blend shape of ARKit"),
        ("[stand_ins]\njawOpen = { aa = 1.0 }", "stand_ins.jawOpen: expected a list of tables"),
        ("[stand_ins]\njawOpen = [{ aa = 'all' }]", "stand_ins.jawOpen: the weight of aa is not a number"),
        ("[names]\naa = 3", "names.aa: expected a list of names"),
        ("[standins]", "standins: known are"),
        ("names = [", "the file: "),
    ],
)
def test_an_entry_that_cannot_be_used_is_named(tmp_path: Path, text: str, said: str) -> None:
    file = tmp_path / "stand_ins.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(RealizerError, match=rf"stand_ins\.toml: {said}"):
        StandIns.read(file)
