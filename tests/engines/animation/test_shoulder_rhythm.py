"""The shoulder girdle turns with a raised arm, and the hand stays where it is."""

import math

import pytest

from reactive_realizer.embodiment.arm_anatomy import ArmRotations
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.quaternion import angle, difference, from_euler
from reactive_realizer.embodiment.shoulder_rhythm import girdle_elevation, raised
from reactive_realizer.embodiment.two_bone_ik import Arm


@pytest.mark.parametrize(("degrees", "girdle"), [(0, 0), (10, 0), (60, 10), (90, 20), (120, 30)])
def test_beyond_30_degrees_the_girdle_takes_a_third_of_the_elevation(degrees: float, girdle: float) -> None:
    aside, down = math.sin(math.radians(degrees)), -math.cos(math.radians(degrees))
    for upper_arm in ((aside, down, 0.0), (0.0, down, aside)):
        assert math.degrees(girdle_elevation(upper_arm)) == pytest.approx(girdle, abs=1e-6)


@pytest.mark.parametrize("side", ["l", "r"])
@pytest.mark.parametrize("goal", [(0.0, -0.2, 0.25), (0.1, 0.1, 0.2), (-0.1, 0.2, 0.3), (0.0, -0.4, 0.05)])
def test_the_hand_stays_in_its_place(skeleton: Skeleton, side: str, goal: tuple[float, float, float]) -> None:
    arm = ArmRotations(*Arm.of(skeleton, side).solve(goal, 0.3), from_euler(0.2, 0.4, -0.3))
    girdle, lifted = raised(arm, skeleton, side)

    def body(rotations: ArmRotations) -> Body:
        joints = (f"{side}_{joint}" for joint in Arm.JOINTS)
        return Body(skeleton, dict(zip(joints, rotations, strict=True)))

    before = body(arm).transform(f"{side}_wrist")
    after = body(lifted).posed({f"{side}_sternoclavicular": girdle}).transform(f"{side}_wrist")
    assert after.position == pytest.approx(before.position, abs=1e-6)
    assert angle(difference(before.rotation, after.rotation)) < 1e-6
