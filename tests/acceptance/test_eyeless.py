"""Characters without eyes."""

from pathlib import Path

import pytest

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import OWN
from reactive_realizer.testing.pilot import open_pilot

HUMANS = """
[character.alice]
avatar = "avatars/eyeless.glb"

[character.bob]
avatar = "avatars/male.glb"
position = [0.0, 0.0, 2.0]
heading = 180
"""


def without(eyes: list[str], folder: Path) -> SceneOptions:
    """A scene in which Alice lacks eyes."""
    avatar = (PACKAGE_ASSETS / "avatars" / "female.glb").read_bytes()
    for eye in eyes:
        for name in (eye, eye[0].lower() + eye[1:]):  # of the bone, and in the humanoid of VRM
            avatar = avatar.replace(f'"{name}"'.encode(), f'"{name[:-1]}X"'.encode())
    (folder / "avatars").mkdir()
    (folder / "avatars" / "eyeless.glb").write_bytes(avatar)
    (folder / "two.toml").write_text(HUMANS)
    return SceneOptions(human=folder / "two.toml", voice="text", assets=(folder,))


@pytest.mark.parametrize("eyes", [["LeftEye"], ["LeftEye", "RightEye"]])
async def test_figures_without_eyes_look_with_the_head_and_are_looked_at_at_the_top_of_the_neck(
    tmp_path: Path, eyes: list[str]
) -> None:
    async with open_pilot(without(eyes, tmp_path)) as pilot:
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


@pytest.mark.parametrize(
    ("eyes", "told"),
    [(["LeftEye"], "l_eyeball_joint stay still"), (["LeftEye", "RightEye"], "has none of the joints of EYES")],
)
async def test_key_poses_of_eyes_say_which_eyes_a_figure_does_not_have(
    tmp_path: Path, eyes: list[str], told: str
) -> None:
    pose = '<rr:keyPose time="1"><rr:lookAt target="0 0.6 1"/></rr:keyPose>'
    async with open_pilot(without(eyes, tmp_path)) as pilot:
        keys = f'<rr:keyPoses xmlns:rr="{OWN}" id="k" group="EYES">{pose}</rr:keyPoses>'
        pilot.block("a", keys, characterId="alice")
        await pilot.advance(0.5)
        (warning,) = pilot.feedback.of("warningFeedback")
        assert told in warning.text
