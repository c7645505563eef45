"""Faces of other tools: expressions of VRM files, from BML to the weights of their morph targets."""

from pathlib import Path
from typing import Any

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import open_pilot

from .rigs import Rig, write

HUMAN = '[character.alice]\navatar = "avatars/anna.vrm"\nidle = false\n'
FACES = """
<faceLexeme id="shut" lexeme="CLOSE_EYES" amount="1" start="0" end="2"/>
<faceLexeme id="glad" lexeme="JOY" amount="1" start="2.5" end="4.5"/>
<faceLexeme id="angry" lexeme="ANGER" amount="1" start="5" end="7"/>
<bmlt:facemorph xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt" id="wow" targetname="Wow" intensity="0.5" start="7.5"
  end="9.5"/>
"""
TARGETS = ("key 0", "key 1", "key 2", "key 3")


def vrm() -> dict[str, Any]:
    """A scene of VRM 1 with four morph targets, four expressions that use them, and one that cannot be used."""
    scene = Rig().scene()
    scene["meshes"] = [{"name": "Face", "primitives": [{"targets": [{}] * 4}], "extras": {"targetNames": TARGETS}}]
    node = len(scene["nodes"])
    scene["nodes"].append({"name": "Face", "mesh": 0})
    preset, custom = {"blink": [0], "happy": [1], "angry": [1, 2], "sad": [9]}, {"Wow": [3]}
    binds = {
        name: {"morphTargetBinds": [{"node": node, "index": i, "weight": 1.0} for i in targets]}
        for name, targets in (preset | custom).items()
    }
    kinds = {"preset": {n: binds[n] for n in preset}, "custom": {n: binds[n] for n in custom}}
    scene["extensions"] = {"VRMC_vrm": {"humanoid": {"humanBones": {}}, "expressions": kinds}}
    return scene


async def test_expressions_show_by_those_of_the_file(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "avatars").mkdir()
    write(tmp_path / "avatars" / "anna.vrm", vrm())
    human = tmp_path / "human.toml"
    human.write_text(HUMAN)
    async with open_pilot(SceneOptions(human, "text", (tmp_path,))) as pilot:
        assert "anna.vrm: the expression 'sad' moves the morph target 9 of the mesh 'Face'" in caplog.text
        pilot.watch()
        pilot.block("b", FACES)
        await pilot.advance(10)
        assert pilot.feedback.warnings == []
        morphs = pilot.realizer.characters["alice"].humanoid.avatar.morphs
        frames = {round(f.time, 2): dict(zip(morphs, f.weights, strict=True)) for f in pilot.frames["alice"]}
    shown = {time: [round(float(frames[time][name]), 1) for name in TARGETS] for time in (1.0, 3.5, 6.0, 8.5)}
    assert shown[1.0] == [1.0, 0.0, 0.0, 0.0]
    assert shown[3.5][1] > 0.7
    assert shown[6.0] == [0.0, 1.0, 1.0, 0.0]
    assert shown[8.5] == [0.0, 0.0, 0.0, 0.5]
