"""Characters without eyes."""

from pathlib import Path

import pytest

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import open_pilot

HUMANS = """
[character.alice]
avatar = "avatars/eyeless.glb"

[character.bob]
avatar = "avatars/male.glb"
position = [0.0, 0.0, 2.0]
heading = 180
"""


@pytest.mark.parametrize("eyes", [["LeftEye"], ["LeftEye", "RightEye"]])
async def test_figures_without_eyes_look_with_the_head_and_are_looked_at_at_the_top_of_the_neck(
    tmp_path: Path, eyes: list[str]
) -> None:
    avatar = (PACKAGE_ASSETS / "avatars" / "female.glb").read_bytes()
    for eye in eyes:
        for name in (eye, eye[0].lower() + eye[1:]):  # of the bone, and in the humanoid of VRM
            avatar = avatar.replace(f'"{name}"'.encode(), f'"{name[:-1]}X"'.encode())
    (tmp_path / "avatars").mkdir()
    (tmp_path / "avatars" / "eyeless.glb").write_bytes(avatar)
    (tmp_path / "two.toml").write_text(HUMANS)
    options = SceneOptions(human=tmp_path / "two.toml", voice="text", assets=(tmp_path,))
    async with open_pilot(options) as pilot:
        pilot.watch()
        pilot.block("b", '<gaze id="g" target="alice"/>', characterId="bob")
        pilot.block("a", '<gaze id="g" target="bob:l_wrist" influence="HEAD"/>', characterId="alice")
        await pilot.advance(3.0)
        alice = pilot.realizer.characters["alice"].humanoid
        world = pilot.realizer.world.snapshot()
        assert "l_eyeball_joint" not in alice.avatar.skeleton
        assert pilot.feedback.warnings == []
        assert world["alice"] == pytest.approx(alice.locate("skullbase"))
        assert {"b:g:end", "a:g:end"} <= set(pilot.feedback.progress)
