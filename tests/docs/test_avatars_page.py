"""docs/avatars.md: its table of stand-ins is used."""

from dataclasses import replace
from pathlib import Path

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.face_map import FaceMap, StandIns
from reactive_realizer.embodiment.morph_targets import MorphTargets

from .conftest import fences


def test_brows_rise_by_the_expression_of_the_example_and_lids_close_by_its_morph_target(tmp_path: Path) -> None:
    (example,) = fences("docs/avatars.md", "toml")
    file = tmp_path / "stand_ins.toml"
    file.write_text(example.text, encoding="utf-8")
    targets = MorphTargets(expressions={"Wonder": {"key 1": 1.0}})
    female = Avatar.read(PACKAGE_ASSETS / "avatars" / "female.glb")
    face = FaceMap(replace(female, morphs=("key 1", "CloseBothEyes"), targets=targets), StandIns.read(file))
    assert face({"browInnerUp": 0.8}) == {"key 1": 0.4}
    assert face({"eyeBlinkLeft": 1.0, "eyeBlinkRight": 1.0}) == {"CloseBothEyes": 1.0}
