"""Visemes that turn joints: an avatar without blend shapes opens its mouth with the bone of its jaw."""

import json
import struct
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.assets import Assets
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.joints import JAW
from reactive_realizer.embodiment.quaternion import rotation_vector
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import open_pilot

VISEMES = f"""
[articulators.jaw]
joints = ["{JAW}"]
before = 0.06
after = 0.06

[visemes.PP]
contact = ["jaw"]

[visemes.aa]
joints = {{ {JAW} = [18, 0, 0] }}

[visemes.oh]
joints = {{ {JAW} = [12, 0, 0] }}
"""


def with_jaw(path: Path) -> None:
    """Writes the avatar of the package with one more bone, the jaw, and without morph targets."""
    glb = Assets()("avatars/female.glb").read_bytes()
    length = struct.unpack_from("<I", glb, 12)[0]
    scene = json.loads(glb[20 : 20 + length])
    head = next(node for node in scene["nodes"] if node.get("name") == "Head")
    head["children"] = [*head.get("children", []), len(scene["nodes"])]
    scene["skins"][0]["joints"].append(len(scene["nodes"]))
    scene["nodes"].append({"name": "Jaw", "translation": [0.0, 0.02, 0.03]})
    for mesh in scene["meshes"]:
        mesh.pop("extras", None)
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    rest = glb[20 + length :]
    header = struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest))
    path.write_bytes(header + struct.pack("<I4s", len(text), b"JSON") + text + rest)


def human_file(folder: Path, *, jaw: bool) -> Path:
    if jaw:
        with_jaw(folder / "puppet.glb")
    else:
        (folder / "puppet.glb").write_bytes(Assets()("avatars/female.glb").read_bytes())
    (folder / "puppet.visemes.toml").write_text(VISEMES)
    human = folder / "human.toml"
    human.write_text('[character.alice]\navatar = "puppet.glb"\nidle = false\n')
    return human


@pytest.mark.speech
async def test_the_jaw_turns_with_the_vowels_and_is_closed_in_a_b_and_at_the_end(tmp_path: Path) -> None:
    human = human_file(tmp_path, jaw=True)
    async with open_pilot(SceneOptions(human, "espeak", (tmp_path,))) as pilot:
        pilot.watch()
        pilot.block("b", '<speech id="s"><text>Papa, mama.</text></speech>')
        await pilot.advance(2.5)
        assert pilot.feedback.warnings == []
        opened = np.degrees([rotation_vector(body.rotation(JAW))[0] for body in pilot.bodies()])
        closings = sum(one > 4.0 > other for one, other in pairwise(opened))
        assert 12.0 < opened.max() < 18.1
        assert closings >= 3
        assert abs(opened[round(50 * pilot.feedback.time("b:s:end")) + 8 :]).max() < 0.1


async def test_an_avatar_without_the_joint_is_refused_with_the_entry(tmp_path: Path) -> None:
    human = human_file(tmp_path, jaw=False)
    with pytest.raises(RealizerError, match=rf"puppet\.visemes\.toml: .*'{JAW}' is not a joint of the avatar"):
        async with open_pilot(SceneOptions(human, "text", (tmp_path,))):
            pass
