"""Controllers move physical joints (thesis 3.2.4 and 4.2.3)."""

import math

import pytest

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import LEGS, ROOT
from reactive_realizer.embodiment.quaternion import angle, difference, from_rotation_vector, rotation_vector
from reactive_realizer.errors import RealizerError
from reactive_realizer.physics.controllers.catalog import CONTROLLERS, new_controller
from reactive_realizer.physics.controllers.compound import CompoundController
from reactive_realizer.physics.controllers.controller import PhysicalController, RagdollController
from reactive_realizer.physics.simulation import Exploded, Simulation

from .skeletons import without

ARM = ("l_shoulder", "l_elbow", "l_wrist")


def simulated(skeleton: Skeleton, controller: PhysicalController, goal: Body, seconds: float) -> Simulation:
    """A simulation in which a controller has acted on its joints for some time."""
    simulation = Simulation(skeleton)
    simulation.place(Body(skeleton))
    simulation.kinematic = set(simulation.joints) - controller.joints
    for _ in range(round(seconds / 0.02)):
        simulation.advance(goal, (controller,), 8)
    return simulation


def off(simulation: Simulation, joint: str, goal: Body) -> float:
    """The angle between a joint and its pose in a body, degrees."""
    return math.degrees(angle(difference(simulation.rotation(joint), goal.rotation(joint))))


@pytest.mark.parametrize("stiffness", [1.0, 100.0])
def test_a_pose_controller_holds_joints_in_their_pose_however_stiff_it_is(skeleton: Skeleton, stiffness: float) -> None:
    goal = Body(skeleton, {"l_elbow": from_rotation_vector((-1.2, 0.0, 0.0))})
    controller = new_controller("PoseController", {"joints": " ".join(ARM)}, skeleton)
    controller.parameters = {**controller.parameters, "stiffnessmultiplier": stiffness}
    simulation = simulated(skeleton, controller, goal, 2.0)
    most = 25.0 if stiffness == 1.0 else 1.0
    assert all(off(simulation, joint, goal) < most for joint in ARM)


def test_a_hinge_is_held_about_its_axis_and_free_about_the_others(skeleton: Skeleton) -> None:
    controller = new_controller("HingeJointController", {"joint": "l_elbow", "axis": "0"}, skeleton)
    controller.parameters = {"angle": -1.0, "ks": 1000.0, "ds": 10.0}
    simulation = simulated(skeleton, controller, Body(skeleton), 1.5)
    assert rotation_vector(simulation.rotation("l_elbow"))[0] == pytest.approx(-1.0, abs=0.05)


def test_a_ball_joint_is_held_at_angles_about_three_axes(skeleton: Skeleton) -> None:
    controller = new_controller("BallJointController", {"joint": "l_shoulder"}, skeleton)
    angles = {"anglex": -0.5, "angley": 0.0, "anglez": 0.3}
    springs = {f"{name}{axis}": value for name, value in (("ks", 5000.0), ("ds", 50.0)) for axis in "xyz"}
    controller.parameters = {**angles, **springs}
    simulation = simulated(skeleton, controller, Body(skeleton), 1.5)
    assert rotation_vector(simulation.rotation("l_shoulder")) == pytest.approx((-0.5, 0.0, 0.3), abs=0.1)


def test_a_figure_balances_on_legs_that_bend(skeleton: Skeleton) -> None:
    controller = new_controller("BalanceController", {}, skeleton)
    controller.parameters = {**controller.parameters, "pelvisheight": 0.85}
    simulation = simulated(skeleton, controller, Body(skeleton), 2.5)
    legs = Body(skeleton).transform("l_hip").position[1]
    assert simulation.body(Body(skeleton)).transform("l_hip").position[1] == pytest.approx(0.87 * legs, rel=0.04)
    center, speed = simulation.center_of_mass()
    feet = [simulation.data.xpos[simulation.body_of(f"{side}_ankle")] for side in "lr"]
    assert abs(float(center[0]) - float(feet[0][0] + feet[1][0]) / 2.0) < 0.02
    assert max(map(abs, speed)) < 0.05


def test_a_desired_part_acts_only_if_others_make_its_joints_physical(skeleton: Skeleton) -> None:
    parts = {
        joint: new_controller("BallJointController", {"joint": joint}, skeleton) for joint in ("l_elbow", "l_wrist")
    }
    controller = CompoundController({"elbow": parts["l_elbow"]}, {"wrist": parts["l_wrist"]})
    assert controller.joints == {"l_elbow"}
    assert controller.desired == {"l_wrist"}
    stiff = {"wrist:anglex": 0.5, "wrist:ksx": 1000.0, "wrist:dsx": 10.0}
    controller.parameters = {**controller.parameters, **stiff}
    turned = []
    for others in ((), ("l_wrist",)):
        controller.joints = frozenset({"l_elbow", *others})
        simulation = simulated(skeleton, controller, Body(skeleton), 1.0)
        turned.append(rotation_vector(simulation.rotation("l_wrist"))[0])
    assert turned == pytest.approx([0.0, 0.5], abs=0.05)


@pytest.mark.parametrize("duration", [0.004, 0.02, 0.033])
def test_a_push_has_its_full_effect_however_short_it_is(skeleton: Skeleton, duration: float) -> None:
    simulation = Simulation(skeleton, floating=True)
    simulation.place(Body(skeleton))
    simulation.push(ROOT, (0.0, 0.0, 50.0), duration)
    for _ in range(4):
        simulation.advance(Body(skeleton), steps=8)
    _, (_, forward, _) = simulation.center_of_mass()
    assert -forward * simulation.mass == pytest.approx(50.0 * duration, rel=0.02)


def test_a_simulation_that_cannot_go_on_says_so(skeleton: Skeleton) -> None:
    simulation = Simulation(skeleton)
    simulation.push(ROOT, (0.0, 0.0, 1e12), 1.0)
    with pytest.raises(Exploded):
        simulation.advance(Body(skeleton), (RagdollController(simulation.joints),), 400)


def test_every_kind_of_controller_is_found_with_and_without_a_package(skeleton: Skeleton) -> None:
    for name in CONTROLLERS:
        for kind in (name, f"hmi.physics.controller.{name}"):
            controller = new_controller(kind, {"joint": "l_elbow"}, skeleton)
            assert set(controller.parameters) == set(controller.ranges)


def test_a_figure_without_legs_cannot_balance_but_lets_its_arms_hang(skeleton: Skeleton) -> None:
    bust = without(skeleton, LEGS)
    with pytest.raises(RealizerError, match=r"this character cannot balance: it lacks .*l_hip"):
        new_controller("BalanceController", {}, bust)
    raised = Body(bust, {"l_shoulder": from_rotation_vector((-1.0, 0.0, 0.0))})
    simulation = simulated(bust, RagdollController(ARM), raised, 3.0)
    assert off(simulation, "l_shoulder", Body(bust)) < 10.0
