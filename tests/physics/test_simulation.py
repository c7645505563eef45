"""Mixed dynamics: joints that are moved, beside joints that move physically."""

import math
from collections.abc import Collection
from functools import partial
from importlib.resources import files
from pathlib import Path
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import ROOT, SIDES
from reactive_realizer.embodiment.quaternion import Quat, angle, difference, from_rotation_vector
from reactive_realizer.physics.controllers.controller import NoController
from reactive_realizer.physics.rotations import swing_and_twist
from reactive_realizer.physics.segments import LIMITS, SEGMENTS
from reactive_realizer.physics.simulation import Simulation

ARMS = tuple(f"{side}_{joint}" for side in SIDES for joint in ("shoulder", "elbow", "wrist"))
LEFT_ARM = ARMS[:3]
JOINTS = tuple(segment.joint for segment in SEGMENTS)
STEP = 0.0025
SOFT = 12.0
"""How far the weight of a fallen body may press joints beyond their limits, degrees."""
MALE = Avatar.read(Path(str(files("reactive_realizer"))) / "assets/avatars/male.glb").skeleton


def swing(skeleton: Skeleton, time: float) -> Body:
    """Both arms swing at 1 Hz, by 1 rad; the spine turns along, and the pelvis moves."""
    phase = 2.0 * math.pi * time
    rotations: dict[str, Quat] = {}
    for side in SIDES:
        rotations[f"{side}_shoulder"] = from_rotation_vector((math.sin(phase), 0.0, 0.0))
        rotations[f"{side}_elbow"] = from_rotation_vector((0.4 * math.cos(phase) - 0.4, 0.0, 0.0))
        rotations[f"{side}_wrist"] = from_rotation_vector((0.0, 0.0, 0.4 * math.sin(phase)))
    rotations["vl5"] = rotations["vt6"] = from_rotation_vector((0.0, 0.1 * math.sin(phase), 0.0))
    rotations[ROOT] = from_rotation_vector((0.0, 0.1 * math.sin(phase), 0.0))
    return Body(skeleton, rotations, (0.05 * math.sin(phase), 0.3, 0.0))


def momenta(skeleton: Skeleton, kinematic: Collection[str], step: float) -> NDArray[np.float64]:
    """The angular momenta of a second of a floating figure that swings, kg m^2/s."""
    simulation = Simulation(skeleton, substep=step, floating=True)
    simulation.place(swing(skeleton, 0.0))
    simulation.kinematic = kinematic
    found = []
    for number in range(1, round(1.0 / step) + 1):
        simulation.advance(swing(skeleton, number * step))
        found.append(np.linalg.norm(simulation.angular_momentum()))
    return np.array(found)


@given(st.sets(st.sampled_from(JOINTS)))
@settings(max_examples=10)
def test_any_set_of_kinematic_joints_follows_its_animation(kinematic: set[str]) -> None:
    simulation = Simulation(MALE)
    simulation.place(swing(MALE, 0.0))
    simulation.kinematic = kinematic
    for number in range(1, 41):
        simulation.advance(swing(MALE, number * STEP))
    everything_kinematic = Simulation(MALE)
    everything_kinematic.place(swing(MALE, 40 * STEP))
    for joint in JOINTS:
        off = angle(difference(simulation.rotation(joint), everything_kinematic.rotation(joint)))
        assert off < 1e-4 or joint not in kinematic
    if ROOT in kinematic:
        assert simulation.data.qpos[:3] == pytest.approx(everything_kinematic.data.qpos[:3])
    assert np.isfinite(simulation.data.qpos).all()


def test_the_momentum_of_a_floating_figure_stays_zero_but_for_the_error_of_the_integrator(skeleton: Skeleton) -> None:
    """Thesis 3.1; an error in proportion to the step is that of MuJoCo's semi-implicit Euler integrator."""
    of_swing = momenta(skeleton, JOINTS, STEP).max()
    error, half = (momenta(skeleton, ARMS, step).max() for step in (STEP, STEP / 2.0))
    assert error < 0.03 * of_swing
    assert half == pytest.approx(error / 2.0, rel=0.25)


def test_a_body_without_kinematic_joints_collapses_on_the_floor_within_its_limits(skeleton: Skeleton) -> None:
    simulation = Simulation(skeleton)
    for _ in range(1200):
        simulation.advance(Body(skeleton))
    body = simulation.body(Body(skeleton))
    assert body.transform("skullbase").position[1] < 0.5
    for joint in JOINTS:
        assert body.transform(joint).position[1] > -0.02
    for joint, limits in LIMITS.items():
        turned = np.degrees(swing_and_twist(simulation.rotation(joint)))
        assert (turned > np.array(limits.lowest) - SOFT).all(), joint
        assert (turned < np.array(limits.highest) + SOFT).all(), joint


@pytest.mark.parametrize("seed", range(8))
def test_a_limp_body_that_is_thrown_does_not_whip_at_the_limits_of_its_joints(seed: int) -> None:
    random = Random(seed)
    any_turn = partial(random.uniform, -1.0, 1.0)
    turns = {joint: from_rotation_vector((any_turn(), any_turn(), any_turn())) for joint in JOINTS}
    simulation = Simulation(MALE)
    simulation.place(Body(MALE, turns, (0.0, 0.3, 0.0)))
    simulation.push("vl5", (random.uniform(-400.0, 400.0), 0.0, random.uniform(-400.0, 400.0)), 0.2)
    fastest = []
    for _ in range(100):
        simulation.advance(Body(MALE), steps=8)
        fastest.append(float(np.abs(simulation.data.qvel[simulation.degrees(ROOT).stop :]).max()))
    # At first, joints return from poses beyond their limits.
    assert max(fastest[6:]) < 80.0


def test_a_loose_arm_falls_and_swings_ever_less(skeleton: Skeleton) -> None:
    raised = Body(skeleton, {"l_shoulder": from_rotation_vector((-1.0, 0.0, 0.0))})
    simulation = Simulation(skeleton)
    simulation.place(raised)
    simulation.kinematic = set(JOINTS).difference(LEFT_ARM)
    lowest = Body(skeleton).transform("l_wrist").position[1]
    heights = []
    for _ in range(round(2.0 / STEP)):
        simulation.advance(raised)
        heights.append(simulation.body(raised).transform("l_wrist").position[1] - lowest)
    forward, back = heights[0], max(heights[round(0.5 / STEP) : round(1.0 / STEP)])
    assert min(heights) == pytest.approx(0.0, abs=0.02)
    assert 0.2 * forward < back < 0.9 * forward


def test_a_joint_that_becomes_physical_keeps_its_pose_and_velocity(skeleton: Skeleton) -> None:
    simulation = Simulation(skeleton)
    simulation.place(swing(skeleton, 0.0))
    simulation.kinematic = JOINTS
    for number in range(1, 101):
        simulation.advance(swing(skeleton, number * STEP))
    before = simulation.data.qvel.copy()
    simulation.kinematic = set(JOINTS).difference(LEFT_ARM)
    simulation.advance(swing(skeleton, 101 * STEP))
    for joint in LEFT_ARM:
        moved = simulation.data.qvel[simulation.degrees(joint)] - before[simulation.degrees(joint)]
        assert np.abs(moved).max() < 0.5


def test_joints_within_the_spine_stay_as_they_are_animated(skeleton: Skeleton) -> None:
    animated = Body(
        skeleton, {"vt10": from_rotation_vector((0.2, 0.0, 0.0)), "vl5": from_rotation_vector((0.1, 0.0, 0.0))}
    )
    simulation = Simulation(skeleton)
    simulation.place(animated)
    body = simulation.body(animated)
    for joint in ("vl5", "vt10", "vt6", "skullbase", "l_wrist"):
        assert body.transform(joint).rotation == pytest.approx(animated.transform(joint).rotation)
    assert body.root == pytest.approx(animated.root, abs=1e-9)


def test_an_unknown_joint_cannot_be_kinematic(skeleton: Skeleton) -> None:
    with pytest.raises(KeyError, match="vt10"):
        Simulation(skeleton).kinematic = ["vt10"]


def test_reactions_are_scaled(skeleton: Skeleton) -> None:
    """The factor k of thesis 3.1: a trunk that floats is turned less by arms that swing."""

    class Factor(NoController):
        def __init__(self, factor: float) -> None:
            self.factor = factor

        def act(self, simulation: Simulation, *_: object) -> None:
            simulation.reaction = self.factor

    def turned(factor: float) -> float:
        simulation = Simulation(skeleton, floating=True)
        simulation.place(swing(skeleton, 0.0))
        simulation.kinematic = ARMS
        for number in range(1, 13):
            simulation.advance(swing(skeleton, number * 0.02), (Factor(factor),), 8)
        return angle(simulation.rotation(ROOT))

    half, whole, more = (turned(factor) for factor in (0.5, 1.0, 1.5))
    assert half < 0.7 * whole
    assert more > 1.2 * whole
