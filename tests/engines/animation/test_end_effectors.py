"""Where the limbs and the root of a ProcAnimation are."""

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import (
    IDENTITY,
    angle,
    from_axis_angle,
    from_euler,
    rotate,
)
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import add, dot, subtract
from reactive_realizer.engines.animation.arms.gesture_motion_unit import GestureMotionUnit
from reactive_realizer.engines.animation.motion_unit import Moment
from reactive_realizer.engines.animation.procedural.proc_motion_unit import ProcMotionUnit


@pytest.mark.parametrize("side", ["l", "r"])
def test_a_local_end_effector_brings_the_wrist_to_a_place_from_the_shoulder_that_leans_with_the_trunk(
    read, skeleton, side
):
    animation = read(f'<EndEffector target="{side}_wrist" local="true" translation="0.05;-0.2;0.25" swivel="0.3"/>')
    for lean in (IDENTITY, from_axis_angle((1.0, 0.0, 0.0), 0.4)):
        body = Body(skeleton, {"vl5": lean})
        moved = body.posed(animation.sample(0.0, {}, body).rotations)
        way = subtract(moved.place(f"{side}_wrist").position, moved.place(f"{side}_shoulder").position)
        assert way == pytest.approx(rotate(lean, (0.05, -0.2, 0.25)), abs=1e-6)


@pytest.mark.parametrize("side", ["l", "r"])
def test_an_end_effector_that_is_not_local_brings_the_wrist_to_a_place_above_the_ground(read, skeleton, side):
    x = 0.15 if side == "l" else -0.15
    animation = read(f'<EndEffector target="{side}_wrist" local="false" translation="{x};1.15;0.3"/>')
    body = Body(skeleton, {"vl5": from_axis_angle((0.0, 1.0, 0.0), 0.2)})
    moved = body.posed(animation.sample(0.0, {}, body).rotations)
    assert moved.place(f"{side}_wrist").position == pytest.approx((x, 1.15, 0.3), abs=1e-6)


def test_the_forearm_makes_half_of_the_wrists_twist_and_the_hand_stays_as_it_is(read, skeleton):
    arm = '<EndEffector target="l_wrist" local="true" translation="0;-0.2;0.25"/>'
    plain, twisted = (
        read(arm + f'<Rotation target="l_wrist" rotation="0;{twist};0"/>').sample(0.0, {}, Body(skeleton)).rotations
        for twist in (0.0, 1.2)
    )
    assert angle(twisted["l_wrist"]) == pytest.approx(0.6, abs=1e-6)
    before, after = (Body(skeleton, pose).place("l_wrist") for pose in (plain, twisted))
    assert before.position == pytest.approx(after.position, abs=1e-9)
    assert rotate(before.rotation, rotate(from_euler(0.0, 1.2, 0.0), (1.0, 0.0, 0.0))) == pytest.approx(
        rotate(after.rotation, (1.0, 0.0, 0.0)), abs=1e-6
    )


@pytest.mark.parametrize("side", ["l", "r"])
def test_an_ankle_comes_to_its_place_above_the_ground_and_its_foot_stays_flat(read, skeleton, side):
    x = 0.15 if side == "l" else -0.15
    animation = read(f'<EndEffector target="{side}_ankle" translation="{x};0.25;0.2" swivel="0.2"/>').on(skeleton)
    body = Body(skeleton, {"HumanoidRoot": from_euler(0.1, 0.3, 0.05)})
    moved = body.posed(animation.sample(0.0, {}, body).rotations)
    foot = moved.place(f"{side}_ankle")
    assert foot.position == pytest.approx((x, 0.25, 0.2), abs=1e-6)
    assert rotate(foot.rotation, (0.0, 1.0, 0.0)) == pytest.approx((0.0, 1.0, 0.0), abs=1e-9)
    knee, shank = moved.place(f"{side}_knee")
    toes = rotate(foot.rotation, (0.0, 0.0, 1.0))
    assert dot(toes, rotate(shank, (1.0, 0.0, 0.0))) == pytest.approx(0.0, abs=1e-9)
    assert toes[2] > 0.8
    assert knee[2] > max(moved.place(f"{side}_hip").position[2], foot.position[2])


@pytest.mark.parametrize("side", ["l", "r"])
def test_a_local_ankle_is_placed_from_the_hip_in_the_axes_of_the_pelvis(read, skeleton, side):
    animation = read(f'<EndEffector target="{side}_ankle" local="true" translation="0.05;-0.6;0.2"/>').on(skeleton)
    turn = from_euler(0.2, 0.5, 0.0)
    body = Body(skeleton, {"HumanoidRoot": turn})
    moved = body.posed(animation.sample(0.0, {}, body).rotations)
    way = subtract(moved.place(f"{side}_ankle").position, moved.place(f"{side}_hip").position)
    assert way == pytest.approx(rotate(turn, (0.05, -0.6, 0.2)), abs=1e-6)


def test_a_foot_is_turned_otherwise_if_the_file_says_so(read, skeleton):
    leg = '<EndEffector target="l_ankle" translation="0.1;0.3;0.1"/>'
    animation = read(leg + '<Rotation target="l_ankle" rotation="0.4;0;0"/>').on(skeleton)
    assert animation.sample(0.0, {}, Body(skeleton)).rotations["l_ankle"] == from_euler(0.4, 0.0, 0.0)


def test_a_figure_whose_ankles_are_where_they_are_anyhow_stands_as_it_stood(read, skeleton):
    body = Body(skeleton)
    left, right = (body.place(f"{side}_ankle").position for side in "lr")
    animation = read(
        f'<EndEffector target="l_ankle" translation="{left[0]};{left[1]};{left[2]}"/>'
        f'<EndEffector target="r_ankle" translation="{right[0]};{right[1]};{right[2]}"/>'
    )
    moved = body.posed(animation.on(skeleton).sample(0.0, {}, body).rotations)
    for joint, place in (("l_ankle", left), ("r_ankle", right)):
        assert moved.place(joint).position == pytest.approx(place, abs=0.002)


@pytest.mark.parametrize("name", ["root", "HumanoidRoot"])
def test_the_root_is_at_a_place_above_the_ground_or_moved_from_its_own(read, skeleton, name):
    at_rest = skeleton.offset("HumanoidRoot")
    for local, expected in (("false", subtract((0.1, 0.8, 0.2), at_rest)), ("true", (0.1, 0.8, 0.2))):
        animation = read(f'<EndEffector target="{name}" local="{local}" translation="0.1;1.6*t;0.2"/>').on(skeleton)
        posed = animation.sample(0.5, {}, Body(skeleton))
        assert (posed.rotations, posed.root) == ({}, pytest.approx(expected))


def test_an_animation_that_says_nothing_of_the_root_leaves_it_alone(read, skeleton):
    assert read('<Rotation target="vc4" rotation="0;0;0"/>').sample(0.0, {}, Body(skeleton)).root is None


def test_feet_stay_where_they_are_while_the_root_sinks_and_turns(read, skeleton):
    feet = "".join(
        f'<EndEffector target="{side}_ankle" translation="{x};0.1;0"/>' for side, x in (("l", 0.1), ("r", -0.1))
    )
    sinking = '<EndEffector target="root" local="true" translation="0;-0.3*t;0"/>'
    turning = '<Rotation target="HumanoidRoot" rotation="0;0.3*t;0"/>'
    animation = read(feet + sinking + turning).on(skeleton)
    for phase in (0.2, 0.6, 1.0):
        posed = animation.sample(phase, {}, Body(skeleton))
        moved = Body(skeleton).posed(posed.rotations, posed.root)
        assert moved.place("l_ankle").position == pytest.approx((0.1, 0.1, 0.0), abs=1e-6)
        assert moved.place("r_ankle").position == pytest.approx((-0.1, 0.1, 0.0), abs=1e-6)


def test_in_the_mirror_the_root_goes_to_the_other_side_and_the_left_foot_does_what_the_right_one_did(read, skeleton):
    root = '<EndEffector target="root" local="true" translation="0.1;-0.2;0.05"/>'
    foot = '<EndEffector target="r_ankle" local="true" translation="-0.05;-0.6;0.1" swivel="0.3"/>'
    animation = read(root + foot).on(skeleton)
    plain, mirrored = (each.sample(0.0, {}, Body(skeleton)) for each in (animation, animation.mirrored()))
    assert mirrored.root == pytest.approx((-0.1, -0.2, 0.05))
    for joint in ("hip", "knee", "ankle"):
        w, x, y, z = plain.rotations[f"r_{joint}"]
        assert mirrored.rotations[f"l_{joint}"] == pytest.approx((w, x, -y, -z), abs=0.02)


def test_of_an_animation_confined_to_the_root_the_root_alone_moves(read, skeleton):
    root = '<EndEffector target="root" local="true" translation="0.1;-0.2;0.05"/>'
    animation = read(root + '<Rotation target="vc4" rotation="1;0;0"/>').of(frozenset({"HumanoidRoot"})).on(skeleton)
    posed = animation.sample(0.0, {}, Body(skeleton))
    assert (posed.rotations, posed.root) == ({}, (0.1, -0.2, 0.05))


def test_of_an_animation_confined_to_the_neck_the_root_stays(read, skeleton):
    root = '<EndEffector target="root" local="true" translation="0.1;-0.2;0.05"/>'
    animation = read(root + '<Rotation target="vc4" rotation="1;0;0"/>').of(frozenset({"vc4"})).on(skeleton)
    assert animation.sample(0.0, {}, Body(skeleton)).root is None


@pytest.mark.parametrize("side", ["l", "r"])
@pytest.mark.parametrize(("above", "missing"), [(-0.005, None), (0.1, 0.1), (1.0, 1.0)])
def test_what_is_missing_to_a_place_in_the_figures_frame_is_told_from_a_centimeter_on(
    read, skeleton, side, above, missing
):
    limb, shoulder = Arm.of(skeleton, side), Body(skeleton).place(f"{side}_shoulder").position
    x, y, z = add(shoulder, (0.0, 0.0, limb.reach + above))
    fault = (
        read(f'<EndEffector target="{side}_wrist" translation="{x};{y};{z}"/>').sample(0.3, {}, Body(skeleton)).fault
    )
    if missing is None:
        assert fault is None
    else:
        assert fault.code == "not-reachable"
        assert fault.details["joint"] == f"{side}_wrist"
        assert fault.details["phase"] == 0.3
        assert fault.details["distance"] == pytest.approx(missing, abs=0.012)


@pytest.mark.parametrize("side", ["l", "r"])
def test_nor_is_a_foot_in_the_air_where_the_leg_is_too_short_without_a_word(read, skeleton, side):
    animation = read(f'<EndEffector target="{side}_ankle" translation="0;-0.3;0"/>').on(skeleton)
    assert animation.sample(0.0, {}, Body(skeleton)).fault.details["joint"] == f"{side}_ankle"


@pytest.mark.parametrize(("stretch", "told"), [(1.0, False), (1.45, False), (1.6, True)])
def test_a_place_seen_from_the_shoulder_may_be_that_of_an_arm_half_as_long_again(read, skeleton, stretch, told):
    far = stretch * Arm.of(skeleton, "l").reach
    posed = read(f'<EndEffector target="l_wrist" local="true" translation="0;0;{far}"/>').sample(
        0.0, {}, Body(skeleton)
    )
    assert (posed.fault is not None) is told


@pytest.mark.parametrize(
    "make",
    [
        lambda file, _: ProcMotionUnit(file, {}, LayerKind.GESTURE),
        lambda file, rest: GestureMotionUnit(file, {}, rest),
    ],
)
def test_a_motion_complains_of_what_it_shows_not_of_what_it_is_asked_that_it_would_show(read, skeleton, make):
    body = Body(skeleton)
    motion = make(read('<EndEffector target="l_wrist" translation="0;3;0"/>').on(skeleton), body)
    motion.pose(Moment(0.5, GlobalTime(0.0), body))
    assert motion.fault is None
    for phase in (0.5, 0.6):
        motion.pose(Moment(phase, GlobalTime(0.0), body, body))
    assert motion.fault.code == "not-reachable"
