"""Other ways to simulate a figure with moving limbs, to which `benchmarks.physics` compares mixed dynamics."""

from collections.abc import Callable, Collection

import mujoco
import numpy as np
from lxml import etree
from numpy.typing import NDArray

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.physics.mjcf import mjcf
from reactive_realizer.physics.simulation import Simulation

_LARGEST = 1e3
"""Velocities above this are those of a simulation that has become unstable, m/s or rad/s."""


def lagged_momentum(
    motion: Callable[[float], Body],
    kinematic: Collection[str],
    step: float,
    seconds: float,
    scale: float = 1.0,
    share: float = 1.0,
) -> float | None:
    """The largest angular momentum of a free-floating figure by the method of the thesis, kg m^2/s; None if unstable.

    Only the physical segments are simulated. Recursive Newton-Euler inverse dynamics (thesis 3.2 to 3.7) gives the
    forces that the kinematic ones exert on them, from the positions, velocities and accelerations of the kinematic
    joints, and from the acceleration that their base had in the previous step.

    Args:
        motion: the pose of the kinematic joints at a time, s.
        kinematic: joints, with all their descendants.
        step: time of a step, s.
        seconds: simulated.
        scale: k of the thesis: the forces are multiplied by it.
        share: of the latest acceleration of the base in the one that is used; the rest is from earlier steps.
    """
    skeleton = motion(0.0).skeleton
    whole, pose = (Simulation(skeleton, substep=step, floating=True) for _ in range(2))
    trunk = _without(skeleton, kinematic, step)
    data, base = whole.data, mujoco.MjData(trunk)
    moved = np.zeros(whole.model.nv, dtype=bool)
    placed = np.zeros(whole.model.nq, dtype=bool)
    for joint in kinematic:
        moved[whole.degrees(joint)] = True
        placed[whole.positions(joint)] = True
    forces, own, speeds = np.zeros(whole.model.nv), np.zeros(trunk.nv), np.zeros(whole.model.nv)
    acceleration, worst = np.zeros(trunk.nv), 0.0
    for number in range(round(seconds / step)):
        pose.place(motion((number + 1) * step))
        wanted = np.where(placed, pose.data.qpos, data.qpos)
        mujoco.mj_differentiatePos(whole.model, speeds, step, data.qpos, wanted)
        data.qacc[:] = (speeds - data.qvel) / step
        data.qacc[~moved] = base.qacc[:] = acceleration
        _newton_euler(whole.model, data, forces)
        _newton_euler(trunk, base, own)
        base.qfrc_applied[:] = scale * (own - forces[~moved])
        before = base.qvel.copy()
        mujoco.mj_step(trunk, base)
        if not np.abs(base.qvel).max() < _LARGEST:
            return None
        acceleration += share * ((base.qvel - before) / step - acceleration)
        data.qpos[placed], data.qpos[~placed] = wanted[placed], base.qpos
        data.qvel[moved], data.qvel[~moved] = speeds[moved], base.qvel
        worst = max(worst, float(np.linalg.norm(whole.angular_momentum())))
    return worst


def all_physical_momentum(
    motion: Callable[[float], Body], moved: Collection[str], step: float, seconds: float
) -> float:
    """The largest angular momentum of a free-floating figure of which all joints are physical, kg m^2/s.

    Args:
        motion: the pose of some joints at a time, s.
        moved: these joints. In each step, they have the torques that bring them into this pose.
        step: time of a step, s.
        seconds: simulated.
    """
    skeleton = motion(0.0).skeleton
    figure, pose = (Simulation(skeleton, substep=step, floating=True) for _ in range(2))
    figure.place(motion(0.0))
    model, data = figure.model, figure.data
    own = np.zeros(model.nv, dtype=bool)
    placed = np.zeros(model.nq, dtype=bool)
    for joint in moved:
        own[figure.degrees(joint)] = placed[figure.positions(joint)] = True
    inertia, speeds, torques, worst = np.zeros((model.nv, model.nv)), np.zeros(model.nv), np.zeros(model.nv), 0.0
    for number in range(1, round(seconds / step) + 1):
        pose.place(motion(number * step))
        mujoco.mj_differentiatePos(model, speeds, step, data.qpos, np.where(placed, pose.data.qpos, data.qpos))
        accelerations = (speeds - data.qvel)[own] / step
        mujoco.mj_forward(model, data)
        mujoco.mj_fullM(model, data, inertia)
        forces = data.qfrc_passive - data.qfrc_bias
        inertia += step * np.diag(model.dof_damping)  # as MuJoCo integrates it
        rest = np.linalg.solve(inertia[~own][:, ~own], forces[~own] - inertia[~own][:, own] @ accelerations)
        torques[own] = inertia[own][:, ~own] @ rest + inertia[own][:, own] @ accelerations - forces[own]
        figure.advance(motion(0.0), torques=torques)
        worst = max(worst, float(np.linalg.norm(figure.angular_momentum())))
    return worst


def _without(skeleton: Skeleton, joints: Collection[str], step: float) -> mujoco.MjModel:
    """The model of a figure without some segments."""
    element = etree.fromstring(mjcf(skeleton))
    for parent in [*element.iter("body")]:
        for body in parent.findall("body"):
            if body.get("name") in joints:
                parent.remove(body)
    model = mujoco.MjModel.from_xml_string(etree.tostring(element, encoding="unicode"))
    model.opt.timestep = step
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_GRAVITY | mujoco.mjtDisableBit.mjDSBL_CONTACT
    return model


def _newton_euler(model: mujoco.MjModel, data: mujoco.MjData, forces: NDArray[np.float64]) -> None:
    """Write the forces that give a state its accelerations."""
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_comVel(model, data)
    mujoco.mj_rne(model, data, 1, forces)
