"""The command `avatar`."""

from importlib.resources import files
from pathlib import Path

import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.assembly.human_file import read_human_file

FEMALE = Path(str(files("reactive_realizer"))) / "assets" / "avatars" / "female.glb"


def test_it_lists_bones_gaps_and_morph_targets(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["avatar", str(FEMALE)]) == 0
    *bones, joints, morphs = capsys.readouterr().out.splitlines()
    assert [line.split() for line in bones if "LeftForeArm" in line] == [["LeftForeArm", "l_elbow"]]
    assert joints == "joints: 54; missing: temporomandibular"
    assert "jawOpen" in morphs
    assert "skinBlush" not in morphs


def test_it_writes_a_human_file(tmp_path: Path) -> None:
    human = tmp_path / "human.toml"
    assert main(["avatar", str(FEMALE), "--write", str(human)]) == 0
    assert read_human_file(human).characters["alice"].avatar == "avatars/female.glb"


def test_a_file_that_is_no_avatar_is_refused_and_nothing_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wrong, human = tmp_path / "wrong.glb", tmp_path / "human.toml"
    wrong.write_bytes(b"<html>no avatar here</html>")
    assert main(["avatar", str(wrong), "--write", str(human)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line == "wrong.glb cannot be used as an avatar: not a binary glTF 2 file"
    assert not human.exists()
