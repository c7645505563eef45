"""What a controller is, and the simplest of them."""

from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING

from reactive_realizer.embodiment.body import Body

if TYPE_CHECKING:
    from reactive_realizer.physics.simulation import Simulation


class PhysicalController(ABC):
    """Moves physical joints by torques.

    Attributes:
        joints: of segments, that it needs to be physical.
        desired: further joints that it moves if they are physical.
        parameters: name -> value; may change before any step.
        ranges: name of each parameter -> its lowest and highest value.
        fixed: names of parameters that are read only when it is made.
        failed: whether the simulation could not go on while it acted.
    """

    joints: frozenset[str]
    desired: frozenset[str] = frozenset()
    parameters: Mapping[str, float] = MappingProxyType({})
    ranges: Mapping[str, tuple[float, float]] = MappingProxyType({})
    fixed: frozenset[str] = frozenset()
    failed = False

    @abstractmethod
    def act(self, simulation: "Simulation", goal: Body, torques: list[float], damping: list[float]) -> None:
        """Add torques, Nm, and damping, Nms, of degrees of freedom to lists, (nv,), before a period.

        The torque at the end of the period counts, as in a stable PD controller (Tan, Liu and Turk 2011): the part of
        it that depends on velocities is damping, which MuJoCo integrates implicitly. What concerns kinematic joints has
        no effect.

        Args:
            simulation: the state of the figure.
            goal: its pose if no joint were physical.
            torques: on the degrees of freedom, in the axes of their segments.
            damping: of the degrees of freedom.
        """


class RagdollController(PhysicalController):
    """Lets joints hang loosely.

    Args:
        joints: of segments.
    """

    fixed = frozenset({"joints"})

    def __init__(self, joints: Collection[str]) -> None:
        self.joints = frozenset(joints)

    def act(self, simulation: "Simulation", goal: Body, torques: list[float], damping: list[float]) -> None:
        """Add nothing: the damping of joints and the springs at their limits are part of every simulation."""


class NoController(PhysicalController):
    """Moves nothing: it takes the place of another controller of its replacement group (thesis example 19)."""

    joints = frozenset()

    def act(self, simulation: "Simulation", goal: Body, torques: list[float], damping: list[float]) -> None:
        """Add nothing."""
