"""Controllers of single joints: springs and dampers that hold them loosely in a pose (thesis 4.2.3)."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import from_euler
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.physics.controllers.controller import PhysicalController

if TYPE_CHECKING:
    from reactive_realizer.physics.simulation import Simulation

AXES = "xyz"

_ANGLE = (-3.2, 3.2)
_SPRING = (0.0, 1e4)
_DAMPER = (0.0, 1e3)

_USUAL_SPRING, _USUAL_DAMPER = 5.0, 0.5
"""Of a joint that hangs loosely, Nm/rad and Nms/rad."""


class BallJointController(PhysicalController):
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

    def act(self, simulation: "Simulation", goal: Body, torques: list[float], damping: list[float]) -> None:
        """Add the torques of the springs."""
        wanted = from_euler(*self._values("angle"))
        simulation.pull(self._joint, wanted, self._values("ks"), self._values("ds"), torques, damping)

    def _values(self, name: str) -> Vec3:
        values = self.parameters
        return (values[f"{name}x"], values[f"{name}y"], values[f"{name}z"])


class HingeJointController(PhysicalController):
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
        self._joint, self._axis = joint, axis
        self.parameters = {"angle": 0.0, "ks": _USUAL_SPRING, "ds": _USUAL_DAMPER}

    def act(self, simulation: "Simulation", goal: Body, torques: list[float], damping: list[float]) -> None:
        """Add the torque of the spring."""
        wanted = from_euler(*self._about_axis("angle"))
        simulation.pull(self._joint, wanted, self._about_axis("ks"), self._about_axis("ds"), torques, damping)

    def _about_axis(self, name: str) -> Vec3:
        x, y, z = (self.parameters[name] * (axis == self._axis) for axis in range(3))
        return (x, y, z)


class PoseController(PhysicalController):
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

    def act(self, simulation: "Simulation", goal: Body, torques: list[float], damping: list[float]) -> None:
        """Add the torques of the springs."""
        frequency = self._FREQUENCY * math.sqrt(self.parameters["stiffnessmultiplier"])
        for joint in self._held:
            simulation.hold(joint, goal, (frequency,) * 3, self.parameters["damping"], torques, damping)
