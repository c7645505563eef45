"""Avatars of other tools perform: what a renderer shows of their bones, from BML to frames."""

import math
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.vector import Vec3, distance, dot, scale, subtract, unit
from reactive_realizer.testing.pilot import open_pilot

from .rigs import Rig, bone_places, write
from .test_rest_poses import RIGS

TARGET = (0.6, 1.2, 1.5)
HUMAN = f"""
[character.alice]
avatar = "avatars/rig.glb"
idle = false

[target.thing]
position = {list(TARGET)}
"""
POINT = '<pointing id="p" target="thing" mode="LEFT_HAND" start="0" ready="1" relax="3"/>'


async def performed(tmp_path: Path, rig: Rig, behaviors: str) -> list[tuple[float, dict[str, Vec3]]]:
    """The time of each frame, and where its joints are shown."""
    (tmp_path / "avatars").mkdir()
    scene = rig.scene()
    write(tmp_path / "avatars" / "rig.glb", scene)
    human = tmp_path / "human.toml"
    human.write_text(HUMAN)
    async with open_pilot(SceneOptions(human, "text", (tmp_path,))) as pilot:
        pilot.watch()
        pilot.block("b", behaviors)
        await pilot.advance(5)
        assert pilot.feedback.warnings == []
        avatar = pilot.realizer.characters["alice"].humanoid.avatar
        return [
            (f.time, bone_places(scene, avatar, tuple(f.root.tolist()), f.rotations)) for f in pilot.frames["alice"]
        ]


@pytest.mark.parametrize("rig", [name for name in RIGS if "fingers" not in name])
async def test_the_finger_that_is_shown_points_to_the_target(tmp_path: Path, rig: str) -> None:
    for time, places in await performed(tmp_path, RIGS[rig], POINT):
        if 1.5 <= time <= 2.5:
            base, tip = places["l_index1"], places["l_index3"]
            cosine = dot(unit(subtract(tip, base)), unit(subtract(TARGET, base)))
            assert math.degrees(math.acos(min(1.0, cosine))) < 2.0


@pytest.mark.parametrize("rig", RIGS)
async def test_the_feet_that_are_shown_stay_where_they_stand(tmp_path: Path, rig: str) -> None:
    gesture = '<gesture id="g" lexeme="OFFER" mode="LEFT_HAND" start="0"/>'
    frames = await performed(tmp_path, RIGS[rig], gesture)
    _, first = frames[0]
    for foot in ("l_ankle", "r_ankle"):
        assert max(math.dist(places[foot], first[foot]) for _, places in frames) < 0.01
    assert max(math.dist(places["l_wrist"], first["l_wrist"]) for _, places in frames) > 0.2


SELF = '<gesture id="g" lexeme="SELF" mode="RIGHT_HAND" start="0" stroke="1.5" relax="3"/>'


async def hand_before_chest(tmp_path: Path, rig: Rig) -> Vec3:
    """The wrist as seen from the chest while it points to the speaker, in relation to the size of the figure."""
    _, places = min(await performed(tmp_path, rig, SELF), key=lambda frame: abs(frame[0] - 2.0))
    return scale(subtract(places["r_wrist"], places["vt6"]), 1.0 / rig.size)


async def test_a_hand_on_the_heart_is_on_the_heart_of_figures_of_any_size(tmp_path: Path) -> None:
    near = {"small": 0.01, "Mixamo in centimeters": 0.001, "tall": 0.04}
    hands = {}
    for name, rig in {"own": Rig(), **{name: RIGS[name] for name in near}}.items():
        (tmp_path / name).mkdir()
        hands[name] = await hand_before_chest(tmp_path / name, rig)
    assert [name for name in near if distance(hands[name], hands["own"]) > near[name]] == []
