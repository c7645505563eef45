"""Limbs that are switched between gesture and physics, of which `benchmarks.physics` measures the jumps."""

import math
from collections.abc import Iterator
from random import Random

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import Quat, difference, from_rotation_vector, rotation_vector
from reactive_realizer.engines.animation.physical_figure import PhysicalFigure
from reactive_realizer.physics.controllers.controller import RagdollController
from reactive_realizer.physics.simulation import SUBSTEP

_FRAME = SUBSTEP
"""A frame as short as a step: what forces change within it is small, and a jump is seen beside it."""

_FEWEST = 200
"""Frames that contain a switch at least."""

_ARMS = {side: tuple(f"{side}_{joint}" for joint in ("shoulder", "elbow", "wrist")) for side in SIDES}
_MEASURED = tuple(joint for arm in _ARMS.values() for joint in arm[:2])


def largest_jump(avatar: Avatar, seconds: float) -> dict[str, float]:
    """Return the largest jumps when arms become physical or kinematic at any time, while both of them gesture at 1 Hz.

    Args:
        avatar: of the figure.
        seconds: played.

    Returns:
        ``rad_s``: the change of the angular velocity of a shoulder or an elbow from the frame before a switch to the
        one after it, 2.5 ms later; ``rad``: the distance from where the joint would be at the same velocity. Both
        contain what gravity and the gesture change within a frame.
    """
    turns, switches = _play(avatar, max(_FEWEST, round(seconds / _FRAME)))
    velocities = np.array(turns) / _FRAME
    changes = np.linalg.norm(np.diff(velocities, axis=0), axis=2)
    most = max(float(changes[max(frame - 1, 0) : frame + 1].max()) for frame in switches)
    return {"rad": round(most * _FRAME, 4), "rad_s": round(most, 3)}


def _play(avatar: Avatar, frames: int) -> tuple[list[NDArray[np.float64]], list[int]]:
    """Return how far each measured joint turns in each frame, (J, 3) rad, and the frames that begin with a switch."""
    humanoid, turns, switches = Humanoid(avatar), [], []
    figure, before, was_loose = PhysicalFigure(humanoid), humanoid.shown, frozenset[str]()
    for frame, loose in zip(range(frames), _loose_arms(), strict=False):
        if loose != was_loose:
            switches.append(frame)
        was_loose = loose
        dynamics = figure.dynamics([RagdollController(_ARMS[side]) for side in sorted(loose)], ())
        time = GlobalTime(frame * _FRAME)
        humanoid.move(time, [Layer(LayerKind.GESTURE, _gesture(time))])
        if dynamics is not None:
            humanoid.simulate(dynamics)
        humanoid.look(None, ())
        turns.append(np.array([_turn(joint, before, humanoid.shown) for joint in _MEASURED]))
        before = humanoid.shown
    return turns, switches


def _loose_arms() -> Iterator[frozenset[str]]:
    """Yield the arms that are physical in each frame: none at first, then others every few frames."""
    random = Random(0)
    yield from (frozenset[str]() for _ in range(20))
    while True:
        loose = frozenset(side for side in SIDES if random.random() < 0.5)
        yield from (loose for _ in range(random.randint(24, 96)))


def _gesture(time: float) -> dict[str, Quat]:
    forth = math.sin(2.0 * math.pi * time)
    return {
        **{f"{side}_shoulder": from_rotation_vector((-0.5 + 0.5 * forth, 0.0, 0.0)) for side in SIDES},
        **{f"{side}_elbow": from_rotation_vector((-1.9 - 0.2 * forth, 0.0, 0.0)) for side in SIDES},
    }


def _turn(joint: str, before: Body, after: Body) -> tuple[float, float, float]:
    return rotation_vector(difference(before.rotation(joint), after.rotation(joint)))
