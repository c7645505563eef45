"""End effectors and the root in procedural animations."""

import math
from collections.abc import Callable

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import (
    IDENTITY,
    angle,
    difference,
    from_axis_angle,
    from_euler,
    multiply,
    rotate,
)
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import add, dot, subtract
from reactive_realizer.engines.animation.motion_unit import Moment, MotionUnit
from reactive_realizer.engines.animation.motions.gesture import GestureMotionUnit
from reactive_realizer.engines.animation.motions.procedural import ProceduralMotionUnit
from reactive_realizer.engines.animation.procedural.procedural_animation import ProceduralAnimation
from reactive_realizer.testing.motion_laws import arm_turns


@pytest.mark.parametrize("side", ["l", "r"])
def test_a_local_end_effector_places_the_wrist_relative_to_the_leaning_trunk(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton, side: str
) -> None:
    animation = read(f'<EndEffector target="{side}_wrist" local="true" translation="0.05;-0.2;0.25" swivel="0.3"/>')
    for lean in (IDENTITY, from_axis_angle((1.0, 0.0, 0.0), 0.4)):
        body = Body(skeleton, {"vl5": lean})
        moved = body.posed(animation.sample(0.0, {}, body).rotations)
        way = subtract(moved.transform(f"{side}_wrist").position, moved.transform(f"{side}_shoulder").position)
        assert way == pytest.approx(rotate(lean, (0.05, -0.2, 0.25)), abs=1e-6)


@pytest.mark.parametrize("side", ["l", "r"])
def test_a_global_end_effector_places_the_wrist_above_the_ground(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton, side: str
) -> None:
    x = 0.15 if side == "l" else -0.15
    animation = read(f'<EndEffector target="{side}_wrist" local="false" translation="{x};1.15;0.3"/>')
    body = Body(skeleton, {"vl5": from_axis_angle((0.0, 1.0, 0.0), 0.2)})
    moved = body.posed(animation.sample(0.0, {}, body).rotations)
    assert moved.transform(f"{side}_wrist").position == pytest.approx((x, 1.15, 0.3), abs=1e-6)


def test_the_forearm_makes_half_of_the_wrists_twist_and_the_hand_keeps_its_pose(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    arm = '<EndEffector target="l_wrist" local="true" translation="0;-0.2;0.25"/>'
    plain, twisted = (
        read(arm + f'<Rotation target="l_wrist" rotation="0;{twist};0"/>').sample(0.0, {}, Body(skeleton)).rotations
        for twist in (0.0, 1.0)
    )
    assert angle(twisted["l_wrist"]) == pytest.approx(0.5, abs=1e-6)
    before, after = (Body(skeleton, pose).transform("l_wrist") for pose in (plain, twisted))
    assert before.position == pytest.approx(after.position, abs=1e-9)
    assert rotate(before.rotation, rotate(from_euler(0.0, 1.0, 0.0), (1.0, 0.0, 0.0))) == pytest.approx(
        rotate(after.rotation, (1.0, 0.0, 0.0)), abs=1e-6
    )


@pytest.mark.parametrize("twist", [-2.2, -1.4, -0.9, 0.9, 1.4, 2.2])
@pytest.mark.parametrize("deviation", [-0.8, 0.0, 0.8])
def test_forearm_and_hand_keep_their_limits_and_the_elbow_swivels_for_them(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton, twist: float, deviation: float
) -> None:
    place = (0.05, -0.2, 0.3)
    arm = '<EndEffector target="l_wrist" local="true" translation="0.05;-0.2;0.3"/>'
    plain = read(arm).sample(0.0, {}, Body(skeleton)).rotations
    wanted = multiply(plain["l_shoulder"], multiply(plain["l_elbow"], from_euler(deviation, twist, 0.3)))
    turned = read(f'{arm}<Rotation target="l_wrist" rotation="{deviation};{twist};0.3"/>')
    body = Body(skeleton, turned.sample(0.0, {}, Body(skeleton)).rotations)
    pronation, radial = arm_turns(body, "l")
    assert -85 < pronation < 85
    assert -35 < radial < 25
    hand = body.transform("l_wrist")
    assert hand.position == pytest.approx(add(body.transform("l_shoulder").position, place), abs=1e-9)
    if deviation == 0.0 and abs(twist) < 1.5:
        assert angle(difference(wanted, hand.rotation)) < math.radians(5)


@pytest.mark.parametrize("side", ["l", "r"])
def test_a_global_end_effector_places_the_ankle_and_keeps_the_foot_flat(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton, side: str
) -> None:
    x = 0.15 if side == "l" else -0.15
    animation = read(f'<EndEffector target="{side}_ankle" translation="{x};0.25;0.2" swivel="0.2"/>').fitted_to(
        skeleton
    )
    body = Body(skeleton, {"HumanoidRoot": from_euler(0.1, 0.3, 0.05)})
    moved = body.posed(animation.sample(0.0, {}, body).rotations)
    foot = moved.transform(f"{side}_ankle")
    assert foot.position == pytest.approx((x, 0.25, 0.2), abs=1e-6)
    assert rotate(foot.rotation, (0.0, 1.0, 0.0)) == pytest.approx((0.0, 1.0, 0.0), abs=1e-9)
    knee, shank = moved.transform(f"{side}_knee")
    toes = rotate(foot.rotation, (0.0, 0.0, 1.0))
    assert dot(toes, rotate(shank, (1.0, 0.0, 0.0))) == pytest.approx(0.0, abs=1e-9)
    assert toes[2] > 0.8
    assert knee[2] > max(moved.transform(f"{side}_hip").position[2], foot.position[2])


@pytest.mark.parametrize("side", ["l", "r"])
def test_a_local_end_effector_places_the_ankle_relative_to_the_hip(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton, side: str
) -> None:
    animation = read(f'<EndEffector target="{side}_ankle" local="true" translation="0.05;-0.6;0.2"/>').fitted_to(
        skeleton
    )
    turn = from_euler(0.2, 0.5, 0.0)
    body = Body(skeleton, {"HumanoidRoot": turn})
    moved = body.posed(animation.sample(0.0, {}, body).rotations)
    way = subtract(moved.transform(f"{side}_ankle").position, moved.transform(f"{side}_hip").position)
    assert way == pytest.approx(rotate(turn, (0.05, -0.6, 0.2)), abs=1e-6)


def test_a_rotation_of_the_ankle_turns_the_foot(read: Callable[..., ProceduralAnimation], skeleton: Skeleton) -> None:
    leg = '<EndEffector target="l_ankle" translation="0.1;0.3;0.1"/>'
    animation = read(leg + '<Rotation target="l_ankle" rotation="0.4;0;0"/>').fitted_to(skeleton)
    assert animation.sample(0.0, {}, Body(skeleton)).rotations["l_ankle"] == from_euler(0.4, 0.0, 0.0)


def test_end_effectors_at_the_current_ankles_change_nothing(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    body = Body(skeleton)
    left, right = (body.transform(f"{side}_ankle").position for side in "lr")
    animation = read(
        f'<EndEffector target="l_ankle" translation="{left[0]};{left[1]};{left[2]}"/>'
        f'<EndEffector target="r_ankle" translation="{right[0]};{right[1]};{right[2]}"/>'
    )
    moved = body.posed(animation.fitted_to(skeleton).sample(0.0, {}, body).rotations)
    for joint, place in (("l_ankle", left), ("r_ankle", right)):
        assert moved.transform(joint).position == pytest.approx(place, abs=0.002)


@pytest.mark.parametrize("name", ["root", "HumanoidRoot"])
def test_the_root_is_placed_above_the_ground_or_relative_to_its_default(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton, name: str
) -> None:
    at_rest = skeleton.offset("HumanoidRoot")
    for local, expected in (("false", subtract((0.1, 0.8, 0.2), at_rest)), ("true", (0.1, 0.8, 0.2))):
        animation = read(f'<EndEffector target="{name}" local="{local}" translation="0.1;1.6*t;0.2"/>').fitted_to(
            skeleton
        )
        posed = animation.sample(0.5, {}, Body(skeleton))
        assert posed.rotations == {}
        assert posed.root == pytest.approx(expected)


def test_an_animation_without_a_root_track_leaves_the_root_alone(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    assert read('<Rotation target="vc4" rotation="0;0;0"/>').sample(0.0, {}, Body(skeleton)).root is None


def test_feet_stay_in_place_while_the_root_sinks_and_turns(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    feet = "".join(
        f'<EndEffector target="{side}_ankle" translation="{x};0.1;0"/>' for side, x in (("l", 0.1), ("r", -0.1))
    )
    sinking = '<EndEffector target="root" local="true" translation="0;-0.3*t;0"/>'
    turning = '<Rotation target="HumanoidRoot" rotation="0;0.3*t;0"/>'
    animation = read(feet + sinking + turning).fitted_to(skeleton)
    for phase in (0.2, 0.6, 1.0):
        posed = animation.sample(phase, {}, Body(skeleton))
        moved = Body(skeleton).posed(posed.rotations, posed.root)
        assert moved.transform("l_ankle").position == pytest.approx((0.1, 0.1, 0.0), abs=1e-6)
        assert moved.transform("r_ankle").position == pytest.approx((-0.1, 0.1, 0.0), abs=1e-6)


def test_mirroring_exchanges_the_feet_and_the_side_of_the_root(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    root = '<EndEffector target="root" local="true" translation="0.1;-0.2;0.05"/>'
    foot = '<EndEffector target="r_ankle" local="true" translation="-0.05;-0.6;0.1" swivel="0.3"/>'
    animation = read(root + foot).fitted_to(skeleton)
    plain, mirrored = (each.sample(0.0, {}, Body(skeleton)) for each in (animation, animation.mirrored()))
    assert mirrored.root == pytest.approx((-0.1, -0.2, 0.05))
    for joint in ("hip", "knee", "ankle"):
        w, x, y, z = plain.rotations[f"r_{joint}"]
        assert mirrored.rotations[f"l_{joint}"] == pytest.approx((w, x, -y, -z), abs=0.02)


def test_an_animation_restricted_to_the_root_moves_only_the_root(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    root = '<EndEffector target="root" local="true" translation="0.1;-0.2;0.05"/>'
    animation = (
        read(root + '<Rotation target="vc4" rotation="1;0;0"/>')
        .restricted_to(frozenset({"HumanoidRoot"}))
        .fitted_to(skeleton)
    )
    posed = animation.sample(0.0, {}, Body(skeleton))
    assert (posed.rotations, posed.root) == ({}, (0.1, -0.2, 0.05))


def test_an_animation_restricted_to_the_neck_does_not_move_the_root(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton
) -> None:
    root = '<EndEffector target="root" local="true" translation="0.1;-0.2;0.05"/>'
    animation = (
        read(root + '<Rotation target="vc4" rotation="1;0;0"/>').restricted_to(frozenset({"vc4"})).fitted_to(skeleton)
    )
    assert animation.sample(0.0, {}, Body(skeleton)).root is None


@pytest.mark.parametrize("side", ["l", "r"])
@pytest.mark.parametrize(("above", "missing"), [(-0.005, None), (0.1, 0.1), (1.0, 1.0)])
def test_missing_a_global_goal_by_more_than_a_centimeter_is_reported(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton, side: str, above: float, missing: float | None
) -> None:
    limb, shoulder = Arm.of(skeleton, side), Body(skeleton).transform(f"{side}_shoulder").position
    x, y, z = add(shoulder, (0.0, 0.0, limb.reach + above))
    fault = (
        read(f'<EndEffector target="{side}_wrist" translation="{x};{y};{z}"/>').sample(0.3, {}, Body(skeleton)).fault
    )
    if missing is None:
        assert fault is None
    else:
        assert fault
        assert fault.code == "not-reachable"
        assert fault.details["joint"] == f"{side}_wrist"
        assert fault.details["phase"] == 0.3
        assert fault.details["distance"] == pytest.approx(missing, abs=0.012)


@pytest.mark.parametrize("side", ["l", "r"])
def test_a_leg_that_is_too_short_for_its_goal_is_reported(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton, side: str
) -> None:
    animation = read(f'<EndEffector target="{side}_ankle" translation="0;-0.3;0"/>').fitted_to(skeleton)
    fault = animation.sample(0.0, {}, Body(skeleton)).fault
    assert fault
    assert fault.details["joint"] == f"{side}_ankle"


@pytest.mark.parametrize(("stretch", "told"), [(1.0, False), (1.45, False), (1.6, True)])
def test_a_local_goal_may_be_that_of_an_arm_half_as_long_again(
    read: Callable[..., ProceduralAnimation], skeleton: Skeleton, stretch: float, told: bool
) -> None:
    far = stretch * Arm.of(skeleton, "l").reach
    posed = read(f'<EndEffector target="l_wrist" local="true" translation="0;0;{far}"/>').sample(
        0.0, {}, Body(skeleton)
    )
    assert (posed.fault is not None) is told


@pytest.mark.parametrize(
    "make",
    [
        lambda file, _: ProceduralMotionUnit(file, {}, LayerKind.GESTURE),
        lambda file, rest: GestureMotionUnit(file, {}, rest),
    ],
)
def test_a_motion_reports_a_missed_goal_only_when_it_is_shown(
    read: Callable[..., ProceduralAnimation],
    skeleton: Skeleton,
    make: Callable[[ProceduralAnimation, Body], MotionUnit],
) -> None:
    body = Body(skeleton)
    motion = make(read('<EndEffector target="l_wrist" translation="0;3;0"/>').fitted_to(skeleton), body)
    motion.pose(Moment(0.5, GlobalTime(0.0), body))
    hidden = motion.fault
    assert hidden is None
    for phase in (0.5, 0.6):
        motion.pose(Moment(phase, GlobalTime(0.0), body, body))
    assert motion.fault
    assert motion.fault.code == "not-reachable"
