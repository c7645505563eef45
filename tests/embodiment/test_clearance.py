"""Arms that keep out of the figure's own body. How near is near enough is our choice."""

import math
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.clearance import MARGIN, Clearance
from reactive_realizer.embodiment.flesh import Flesh, flesh_of
from reactive_realizer.embodiment.girth import girth_of
from reactive_realizer.embodiment.glb import read_binary, write_binary
from reactive_realizer.embodiment.quaternion import from_axis_angle, multiply, rotate
from reactive_realizer.embodiment.skin import read_skin
from reactive_realizer.embodiment.vector import add, distance, scale

PACKAGE = Path(str(files("reactive_realizer"))) / "assets" / "avatars"
AVATARS = {name: Avatar.read(PACKAGE / f"{name}.glb") for name in ("female", "male")}
SIDEWAYS, INWARD = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
ASIDE = 0.35
FINGERS = ("thumb", "index", "middle", "ring", "pinky")
YIELDING = 0.01
"""m that a hand may stay in flesh."""


@pytest.fixture(params=AVATARS)
def avatar(request: pytest.FixtureRequest) -> Avatar:
    """The one avatar, and the other."""
    return AVATARS[request.param]


def bent(avatar: Avatar, inward: float, forward: float = 0.5, elbow: float = 1.4) -> Body:
    """A figure whose right forearm points to its left, the farther the more it is turned inward, rad.

    Its left arm is away from the body, and so is its right elbow: in the default pose, the hands are in the thighs.
    """
    shoulder = multiply(from_axis_angle((0.0, 1.0, 0.0), inward), from_axis_angle(SIDEWAYS, -forward))
    shoulder = multiply(from_axis_angle(INWARD, -ASIDE), shoulder)
    aside = {"l_shoulder": from_axis_angle(INWARD, 0.5)}
    return Body(avatar.skeleton, {**aside, "r_shoulder": shoulder, "r_elbow": from_axis_angle(SIDEWAYS, -elbow)})


def wrist(body: Body) -> tuple[float, float, float]:
    """Where the right wrist is, m."""
    return body.transform("r_wrist").position


def depths(part: Flesh, avatar: Avatar, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """How deep points are in a part of the figure at rest, m; those that are far outside of it are left out."""
    body = Body(avatar.skeleton)
    part.find(body)
    part.pose(body)
    found = part.contacts([(x, y, z) for x, y, z in points.tolist()], [0.0] * len(points), 0.1)
    return np.array([each.depth for each in found.values()])


def tip_depth(avatar: Avatar, body: Body, finger: str) -> float:
    """How deep the tip of a finger of the right hand is in the figure, m; at least -0.1."""
    girth, joint = girth_of(avatar), f"r_{finger}3"
    place, turn = body.transform(joint)
    tip = add(place, rotate(turn, scale(avatar.skeleton.offset(joint), 0.7)))
    found = [-0.1]
    for part in flesh_of(avatar.skeleton, girth):
        part.find(body)
        part.pose(body)
        found += [each.depth for each in part.contacts([tip], [girth.finger], 0.1).values()]
    return max(found)


@pytest.mark.parametrize(
    ("number", "joint"), [(0, "HumanoidRoot"), (0, "vl5"), (0, "vt10"), (1, "l_hip"), (2, "r_hip")]
)
def test_the_surface_of_a_figure_is_its_skin(avatar: Avatar, number: int, joint: str) -> None:
    """Most vertices are within a few millimeters of it, and hardly any is a centimeter outside of it."""
    part = flesh_of(avatar.skeleton, girth_of(avatar))[number]
    found = depths(part, avatar, read_skin(avatar)[joint])
    assert np.percentile(np.abs(found), 70) < 0.007
    assert np.percentile(found, 1) > -0.01


def test_a_head_is_as_large_as_its_skin_and_hair(avatar: Avatar) -> None:
    found = depths(flesh_of(avatar.skeleton, girth_of(avatar))[-1], avatar, read_skin(avatar)["skullbase"])
    assert np.percentile(found, 1) > -0.01


def test_a_figure_without_a_readable_skin_is_as_thick_as_people_are(avatar: Avatar) -> None:
    measured, usual = girth_of(avatar), girth_of(replace(avatar, path=None))
    for rows, expected in ((measured.trunk.rows[2:9], usual.trunk.rows[2:9]), (measured.thigh.rows, usual.thigh.rows)):
        assert np.mean(rows, axis=1) == pytest.approx(np.mean(expected, axis=1), rel=0.4)
    assert measured.forearm == pytest.approx(usual.forearm, rel=0.4)
    assert measured.hand == pytest.approx(usual.hand, rel=0.3)
    assert measured.finger == pytest.approx(usual.finger, rel=0.3)


def test_a_skin_that_claims_more_than_any_file_has_is_not_read(tmp_path: Path) -> None:
    scene, _ = read_binary(PACKAGE / "female.glb")
    claimed = [{"count": 10**13, "componentType": 5126, "type": "VEC3"} for _ in scene["accessors"]]
    write_binary(tmp_path / "claims.glb", {**scene, "accessors": claimed}, b"")
    avatar = Avatar.read(tmp_path / "claims.glb")
    assert girth_of(avatar) == girth_of(replace(avatar, path=None))


@pytest.mark.parametrize("number", [math.nan, math.inf])
def test_a_skin_with_a_vertex_that_is_nowhere_is_not_used(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, number: float
) -> None:
    scene, data = read_binary(PACKAGE / "female.glb")
    position = scene["accessors"][scene["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]
    at = scene["bufferViews"][position["bufferView"]].get("byteOffset", 0) + position.get("byteOffset", 0)
    broken = bytearray(data)
    broken[at : at + 4] = np.array([number], "<f4").tobytes()
    write_binary(tmp_path / "broken.glb", scene, bytes(broken))
    avatar = Avatar.read(tmp_path / "broken.glb")
    assert girth_of(avatar) == girth_of(replace(avatar, path=None))
    assert "the skin of broken.glb is not read" in caplog.text


def test_a_hand_in_the_belly_goes_out_in_front(avatar: Avatar) -> None:
    clearance, inside = Clearance.of(avatar), bent(avatar, 1.3, 0.3)
    assert clearance.deepest(inside) > 0.03
    outside = clearance(inside)
    assert clearance.deepest(outside) < YIELDING
    assert wrist(outside)[2] > wrist(inside)[2]
    assert outside.pose.keys() == inside.pose.keys() | {"r_shoulder", "r_elbow"}


@pytest.mark.parametrize(
    ("finger", "turn", "hand", "inward"), [("thumb", 0.8, 0.0, 1.3), ("pinky", 0.0, 1.5, 1.0)], ids=["thumb", "little"]
)
def test_a_finger_at_the_edge_of_a_hand_keeps_clear_wherever_it_points(
    avatar: Avatar, finger: str, turn: float, hand: float, inward: float
) -> None:
    """The other fingers are bent to a fist."""
    fist = {f"r_{each}{number}": from_axis_angle(INWARD, 1.2) for each in FINGERS for number in (1, 2, 3)}
    finger_alone = {f"r_{finger}{number}": from_axis_angle(INWARD, turn) for number in (1, 2, 3)}
    inside = bent(avatar, inward, 0.3).posed({**fist, **finger_alone, "r_wrist": from_axis_angle(INWARD, hand)})
    assert tip_depth(avatar, inside, finger) > 0.05
    assert tip_depth(avatar, Clearance.of(avatar)(inside), finger) < YIELDING


def test_a_forearm_between_thigh_and_belly_leaves_both(avatar: Avatar) -> None:
    """The shortest way out of each of them leads into the other one."""
    clearance = Clearance.of(avatar)
    hips = {f"{side}_hip": from_axis_angle(SIDEWAYS, -0.5 * math.pi) for side in "lr"}
    inside = bent(avatar, 1.1, 0.5, 1.5).posed({**hips, "vl5": from_axis_angle(SIDEWAYS, 0.9)})
    assert clearance.deepest(inside) > 0.05
    assert clearance.deepest(clearance(inside)) < YIELDING


def test_an_arm_that_is_free_stays_as_it_is(avatar: Avatar) -> None:
    clearance, free = Clearance.of(avatar), bent(avatar, 0.0)
    assert clearance.deepest(free) == -MARGIN
    assert clearance(free) is free


def test_a_hand_that_jumps_into_flesh_is_noticed_in_the_same_frame(avatar: Avatar) -> None:
    """Where arms are far away from flesh, they are not looked at in every frame."""
    clearance = Clearance.of(avatar)
    for _ in range(20):
        clearance(bent(avatar, 0.0))
    assert clearance.deepest(clearance(bent(avatar, 1.3, 0.3))) < YIELDING


def test_the_way_out_does_not_depend_on_the_frames_before(avatar: Avatar) -> None:
    clearance = Clearance.of(avatar)
    turns = [0.01 * number for number in range(140)]
    shown = [wrist(clearance(bent(avatar, inward, 0.3))) for inward in turns]
    assert shown == [wrist(Clearance.of(avatar)(bent(avatar, inward, 0.3))) for inward in turns]


def test_a_hand_that_passes_by_slides_along_the_body(avatar: Avatar) -> None:
    """Its way is bent nowhere sharply: in steps of 3 mm, no step differs by more than 0.8 mm from the one before."""
    clearance = Clearance.of(avatar)
    turns = np.arange(0.0, 1.4, 0.01)
    way = np.array([wrist(clearance(bent(avatar, inward, 0.3))) for inward in turns])
    assert np.abs(np.diff(way, 2, axis=0)).max() < 0.0008
    plain = [wrist(bent(avatar, inward, 0.3)) for inward in turns]
    assert max(map(distance, map(tuple, way), plain)) > 0.03


def test_a_hand_that_lies_on_the_skin_hardly_moves(avatar: Avatar) -> None:
    clearance = Clearance.of(avatar)
    touching = min(
        (bent(avatar, inward, 0.3) for inward in np.arange(0.3, 1.3, 0.01)),
        key=lambda body: abs(clearance.deepest(body)),
    )
    assert abs(clearance.deepest(touching)) < 0.002
    assert distance(wrist(clearance(touching)), wrist(touching)) < 0.008


def test_the_rest_of_the_figure_does_not_matter(avatar: Avatar) -> None:
    """Wherever it stands and faces, the same arm goes the same way."""
    inside, turn = bent(avatar, 1.3, 0.3), from_axis_angle((0.0, 1.0, 0.0), math.radians(130.0))
    elsewhere = inside.posed({"HumanoidRoot": turn}, (2.0, 0.1, -3.0))
    here, there = (Clearance.of(avatar)(body) for body in (inside, elsewhere))
    assert there.rotation("r_shoulder") == pytest.approx(here.rotation("r_shoulder"), abs=1e-6)
