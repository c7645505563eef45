"""Measures mixed dynamics: its cost, how well it conserves momentum, beside the method of the thesis, and its jumps."""

import math
from collections.abc import Callable, Collection
from pathlib import Path

import numpy as np

import reactive_realizer
from benchmarks._conductors import cores, tick_times
from benchmarks._mixed_dynamics import all_physical_momentum, lagged_momentum
from benchmarks._switches import largest_jump
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.quaternion import from_rotation_vector
from reactive_realizer.physics.simulation import Simulation

AIMS = {"momentum_error.ours.2.5": 0.05}

_CROWDS = (1, 10, 30, 100)
_TICK_US = 1e4
_STEPS_IN_TICK = {"2.5": 4, "5": 2}
"""Steps of a simulation in a tick, by the time of a step, ms."""

_FRAMES_MEASURED = 25

_STEPS = {"5": 0.005, "2.5": 0.0025, "1": 0.001}
"""Times of a step, s, by their names, ms."""

_SETTINGS = {"as_published": (1.0, 1.0), "k_0.5": (0.5, 1.0), "averaged_0.3": (1.0, 0.3), "averaged_0.15": (1.0, 0.15)}
"""Settings of the baseline: the factor of the forces, and the share of the latest acceleration."""

_ARMS = tuple(f"{side}_{joint}" for side in SIDES for joint in ("shoulder", "elbow", "wrist"))
_AVATAR = Path(reactive_realizer.__file__).parent / "assets/avatars/male.glb"


def measure(seconds: float = 4.0, most: int = _CROWDS[-1]) -> dict[str, object]:
    """The time of a tick with conductors, and how many run in real time; errors of the momentum; and jumps at switches.

    The momentum is the angular one of a free-floating figure that swings both arms at 1 Hz without gravity, which
    should be 0. It is given as a share of that of the swing while all else is held; None means that the simulation
    became unstable. ``all_physical`` is a figure with the same motion whose arms are moved by torques, which inverse
    dynamics gives for each step; its error is that of the integrator.

    Args:
        seconds: simulated for momentum and jumps.
        most: number of conductors; larger crowds have no result.
    """
    return {
        "us_per_tick": {str(size): _times(size) if size <= most else _NO_TIMES for size in _CROWDS},
        "realtime_characters": {name: _in_real_time(steps, most) for name, steps in _STEPS_IN_TICK.items()},
        "momentum_error": _momentum_errors(seconds),
        "switch_jump": largest_jump(Avatar.read(_AVATAR), seconds),
    }


_NO_TIMES = {"one_thread": None, "all": None}


def _times(size: int) -> dict[str, float]:
    """The time of a tick with conductors whose simulations share one thread, or have one a core, us."""
    one, several = tick_times(size, _STEPS_IN_TICK["2.5"], (1, cores()), _FRAMES_MEASURED)
    return {"one_thread": round(one), "all": round(several)}


def _in_real_time(steps: int, most: int) -> int:
    """The number of conductors that a tick has time for; measured with about as many."""
    found = 10
    for _ in range(2):
        size = min(most, max(1, found))
        (time,) = tick_times(size, steps, (cores(),), _FRAMES_MEASURED)
        found = int(size * _TICK_US / time)
    return found


def _momentum_errors(seconds: float) -> dict[str, object]:
    swing = _swing()
    of_swing = _momentum(swing, _STEPS["2.5"], seconds, kinematic=None)
    return {
        "ours": {name: _share(_momentum(swing, step, seconds, _ARMS), of_swing) for name, step in _STEPS.items()},
        "all_physical": {
            name: _share(all_physical_momentum(swing, _ARMS, step, seconds), of_swing) for name, step in _STEPS.items()
        },
        "baseline": {
            name: {
                setting: _share(lagged_momentum(swing, _ARMS, step, seconds, scale, share), of_swing)
                for setting, (scale, share) in _SETTINGS.items()
            }
            for name, step in _STEPS.items()
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


def _momentum(motion: Callable[[float], Body], step: float, seconds: float, kinematic: Collection[str] | None) -> float:
    """The largest angular momentum of a figure with some kinematic joints, None for all, kg m^2/s."""
    simulation, worst = Simulation(motion(0.0).skeleton, substep=step, floating=True), 0.0
    simulation.place(motion(0.0))
    simulation.kinematic = simulation.joints if kinematic is None else kinematic
    for number in range(1, round(seconds / step) + 1):
        simulation.advance(motion(number * step))
        worst = max(worst, float(np.linalg.norm(simulation.angular_momentum())))
    return worst
