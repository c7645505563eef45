"""Controllers of single joints: springs and dampers that hold them loosely in a pose (thesis 4.2.3)."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import from_euler
from reactive_realizer.physics.controllers.controller import Controller
from reactive_realizer.physics.rotations import Array, turns

if TYPE_CHECKING:
    from reactive_realizer.physics.simulation import Simulation

AXES = "xyz"

_ANGLE = (-3.2, 3.2)
_SPRING = (0.0, 1e4)
_DAMPER = (0.0, 1e3)

_USUAL_SPRING, _USUAL_DAMPER = 5.0, 0.5
"""Of a joint that hangs loosely, Nm/rad and Nms/rad."""


class BallJointController(Controller):
    """Holds a joint at angles about its three axes by springs and dampers.

    Parameters for each axis a: ``anglea``, rad (Euler angles, x first), the stiffness ``ksa``, Nm/rad, and the damping
    ``dsa``, Nms/rad.

    Args:
        joint: of a segment.
    """

    ranges: Mapping[str, tuple[float, float]] = {
        f"{name}{axis}": limits
        for name, limits in (("angle", _ANGLE), ("ks", _SPRING), ("ds", _DAMPER))
        for axis in AXES
    }
    fixed = frozenset({"joint"})

    def __init__(self, joint: str) -> None:
        self.joints = frozenset({joint})
        self._joint = joint
        self.parameters = {
            **{f"angle{axis}": 0.0 for axis in AXES},
            **{f"ks{axis}": _USUAL_SPRING for axis in AXES},
            **{f"ds{axis}": _USUAL_DAMPER for axis in AXES},
        }

    def act(self, simulation: "Simulation", goal: Body, torques: Array, damping: Array) -> None:
        """Add the torques of the springs."""
        angles, springs, dampers = (self._values(name) for name in ("angle", "ks", "ds"))
        _spring(simulation, self._joint, angles, springs, dampers, torques, damping)

    def _values(self, name: str) -> Array:
        return np.array([self.parameters[f"{name}{axis}"] for axis in AXES])


class HingeJointController(Controller):
    """Holds a joint at an angle about one of its axes by a spring and a damper; about the others, it turns freely.

    Parameters: ``angle``, rad, its stiffness ``ks``, Nm/rad, and its damping ``ds``, Nms/rad.

    Args:
        joint: of a segment.
        axis: 0, 1 or 2 for x, y or z.
    """

    ranges: Mapping[str, tuple[float, float]] = {"angle": _ANGLE, "ks": _SPRING, "ds": _DAMPER}
    fixed = frozenset({"joint", "axis"})

    def __init__(self, joint: str, axis: int = 0) -> None:
        self.joints = frozenset({joint})
        self._joint, self._axis = joint, np.eye(3)[axis]
        self.parameters = {"angle": 0.0, "ks": _USUAL_SPRING, "ds": _USUAL_DAMPER}

    def act(self, simulation: "Simulation", goal: Body, torques: Array, damping: Array) -> None:
        """Add the torque of the spring."""
        angle, spring, damper = (self.parameters[name] * self._axis for name in ("angle", "ks", "ds"))
        _spring(simulation, self._joint, angle, spring, damper, torques, damping)


def _spring(
    simulation: "Simulation",
    joint: str,
    angles: Array,
    springs: Array,
    dampers: Array,
    torques: Array,
    damping: Array,
) -> None:
    """Add springs and dampers about the axes of a joint, which are stable however stiff (`Controller.act`)."""
    degrees = simulation.degrees(joint)
    now = simulation.data.qpos[np.newaxis, simulation.positions(joint)]
    (way,) = turns(now, np.array([from_euler(*angles.tolist())]))
    torques[degrees] += springs * way
    damping[degrees] += springs * simulation.period + dampers


class PoseController(Controller):
    """Holds joints in the pose of the animation, so that they follow it softly and give way to forces.

    Parameters: ``stiffnessmultiplier`` and ``damping``, 1 for critical.

    Args:
        joints: of segments, without the root.
    """

    ranges: Mapping[str, tuple[float, float]] = {"stiffnessmultiplier": (0.0, 100.0), "damping": (0.0, 5.0)}
    fixed = frozenset({"joints"})
    _FREQUENCY = 15.0

    def __init__(self, joints: tuple[str, ...]) -> None:
        self.joints = frozenset(joints)
        self._held = joints
        self.parameters = {"stiffnessmultiplier": 1.0, "damping": 1.0}

    def act(self, simulation: "Simulation", goal: Body, torques: Array, damping: Array) -> None:
        """Add the torques of the springs."""
        frequency = self._FREQUENCY * float(np.sqrt(self.parameters["stiffnessmultiplier"]))
        simulation.hold(self._held, goal, frequency, self.parameters["damping"], torques, damping)
