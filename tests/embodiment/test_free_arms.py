"""Arms that are far from the body are not looked at in every frame, and still keep clear of it in each."""

import math
from collections.abc import Callable
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.clearance import ALL_THE_WAY, Clearance
from reactive_realizer.embodiment.free_arms import FreeArms
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, from_axis_angle

AVATAR = Avatar.read(Path(str(files("reactive_realizer"))) / "assets" / "avatars" / "female.glb")
INWARD = (0.0, 0.0, 1.0)


def figure(**turns: Quat) -> Body:
    """A figure whose arms hang a hand's breadth away from its thighs."""
    aside = {"l_shoulder": from_axis_angle(INWARD, 0.3), "r_shoulder": from_axis_angle(INWARD, -0.3)}
    return Body(AVATAR.skeleton, {**dict.fromkeys(AVATAR.skeleton.joints, IDENTITY), **aside, **turns})


def arm_in(angle: float) -> Body:
    """The right arm comes to the thigh."""
    return figure(r_shoulder=from_axis_angle(INWARD, angle - 0.3))


def leg_out(angle: float) -> Body:
    """The right thigh comes to the arm."""
    return figure(r_hip=from_axis_angle(INWARD, -angle))


def trunk_aside(angle: float) -> Body:
    """The trunk brings the right arm to the thigh."""
    return figure(vl5=from_axis_angle(INWARD, angle))


@pytest.fixture
def looks(monkeypatch: pytest.MonkeyPatch) -> list[Body]:
    """The bodies of which arms were looked at."""
    looked: list[Body] = []
    near = Clearance._near

    def noted(clearance: Clearance, body: Body, side: str, away: float) -> object:
        looked.append(body)
        return near(clearance, body, side, away)

    monkeypatch.setattr(Clearance, "_near", noted)
    return looked


def new_arms() -> FreeArms:
    return FreeArms(Clearance.of(AVATAR), AVATAR.skeleton)


def test_arms_that_hang_and_sway_are_rarely_looked_at(looks: list[Body]) -> None:
    arms, sway = new_arms(), [0.003 * math.sin(0.05 * number) for number in range(200)]
    for angle in sway:
        body = arm_in(angle)
        assert arms(body, ALL_THE_WAY) is body
    assert len(looks) < 40


@pytest.mark.parametrize(
    ("course", "begin", "end"), [(arm_in, 0.1, 0.2), (leg_out, 0.4, 0.52), (trunk_aside, 0.2, 0.32)]
)
@pytest.mark.parametrize("frames", [200, 20])
def test_each_pose_is_changed_as_if_it_were_the_first_one(
    course: Callable[[float], Body], begin: float, end: float, frames: int
) -> None:
    """However slowly arm or flesh come near, and however fast."""
    arms, clearance, moved = new_arms(), Clearance.of(AVATAR), 0
    for angle in np.linspace(begin, end, frames).tolist():
        body = course(angle)
        expected = clearance(body)
        moved += expected is not body
        assert arms(body, ALL_THE_WAY).pose == expected.pose
    assert 0 < moved < frames


def test_an_arm_that_jumps_into_flesh_is_noticed_in_the_same_frame() -> None:
    arms, clearance = new_arms(), Clearance.of(AVATAR)
    for _ in range(10):
        arms(figure(), ALL_THE_WAY)
    assert arms(arm_in(0.4), ALL_THE_WAY).pose == clearance(arm_in(0.4)).pose != arm_in(0.4).pose


def test_an_arm_that_begins_to_keep_clear_is_moved_in_the_same_frame() -> None:
    """Until then it may be in flesh, because it points."""
    arms, inside = new_arms(), arm_in(0.4)
    for _ in range(10):
        assert arms(inside, {"l": 1.0, "r": 0.0}) is inside
    assert arms(inside, ALL_THE_WAY).pose == Clearance.of(AVATAR)(inside).pose
