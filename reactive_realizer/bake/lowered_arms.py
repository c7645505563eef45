"""The pose of a figure whose arms hang, in which clothes are fitted."""

import numpy as np

from reactive_realizer.bake.numeric import Array
from reactive_realizer.bake.rig import SIDES, Rig

_ANGLE = np.deg2rad(72)
"""By which the arms are lowered from the T-pose."""


class LoweredArms:
    """Takes vertices from the T-pose to this pose and back, by linear skinning."""

    def __init__(self, rig: Rig, weights: Array) -> None:
        """Prepare the motion of vertices with bone weights (v, joints)."""
        turns = np.tile(np.eye(3), (len(rig.names), 1, 1))
        moves = np.zeros((len(rig.names), 3))
        for side, sign in SIDES:
            shoulder, turn = rig.places[side + "Arm"], _about_z(-sign * _ANGLE)
            for joint in rig.columns(side + "Arm", side + "ForeArm", side + "Hand"):
                turns[joint], moves[joint] = turn, shoulder - turn @ shoulder
        self._turns, self._moves = np.einsum("vk,kij->vij", weights, turns), weights @ moves

    def apply(self, points: Array) -> Array:
        """Points (v, 3) of the T-pose in this pose, m."""
        return np.einsum("vij,vj->vi", self._turns, points) + self._moves

    def undo(self, points: Array) -> Array:
        """Points (v, 3) of this pose in the T-pose, m."""
        return np.linalg.solve(self._turns, (points - self._moves)[..., None])[..., 0]


def _about_z(angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
