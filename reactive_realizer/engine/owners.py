"""The units that own resources while others begin."""

from collections.abc import Iterable

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState


class Owners:
    """The units that others may exclude, by their resources and groups.

    Args:
        units: those that play, and those that ended since the last tick: in a late tick, they may have been playing
            when another unit was to begin.
    """

    def __init__(self, units: Iterable[PlanUnit]) -> None:
        self._order: dict[PlanUnit, int] = {}
        self._by_resource: dict[str, list[PlanUnit]] = {}
        self._by_group: dict[str, list[PlanUnit]] = {}
        self._accompanying: list[PlanUnit] = []
        for unit in units:
            self.add(unit)

    def add(self, unit: PlanUnit) -> None:
        """Add a unit that has begun."""
        self._order[unit] = len(self._order)
        for resource in unit.resources:
            self._by_resource.setdefault(resource, []).append(unit)
        if unit.group is not None:
            self._by_group.setdefault(unit.group, []).append(unit)
        if unit.accompanies:
            self._accompanying.append(unit)

    def kept_from(self, unit: PlanUnit, time: GlobalTime) -> frozenset[str]:
        """The resources that others keep from a unit at a time; what accompanies keeps none from what was asked for."""
        owned = self._by_resource.items()
        return frozenset(resource for resource, units in owned if any(_keeps(other, unit, time) for other in units))

    def excluded_by(self, unit: PlanUnit, time: GlobalTime) -> tuple[list[PlanUnit], list[PlanUnit]]:
        """The units that cannot play together with one that begins at a time: those that stay, and those that leave.

        Both are in the order in which they were added. A unit leaves if it only returns to rest, or accompanies others
        while the one that begins does not.
        """
        rivals = {other for resource in unit.resources for other in self._by_resource.get(resource, ())}
        rivals.update(self._by_group.get(unit.group or "", ()))
        rivals.update(self._order if unit.accompanies else self._accompanying)
        if not rivals:
            return [], []
        excluded = sorted((other for other in rivals if unit.excludes(other)), key=self._order.__getitem__)
        staying = [each for each in excluded if _keeps(each, unit, time)]
        leaving = [each for each in excluded if each.state is UnitState.IN_EXEC and each not in staying]
        return staying, leaving


def _keeps(unit: PlanUnit, other: PlanUnit, time: GlobalTime) -> bool:
    """Return whether a unit holds its resources at a time, rather than releasing them to another one that begins."""
    if unit.accompanies and not other.accompanies:
        return False
    asked = other.accompanies and not unit.accompanies
    match unit.state:
        case UnitState.IN_EXEC:
            return asked or not unit.subsiding(time)
        case UnitState.DONE:
            return not is_due(unit.points[-1].peg.value, time) and not unit.subsiding(time)
        case _:
            return False
