"""Compound controllers: several controllers as one (thesis 4.2.3, figure 4.2)."""

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, TypeVar

from reactive_realizer.embodiment.body import Body
from reactive_realizer.physics.controllers.controller import PhysicalController

if TYPE_CHECKING:
    from reactive_realizer.physics.simulation import Simulation

T = TypeVar("T")


class CompoundController(PhysicalController):
    """Several controllers as one.

    A parameter of a part is ``part:parameter``.

    Args:
        required: id -> part that is essential; all of its joints become physical.
        desired: id -> part that acts only if its joints are physical anyway.
    """

    def __init__(self, required: Mapping[str, PhysicalController], desired: Mapping[str, PhysicalController]) -> None:
        self._required, self._parts = required, {**required, **desired}
        self.joints = _joints(list(required.values()))
        self.desired = _joints(list(desired.values()))
        self.parameters = _named(self._parts, lambda part: part.parameters)
        self._given: Mapping[str, float] = self.parameters
        self.ranges = _named(self._parts, lambda part: part.ranges)

    def act(self, simulation: "Simulation", goal: Body, torques: list[float], damping: list[float]) -> None:
        """Let all parts act."""
        if self.parameters is not self._given:
            self._given = self.parameters
            for id_, part in self._parts.items():
                part.parameters = {name: self.parameters[f"{id_}:{name}"] for name in part.parameters}
        for part in self._parts.values():
            part.act(simulation, goal, torques, damping)


def _named(
    parts: Mapping[str, PhysicalController], values: Callable[[PhysicalController], Mapping[str, T]]
) -> dict[str, T]:
    """Return values of all parts by the names of their parameters."""
    return {f"{id_}:{name}": value for id_, part in parts.items() for name, value in values(part).items()}


def _joints(parts: Sequence[PhysicalController]) -> frozenset[str]:
    return frozenset(joint for part in parts for joint in part.joints)
