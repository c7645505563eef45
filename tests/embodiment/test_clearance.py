"""Arms that keep out of the figure's own body. How near is near enough is our choice."""

import math
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.clearance import MARGIN, Clearance
from reactive_realizer.embodiment.girth import girth_of
from reactive_realizer.embodiment.glb import read_binary, write_binary
from reactive_realizer.embodiment.quaternion import from_axis_angle, multiply
from reactive_realizer.embodiment.vector import distance

PACKAGE = Path(str(files("reactive_realizer"))) / "assets" / "avatars"
AVATARS = {name: Avatar.read(PACKAGE / f"{name}.glb") for name in ("female", "male")}
SIDEWAYS, INWARD = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
YIELDING = 0.01
"""m that a hand may stay in flesh."""


@pytest.fixture(params=AVATARS)
def avatar(request: pytest.FixtureRequest) -> Avatar:
    """The one avatar, and the other."""
    return AVATARS[request.param]


def bent(avatar: Avatar, inward: float, forward: float = 0.5, elbow: float = 1.4) -> Body:
    """A figure whose right forearm points to its left, the farther the more it is turned inward, rad.

    Its left arm is away from the body: in the default pose, the hands are in the thighs.
    """
    shoulder = multiply(from_axis_angle((0.0, 1.0, 0.0), inward), from_axis_angle(SIDEWAYS, -forward))
    aside = {"l_shoulder": from_axis_angle((0.0, 0.0, 1.0), 0.5)}
    return Body(avatar.skeleton, {**aside, "r_shoulder": shoulder, "r_elbow": from_axis_angle(SIDEWAYS, -elbow)})


def wrist(body: Body) -> tuple[float, float, float]:
    """Where the right wrist is, m."""
    return body.transform("r_wrist").position


def test_the_size_of_a_figure_is_that_of_its_skin(avatar: Avatar) -> None:
    girth = girth_of(avatar)
    waist = girth.trunk[3]
    assert 0.12 < waist.side < 0.17
    assert 0.17 < waist.front + waist.back < 0.23
    assert 0.08 < girth.thigh.begin < 0.12
    assert girth.thigh.end < girth.thigh.begin
    assert girth.forearm.end < girth.forearm.begin < 0.05


def test_a_figure_without_a_readable_skin_is_as_thick_as_people_are(avatar: Avatar) -> None:
    measured, usual = girth_of(avatar), girth_of(replace(avatar, path=None))
    for section, expected in zip(measured.trunk[:8], usual.trunk, strict=False):
        assert section.side == pytest.approx(expected.side, rel=0.5)
    assert measured.thigh.begin == pytest.approx(usual.thigh.begin, rel=0.3)
    assert measured.hand == pytest.approx(usual.hand, rel=0.3)


def test_a_skin_that_claims_more_than_any_file_has_is_not_read(tmp_path: Path) -> None:
    scene, _ = read_binary(PACKAGE / "female.glb")
    claimed = [{"count": 10**13, "componentType": 5126, "type": "VEC3"} for _ in scene["accessors"]]
    write_binary(tmp_path / "claims.glb", {**scene, "accessors": claimed}, b"")
    avatar = Avatar.read(tmp_path / "claims.glb")
    assert girth_of(avatar) == girth_of(replace(avatar, path=None))


def test_a_hand_in_the_belly_goes_out_in_front(avatar: Avatar) -> None:
    clearance, inside = Clearance.of(avatar), bent(avatar, 1.3, 0.3)
    assert clearance.deepest(inside) > 0.03
    outside = clearance(inside)
    assert clearance.deepest(outside) < YIELDING
    assert wrist(outside)[2] > wrist(inside)[2]
    assert outside.pose.keys() == inside.pose.keys() | {"r_shoulder", "r_elbow"}


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
    """Its way is bent nowhere sharply: in steps of 3 mm, no step differs by more than 0.5 mm from the one before."""
    clearance = Clearance.of(avatar)
    turns = np.arange(0.0, 1.4, 0.01)
    way = np.array([wrist(clearance(bent(avatar, inward, 0.3))) for inward in turns])
    assert np.abs(np.diff(way, 2, axis=0)).max() < 0.0005
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
