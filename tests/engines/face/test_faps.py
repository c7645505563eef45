"""MPEG-4's facial animation parameters: how far they move the faces of the avatars, and in frames."""

from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.face_mesh import FaceMesh
from reactive_realizer.embodiment.quaternion import rotate
from reactive_realizer.engines.face.faps import FapTable
from reactive_realizer.engines.face.fapu import Fapu
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .conftest import weight

ASSETS = Path(str(files("reactive_realizer"))) / "assets"
TABLE = ASSETS / "face" / "faps.json"
AVATARS = [Avatar.read(ASSETS / "avatars" / f"{name}.glb") for name in ("female", "male")]

UP, DOWN, LEFT, RIGHT, FORWARD = (0, 1, 0), (0, -1, 0), (1, 0, 0), (-1, 0, 0), (0, 0, 1)


def face(avatar: Avatar) -> FaceMesh:
    assert avatar.path
    return FaceMesh.read(avatar.path)


@pytest.mark.parametrize("avatar", AVATARS, ids=["female", "male"])
def test_the_units_are_distances_in_the_face_of_the_avatar(avatar: Avatar) -> None:
    units = Fapu.measured(avatar, face(avatar))
    millimeters = {name: 1000 * 1024 * getattr(units, name) for name in Fapu.__slots__}
    # Means of adults with room to both sides: L. G. Farkas, "Anthropometry of the Head and Face" (1994).
    ranges = {"ES": (50, 72), "ENS": (38, 58), "MNS": (14, 28), "MW": (42, 65), "IRISD": (8, 16)}
    assert {name: low < millimeters[name] < high for name, (low, high) in ranges.items()} == dict.fromkeys(ranges, True)


@pytest.mark.parametrize("avatar", AVATARS, ids=["female", "male"])
@pytest.mark.parametrize(
    ("fap", "value", "unit", "direction"),
    [
        ("open_jaw", 500, "MNS", DOWN),
        ("stretch_r_cornerlip", 60, "MW", RIGHT),
        ("raise_l_cornerlip", 400, "MNS", UP),
        ("raise_l_cornerlip", -200, "MNS", UP),
        ("thrust_jaw", 300, "MNS", FORWARD),
        ("close_t_r_eyelid", 700, "IRISD", DOWN),
        ("raise_l_o_eyebrow", 90, "ENS", UP),
        ("squeeze_l_eyebrow", 50, "ES", RIGHT),
        ("puff_l_cheek", 40, "ES", LEFT),
    ],
)
def test_a_value_moves_the_feature_point_by_so_many_units(
    avatar: Avatar, fap: str, value: float, unit: str, direction: tuple[int, int, int]
) -> None:
    table, mesh = FapTable(TABLE, avatar), face(avatar)
    moved = mesh.displacement(table.weights(dict.fromkeys(table.numbers(fap), value))) @ np.array(direction)
    distance = value * getattr(Fapu.measured(avatar, mesh), unit)
    assert (moved.max() if value > 0 else moved.min()) == pytest.approx(distance)


def test_parameters_that_share_a_blend_shape_do_not_move_it_twice() -> None:
    table = FapTable(TABLE, AVATARS[0])
    left, both = table.weights({31: 60}), table.weights({31: 60, 32: 60})
    assert left == both
    assert 0.0 < both["browInnerUp"] < 1.0


async def test_a_parameter_plays_by_number_and_by_name(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        """<bmlt:facefap id="f" fap="12" value="400" start="0" attackPeak="0.4" relax="1" end="1.4"/>
           <bmlt:facefap id="g" fap="raise_l_o_eyebrow" value="100" start="0" attackPeak="0.4" relax="1" end="1.4"/>""",
    )
    await pilot.advance(2)
    assert pilot.feedback.warnings == []
    assert 0.3 < weight(pilot, "mouthSmileLeft")[30] < 0.6
    assert weight(pilot, "mouthSmileRight").max() == 0.0
    assert 0.4 < weight(pilot, "browOuterUpLeft")[30] < 0.9
    assert pilot.feedback.time("b:f:attackPeak") == 0.4


async def test_several_parameters_play_as_one_behavior(pilot: RealizerPilot) -> None:
    pilot.block("b", '<bmlt:facefap id="f" fap="12 raise_r_cornerlip" value="400"/>')
    await pilot.advance(2)
    assert pilot.feedback.warnings == []
    assert weight(pilot, "mouthSmileLeft").max() == weight(pilot, "mouthSmileRight").max() > 0.3


async def test_what_is_no_parameter_or_moves_no_blend_shape_is_warned_of(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        """<bmlt:facefap id="none" fap="69" value="1"/><bmlt:facefap id="eye" fap="27" value="1000"/>
           <bmlt:facefap id="jaw" fap="open_jaw" value="-100"/><wait id="w" duration="0.1"/>""",
    )
    await pilot.advance(1)
    told = [each.text for each in pilot.feedback.of("warningFeedback")]
    assert "there is no facial animation parameter '69'" in told[0]
    assert "positive values of the facial animation parameter 27 (thrust_l_eyeball); eyes only turn" in told[1]
    assert "negative values of the facial animation parameter 3 (open_jaw)" in told[2]
    assert pilot.feedback.reached("b:w:end")


@pytest.mark.parametrize(
    ("fap", "value", "joint", "axis"),
    [
        ("head_pitch", 20_000, "skullbase", DOWN),
        ("head_yaw", 20_000, "skullbase", LEFT),
        ("head_yaw", -20_000, "skullbase", RIGHT),
        ("yaw_l_eyeball", 20_000, "l_eyeball_joint", LEFT),
        ("pitch_r_eyeball", 20_000, "r_eyeball_joint", DOWN),
    ],
)
async def test_an_angle_turns_a_joint_by_hundred_thousandths_of_a_radian(
    fap: str, value: float, joint: str, axis: tuple[int, int, int], tmp_path: Path
) -> None:
    human = tmp_path / "still.toml"
    human.write_text('[character.alice]\navatar = "avatars/female.glb"\nidle = false\n')
    async with open_pilot(SceneOptions(human)) as pilot:
        pilot.watch()
        pilot.block("b", f'<bmlt:facefap id="f" fap="{fap}" value="{value}" start="0.1" relax="1" end="1.4"/>')
        await pilot.advance(2)
        assert pilot.feedback.warnings == []
        ahead = [rotate(body.transform(joint).rotation, (0.0, 0.0, 1.0)) for body in pilot.bodies()]
        toward = np.array(ahead) @ np.array(axis)
        assert np.arcsin(toward[45]) - np.arcsin(toward[0]) == pytest.approx(0.2, abs=0.002)
        assert toward[-1] == pytest.approx(toward[0], abs=0.002)


async def test_a_rolled_head_tilts_to_its_right(tmp_path: Path) -> None:
    human = tmp_path / "still.toml"
    human.write_text('[character.alice]\navatar = "avatars/female.glb"\nidle = false\n')
    async with open_pilot(SceneOptions(human)) as pilot:
        pilot.watch()
        pilot.block("b", '<bmlt:facefap id="f" fap="50" value="20000" start="0.1" relax="1" end="1.4"/>')
        await pilot.advance(1)
        crown = rotate(pilot.bodies()[45].transform("skullbase").rotation, (0.0, 1.0, 0.0))
        assert crown[0] == pytest.approx(-np.sin(0.2), abs=0.003)


def test_all_parameters_but_fifteen_are_played() -> None:
    table = FapTable(TABLE, AVATARS[0])
    played = {number for number in range(1, 69) if _plays(table, number)}
    assert set(range(1, 69)) - played == {1, 2, 27, 28, 29, 30, 43, 44, 46, 47, 64, 65, 66, 67, 68}


def _plays(table: FapTable, number: int) -> bool:
    try:
        return bool(table.weights({number: 100.0}))
    except RealizerError:
        return False
