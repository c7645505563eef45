"""The laws of motion are measured in bodies of which the motion is known, and in scenes that are always the same."""

import math
from importlib.resources import files
from pathlib import Path

import pytest

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import from_axis_angle
from reactive_realizer.testing.motion_laws import arm_ranges, arm_turns, worst_motion
from reactive_realizer.testing.motion_scenes import play_scene
from reactive_realizer.testing.pilot import open_pilot

SKELETON = Avatar.read(Path(str(files("reactive_realizer"))) / "assets" / "avatars" / "male.glb").skeleton
FRAME = 0.02
X, Y = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)


def test_the_worst_motion_is_that_between_any_two_frames() -> None:
    wrist, head = (from_axis_angle(axis, radians) for axis, radians in ((X, 0.1), (Y, 0.12)))
    still, turned = Body(SKELETON), Body(SKELETON, {"r_wrist": wrist, "vc4": head, "skullbase": head})
    worst = worst_motion([still, still, turned, turned])
    assert worst["wrist_rad_s2"] == pytest.approx(0.1 / FRAME**2)
    assert worst["head_deg_s"] == pytest.approx(math.degrees(0.24 / FRAME)), "neck and skull add up"
    assert worst["wrist_m_s2"] == worst["elbow_rad_s2"] == 0.0


def test_the_acceleration_of_a_wrist_contains_that_of_the_root() -> None:
    moved = [Body(SKELETON, {}, (0.5 * 3.0 * (number * FRAME) ** 2, 0.0, 0.0)) for number in range(4)]
    assert worst_motion(moved)["wrist_m_s2"] == pytest.approx(3.0)


@pytest.mark.parametrize(("side", "inward"), [("l", 1.0), ("r", -1.0)])
def test_the_turn_of_a_forearm_is_that_of_elbow_and_wrist(side: str, inward: float) -> None:
    down = (0.0, -1.0, 0.0)
    turn = from_axis_angle(down, inward * math.radians(30.0))
    body = Body(SKELETON, {f"{side}_elbow": turn, f"{side}_wrist": turn})
    assert arm_turns(body, side) == pytest.approx((60.0, 0.0))
    thumb = Body(SKELETON, {f"{side}_wrist": from_axis_angle(X, math.radians(-20.0))})
    assert arm_turns(thumb, side) == pytest.approx((0.0, 20.0))
    assert arm_ranges([body, thumb, Body(SKELETON)]) == {
        "pronation_deg": 60.0,
        "supination_deg": 0.0,
        "radial_deg": 20.0,
        "ulnar_deg": 0.0,
    }


async def test_a_scene_is_always_the_same_and_no_other_scene_is() -> None:
    assert await played(3) == await played(3) != await played(4)


async def played(seed: int) -> list[Body]:
    async with open_pilot() as pilot:
        await play_scene(seed, pilot)
        return pilot.bodies()
