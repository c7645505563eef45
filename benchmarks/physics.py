"""Measures mixed dynamics: how well it conserves momentum, beside the method of the thesis, and what a step costs."""

import math
from collections.abc import Callable, Collection
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np

import reactive_realizer
from benchmarks._mixed_dynamics import all_physical_momentum, lagged_momentum
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.quaternion import from_rotation_vector
from reactive_realizer.physics.simulation import Simulation

AIMS = {"momentum_error.ours.2.5": 0.05}

_STEPS = {"5": 0.005, "2.5": 0.0025, "1": 0.001}
"""Times of a step, s, by their names, ms."""

_SETTINGS = {"as_published": (1.0, 1.0), "k_0.5": (0.5, 1.0), "averaged_0.3": (1.0, 0.3), "averaged_0.15": (1.0, 0.15)}
"""Settings of the baseline: the factor of the forces, and the share of the latest acceleration."""

_ARMS = tuple(f"{side}_{joint}" for side in SIDES for joint in ("shoulder", "elbow", "wrist"))
_AVATAR = Path(reactive_realizer.__file__).parent / "assets/avatars/male.glb"


def measure(seconds: float = 4.0) -> dict[str, object]:
    """The angular momentum of a free-floating figure that swings both arms at 1 Hz without gravity, and costs of steps.

    The momentum should be 0. It is given as a share of that of the swing while all else is held; None means that the
    simulation became unstable. ``all_physical`` is a figure with the same motion whose arms are moved by torques,
    which inverse dynamics gives for each step; its error is that of the integrator.

    Args:
        seconds: simulated.
    """
    swing = _swing()
    of_swing = _momentum(swing, _STEPS["2.5"], seconds, kinematic=None)
    return {
        "momentum_error": {
            "ours": {name: _share(_momentum(swing, step, seconds, _ARMS), of_swing) for name, step in _STEPS.items()},
            "all_physical": {
                name: _share(all_physical_momentum(swing, _ARMS, step, seconds), of_swing)
                for name, step in _STEPS.items()
            },
            "baseline": {
                name: {
                    setting: _share(lagged_momentum(swing, _ARMS, step, seconds, scale, share), of_swing)
                    for setting, (scale, share) in _SETTINGS.items()
                }
                for name, step in _STEPS.items()
            },
        },
        "us_per_step": {
            "arms_kinematic": _microseconds(swing, _ARMS, seconds),
            "one_arm_loose": _microseconds(swing, None, seconds, loose=_ARMS[:3]),
        },
    }


def _share(momentum: float | None, whole: float) -> float | None:
    return None if momentum is None else round(momentum / whole, 4)


def _swing() -> Callable[[float], Body]:
    """Both arms swing by 1 rad, with bending elbows and hands."""
    skeleton = Avatar.read(_AVATAR).skeleton

    def at(time: float) -> Body:
        phase = 2.0 * math.pi * time
        rotations = {}
        for side, out in zip(SIDES, (1.0, -1.0), strict=True):
            rotations[f"{side}_shoulder"] = from_rotation_vector((math.sin(phase), 0.0, 0.3 * out))
            rotations[f"{side}_elbow"] = from_rotation_vector((0.4 * math.cos(phase) - 0.4, 0.0, 0.0))
            rotations[f"{side}_wrist"] = from_rotation_vector((0.0, 0.0, 0.4 * math.sin(phase)))
        return Body(skeleton, rotations)

    return at


def _simulation(
    motion: Callable[[float], Body], step: float, kinematic: Collection[str] | None, floating: bool = True
) -> Simulation:
    """A figure with some kinematic joints, None for all, in the pose that its motion has at first."""
    simulation = Simulation(motion(0.0).skeleton, substep=step, floating=floating)
    simulation.place(motion(0.0))
    simulation.kinematic = simulation.joints if kinematic is None else kinematic
    return simulation


def _momentum(motion: Callable[[float], Body], step: float, seconds: float, kinematic: Collection[str] | None) -> float:
    """The largest angular momentum, kg m^2/s."""
    simulation, worst = _simulation(motion, step, kinematic), 0.0
    for number in range(1, round(seconds / step) + 1):
        simulation.advance(motion(number * step))
        worst = max(worst, float(np.linalg.norm(simulation.angular_momentum())))
    return worst


def _microseconds(
    motion: Callable[[float], Body], kinematic: Collection[str] | None, seconds: float, loose: Collection[str] = ()
) -> float:
    """The median processor time of a step of a figure on the ground, us."""
    step = _STEPS["2.5"]
    simulation = _simulation(motion, step, kinematic, floating=False)
    simulation.kinematic = set(simulation.kinematic).difference(loose)
    times = []
    for number in range(round(seconds / step)):
        body = motion(number * step)
        begin = perf_counter()
        simulation.advance(body)
        times.append(perf_counter() - begin)
    return round(1e6 * median(times), 1)
