"""MPEG-4's facial animation parameters: how far they move the faces of the avatars, and in frames."""

import json
import struct
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.face_map import STAND_INS, FaceMap, StandIns
from reactive_realizer.embodiment.face_mesh import FaceMesh
from reactive_realizer.embodiment.face_names import ARKIT
from reactive_realizer.embodiment.glb import read_binary
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


def map_of(avatar: Avatar) -> FaceMap:
    return FaceMap(avatar, StandIns.read(ASSETS / STAND_INS))


def table_of(avatar: Avatar) -> FapTable:
    return FapTable(TABLE, avatar, map_of(avatar))


@pytest.mark.parametrize("avatar", AVATARS, ids=["female", "male"])
def test_the_units_are_distances_in_the_face_of_the_avatar(avatar: Avatar) -> None:
    units = Fapu.measured(avatar, face(avatar), map_of(avatar))
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
    table, mesh = table_of(avatar), face(avatar)
    moved = mesh.displacement(table.weights(dict.fromkeys(table.numbers(fap), value))) @ np.array(direction)
    distance = value * getattr(Fapu.measured(avatar, mesh, map_of(avatar)), unit)
    assert (moved.max() if value > 0 else moved.min()) == pytest.approx(distance)


def test_parameters_that_share_a_blend_shape_do_not_move_it_twice() -> None:
    table = table_of(AVATARS[0])
    middle, outer = table.weights({4: 60}), table.weights({4: 60, 51: 60})
    assert middle == outer
    assert 0.0 < outer["mouthRollUpper"] < 1.0


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
        """<bmlt:facefap id="none" fap="69" value="1"/><bmlt:facefap id="jaw" fap="open_jaw" value="-100"/>
           <bmlt:facefap id="still" fap="3"/>
           <bmlt:facefap id="which" fap="viseme"/><wait id="w" duration="0.1"/>""",
    )
    await pilot.advance(1)
    told = [each.text for each in pilot.feedback.of("warningFeedback")]
    assert "there is no facial animation parameter '69'" in told[0]
    assert "negative values of the facial animation parameter 3 (open_jaw)" in told[1]
    assert "the parameter value of a face unit is missing" in told[2]
    assert "the parameter viseme_select1 of a face unit is missing" in told[3]
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


# --- visemes and expressions


@pytest.mark.parametrize(
    ("fap", "attributes", "like"),
    [
        ("viseme", 'viseme_select1="14"', {"mouthPucker": 0.85, "mouthFunnel": 0.2, "jawOpen": 0.07}),
        ("1", 'viseme_select1="14" viseme_select2="10" viseme_blend="21"', {"mouthPucker": 0.28, "jawOpen": 0.3}),
        ("2", 'expression_select1="1"', {"mouthSmileLeft": 0.9, "cheekSquintLeft": 0.8}),
        ("expression", 'expression_select1="1" expression_intensity1="21"', {"mouthSmileLeft": 0.3}),
        (
            "2",
            'expression_select1="6" expression_intensity1="31" expression_select2="2" expression_intensity2="31"',
            {"browInnerUp": 0.93, "mouthFrownLeft": 0.39},
        ),
        ("2 35", 'expression_select1="1" value="60"', {"mouthSmileLeft": 0.9, "browOuterUpLeft": 0.45}),
    ],
)
async def test_visemes_and_expressions_are_selected_by_their_index_and_mixed(
    pilot: RealizerPilot, fap: str, attributes: str, like: dict[str, float]
) -> None:
    pilot.block("b", f'<bmlt:facefap id="f" fap="{fap}" {attributes}/>')
    await pilot.advance(1)
    assert pilot.feedback.warnings == []
    assert {morph: weight(pilot, morph).max() for morph in like} == pytest.approx(like, abs=0.08)


async def test_keyframes_have_values_but_select_no_faces(pilot: RealizerPilot) -> None:
    rows = "0 0 0  0.5 {} 300  1 0 0"
    for id_, selected in (("none", 0), ("some", 5)):
        frames = f'<FaceInterpolator parts="viseme open_jaw">{rows.format(selected)}</FaceInterpolator>'
        pilot.block(id_, f'<bmlt:facekeyframe id="f" type="FAPS">{frames}</bmlt:facekeyframe>')
        await pilot.advance(1.5)
    assert weight(pilot, "jawOpen").max() > 0.1
    (warning,) = [each.text for each in pilot.feedback.of("warningFeedback")]
    assert "1 (viseme) has no value of its own" in warning


async def test_a_recording_plays_without_the_values_that_the_avatar_cannot_show_which_is_told_once(
    pilot: RealizerPilot,
) -> None:
    rows = "0 0 0  0.3 300 -4  0.6 200 -9  1 0 0"
    frames = f'<FaceInterpolator parts="open_jaw squeeze_l_eyebrow">{rows}</FaceInterpolator>'
    pilot.block("b", f'<bmlt:facekeyframe id="f" type="FAPS">{frames}</bmlt:facekeyframe>')
    await pilot.advance(1.5)
    assert weight(pilot, "jawOpen").max() > 0.1
    assert pilot.feedback.status("b") == "DONE"
    (warning,) = [each.text for each in pilot.feedback.of("warningFeedback")]
    assert "negative values of the facial animation parameter 37 (squeeze_l_eyebrow)" in warning


# --- the table of the standard

BOTH_WAYS = """
MNS down 4 8 9 51 55 56; MNS up 5 10 11 12 13 18 44 46 52 57 58 59 60; MW left 6 53; MW right 7 15 43 54
MNS forward 16 17; MW forward 45; IRISD down 19 20; IRISD up 21 22; IRISD outward 29 30; ES forward 27 28
ENS up 31 32 33 34 35 36 63 65 66; ES right 37 40; ES left 38 39; ENS left 61 67; ENS right 62 64 68
"""
"""Units and directions of positive values of the parameters that move both ways (ISO/IEC 14496-2, table C.1)."""

ONE_WAY = "MNS down 3; MNS forward 14; ENS up 41 42"
"""Those of parameters that have no negative values."""

ANGLES = {23, 24, 25, 26, 47, 48, 49, 50}


def test_units_and_directions_are_those_of_the_standard() -> None:
    expected = {
        int(number): (unit, direction)
        for group in f"{BOTH_WAYS.strip()};{ONE_WAY}".replace("\n", ";").split(";")
        for unit, direction, *numbers in [group.split()]
        for number in numbers
    }
    faps = json.loads(TABLE.read_text(encoding="utf-8"))["faps"]
    found = {int(number): (fap.get("unit"), fap.get("direction")) for number, fap in faps.items()}
    assert {number: pair for number, pair in found.items() if number > 2} == expected | dict.fromkeys(
        ANGLES, ("AU", None)
    )


# --- what the avatar has


@pytest.mark.parametrize("avatar", AVATARS, ids=["female", "male"])
def test_all_parameters_are_played_on_the_avatars_of_the_package(avatar: Avatar) -> None:
    table = table_of(avatar)
    assert [number for number in range(3, 69) if not _plays(table, number, 100.0)] == []
    one_way, without_shape = {3, 14, 41, 42, 47}, {18, 21, 22, 37, 38, 45}
    assert {number for number in range(3, 69) if not _plays(table, number, -100.0)} == one_way | without_shape


PAIRS = [
    pair
    for first in (6, 8, 10, 12, 19, 21, 27, 29, 31, 33, 35, 37, 39, 41, 53, 55, 57, 59, 61, 65, 67)
    for pair in ((first, LEFT), (first + 1, RIGHT))
]


@pytest.mark.parametrize("avatar", AVATARS, ids=["female", "male"])
@pytest.mark.parametrize("sign", [1.0, -1.0], ids=["positive", "negative"])
def test_a_parameter_of_one_side_moves_only_this_side(avatar: Avatar, sign: float) -> None:
    table, mesh = table_of(avatar), face(avatar)
    moved = {}
    for number, side in PAIRS:
        if _plays(table, number, sign):
            away = np.linalg.norm(mesh.displacement(map_of(avatar)(table.weights({number: 30.0 * sign}))), axis=1)
            beside = mesh.vertices @ np.array(side)
            # Beyond the middle, the skin follows: most of all with ARKit's mouthLowerDown.
            moved[number] = bool(away[beside < -0.02].max() < 0.25 * away[beside > 0.0].max())
    assert moved == dict.fromkeys(moved, True)
    assert len(moved) == (42 if sign > 0.0 else 36)


@pytest.mark.parametrize("avatar", AVATARS, ids=["female", "male"])
@pytest.mark.parametrize("value", [20.0, -20.0])
def test_a_raised_nose_is_raised_at_its_tip_and_the_brows_stay(avatar: Avatar, value: float) -> None:
    mesh = face(avatar)
    moved = mesh.displacement(table_of(avatar).weights({63: value}))
    tip = mesh.vertices[:, 2].argmax()
    up = value * Fapu.measured(avatar, mesh, map_of(avatar)).ENS
    assert moved[tip, 1] == pytest.approx(up, rel=0.15)
    assert np.abs(moved[mesh.vertices[:, 1] > mesh.vertices[tip, 1] + 0.03]).max() < 1e-4


@pytest.mark.parametrize(("number", "upper", "lower"), [(16, 0.0, 1.0), (17, 1.0, 0.0)])
def test_each_lip_is_pushed_alone(number: int, upper: float, lower: float) -> None:
    mesh = face(AVATARS[0])
    pushed = mesh.displacement(table_of(AVATARS[0]).weights({number: 200.0}))[:, 2]
    both = mesh.moves["mouthPucker"][:, 2]
    falls = -mesh.moves["jawOpen"][:, 1]
    lips = both > 0.9 * both.max()
    share = pushed / pushed.max()
    assert share[lips & (falls < 0.1 * falls.max())].mean() == pytest.approx(upper, abs=0.15)
    assert share[lips & (falls > 0.8 * falls.max())].mean() == pytest.approx(lower, abs=0.15)


def test_without_shapes_of_one_side_the_usual_ones_move_both(tmp_path: Path) -> None:
    avatar = Avatar.read(with_morph("noseSneerRight", tmp_path))
    table = table_of(avatar)
    names = {number: set(table.weights({number: 20.0})) for number in (9, 32, 39, 61)}
    assert names == {9: {"mouthRollUpper"}, 32: {"browInnerUp"}, 39: {"cheekPuff"}, 61: {"noseSneerLeft"}}


def test_without_shapes_beyond_those_of_arkit_thirteen_parameters_name_what_is_missing(tmp_path: Path) -> None:
    table = table_of(Avatar.read(with_morph("noseSneerRight", tmp_path)))
    not_played = {number for number in range(3, 69) if not _plays(table, number, 100.0)}
    assert not_played == {27, 28, 29, 30, 43, 44, 46, 47, 64, 65, 66, 67, 68}
    with pytest.raises(RealizerError, match=r"raise_l_ear\); the avatar has no earUpLeft"):
        table.weights({65: 100.0})


@pytest.mark.parametrize(
    ("morph", "fap", "value"),
    [
        ("eyeThrustLeft", 27, 1), ("EyeConstrict_R", 30, -1), ("T03_Tongue_Left", 43, -1), ("TongueCurlUp", 44, 1),
        ("tongueUp", 46, 1), ("TongueRoll", 47, 1), ("Nose_Tip_R", 64, 1), ("Ear_Up_L", 65, 1), ("Ear_In_R", 68, -1),
    ],
)  # fmt: skip
def test_the_others_are_played_by_morph_targets_with_usual_names(
    tmp_path: Path, morph: str, fap: int, value: float
) -> None:
    avatar = Avatar.read(with_morph(morph, tmp_path))
    table = table_of(avatar)
    weights = table.weights({fap: 20.0 * value})
    assert map_of(avatar)(weights) == {morph: pytest.approx(weights[next(iter(weights))])}
    assert not _plays(table, fap, -20.0 * value)


def with_morph(morph: str, folder: Path) -> Path:
    """An avatar with ARKit's shapes, one of them under another name; it moves in all directions, so it fits any."""
    assert AVATARS[0].path
    scene, data = read_binary(AVATARS[0].path)
    for mesh in scene["meshes"]:
        names = mesh.get("extras", {}).get("targetNames", [])
        names[:] = [name if name in ARKIT else f"{mesh['name']} {number}" for number, name in enumerate(names)]
        names[:] = [morph if name == "noseSneerRight" else name for name in names]
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    chunks = [(b"JSON", text), (b"BIN\0", bytes(data))]
    body = b"".join(struct.pack("<I4s", len(chunk), kind) + chunk for kind, chunk in chunks)
    file = folder / "other.glb"
    file.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body)
    return file


def _plays(table: FapTable, number: int, value: float) -> bool:
    try:
        return bool(table.weights({number: value}))
    except RealizerError:
        return False
