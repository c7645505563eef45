"""The command `avatar`."""

import os
from importlib.resources import files
from pathlib import Path

import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.assembly.human_file import read_human_file
from reactive_realizer.embodiment.glb import read_binary, write_binary

FEMALE = Path(str(files("reactive_realizer"))) / "assets" / "avatars" / "female.glb"


def test_it_lists_bones_gaps_and_morph_targets(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["avatar", str(FEMALE)]) == 0
    *bones, joints, morphs, expressions, arkit, _, _, lips = capsys.readouterr().out.splitlines()
    assert [line.split() for line in bones if "LeftForeArm" in line] == [["LeftForeArm", "l_elbow"]]
    assert joints == "joints: 54; missing: temporomandibular"
    assert "jawOpen" in morphs
    assert "skinBlush" not in morphs
    assert expressions.startswith("expressions of the file: aa, ih, ou")
    assert arkit == "ARKit: 52 of 52; missing: none"
    assert lips == "lip-sync: visemes/arkit.toml"


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


def test_a_file_that_does_not_exist_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    missing = tmp_path / "anna.glb"
    assert main(["avatar", str(missing)]) == 2
    assert capsys.readouterr().err == f"anna.glb cannot be used as an avatar: there is no file {missing}\n"


@pytest.mark.timeout(20)
def test_a_pipe_is_refused_and_not_waited_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pipe = tmp_path / "pipe.glb"
    os.mkfifo(pipe)
    assert main(["avatar", str(pipe)]) == 2
    assert "pipe.glb cannot be used as an avatar: not a file" in capsys.readouterr().err


def test_it_says_what_a_face_has_and_what_stands_in_for_the_rest(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene, _ = read_binary(FEMALE)
    scene["meshes"] = [{"name": "Face", "primitives": [{"targets": [{}]}], "extras": {"targetNames": ["Blink"]}}]
    bind = {"node": 54, "index": 7, "weight": 1.0}
    scene["extensions"]["VRMC_vrm"]["expressions"] = {"preset": {"aa": {"morphTargetBinds": [bind]}}}
    file = tmp_path / "anna.vrm"
    write_binary(file, scene, b"")
    assert main(["avatar", str(file)]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert "VRM: 1 of 18; missing: happy, angry, sad, relaxed, surprised, neutral, aa, ih" in "\n".join(printed)
    assert "ARKit: 0 of 52" in printed
    assert "stand-in: eyeBlinkLeft = +0.5 blink" in printed
    (note,) = (line for line in printed if line.startswith("note: the expression"))
    assert note.startswith(
        "note: the expression 'aa' moves the morph target 7 of the mesh 'Face', which does not exist"
    )
